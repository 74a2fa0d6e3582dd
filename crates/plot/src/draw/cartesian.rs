//! Lines over a Cartesian plane: [`Cartesian`].

use super::axis::{Axis, Scale};
use super::page::{Area, Page};
use super::simplify::simplify;
use super::svg::{Anchor, Pen, Point, Svg, Type};
use super::theme::{size, stroke};

/// A line through points.
#[derive(Clone, Debug)]
pub struct Line {
    /// Which series it is, for its colour.
    pub series: usize,
    /// Abscissa and ordinate; a point that is not finite breaks the line.
    pub points: Vec<[f64; 2]>,
    /// Places of arrows that stand for something without a height, each with what is written at it.
    pub spikes: Vec<(f64, String)>,
}

/// A vertical rule.
#[derive(Clone, Debug)]
pub struct Rule {
    /// Where.
    pub at: f64,
    /// What is written at its upper end.
    pub label: String,
}

/// Lines over a Cartesian plane.
#[derive(Clone, Debug)]
pub struct Cartesian {
    /// What stands around it.
    pub page: Page,
    /// The abscissa.
    pub x: Axis,
    /// The ordinate.
    pub y: Axis,
    /// The lines.
    pub lines: Vec<Line>,
    /// Rules behind the lines.
    pub rules: Vec<Rule>,
}

impl Cartesian {
    /// The picture.
    pub fn svg(&self) -> String {
        let (mut svg, area) = self.page.begin();
        let top = if self.rules.is_empty() { 12.0 } else { 30.0 };
        let plot = area.within([104.0, top, 36.0, 66.0]);
        axes(&mut svg, &self.page, plot, [&self.x, &self.y], true);
        let theme = &self.page.theme;
        let at = |p: [f64; 2]| to_page(plot, &self.x, &self.y, p);
        for rule in &self.rules {
            let [x, _] = at([rule.at, self.y.lo]);
            svg.line([x, plot.y], [x, plot.y + plot.h], Pen::new(theme.soft, 1.5).dashed("5 5"));
            let style = Type::new(size::TICK, theme.soft).anchor(Anchor::Middle);
            svg.text([x, plot.y - 8.0], style, &rule.label);
        }
        svg.clip_rect([plot.x, plot.y], [plot.w, plot.h]);
        for line in &self.lines {
            let (colour, dash) = theme.series(line.series);
            for run in line.points.split(|p| !(p[0].is_finite() && p[1].is_finite())) {
                let points: Vec<Point> = run.iter().map(|p| at(*p)).map(|p| near(p, plot)).collect();
                let pen = Pen::new(colour, stroke(line.series, self.lines.len())).dashed(dash);
                svg.polyline(&simplify(&points, 0.15), pen);
            }
        }
        svg.end_group();
        self.draw_spikes(&mut svg, plot);
        svg.finish(&self.page.title)
    }

    fn draw_spikes(&self, svg: &mut Svg, plot: Area) {
        let theme = &self.page.theme;
        let mut n = 0.0;
        for line in &self.lines {
            let (colour, _) = theme.series(line.series);
            for (at, label) in &line.spikes {
                let x = plot.x + plot.w * self.x.place(*at);
                let tip = plot.y + 24.0 + 26.0 * n;
                svg.arrow([x, plot.y + plot.h], [x, tip], Pen::new(colour, 3.0));
                let left = x > plot.x + 0.6 * plot.w;
                let (dx, anchor) = if left { (-10.0, Anchor::End) } else { (10.0, Anchor::Start) };
                let style = Type::new(size::TICK, colour).anchor(anchor).halo(theme.background);
                svg.text([x + dx, tip + 14.0], style, label);
                n += 1.0;
            }
        }
    }
}

fn to_page(plot: Area, x: &Axis, y: &Axis, p: [f64; 2]) -> Point {
    [plot.x + plot.w * x.place(p[0]), plot.y + plot.h * (1.0 - y.place(p[1]))]
}

/// Brought near the plot: what lies far outside would only make numbers long.
fn near(p: Point, plot: Area) -> Point {
    [p[0], p[1].clamp(plot.y - 400.0, plot.y + plot.h + 400.0)]
}

/// Grid where wanted, frame, ticks and titles around a plot.
pub(super) fn axes(svg: &mut Svg, page: &Page, plot: Area, [x, y]: [&Axis; 2], gridded: bool) {
    let theme = &page.theme;
    let (right, bottom) = (plot.x + plot.w, plot.y + plot.h);
    let grid = Pen::new(theme.grid, 1.0);
    if y.scale == Scale::Log && y.ticks.len() < 9 {
        for v in minor(y) {
            let h = bottom - plot.h * y.place(v);
            svg.line([plot.x - 4.0, h], [plot.x, h], Pen::new(theme.ink, 1.0));
        }
    }
    for tick in &y.ticks {
        let h = bottom - plot.h * y.place(tick.at);
        if gridded {
            svg.line([plot.x, h], [right, h], grid);
        }
        svg.line([plot.x - 7.0, h], [plot.x, h], Pen::new(theme.ink, 1.5));
        let style = Type::new(size::TICK, theme.ink).anchor(Anchor::End);
        svg.text([plot.x - 12.0, h + 0.35 * size::TICK], style, &tick.label);
    }
    // Numbers that would touch their neighbours are left out.
    let every = (x.ticks.len() as f64 * 46.0 / plot.w).ceil().max(1.0) as usize;
    for (i, tick) in x.ticks.iter().enumerate() {
        let at = plot.x + plot.w * x.place(tick.at);
        if gridded {
            svg.line([at, plot.y], [at, bottom], grid);
        }
        svg.line([at, bottom], [at, bottom + 7.0], Pen::new(theme.ink, 1.5));
        if i % every == 0 {
            let style = Type::new(size::TICK, theme.ink).anchor(Anchor::Middle);
            svg.text([at, bottom + 9.0 + size::TICK], style, &tick.label);
        }
    }
    svg.line([plot.x, bottom], [right, bottom], Pen::new(theme.ink, 1.5));
    svg.line([plot.x, plot.y], [plot.x, bottom], Pen::new(theme.ink, 1.5));
    let style = Type::new(size::AXIS, theme.ink).anchor(Anchor::Middle);
    svg.text([plot.x + 0.5 * plot.w, bottom + 18.0 + size::TICK + size::AXIS], style, &x.title);
    let longest = y.ticks.iter().map(|t| super::text::text_width(&t.label, size::TICK)).fold(0.0, f64::max);
    svg.text([plot.x - 26.0 - longest, plot.y + 0.5 * plot.h], style.upright(), &y.title);
}

/// 2 to 9 times the powers of ten.
fn minor(axis: &Axis) -> Vec<f64> {
    let from = super::ticks::decade_below(axis.lo);
    let to = super::ticks::decade_above(axis.hi);
    let all = (from..to).flat_map(|k| (2..10).map(move |m| f64::from(m) * super::ticks::pow10(k)));
    all.filter(|v| *v > axis.lo && *v < axis.hi).collect()
}
