//! Line drawings of things in space: [`Sketch`].

use sparrow_math::{Real, Vec3, vec3};
use sparrow_plot::draw::page::Entry;
use sparrow_plot::draw::svg::{Anchor, Pen, Point, Svg, Type};
use sparrow_plot::draw::theme::{LIGHT, size};

use crate::chart::page;

/// A drawing on a page of the book, in parallel projection.
pub(crate) struct Sketch {
    svg: Svg,
    title: String,
    centre: Point,
    /// Pixels of a unit.
    scale: f64,
    /// Right, up and towards the viewer.
    axes: [Vec3<f64>; 3],
}

impl Sketch {
    /// Seen from the azimuth and elevation in degrees, z up; `reach` is what fits between centre and border.
    pub(crate) fn new(
        title: &str,
        subtitle: &str,
        legend: Vec<Entry>,
        [azimuth, elevation]: [f64; 2],
        reach: f64,
    ) -> Sketch {
        let (svg, area) = page(title, subtitle, legend).begin();
        let ((sa, ca), (se, ce)) =
            (Real::sin_cos(azimuth.to_radians()), Real::sin_cos(elevation.to_radians()));
        let axes = [vec3(-sa, ca, 0.0), vec3(-se * ca, -se * sa, ce), vec3(ce * ca, ce * sa, se)];
        let scale = 0.5 * (area.w.min(area.h) - 20.0) / reach;
        Sketch { svg, title: title.to_owned(), centre: area.centre(), scale, axes }
    }
    /// The same, moved to the right by `units`.
    pub(crate) fn moved(self, units: f64) -> Sketch {
        Sketch { centre: [self.centre[0] + units * self.scale, self.centre[1]], ..self }
    }
    /// Place on the page.
    pub(crate) fn at(&self, p: Vec3<f64>) -> Point {
        [self.centre[0] + self.scale * p.dot(self.axes[0]), self.centre[1] - self.scale * p.dot(self.axes[1])]
    }
    /// How near to the viewer a point is.
    pub(crate) fn depth(&self, p: Vec3<f64>) -> f64 {
        p.dot(self.axes[2])
    }
    /// A line through points.
    pub(crate) fn line(&mut self, points: &[Vec3<f64>], pen: Pen<'_>) {
        let points: Vec<Point> = points.iter().map(|p| self.at(*p)).collect();
        self.svg.polyline(&points, pen);
    }
    /// A line of which what lies behind the origin is faint.
    pub(crate) fn round(&mut self, points: &[Vec3<f64>], colour: &str, width: f64) {
        for ends in points.windows(2) {
            let pen = Pen::new(colour, width);
            let behind = self.depth(ends[0] + ends[1]) < 0.0;
            self.line(ends, if behind { Pen { colour: LIGHT.grid, ..pen } } else { pen });
        }
    }
    /// An arrow.
    pub(crate) fn arrow(&mut self, from: Vec3<f64>, to: Vec3<f64>, colour: &str, width: f64) {
        let ends = [self.at(from), self.at(to)];
        self.svg.arrow(ends[0], ends[1], Pen::new(colour, width));
    }
    /// A dot.
    pub(crate) fn dot(&mut self, p: Vec3<f64>, colour: &str) {
        let at = self.at(p);
        self.svg.dots(&[at], 4.5, colour, colour);
    }
    /// A text beside a point.
    pub(crate) fn label(&mut self, p: Vec3<f64>, text: &str) {
        let [x, y] = self.at(p);
        let right = x >= self.centre[0];
        let (dx, anchor) = if right { (9.0, Anchor::Start) } else { (-9.0, Anchor::End) };
        let style = Type::new(size::TICK, LIGHT.ink).anchor(anchor).halo(LIGHT.background);
        self.svg.text([x + dx, y + 0.3 * size::TICK], style, text);
    }
    /// The document.
    pub(crate) fn finish(self) -> String {
        self.svg.finish(&self.title)
    }
}

/// `n + 1` points of a curve over the whole turn.
pub(crate) fn turn(n: usize, f: impl Fn(f64, f64) -> Vec3<f64>) -> Vec<Vec3<f64>> {
    (0..=n)
        .map(|k| {
            let (s, c) = Real::sin_cos(core::f64::consts::TAU * k as f64 / n.max(1) as f64);
            f(c, s)
        })
        .collect()
}
