//! Charts in the size of the book: [`Chart`].

use sparrow_plot::draw::axis::Axis;
use sparrow_plot::draw::cartesian::{Cartesian, Line, Rule};
use sparrow_plot::draw::page::{Entry, Page};
use sparrow_plot::draw::table::{Field, Table};
use sparrow_plot::draw::theme::LIGHT;

/// Width and height in pixels: letters stay legible where the picture is as wide as a phone.
pub(crate) const SIZE: [f64; 2] = [660.0, 540.0];

/// A line with its name.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    /// What the legend and the table call it.
    pub(crate) label: String,
    /// Abscissa and ordinate.
    pub(crate) points: Vec<[f64; 2]>,
}

impl Curve {
    /// A function at the places `x`.
    pub(crate) fn of(label: impl Into<String>, x: &[f64], f: impl Fn(f64) -> f64) -> Curve {
        Curve { label: label.into(), points: x.iter().map(|x| [*x, f(*x)]).collect() }
    }
}

/// Lines over a plane.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    /// In large letters, and in the table.
    pub(crate) title: String,
    /// Under it.
    pub(crate) subtitle: String,
    /// The abscissa.
    pub(crate) x: Axis,
    /// The ordinate.
    pub(crate) y: Axis,
    /// The lines.
    pub(crate) curves: Vec<Curve>,
    /// Vertical rules.
    pub(crate) rules: Vec<Rule>,
}

impl Chart {
    /// The picture.
    pub(crate) fn svg(&self) -> String {
        let entries = self.curves.iter().enumerate();
        let legend: Vec<Entry> = entries
            .map(|(i, c)| Entry { label: c.label.clone(), series: i })
            .filter(|e| !e.label.is_empty())
            .collect();
        let lines = self.curves.iter().enumerate().map(|(i, c)| Line {
            series: i,
            points: c.points.clone(),
            spikes: Vec::new(),
        });
        let page = page(&self.title, &self.subtitle, legend);
        let (x, y) = (self.x.clone(), self.y.clone());
        Cartesian { page, x, y, lines: lines.collect(), rules: self.rules.clone() }.svg()
    }
}

/// A page of the book's size.
pub(crate) fn page(title: &str, subtitle: &str, legend: Vec<Entry>) -> Page {
    Page {
        size: SIZE,
        theme: LIGHT,
        title: title.to_owned(),
        subtitle: subtitle.to_owned(),
        legend,
        notes: Vec::new(),
    }
}

/// The numbers of charts: a row for each point.
pub(crate) fn table(charts: &[&Chart]) -> Table {
    let mut table = Table::new(["chart", "curve", "x", "y"]);
    for chart in charts {
        for curve in &chart.curves {
            for p in &curve.points {
                let names = [&chart.title, &curve.label].map(|n| Field::Text(n.clone()));
                table.rows.push(names.into_iter().chain(p.map(Field::Number)).collect());
            }
        }
    }
    table
}

/// `n + 1` places from `lo` to `hi`.
pub(crate) fn steps(lo: f64, hi: f64, n: usize) -> Vec<f64> {
    (0..=n).map(|i| lo + (hi - lo) * i as f64 / n.max(1) as f64).collect()
}
