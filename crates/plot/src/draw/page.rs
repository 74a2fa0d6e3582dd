//! What stands around every plot: title, legend, notes: [`Page`].

use super::svg::{Anchor, Pen, Point, Svg, Type};
use super::text::text_width;
use super::theme::{Theme, size};

/// A rectangle of the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Left.
    pub x: f64,
    /// Top.
    pub y: f64,
    /// Width.
    pub w: f64,
    /// Height.
    pub h: f64,
}

impl Area {
    /// With margins taken off: left, top, right, bottom.
    pub fn within(self, [l, t, r, b]: [f64; 4]) -> Area {
        Area { x: self.x + l, y: self.y + t, w: (self.w - l - r).max(10.0), h: (self.h - t - b).max(10.0) }
    }
    /// The middle.
    pub fn centre(self) -> Point {
        [self.x + 0.5 * self.w, self.y + 0.5 * self.h]
    }
    /// Columns and rows of equal areas for `n` panels, as square as can be.
    pub fn panels(self, n: usize) -> Vec<Area> {
        let n = n.max(1);
        let side = |columns: usize| {
            let rows = n.div_ceil(columns);
            (self.w / columns as f64).min(self.h / rows as f64)
        };
        let columns = (1..=n).max_by(|a, b| side(*a).total_cmp(&side(*b)).then(b.cmp(a))).unwrap_or(1);
        let rows = n.div_ceil(columns);
        let (w, h) = (self.w / columns as f64, self.h / rows as f64);
        let area = |i: usize| Area {
            x: self.x + (i % columns) as f64 * w,
            y: self.y + (i / columns) as f64 * h,
            w,
            h,
        };
        (0..n).map(area).collect()
    }
}

/// An entry of the legend.
#[derive(Clone, Debug)]
pub struct Entry {
    /// What the line shows.
    pub label: String,
    /// Which series it is, for its colour.
    pub series: usize,
}

/// Everything around the plot.
#[derive(Clone, Debug)]
pub struct Page {
    /// Width and height in pixels.
    pub size: [f64; 2],
    /// Colours.
    pub theme: Theme,
    /// In large letters.
    pub title: String,
    /// Under it; broken where it is too long.
    pub subtitle: String,
    /// One entry for each line; none for a plot that speaks for itself.
    pub legend: Vec<Entry>,
    /// Lines at the foot.
    pub notes: Vec<String>,
}

impl Page {
    /// A page with its texts, and the area that is left for the plot.
    pub fn begin(&self) -> (Svg, Area) {
        let [width, height] = self.size;
        let (t, margin) = (&self.theme, 28.0);
        let mut svg = Svg::new(self.size, t.background);
        let room = width - 2.0 * margin;
        let mut y = margin + 0.5 * size::TITLE;
        let shrink = (room / text_width(&self.title, size::TITLE).max(1.0)).clamp(0.5, 1.0);
        svg.text([margin, y], Type::new(size::TITLE * shrink, t.ink).bold(), &self.title);
        for line in wrap(&self.subtitle, room, size::SUBTITLE) {
            y += 1.45 * size::SUBTITLE;
            svg.text([margin, y], Type::new(size::SUBTITLE, t.soft), &line);
        }
        y = self.draw_legend(&mut svg, [margin, y], room);
        let mut foot = height - 12.0;
        let notes: Vec<String> = self.notes.iter().flat_map(|n| wrap(n, room, size::NOTE)).collect();
        for line in notes.iter().rev() {
            svg.text([margin, foot], Type::new(size::NOTE, t.soft), line);
            foot -= 1.35 * size::NOTE;
        }
        let top = y + 14.0;
        (svg, Area { x: 0.0, y: top, w: width, h: (foot - top).max(40.0) })
    }

    fn draw_legend(&self, svg: &mut Svg, from: Point, room: f64) -> f64 {
        const SWATCH: f64 = 38.0;
        let gap = 26.0;
        let (mut x, mut y) = (from[0], from[1]);
        for (i, entry) in self.legend.iter().enumerate() {
            let w = SWATCH + text_width(&entry.label, size::LEGEND) + gap;
            if i == 0 || x + w - gap > from[0] + room {
                (x, y) = (from[0], y + 1.6 * size::LEGEND);
            }
            let (colour, dash) = self.theme.series(entry.series);
            let middle = y - 0.35 * size::LEGEND;
            svg.line([x, middle], [x + SWATCH - 10.0, middle], Pen::new(colour, 4.0).dashed(dash));
            svg.text([x + SWATCH, y], Type::new(size::LEGEND, self.theme.ink), &entry.label);
            x += w;
        }
        y
    }
}

/// Lines no wider than `room`, broken at blanks.
fn wrap(text: &str, room: f64, size: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ').filter(|w| !w.is_empty()) {
        match lines.last_mut() {
            Some(line) if text_width(line, size) + text_width(word, size) + 0.36 * size <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The title of a panel, made smaller where it is too wide.
pub(super) fn panel_title(svg: &mut Svg, theme: &Theme, middle: Point, room: f64, text: &str) {
    let shrink = (room / text_width(text, size::AXIS).max(1.0)).clamp(0.6, 1.0);
    let style = Type::new(size::AXIS * shrink, theme.ink).bold().anchor(Anchor::Middle);
    svg.text(middle, style, text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_fill_the_area() {
        let area = Area { x: 0.0, y: 0.0, w: 900.0, h: 400.0 };
        let columns = |n: usize| {
            let p = area.panels(n);
            assert_eq!(p.len(), n);
            p.iter().filter(|a| a.y <= 0.0).count()
        };
        assert_eq!([columns(1), columns(2), columns(3), columns(4), columns(6)], [1, 2, 3, 4, 3]);
    }

    #[test]
    fn long_texts_are_broken() {
        let lines = wrap("one two three four five six seven", 100.0, 18.0);
        assert!(lines.len() > 2 && lines.iter().all(|l| text_width(l, 18.0) <= 100.0), "{lines:?}");
        assert_eq!(lines.join(" "), "one two three four five six seven");
    }
}
