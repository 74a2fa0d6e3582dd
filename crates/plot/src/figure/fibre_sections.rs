//! Sections of fibres: light over the inclination, around the fibre, and TRT with its caustics.

use core::f64::consts::PI;

use sparrow_models::{FibreKind, N_LOBES};

use super::options::Options;
use super::width::Width;
use super::{Figure, column, page, several_views, view_of};
use crate::draw::axis::Axis;
use crate::draw::cartesian::{Cartesian, Line};
use crate::draw::page::Entry;
use crate::draw::table::Table;
use crate::draw::ticks::pow10;
use crate::series::{Series, inclined};

/// Names of lobes, and of their sum.
const LOBES: [&str; N_LOBES + 1] = ["R", "TT", "TRT", "more", "all"];
/// Rays over the width of a fibre that has no far field of its own.
const RAYS: usize = 96;
/// Directions summed over.
const SUMMED: usize = 90;
/// Decades that a logarithmic axis shows.
const DECADES: i32 = 5;

/// What a fibre that was traced sends, lobe by lobe, to be laid over a series' section.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The angles of the section, in degrees, whole numbers.
    pub angles: Vec<f64>,
    /// Light by lobe at each.
    pub lobes: Vec<[f64; N_LOBES]>,
}

/// Lines of one colour lie this many series apart, the later ones dashed.
const DASHED: usize = 7;

/// What runs along the abscissa, from `-end` to `end` degrees in steps of `step`; the other angle is summed over.
struct Section {
    along: bool,
    end: f64,
    step: f64,
    /// One lobe alone.
    only: Option<usize>,
    title: &'static str,
    unit: &'static str,
    about: &'static str,
}

/// `A_p M_p` over the inclination.
pub(super) fn longitudinal(series: &[Series<FibreKind>], traced: &[Traced], o: &Options) -> Figure {
    figure(
        series,
        traced,
        o,
        &Section {
            along: true,
            end: 90.0,
            step: 0.5,
            only: None,
            title: "inclination θ_{i}  [deg]",
            unit: "∫ S cos θ_{i} dφ  [rad/sr]",
            about: "light over the inclination, from all azimuths",
        },
    )
}

/// `N_p` around the fibre.
pub(super) fn azimuthal(series: &[Series<FibreKind>], traced: &[Traced], o: &Options) -> Figure {
    figure(
        series,
        traced,
        o,
        &Section {
            along: false,
            end: 180.0,
            step: 1.0,
            only: None,
            title: "azimuth φ_{i} - φ_{o}  [deg]",
            unit: "∫ S cos² θ_{i} dθ_{i}  [1/rad]",
            about: "light around the fibre, from all inclinations",
        },
    )
}

/// `N_TRT` about the viewer's azimuth.
pub(super) fn caustic(series: &[Series<FibreKind>], traced: &[Traced], o: &Options) -> Figure {
    figure(
        series,
        traced,
        o,
        &Section {
            along: false,
            end: 60.0,
            step: 0.25,
            only: Some(2),
            title: "azimuth φ_{i} - φ_{o}  [deg]",
            unit: "∫ S_{TRT} cos² θ_{i} dθ_{i}  [1/rad]",
            about: "TRT around the fibre, from all inclinations",
        },
    )
}

impl Section {
    fn angles(&self) -> Vec<f64> {
        let n = (2.0 * self.end / self.step).round() as usize;
        (0..=n).map(|k| k as f64 * self.step - self.end).collect()
    }
    fn unit_name(&self) -> &'static str {
        if self.along { "[rad/sr]" } else { "[1/rad]" }
    }
    /// The lobes at one angle, summed over the other.
    fn at(&self, s: &Series<FibreKind>, width: &Width, angle: f64) -> [f64; N_LOBES] {
        let (whole, wo) = (if self.along { 360.0 } else { 180.0 }, s.wo());
        let step = whole / SUMMED as f64;
        let mut sum = [0.0; N_LOBES];
        for k in 0..SUMMED {
            let other = (k as f64 + 0.5) * step - 0.5 * whole;
            let [theta, phi] = if self.along { [angle, other] } else { [other, angle] };
            // Over inclinations solid angle is cos theta dtheta dphi.
            let wi = inclined([theta, s.wo_deg[1] + phi]);
            let measure = if self.along { 1.0 } else { sparrow_models::fibre_cosine(wi) };
            for (sum, q) in sum.iter_mut().zip(width.lobes(wo, wi)) {
                *sum += q * measure * step * (PI / 180.0);
            }
        }
        sum
    }
}

fn figure(series: &[Series<FibreKind>], traced: &[Traced], o: &Options, section: &Section) -> Figure {
    let angles = section.angles();
    let curves = |s: &Series<FibreKind>| -> Vec<[f64; N_LOBES]> {
        let width = Width::new(s, RAYS);
        angles.iter().map(|a| section.at(s, &width, *a)).collect()
    };
    let all: Vec<_> = series.iter().map(curves).collect();
    let own = |lobes: &[f64; N_LOBES]| section.only.map_or(lobes.iter().sum(), |p| lobes[p]);
    // One model is shown lobe by lobe, several by what is asked of them.
    let alone = all.len() == 1 && section.only.is_none();
    let mut columns: Vec<Column> = Vec::new();
    let views = several_views(series);
    for (k, (s, curve)) in series.iter().zip(&all).enumerate() {
        let name = if alone { String::new() } else { column(s, views, section.unit_name()) };
        let measured = traced.get(k).map(|t| (t.at(&angles), format!("{name} traced").trim().to_owned()));
        let sides = core::iter::once((curve.clone(), name.clone(), 0))
            .chain(measured.map(|(lobes, name)| (lobes, name, DASHED)));
        for (lobes, name, dashed) in sides {
            if alone {
                columns.extend(by_lobe(&lobes, &name, dashed));
            } else {
                let values = lobes.iter().map(own).collect();
                columns.push(Column { name, series: k + dashed, values });
            }
        }
    }
    let head = if section.along { "theta_i_deg" } else { "phi_deg" };
    let mut table =
        Table::new(core::iter::once(head.to_owned()).chain(columns.iter().map(|c| c.name.clone())));
    for (k, angle) in angles.iter().enumerate() {
        table.numbers(core::iter::once(*angle).chain(columns.iter().map(|c| c.values[k])));
    }
    let hi = columns.iter().flat_map(|c| &c.values).copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
    let y = if o.log {
        Axis::log(section.unit, hi / pow10(DECADES), hi, 8)
    } else {
        Axis::linear(section.unit, 0.0, hi, 6)
    };
    let mut about = vec![section.about.to_owned()];
    about.extend(view_of(series));
    about.push(
        if series.iter().any(|s| s.h.is_some()) { "near field" } else { "over the whole width" }.to_owned(),
    );
    let mut page = page(series, o, &about, !alone, [960.0, 680.0]);
    if alone && columns.len() > 1 || !traced.is_empty() {
        let entry = |c: &Column| Entry { label: c.name.clone(), series: c.series };
        page.legend = columns.iter().map(entry).collect();
    }
    let line = |c: &Column| Line {
        series: c.series,
        points: angles.iter().zip(&c.values).map(|(a, v)| [*a, *v]).filter(|p| p[1].is_finite()).collect(),
        spikes: Vec::new(),
    };
    let lines = columns.iter().map(line).collect();
    let x = Axis::degrees(section.title, -section.end, section.end);
    Figure { svg: Cartesian { page, x, y, lines, rules: Vec::new() }.svg(), table }
}

/// One line and its numbers.
struct Column {
    name: String,
    series: usize,
    values: Vec<f64>,
}

/// Lobes that are there, and their sum; the sum alone of a model that tells no lobes apart.
fn by_lobe(curve: &[[f64; N_LOBES]], name: &str, dashed: usize) -> Vec<Column> {
    let column = |p: usize, values: Vec<f64>| Column {
        name: format!("{} {name}", LOBES[p]).trim().to_owned(),
        series: p + dashed,
        values,
    };
    let lobe = |p: usize| column(p, curve.iter().map(|lobes| lobes[p]).collect());
    let mut columns: Vec<Column> =
        (0..N_LOBES).map(lobe).filter(|c| c.values.iter().any(|v| *v > 0.0)).collect();
    if columns.len() < 2 {
        columns.clear();
    }
    columns.push(column(N_LOBES, curve.iter().map(|lobes| lobes.iter().sum()).collect()));
    columns
}

impl Traced {
    /// The lobes at the angles of a section; no numbers between those of the trace.
    fn at(&self, angles: &[f64]) -> Vec<[f64; N_LOBES]> {
        let near = |a: &f64| self.angles.iter().position(|b| (a - b).abs() < 1e-9);
        angles.iter().map(|a| near(a).map_or([f64::NAN; N_LOBES], |k| self.lobes[k])).collect()
    }
}
