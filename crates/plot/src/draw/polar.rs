//! Lobes in a plane through the normal: [`Polar`].

use sparrow_math::Real;

use super::axis::{Axis, Scale};
use super::page::Page;
use super::simplify::simplify;
use super::svg::{Anchor, Pen, Point, Svg, Type};
use super::text::text_width;
use super::theme::{size, stroke};

/// A lobe: a length for every angle.
#[derive(Clone, Debug)]
pub struct Lobe {
    /// Which series it is, for its colour.
    pub series: usize,
    /// Angle from the upward direction in degrees, positive to the right, and length.
    pub points: Vec<[f64; 2]>,
    /// Angles in degrees of arrows that stand for something without a length, each with what is written at it.
    pub spikes: Vec<(f64, String)>,
}

/// An arrow that shows a given direction.
#[derive(Clone, Debug)]
pub struct Ray {
    /// Angle in degrees, as for lobes.
    pub angle: f64,
    /// What is written at its outer end.
    pub label: String,
    /// Drawn in the colour of this series; none for ink.
    pub series: Option<usize>,
    /// A dashed line instead of an arrow.
    pub faint: bool,
}

/// Lobes in a plane through the normal, which points up.
#[derive(Clone, Debug)]
pub struct Polar {
    /// What stands around it.
    pub page: Page,
    /// The lengths, from the centre to the rim.
    pub r: Axis,
    /// The whole disc instead of its upper half.
    pub full: bool,
    /// The lobes.
    pub lobes: Vec<Lobe>,
    /// Directions to be shown.
    pub rays: Vec<Ray>,
}

/// Place on the page of angle and distance.
#[derive(Clone, Copy)]
struct Disc {
    centre: Point,
    radius: f64,
}

impl Disc {
    /// `t` is 1 at the rim.
    fn at(&self, degrees: f64, t: f64) -> Point {
        let (s, c) = Real::sin_cos(degrees.to_radians());
        [self.centre[0] + self.radius * t * s, self.centre[1] - self.radius * t * c]
    }
    /// The arc from one angle to another at distance `t`.
    fn arc(&self, from: f64, to: f64, t: f64) -> Vec<Point> {
        let n = ((to - from).abs() / 3.0).ceil().max(1.0) as usize;
        (0..=n).map(|i| self.at(from + (to - from) * i as f64 / n as f64, t)).collect()
    }
}

impl Polar {
    /// The picture.
    pub fn svg(&self) -> String {
        let (mut svg, area) = self.page.begin();
        let plot = area.within([80.0, 58.0, 80.0, if self.full { 44.0 } else { 64.0 }]);
        let disc = if self.full {
            Disc { centre: plot.centre(), radius: 0.5 * plot.w.min(plot.h) }
        } else {
            let radius = (0.5 * plot.w).min(plot.h);
            Disc { centre: [plot.x + 0.5 * plot.w, plot.y + 0.5 * (plot.h + radius)], radius }
        };
        self.draw_grid(&mut svg, disc);
        for ray in self.rays.iter().filter(|r| r.faint) {
            self.draw_ray(&mut svg, disc, ray);
        }
        svg.clip_circle(disc.centre, disc.radius);
        for lobe in &self.lobes {
            self.draw_lobe(&mut svg, disc, lobe);
        }
        svg.end_group();
        self.draw_surface(&mut svg, disc);
        for lobe in &self.lobes {
            self.draw_spikes(&mut svg, disc, lobe);
        }
        for ray in self.rays.iter().filter(|r| !r.faint) {
            self.draw_ray(&mut svg, disc, ray);
        }
        svg.finish(&self.page.title)
    }

    /// The range of angles, in degrees.
    fn ends(&self) -> [f64; 2] {
        if self.full { [-180.0, 180.0] } else { [-90.0, 90.0] }
    }

    fn draw_grid(&self, svg: &mut Svg, disc: Disc) {
        let theme = &self.page.theme;
        let [lo, hi] = self.ends();
        for tick in self.r.ticks.iter().filter(|t| self.r.place(t.at) > 1e-6) {
            svg.polyline(&disc.arc(lo, hi, self.r.place(tick.at)), Pen::new(theme.grid, 1.2));
        }
        let (step, first) = (15.0, lo);
        let n = ((hi - lo) / step) as usize;
        for i in 0..=n {
            let angle = first + step * i as f64;
            if self.full && i == 0 {
                continue;
            }
            let major = i % 2 == 0;
            let inner = if major { 0.0 } else { 0.96 };
            svg.line(disc.at(angle, inner), disc.at(angle, 1.0), Pen::new(theme.grid, 1.2));
            if major {
                self.draw_angle(svg, disc, angle);
            }
        }
        svg.polyline(&disc.arc(lo, hi, 1.0), Pen::new(theme.soft, 1.5));
    }

    fn draw_angle(&self, svg: &mut Svg, disc: Disc, angle: f64) {
        let [x, y] = disc.at(angle, 1.0 + 16.0 / disc.radius);
        let sine = (x - disc.centre[0]) / disc.radius;
        let anchor = if sine > 0.2 {
            Anchor::Start
        } else if sine < -0.2 {
            Anchor::End
        } else {
            Anchor::Middle
        };
        let label = format!("{}°", super::ticks::label(angle, 1.0));
        let style = Type::new(size::TICK, self.page.theme.ink).anchor(anchor);
        svg.text([x, y + 0.35 * size::TICK], style, &label);
    }

    /// Surface, normal, and the numbers of the rings along the surface.
    fn draw_surface(&self, svg: &mut Svg, disc: Disc) {
        let theme = &self.page.theme;
        let [cx, cy] = disc.centre;
        svg.line([cx - disc.radius, cy], [cx + disc.radius, cy], Pen::new(theme.ink, 3.0));
        let place = |at: f64| cx + disc.radius * self.r.place(at);
        let mut free = f64::NEG_INFINITY;
        for tick in &self.r.ticks {
            let (x, w) = (place(tick.at), text_width(&tick.label, size::TICK));
            if x - 0.5 * w < free + 8.0 {
                continue;
            }
            free = x + 0.5 * w;
            svg.line([x, cy], [x, cy + 6.0], Pen::new(theme.ink, 1.5));
            let style = Type::new(size::TICK, theme.ink).anchor(Anchor::Middle).halo(theme.background);
            svg.text([x, cy + 8.0 + size::TICK], style, &tick.label);
        }
        let style = Type::new(size::AXIS, theme.ink).anchor(Anchor::Middle).halo(theme.background);
        svg.text([cx + 0.5 * disc.radius, cy + 17.0 + size::TICK + size::AXIS], style, &self.r.title);
    }

    fn draw_lobe(&self, svg: &mut Svg, disc: Disc, lobe: &Lobe) {
        let (colour, dash) = self.page.theme.series(lobe.series);
        let limit = if self.r.scale == Scale::Log { 0.0 } else { f64::NEG_INFINITY };
        let place = |p: &[f64; 2]| disc.at(p[0], self.r.place(p[1]).max(limit).clamp(0.0, 3.0));
        for run in lobe.points.split(|p| !p[1].is_finite()) {
            let points = simplify(&run.iter().map(place).collect::<Vec<_>>(), 0.1);
            let mut filled = points.clone();
            filled.push(disc.centre);
            svg.area(&filled, colour, 0.1);
            svg.polyline(&points, Pen::new(colour, stroke(lobe.series, self.lobes.len())).dashed(dash));
        }
    }

    fn draw_spikes(&self, svg: &mut Svg, disc: Disc, lobe: &Lobe) {
        let theme = &self.page.theme;
        let (colour, _) = theme.series(lobe.series);
        for (angle, label) in &lobe.spikes {
            // Series of the same direction stay apart: each reaches a little less far than the one before.
            let reach = 0.94 - 0.1 * (lobe.series % 6) as f64;
            let tip = disc.at(*angle, reach);
            svg.arrow(disc.centre, tip, Pen::new(colour, 3.5));
            let right = tip[0] >= disc.centre[0];
            let (dx, anchor) = if right { (12.0, Anchor::Start) } else { (-12.0, Anchor::End) };
            let style = Type::new(size::TICK, colour).bold().anchor(anchor).halo(theme.background);
            svg.text([tip[0] + dx, tip[1] + 10.0], style, label);
        }
    }

    fn draw_ray(&self, svg: &mut Svg, disc: Disc, ray: &Ray) {
        let theme = &self.page.theme;
        let colour = ray.series.map_or(theme.ink, |i| theme.series(i).0);
        if ray.faint {
            let pen = Pen::new(colour, 1.5).dashed("6 6");
            svg.line(disc.centre, disc.at(ray.angle, 1.0), pen);
        } else {
            svg.arrow(disc.centre, disc.at(ray.angle, 1.0 - 1.0 / disc.radius), Pen::new(colour, 2.5));
        }
        if ray.label.is_empty() {
            return;
        }
        // Outside the numbers of the angles.
        // They reach far where they stand beside the disc; there the label moves a little along the rim.
        let off = ray.angle - 30.0 * (ray.angle / 30.0).round();
        let beside = off.abs() < 5.0 && (15.0..=165.0).contains(&ray.angle.abs());
        let towards = if (ray.angle.abs() > 90.0) == (ray.angle > 0.0) { 1.0 } else { -1.0 };
        let angle = if beside { ray.angle - off + 7.0 * towards } else { ray.angle };
        let [x, y] = disc.at(angle, 1.0 + 42.0 / disc.radius);
        let anchor = if (x - disc.centre[0]).abs() < 0.2 * disc.radius {
            Anchor::Middle
        } else if x > disc.centre[0] {
            Anchor::Start
        } else {
            Anchor::End
        };
        let style = Type::new(size::AXIS, colour).bold().anchor(anchor);
        svg.text([x, y + 0.3 * size::AXIS], style, &ray.label);
    }
}
