//! Surfaces in space, seen from one side and above: [`Space`].

use sparrow_math::{Real, Vec3, vec3};

use super::axis::Axis;
use super::colour_map::{hex, rgb};
use super::heat::colour_bar;
use super::page::{Area, Page, panel_title};
use super::svg::{Anchor, Pen, Point, Svg, Type};
use super::theme::size;

/// A facet of a surface that is seen from outside.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Corners, in turn, anticlockwise as seen from outside.
    pub corners: [Vec3<f64>; 4],
    /// Place on the colour axis's scale, 0..1.
    pub tone: f64,
}

/// An arrow from the origin.
#[derive(Clone, Debug)]
pub struct Pointer {
    /// Its tip.
    pub tip: Vec3<f64>,
    /// What is written there.
    pub label: String,
    /// In the colour of this series; none for ink.
    pub series: Option<usize>,
}

/// One surface over the plane z = 0, of about unit size.
#[derive(Clone, Debug)]
pub struct Body {
    /// What it shows.
    pub title: String,
    /// The surface.
    pub facets: Vec<Facet>,
    /// Arrows.
    pub pointers: Vec<Pointer>,
    /// Something reaches below the plane.
    pub below: bool,
}

/// Surfaces in space with a common colour bar.
#[derive(Clone, Debug)]
pub struct Space {
    /// What stands around them.
    pub page: Page,
    /// What colours mean.
    pub colour: Axis,
    /// Azimuth of the observer in degrees.
    pub azimuth: f64,
    /// Height of the observer above the plane in degrees, above zero.
    pub elevation: f64,
    /// The surfaces.
    pub bodies: Vec<Body>,
}

/// What is drawn from back to front.
enum Item<'a> {
    Facet(&'a Facet),
    Segment { ends: [Vec3<f64>; 2], colour: &'static str },
}

/// Parallel projection.
#[derive(Clone, Copy)]
struct View {
    right: Vec3<f64>,
    up: Vec3<f64>,
    to_eye: Vec3<f64>,
    centre: Point,
    scale: f64,
}

impl View {
    fn at(&self, p: Vec3<f64>) -> Point {
        [self.centre[0] + self.scale * p.dot(self.right), self.centre[1] - self.scale * p.dot(self.up)]
    }
}

impl Space {
    /// The picture.
    pub fn svg(&self) -> String {
        let (mut svg, area) = self.page.begin();
        let all = area.within([14.0, 0.0, 150.0, 6.0]);
        for (body, place) in self.bodies.iter().zip(all.panels(self.bodies.len())) {
            self.draw_body(&mut svg, body, place);
        }
        colour_bar(&mut svg, &self.page, area, &self.colour);
        svg.finish(&self.page.title)
    }

    fn view(&self, body: &Body, plot: Area) -> View {
        let (sa, ca) = Real::sin_cos(self.azimuth.to_radians());
        let (se, ce) = Real::sin_cos(self.elevation.to_radians());
        // Above the plane a length of 1.25 has to fit, below it one or the near rim of the plane.
        let (above, under) = (1.25 * ce, if body.below { 1.2 * ce } else { 1.12 * se });
        let scale = (plot.w / 2.5).min(plot.h / (above + under));
        let [cx, cy] = plot.centre();
        View {
            right: vec3(-sa, ca, 0.0),
            up: vec3(-se * ca, -se * sa, ce),
            to_eye: vec3(ce * ca, ce * sa, se),
            centre: [cx, cy + 0.5 * scale * (above - under)],
            scale,
        }
    }

    fn draw_body(&self, svg: &mut Svg, body: &Body, place: Area) {
        let theme = &self.page.theme;
        let titled = if body.title.is_empty() { 8.0 } else { 40.0 };
        let plot = place.within([16.0, titled, 16.0, 8.0]);
        if !body.title.is_empty() {
            let middle = [place.x + 0.5 * place.w, place.y + 24.0];
            panel_title(svg, theme, middle, place.w - 10.0, &body.title);
        }
        let view = self.view(body, plot);
        let mut items = self.items(body, &view);
        items.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (below, above): (Vec<_>, Vec<_>) = items.into_iter().partition(|(_, item)| z_of(item) < 0.0);
        self.draw_items(svg, &view, &below);
        self.draw_plane(svg, &view, body.below);
        self.draw_items(svg, &view, &above);
        for pointer in &body.pointers {
            self.draw_tip(svg, &view, pointer);
        }
    }

    /// Facets that face the observer, and arrows in short pieces, each with its nearness.
    fn items<'a>(&self, body: &'a Body, view: &View) -> Vec<(f64, Item<'a>)> {
        let mut items = Vec::new();
        for facet in &body.facets {
            let [a, b, c, d] = facet.corners;
            let centre = (a + b + c + d) * 0.25;
            let across = (c - a).cross(d - b);
            // Half of the cross product is the area as it is seen, in the scale's unit.
            let seen = 0.5 * across.dot(view.to_eye) * view.scale * view.scale;
            if seen > 0.05 {
                items.push((centre.dot(view.to_eye), Item::Facet(facet)));
            }
        }
        const PIECES: usize = 24;
        for pointer in &body.pointers {
            let colour = pointer.series.map_or(self.page.theme.ink, |i| self.page.theme.series(i).0);
            for i in 0..PIECES {
                // A little too long, so that no gap shows.
                let at = |k: f64| pointer.tip * (k / PIECES as f64 * 0.96);
                let ends = [at(i as f64), at(i as f64 + 1.2)];
                let nearness = ((ends[0] + ends[1]) * 0.5).dot(view.to_eye);
                items.push((nearness, Item::Segment { ends, colour }));
            }
        }
        items
    }

    fn draw_items(&self, svg: &mut Svg, view: &View, items: &[(f64, Item<'_>)]) {
        let light = (view.to_eye + view.up * 0.9 - view.right * 0.6).normalized();
        svg.begin_solid();
        for (_, item) in items {
            match item {
                Item::Facet(facet) => {
                    let [a, b, c, d] = facet.corners;
                    let n = (c - a).cross(d - b).normalized();
                    let shade = 0.62 + 0.38 * n.dot(light).max(0.0);
                    let colour = hex(rgb(facet.tone).map(|v| shade * v));
                    svg.facet(&facet.corners.map(|p| view.at(p)), &colour);
                }
                Item::Segment { ends, colour } => {
                    svg.edge(view.at(ends[0]), view.at(ends[1]), Pen::new(colour, 2.5));
                }
            }
        }
        svg.end_group();
    }

    /// The plane as a disc, with the directions x and y.
    fn draw_plane(&self, svg: &mut Svg, view: &View, see_through: bool) {
        let theme = &self.page.theme;
        let ring = |r: f64| -> Vec<Point> {
            let at = |i: u32| Real::sin_cos(f64::from(i).to_radians() * 4.0);
            (0..=90).map(at).map(|(s, c)| view.at(vec3(r * c, r * s, 0.0))).collect()
        };
        svg.area(&ring(1.0), theme.grid, if see_through { 0.55 } else { 0.45 });
        for r in [0.25, 0.5, 0.75, 1.0] {
            svg.polyline(&ring(r), Pen::new(theme.soft, if r < 1.0 { 0.5 } else { 1.2 }));
        }
        for (axis, label) in [(vec3(1.0, 0.0, 0.0), "x"), (vec3(0.0, 1.0, 0.0), "y")] {
            svg.line(view.at(axis * -1.0), view.at(axis), Pen::new(theme.soft, 0.8));
            let [x, y] = view.at(axis * 1.08);
            let style = Type::new(size::TICK, theme.soft).anchor(Anchor::Middle);
            svg.text([x, y + 0.35 * size::TICK], style, label);
        }
    }

    fn draw_tip(&self, svg: &mut Svg, view: &View, pointer: &Pointer) {
        let theme = &self.page.theme;
        let colour = pointer.series.map_or(theme.ink, |i| theme.series(i).0);
        let (from, tip) = (view.at(pointer.tip * 0.93), view.at(pointer.tip));
        svg.arrow(from, tip, Pen::new(colour, 2.5));
        let left = tip[0] < view.centre[0];
        let (dx, anchor) = if left { (-8.0, Anchor::End) } else { (8.0, Anchor::Start) };
        let style = Type::new(size::AXIS, colour).bold().anchor(anchor).halo(theme.background);
        svg.text([tip[0] + dx, tip[1] + 2.0], style, &pointer.label);
    }
}

/// Height of the middle of an item.
fn z_of(item: &Item<'_>) -> f64 {
    match item {
        Item::Facet(f) => f.corners.iter().map(|c| c.z).sum(),
        Item::Segment { ends, .. } => ends[0].z + ends[1].z,
    }
}
