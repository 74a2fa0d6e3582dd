//! Heat maps with a common colour bar: [`Heat`].

use core::fmt::Write;

use super::axis::Axis;
use super::cartesian::axes;
use super::colour_map::{hex, rgb};
use super::page::{Area, Page, panel_title};
use super::svg::{Anchor, Pen, Point, Svg, Type};
use super::text::text_width;
use super::theme::size;

/// Steps of colour that are told apart.
const STEPS: usize = 64;

/// Numbers over a grid of cells.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Cells along the abscissa.
    pub nx: usize,
    /// Cells along the ordinate.
    pub ny: usize,
    /// A number for each cell, row by row from the lowest; not finite where there is none.
    pub values: Vec<f64>,
}

impl Grid {
    /// Draws the cells into a rectangle: colours by `colour`, no cell where there is no number.
    pub(super) fn draw(&self, svg: &mut Svg, colour: &Axis, area: Area) {
        let mut paths: Vec<(String, String)> =
            (0..=STEPS).map(|i| (hex(rgb(i as f64 / STEPS as f64)), String::new())).collect();
        let step =
            |v: f64| v.is_finite().then(|| (colour.place(v).clamp(0.0, 1.0) * STEPS as f64).round() as usize);
        for (row, values) in self.values.chunks(self.nx.max(1)).enumerate() {
            let y = self.ny.saturating_sub(row + 1);
            let mut x = 0;
            while x < values.len() {
                let s = step(values[x]);
                let n = values[x..].iter().take_while(|v| step(**v) == s).count();
                if let Some(path) = s.and_then(|s| paths.get_mut(s)) {
                    // Writing to a string cannot fail.
                    let _ = write!(path.1, "M{x} {y}h{n}v1h-{n}z");
                }
                x += n;
            }
        }
        paths.retain(|p| !p.1.is_empty());
        let cell = [area.w / self.nx.max(1) as f64, area.h / self.ny.max(1) as f64];
        svg.cells([area.x, area.y], cell, &paths);
    }
}

/// One heat map.
#[derive(Clone, Debug)]
pub struct Panel {
    /// What it shows.
    pub title: String,
    /// The numbers.
    pub grid: Grid,
}

/// Heat maps over the same axes, with a common colour bar.
#[derive(Clone, Debug)]
pub struct Heat {
    /// What stands around them.
    pub page: Page,
    /// The abscissa.
    pub x: Axis,
    /// The ordinate.
    pub y: Axis,
    /// What colours mean.
    pub colour: Axis,
    /// The maps.
    pub panels: Vec<Panel>,
}

impl Heat {
    /// The picture.
    pub fn svg(&self) -> String {
        let (mut svg, area) = self.page.begin();
        let all = area.within([14.0, 0.0, 150.0, 6.0]);
        for (panel, place) in self.panels.iter().zip(all.panels(self.panels.len())) {
            let titled = if panel.title.is_empty() { 12.0 } else { 34.0 };
            let plot = square(place.within([86.0, titled, 20.0, 62.0]));
            if !panel.title.is_empty() {
                let middle = [plot.x + 0.5 * plot.w, plot.y - 12.0];
                panel_title(&mut svg, &self.page.theme, middle, plot.w, &panel.title);
            }
            svg.rect([plot.x, plot.y], [plot.w, plot.h], self.page.theme.blank);
            panel.grid.draw(&mut svg, &self.colour, plot);
            axes(&mut svg, &self.page, plot, [&self.x, &self.y], false);
        }
        colour_bar(&mut svg, &self.page, area, &self.colour);
        svg.finish(&self.page.title)
    }
}

/// At most half as wide again as high.
fn square(area: Area) -> Area {
    let w = area.w.min(1.5 * area.h);
    let h = area.h.min(1.2 * w);
    Area { x: area.x + 0.5 * (area.w - w), y: area.y + 0.5 * (area.h - h), w, h }
}

/// The bar at the right of `area` that says what colours mean.
pub(super) fn colour_bar(svg: &mut Svg, page: &Page, area: Area, colour: &Axis) {
    let theme = &page.theme;
    let x = area.x + area.w - 138.0;
    let h = (area.h - 90.0).clamp(60.0, 420.0);
    let bar = Area { x, y: area.y + 0.5 * (area.h - h) - 8.0, w: 22.0, h };
    let values: Vec<f64> = (0..STEPS).map(|i| colour.at((i as f64 + 0.5) / STEPS as f64)).collect();
    Grid { nx: 1, ny: STEPS, values }.draw(svg, colour, bar);
    let corners: [Point; 5] = [
        [bar.x, bar.y],
        [bar.x + bar.w, bar.y],
        [bar.x + bar.w, bar.y + bar.h],
        [bar.x, bar.y + bar.h],
        [bar.x, bar.y],
    ];
    svg.polyline(&corners, Pen::new(theme.soft, 1.0));
    let mut longest: f64 = 0.0;
    for tick in &colour.ticks {
        let y = bar.y + bar.h * (1.0 - colour.place(tick.at));
        svg.line([bar.x + bar.w, y], [bar.x + bar.w + 6.0, y], Pen::new(theme.ink, 1.5));
        let at = [bar.x + bar.w + 10.0, y + 0.35 * size::TICK];
        svg.text(at, Type::new(size::TICK, theme.ink), &tick.label);
        longest = longest.max(text_width(&tick.label, size::TICK));
    }
    let style = Type::new(size::AXIS, theme.ink).anchor(Anchor::Middle).upright();
    let at = [bar.x + bar.w + 22.0 + longest + 0.7 * size::AXIS, bar.y + 0.5 * bar.h];
    svg.text([at[0].min(area.x + area.w - 8.0), at[1]], style, &colour.title);
}
