//! Colours and sizes: [`Theme`].

/// Colours of a page, all `#rrggbb`.
#[derive(Clone, Copy, Debug)]
pub struct Theme {
    /// The page.
    pub background: &'static str,
    /// Texts and axes.
    pub ink: &'static str,
    /// Texts of less weight.
    pub soft: &'static str,
    /// Lines of the grid.
    pub grid: &'static str,
    /// Where a heat map has no value.
    pub blank: &'static str,
    /// Colours of series, that people with any kind of colour vision tell apart [OkabeIto2008].
    pub palette: [&'static str; 7],
}

/// Dark on light, for paper and bright rooms.
pub const LIGHT: Theme = Theme {
    background: "#ffffff",
    ink: "#1a1a1a",
    soft: "#555555",
    grid: "#dddddd",
    blank: "#eeeeee",
    palette: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"],
};

/// Light on dark, for dark rooms.
pub const DARK: Theme = Theme {
    background: "#16181d",
    ink: "#f2f2f2",
    soft: "#b4b8c0",
    grid: "#3a3f4a",
    blank: "#2a2e36",
    palette: ["#56b4e9", "#e69f00", "#2fcfa0", "#cc79a7", "#f0e442", "#ff7f45", "#ffffff"],
};

/// Dashes that part series once the colours are used up.
const DASHES: [&str; 3] = ["", "9 5", "2 4"];
/// More series than this cannot be told apart.
pub const MAX_SERIES: usize = 21;

/// Width of a series' line among `n`, in pixels: later ones are thinner, so that a line under another still shows.
pub fn stroke(i: usize, n: usize) -> f64 {
    let last = n.saturating_sub(1).max(1);
    if n < 2 { 3.5 } else { 4.6 - 1.8 * i.min(last) as f64 / last as f64 }
}

impl Theme {
    /// Colour and dash of a series.
    pub fn series(&self, i: usize) -> (&'static str, &'static str) {
        let n = self.palette.len();
        (self.palette[i % n], DASHES[(i / n) % DASHES.len()])
    }
}

/// Sizes of letters in pixels, on a page of about 960 pixels.
pub mod size {
    /// The page's title.
    pub const TITLE: f64 = 27.0;
    /// The line under it.
    pub const SUBTITLE: f64 = 18.0;
    /// Titles of axes and panels.
    pub const AXIS: f64 = 19.0;
    /// Numbers at ticks.
    pub const TICK: f64 = 16.0;
    /// Entries of the legend.
    pub const LEGEND: f64 = 18.0;
    /// Notes at the foot.
    pub const NOTE: f64 = 14.0;
}
