//! Lobes in the plane of incidence, as polar and as Cartesian figures.

use super::options::{Options, Quantity};
use super::plane::{Curves, curves};
use super::{Figure, column, page, several_views, view_of};
use crate::draw::axis::Axis;
use crate::draw::cartesian::{Cartesian, Line, Rule};
use crate::draw::page::Page;
use crate::draw::polar::{Lobe, Polar, Ray};
use crate::draw::table::Table;
use crate::draw::ticks::short;
use crate::series::Series;

/// Decades that a logarithmic axis shows below the greatest value.
const DECADES: [i32; 2] = [4, 6];
/// The centre of logarithmic polar axes, over the least value: lobes keep some length where they are weakest.
const POLAR_FLOOR: f64 = 0.25;

/// What both figures share.
struct Plane {
    curves: Curves,
    /// What is drawn: the values, or those over their greatest.
    shown: Vec<Vec<f64>>,
    /// Title of the axis of values.
    title: String,
    /// Least and greatest value to be shown.
    range: [f64; 2],
}

impl Plane {
    fn new(series: &[Series], o: &Options, decades: i32) -> Plane {
        let curves = curves(series, o.quantity, o.log);
        let mut shown = curves.values.clone();
        if o.normalize {
            for values in &mut shown {
                let greatest = greatest_of(&curves.theta, values);
                if greatest > 0.0 {
                    values.iter_mut().for_each(|v| *v /= greatest);
                }
            }
        }
        let hi = shown.iter().map(|v| greatest_of(&curves.theta, v)).fold(0.0, f64::max);
        let positive = shown.iter().flatten().copied().filter(|v| *v > 0.0 && v.is_finite());
        let floor = hi / crate::draw::ticks::pow10(decades);
        let lo = if o.log { positive.fold(hi, f64::min).max(floor) } else { 0.0 };
        let symbol = o.quantity.symbol();
        let title = if o.normalize { format!("{symbol} / max") } else { format!("{symbol}  [1/sr]") };
        Plane { curves, shown, title, range: [lo, hi] }
    }

    /// Angle and shown value of one series; a gap where the surface itself lies.
    fn points(&self, i: usize) -> Vec<[f64; 2]> {
        self.curves.theta.iter().zip(&self.shown[i]).map(|(t, v)| [*t, *v]).collect()
    }
    fn spikes(&self, i: usize) -> Vec<(f64, String)> {
        self.curves.deltas[i].iter().map(|(t, share)| (*t, format!("δ {}", short(*share)))).collect()
    }
    /// What the picture cannot say by itself.
    fn notes(&self, series: &[Series], o: &Options) -> Vec<String> {
        let mut notes = Vec::new();
        if self.curves.deltas.iter().any(|d| !d.is_empty()) {
            notes.push("Arrows δ: mirror-like (delta) lobes, with their share of the light; they have no value in 1/sr.".to_owned());
        }
        if o.normalize {
            let greatest = |v: &Vec<f64>| short(greatest_of(&self.curves.theta, v));
            let all: Vec<String> = self.curves.values.iter().map(greatest).collect();
            let what =
                if series.len() == 1 { "Greatest value" } else { "Greatest values, in the legend's order" };
            notes.push(format!("{what}: {} 1/sr.", all.join(", ")));
        }
        notes
    }

    fn table(&self, series: &[Series], quantity: Quantity) -> Table {
        let views = several_views(series);
        let what = format!("{} [1/sr]", quantity.name());
        let names = series.iter().map(|s| column(s, views, &what));
        let mut table = Table::new(core::iter::once("theta_i_deg".to_owned()).chain(names));
        for (k, theta) in self.curves.theta.iter().enumerate() {
            table.numbers(core::iter::once(*theta).chain(self.curves.values.iter().map(|v| v[k])));
        }
        table
    }
}

/// The greatest value but for the last two degrees at grazing, where some models grow without limit.
fn greatest_of(theta: &[f64], values: &[f64]) -> f64 {
    let calm = theta.iter().zip(values).filter(|(t, v)| (t.abs() - 90.0).abs() >= 2.0 && v.is_finite());
    calm.map(|(_, v)| *v).fold(0.0, f64::max)
}

fn plane_page(series: &[Series], o: &Options, plane: &Plane, size: [f64; 2]) -> Page {
    let mut about = vec!["plane of incidence".to_owned()];
    about.extend(view_of(series));
    let mut page = page(series, o, &about, true, size);
    page.notes = plane.notes(series, o);
    page
}

/// Lobes in polar coordinates: the normal up, the viewer to the left.
pub(super) fn polar(series: &[Series], o: &Options) -> Figure {
    let plane = Plane::new(series, o, DECADES[0]);
    let full = plane.curves.full;
    let [lo, hi] = plane.range;
    let r = if o.log {
        Axis::log(&plane.title, POLAR_FLOOR * lo, hi, 6)
    } else {
        Axis::fixed(&plane.title, 0.0, 1.08 * hi, 6)
    };
    let lobes =
        (0..series.len()).map(|i| Lobe { series: i, points: plane.points(i), spikes: plane.spikes(i) });
    let page = plane_page(series, o, &plane, [960.0, if full { 940.0 } else { 640.0 }]);
    let figure = Polar { page, r, full, lobes: lobes.collect(), rays: rays(series) };
    Figure { svg: figure.svg(), table: plane.table(series, o.quantity) }
}

/// The viewers, and the mirror images of the views.
fn rays(series: &[Series]) -> Vec<Ray> {
    let mut rays: Vec<Ray> = Vec::new();
    let apart = several_views(series);
    for (i, s) in series.iter().enumerate() {
        let theta = s.wo_deg[0];
        let colour = apart.then_some(i);
        if rays.iter().any(|r| !r.faint && (r.angle + theta).abs() < 1e-9) {
            continue;
        }
        rays.push(Ray { angle: -theta, label: "ω_{o}".to_owned(), series: colour, faint: false });
        if theta > 1.0 {
            rays.push(Ray { angle: theta, label: String::new(), series: colour, faint: true });
        }
    }
    rays
}

/// Values over the angle.
pub(super) fn cartesian(series: &[Series], o: &Options) -> Figure {
    let plane = Plane::new(series, o, DECADES[1]);
    let [lo, hi] = plane.range;
    let end = if plane.curves.full { 180.0 } else { 90.0 };
    let x = Axis::degrees("θ_{i}  [deg], positive on the mirror side", -end, end);
    let y = if o.log { Axis::log(&plane.title, lo, hi, 8) } else { Axis::linear(&plane.title, 0.0, hi, 6) };
    let lines =
        (0..series.len()).map(|i| Line { series: i, points: plane.points(i), spikes: plane.spikes(i) });
    let lines = lines.collect();
    let mut rules = Vec::new();
    if !several_views(series) {
        let theta = series[0].wo_deg[0];
        rules.push(Rule { at: -theta, label: "ω_{o}".to_owned() });
        if theta > 8.0 {
            rules.push(Rule { at: theta, label: "mirror".to_owned() });
        }
    }
    let page = plane_page(series, o, &plane, [960.0, 680.0]);
    let figure = Cartesian { page, x, y, lines, rules };
    Figure { svg: figure.svg(), table: plane.table(series, o.quantity) }
}
