//! SVG text, element by element: [`Svg`].

use core::fmt::Write;

use super::text::{Escaped, Num, spans};

/// A point on the page: right and down from its top left corner, in pixels at the natural size.
pub type Point = [f64; 2];

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Pen<'a> {
    /// Colour, `#rrggbb`.
    pub colour: &'a str,
    /// Width in pixels.
    pub width: f64,
    /// Lengths of dashes and gaps in pixels; empty for an unbroken line.
    pub dash: &'a str,
}

impl<'a> Pen<'a> {
    /// An unbroken line.
    pub fn new(colour: &'a str, width: f64) -> Pen<'a> {
        Pen { colour, width, dash: "" }
    }
    /// With dashes.
    pub fn dashed(self, dash: &'a str) -> Pen<'a> {
        Pen { dash, ..self }
    }
}

/// Which end of a text its place names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The left end.
    Start,
    /// The middle.
    Middle,
    /// The right end.
    End,
}

/// How a text is written.
#[derive(Clone, Copy, Debug)]
pub struct Type<'a> {
    /// Height of the letters in pixels, as fonts count it.
    pub size: f64,
    /// Colour, `#rrggbb`.
    pub colour: &'a str,
    /// Which end is placed.
    pub anchor: Anchor,
    /// Heavier letters.
    pub bold: bool,
    /// Written upwards.
    pub upright: bool,
    /// Colour of a rim around the letters, for texts upon lines; empty for none.
    pub halo: &'a str,
}

impl<'a> Type<'a> {
    /// Plain letters, placed by their left end.
    pub fn new(size: f64, colour: &'a str) -> Type<'a> {
        Type { size, colour, anchor: Anchor::Start, bold: false, upright: false, halo: "" }
    }
    /// Placed by another end.
    pub fn anchor(self, anchor: Anchor) -> Type<'a> {
        Type { anchor, ..self }
    }
    /// Heavier.
    pub fn bold(self) -> Type<'a> {
        Type { bold: true, ..self }
    }
    /// Written upwards.
    pub fn upright(self) -> Type<'a> {
        Type { upright: true, ..self }
    }
    /// With a rim.
    pub fn halo(self, colour: &'a str) -> Type<'a> {
        Type { halo: colour, ..self }
    }
}

/// A picture that grows element by element. All text that enters is escaped.
#[derive(Clone, Debug)]
pub struct Svg {
    size: [f64; 2],
    body: String,
    n_clips: usize,
}

impl Svg {
    /// An empty page.
    pub fn new(size: [f64; 2], background: &str) -> Svg {
        let mut svg = Svg { size, body: String::new(), n_clips: 0 };
        svg.rect([0.0, 0.0], size, background);
        svg
    }

    /// The document; `title` is what a browser shows for it and a screen reader says.
    pub fn finish(self, title: &str) -> String {
        let [w, h] = self.size.map(Num);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"sans-serif\">\n<title>{}</title>\n{}</svg>\n",
            Escaped(title),
            self.body
        )
    }

    // Writing to a string cannot fail.
    fn put(&mut self, line: core::fmt::Arguments<'_>) {
        let _ = self.body.write_fmt(line);
        self.body.push('\n');
    }

    /// A straight line.
    pub fn line(&mut self, a: Point, b: Point, pen: Pen<'_>) {
        self.path(&format!("M{} {}L{} {}", Num(a[0]), Num(a[1]), Num(b[0]), Num(b[1])), pen);
    }
    /// A line through points; nothing for fewer than two.
    pub fn polyline(&mut self, points: &[Point], pen: Pen<'_>) {
        if points.len() > 1 {
            self.path(&path_of(points), pen);
        }
    }
    /// The outline that path data describe.
    pub fn path(&mut self, d: &str, pen: Pen<'_>) {
        let dash =
            if pen.dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{}\"", pen.dash) };
        self.put(format_args!(
            "<path d=\"{d}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{dash}/>",
            pen.colour,
            Num(pen.width)
        ));
    }
    /// The area within points, `opacity` from 0 to 1.
    pub fn area(&mut self, points: &[Point], fill: &str, opacity: f64) {
        self.put(format_args!(
            "<path d=\"{}z\" fill=\"{fill}\" fill-opacity=\"{}\"/>",
            path_of(points),
            Num(opacity)
        ));
    }
    /// What follows are pieces of a solid, until [`end_group`](Self::end_group).
    pub fn begin_solid(&mut self) {
        self.put(format_args!("<g transform=\"scale(.1)\" stroke-width=\"6\">"));
    }
    /// A facet of a solid: an area whose border has its colour too, so that no seam shows between neighbours.
    pub fn facet(&mut self, points: &[Point], fill: &str) {
        self.put(format_args!("<path d=\"{}z\" fill=\"{fill}\" stroke=\"{fill}\"/>", tenths(points)));
    }
    /// A line amid facets.
    pub fn edge(&mut self, a: Point, b: Point, pen: Pen<'_>) {
        let width = Num(10.0 * pen.width);
        let d = tenths(&[a, b]);
        self.put(format_args!("<path d=\"{d}\" stroke=\"{}\" stroke-width=\"{width}\"/>", pen.colour));
    }
    /// Ends what was begun.
    pub fn end_group(&mut self) {
        self.put(format_args!("</g>"));
    }
    /// A filled rectangle.
    pub fn rect(&mut self, at: Point, size: [f64; 2], fill: &str) {
        let [x, y, w, h] = [at[0], at[1], size[0], size[1]].map(Num);
        self.put(format_args!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" fill=\"{fill}\"/>"));
    }
    /// A circle's outline.
    pub fn circle(&mut self, centre: Point, radius: f64, pen: Pen<'_>) {
        let [x, y, r] = [centre[0], centre[1], radius].map(Num);
        self.put(format_args!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>",
            pen.colour,
            Num(pen.width)
        ));
    }
    /// Dots of one radius, as one element.
    pub fn dots(&mut self, centres: &[Point], radius: f64, fill: &str, rim: &str) {
        let (r, d) = (Num(radius), Num(2.0 * radius));
        let mut path = String::new();
        for [x, y] in centres {
            let _ = write!(path, "M{} {}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0", Num(x - radius), Num(*y));
        }
        self.put(format_args!("<path d=\"{path}\" fill=\"{fill}\" stroke=\"{rim}\" stroke-width=\"0.5\" fill-opacity=\"0.9\" stroke-opacity=\"0.5\"/>"));
    }
    /// An arrow; its head ends at `b`.
    pub fn arrow(&mut self, a: Point, b: Point, pen: Pen<'_>) {
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let len = (dx * dx + dy * dy).sqrt();
        if !(len > 0.0) {
            return;
        }
        let [ux, uy] = [dx / len, dy / len];
        let head = (4.5 * pen.width).min(len);
        let back = [b[0] - head * ux, b[1] - head * uy];
        self.line(a, [b[0] - 0.7 * head * ux, b[1] - 0.7 * head * uy], pen);
        let half = 0.42 * head;
        let corner = |s: f64| [back[0] - s * half * uy, back[1] + s * half * ux];
        self.area(&[b, corner(1.0), corner(-1.0)], pen.colour, 1.0);
    }
    /// A text. `_{..}` lowers and `^{..}` raises what stands in the braces.
    pub fn text(&mut self, at: Point, style: Type<'_>, text: &str) {
        let mut attributes = String::new();
        match style.anchor {
            Anchor::Start => {}
            Anchor::Middle => attributes.push_str(" text-anchor=\"middle\""),
            Anchor::End => attributes.push_str(" text-anchor=\"end\""),
        }
        if style.bold {
            attributes.push_str(" font-weight=\"bold\"");
        }
        if !style.halo.is_empty() {
            let _ = write!(
                attributes,
                " stroke=\"{}\" stroke-width=\"3.5\" stroke-linejoin=\"round\" paint-order=\"stroke\"",
                style.halo
            );
        }
        let [x, y] = at.map(Num);
        if style.upright {
            let _ = write!(attributes, " transform=\"rotate(-90 {x} {y})\"");
        }
        self.put(format_args!(
            "<text xml:space=\"preserve\" x=\"{x}\" y=\"{y}\" font-size=\"{}\" fill=\"{}\"{attributes}>{}</text>",
            Num(style.size),
            style.colour,
            spans(text, style.size)
        ));
    }
    /// Cells of unit size in their own coordinates, mapped to the page by place and size of a cell; one path per colour.
    pub fn cells(&mut self, at: Point, cell: [f64; 2], paths: &[(String, String)]) {
        let [x, y, w, h] = [at[0], at[1], cell[0], cell[1]];
        self.put(format_args!(
            "<g transform=\"translate({} {}) scale({w:.5} {h:.5})\" shape-rendering=\"crispEdges\">",
            Num(x),
            Num(y)
        ));
        for (colour, d) in paths {
            self.put(format_args!("<path fill=\"{colour}\" d=\"{d}\"/>"));
        }
        self.put(format_args!("</g>"));
    }
    /// What follows is cut to a rectangle, until [`end_group`](Self::end_group).
    pub fn clip_rect(&mut self, at: Point, size: [f64; 2]) {
        let [x, y, w, h] = [at[0], at[1], size[0], size[1]].map(Num);
        self.clip(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/>"));
    }
    /// What follows is cut to a circle, until [`end_group`](Self::end_group).
    pub fn clip_circle(&mut self, centre: Point, radius: f64) {
        let [x, y, r] = [centre[0], centre[1], radius].map(Num);
        self.clip(&format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>"));
    }
    fn clip(&mut self, shape: &str) {
        self.n_clips += 1;
        let n = self.n_clips;
        self.put(format_args!(
            "<clipPath id=\"clip{n}\">{shape}</clipPath>\n<g clip-path=\"url(#clip{n})\">"
        ));
    }
}

/// `M x y L x y ..`
fn path_of(points: &[Point]) -> String {
    let mut d = String::new();
    for (i, [x, y]) in points.iter().enumerate() {
        let _ = write!(d, "{}{} {}", if i == 0 { "M" } else { "L" }, Num(*x), Num(*y));
    }
    d
}

/// Path data in whole tenths of a pixel, each point relative to the one before: short.
fn tenths(points: &[Point]) -> String {
    let whole = |v: f64| if v.is_finite() { (10.0 * v).round() as i64 } else { 0 };
    let (mut d, mut last) = (String::new(), [0, 0]);
    for (i, p) in points.iter().enumerate() {
        let [x, y] = p.map(whole);
        let _ = write!(d, "{}{} {}", if i == 0 { "M" } else { "l" }, x - last[0], y - last[1]);
        last = [x, y];
    }
    d
}
