//! Hemispheres seen along the normal, as discs of equal area: [`Discs`].
//!
//! The distance from the centre is `sqrt(2) sin(theta / 2)`, so that equal areas of the disc are equal solid angles
//! (Lambert's azimuthal projection): points spread evenly where a density is constant.

use core::f64::consts::SQRT_2;

use sparrow_math::Real;

use super::axis::Axis;
use super::heat::{Grid, colour_bar};
use super::page::{Area, Page, panel_title};
use super::svg::{Anchor, Pen, Point, Svg, Type};
use super::theme::size;

/// Place in the unit disc of a direction by polar angle and azimuth in radians: x to the right, y up.
pub fn equal_area(theta: f64, phi: f64) -> [f64; 2] {
    let r = SQRT_2 * Real::sin(0.5 * theta);
    let (s, c) = Real::sin_cos(phi);
    [r * c, r * s]
}

/// Polar angle and azimuth in radians of a place in the unit disc; none outside.
pub fn from_disc([x, y]: [f64; 2]) -> Option<[f64; 2]> {
    let r = (x * x + y * y).sqrt();
    (r <= 1.0).then(|| [2.0 * Real::asin(r / SQRT_2), Real::atan2(y, x)])
}

/// Rim of white letters upon any colour of the map.
const SHADOW: &str = "#1c1030";

/// One hemisphere.
#[derive(Clone, Debug)]
pub struct DiscPanel {
    /// What it shows.
    pub title: String,
    /// Numbers over the square around the disc.
    pub grid: Grid,
    /// Points, in the coordinates of [`equal_area`].
    pub points: Vec<[f64; 2]>,
    /// Marked places, each with what is written at it.
    pub marks: Vec<([f64; 2], String)>,
}

/// Hemispheres with a common colour bar.
#[derive(Clone, Debug)]
pub struct Discs {
    /// What stands around them.
    pub page: Page,
    /// What colours mean.
    pub colour: Axis,
    /// The hemispheres.
    pub panels: Vec<DiscPanel>,
}

impl Discs {
    /// The picture.
    pub fn svg(&self) -> String {
        let (mut svg, area) = self.page.begin();
        let all = area.within([14.0, 0.0, 150.0, 6.0]);
        for (panel, place) in self.panels.iter().zip(all.panels(self.panels.len())) {
            self.draw_panel(&mut svg, panel, place);
        }
        colour_bar(&mut svg, &self.page, area, &self.colour);
        svg.finish(&self.page.title)
    }

    fn draw_panel(&self, svg: &mut Svg, panel: &DiscPanel, place: Area) {
        let theme = &self.page.theme;
        let titled = if panel.title.is_empty() { 26.0 } else { 56.0 };
        let plot = place.within([52.0, titled, 52.0, 30.0]);
        let radius = 0.5 * plot.w.min(plot.h);
        let centre = plot.centre();
        let at = |p: [f64; 2]| -> Point { [centre[0] + radius * p[0], centre[1] - radius * p[1]] };
        if !panel.title.is_empty() {
            let middle = [centre[0], centre[1] - radius - 36.0];
            panel_title(svg, theme, middle, place.w - 10.0, &panel.title);
        }
        svg.clip_circle(centre, radius);
        svg.rect([centre[0] - radius, centre[1] - radius], [2.0 * radius; 2], theme.blank);
        let area = Area { x: centre[0] - radius, y: centre[1] - radius, w: 2.0 * radius, h: 2.0 * radius };
        panel.grid.draw(svg, &self.colour, area);
        svg.end_group();
        for theta in [30.0, 60.0] {
            let r = radius * equal_area(f64::to_radians(theta), 0.0)[0];
            svg.circle(centre, r, Pen::new("#ffffff", 1.0).dashed("3 3"));
            let p = at(equal_area(f64::to_radians(theta), f64::to_radians(-67.5)));
            svg.text(p, Type::new(size::NOTE, "#ffffff").halo(SHADOW), &format!("{theta}°"));
        }
        let points: Vec<Point> = panel.points.iter().map(|p| at(*p)).collect();
        if !points.is_empty() {
            svg.dots(&points, if points.len() > 1000 { 1.5 } else { 2.1 }, "#ffffff", SHADOW);
        }
        svg.circle(centre, radius, Pen::new(theme.ink, 1.5));
        for (phi, anchor) in
            [(0.0, Anchor::Start), (90.0, Anchor::Middle), (180.0, Anchor::End), (270.0, Anchor::Middle)]
        {
            let (s, c) = Real::sin_cos(f64::to_radians(phi));
            let out = radius + if anchor == Anchor::Middle { 14.0 } else { 8.0 };
            let p = [centre[0] + out * c, centre[1] - out * s + 0.35 * size::TICK];
            svg.text(p, Type::new(size::TICK, theme.ink).anchor(anchor), &format!("{phi}°"));
        }
        for (place, label) in &panel.marks {
            let p = at(*place);
            svg.circle(p, 7.0, Pen::new("#000000", 4.5));
            svg.circle(p, 7.0, Pen::new("#ff5a36", 2.5));
            let style = Type::new(size::AXIS, "#ffffff").bold().halo(SHADOW);
            svg.text([p[0] + 13.0, p[1] - 8.0], style, label);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::FRAC_PI_2;

    #[test]
    fn areas_are_solid_angles() {
        // The cap of half angle t holds 2 pi (1 - cos t) of the hemisphere's 2 pi.
        for t in [0.1, 0.7, 1.2, FRAC_PI_2] {
            let r = equal_area(t, 0.3);
            let share = r[0] * r[0] + r[1] * r[1];
            assert!((share - (1.0 - Real::cos(t))).abs() < 1e-14, "{t}");
            let back = from_disc([r[0] * 0.999, r[1] * 0.999]).unwrap();
            assert!((back[0] - t).abs() < 3e-3 && (back[1] - 0.3).abs() < 1e-12);
        }
        assert!(from_disc([0.8, 0.8]).is_none());
    }
}
