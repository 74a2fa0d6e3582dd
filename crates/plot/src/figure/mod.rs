//! Figures of models: what is asked of a model, and how it is shown.

mod albedo;
mod delta;
mod energy;
mod fibre_map;
mod fibre_sections;
mod half_difference;
mod lobe3d;
mod options;
mod plane;
mod plane_curves;
mod samples;
mod width;

pub use delta::{Delta, deltas};
pub use energy::albedo;
pub use fibre_sections::Traced;
pub use half_difference::{from_half_difference, to_half_difference};
pub use options::{Kind, Options, Quantity};
pub use plane::plane_direction;
pub use samples::{Drawn, draw_samples};

use sparrow_models::{Bcsdf, FibreKind};

use crate::draw::page::{Entry, Page};
use crate::draw::table::Table;
use crate::error::PlotError;
use crate::series::{Family, Labels, Series};

/// A figure: a picture, and the numbers in it.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The picture, a whole document.
    pub svg: String,
    /// The numbers.
    pub table: Table,
}

/// Draws series as a figure.
///
/// # Errors
/// Where the kind of figure cannot show these series, such as a map over a parameter that the model has not.
pub fn draw_figure(series: &[Series], options: &Options) -> Result<Figure, PlotError> {
    if series.is_empty() {
        return Err(PlotError::plain("there is no model to plot; name one"));
    }
    match options.kind {
        Kind::Polar => Ok(plane_curves::polar(series, options)),
        Kind::Cartesian => Ok(plane_curves::cartesian(series, options)),
        Kind::Lobe3d => few(series, options).map(|()| lobe3d::figure(series, options)),
        Kind::HalfDifference => few(series, options).map(|()| half_difference::figure(series, options)),
        Kind::Samples => few(series, options).map(|()| samples::figure(series, options)),
        Kind::Albedo => Ok(albedo::curves(series, options)),
        Kind::AlbedoMap => {
            few(series, options)?;
            albedo::map(series, options)
        }
        Kind::Longitudinal | Kind::Azimuthal | Kind::Caustic | Kind::FibreMap => {
            Err(wrong_family(options.kind))
        }
    }
}

/// Draws series of fibres as a figure; over sections what was traced, one for each series, or none.
///
/// # Errors
/// Where the kind of figure shows surfaces alone, or a model has mirror-like lobes alone.
pub fn draw_fibres(
    series: &[Series<FibreKind>],
    traced: &[Traced],
    options: &Options,
) -> Result<Figure, PlotError> {
    if series.is_empty() {
        return Err(PlotError::plain("there is no model to plot; name one"));
    }
    if let Some(s) = series.iter().find(|s| !s.model_at(0.0).has_smooth_lobe()) {
        let name = s.kind.name();
        return Err(PlotError::plain(format!(
            "{name} is a mirror and has no value in 1/sr; plot another model"
        )));
    }
    match options.kind {
        Kind::Longitudinal => Ok(fibre_sections::longitudinal(series, traced, options)),
        Kind::Azimuthal => Ok(fibre_sections::azimuthal(series, traced, options)),
        Kind::Caustic => Ok(fibre_sections::caustic(series, traced, options)),
        Kind::FibreMap => few(series, options).map(|()| fibre_map::figure(series, options)),
        Kind::Polar
        | Kind::Cartesian
        | Kind::Lobe3d
        | Kind::HalfDifference
        | Kind::Samples
        | Kind::Albedo
        | Kind::AlbedoMap => Err(wrong_family(options.kind)),
    }
}

fn wrong_family(kind: Kind) -> PlotError {
    let (of, other) = if kind.of_fibres() { ("fibres", "surfaces") } else { ("surfaces", "fibres") };
    let kinds = Kind::ALL.into_iter().filter(|k| k.of_fibres() != kind.of_fibres()).map(Kind::name);
    PlotError::plain(format!(
        "figures of kind {} show {of}; for {other} there are {}",
        kind.name(),
        kinds.collect::<Vec<_>>().join(", ")
    ))
}

/// More panels than this are too small to read.
const MAX_PANELS: usize = 6;

fn few<K: Family>(series: &[Series<K>], options: &Options) -> Result<(), PlotError> {
    if series.len() <= MAX_PANELS {
        return Ok(());
    }
    Err(PlotError::plain(format!(
        "these are {} panels, and a figure of kind {} has room for {MAX_PANELS}; give fewer values",
        series.len(),
        options.kind.name()
    )))
}

/// Page with title, subtitle and legend: `about` says what is shown and where.
fn page<K: Family>(
    series: &[Series<K>],
    options: &Options,
    about: &[String],
    legend: bool,
    size: [f64; 2],
) -> Page {
    let labels = Labels::new(series);
    let title = options.title.clone().unwrap_or_else(|| labels.models.join(", "));
    let subtitle = about.iter().chain(&labels.shared).cloned().collect::<Vec<_>>().join("  ·  ");
    let entries = labels.own.iter().enumerate().map(|(i, l)| Entry { label: l.clone(), series: i });
    Page {
        size: [options.size[0].unwrap_or(size[0]), options.size[1].unwrap_or(size[1])],
        theme: options.theme(),
        title,
        subtitle,
        legend: if legend && series.len() > 1 { entries.collect() } else { Vec::new() },
        notes: Vec::new(),
    }
}

/// A page that `n` panels fill well.
fn panel_size(n: usize) -> [f64; 2] {
    match n {
        1 => [960.0, 720.0],
        2 => [1280.0, 700.0],
        3 => [1500.0, 640.0],
        4 => [1280.0, 1120.0],
        _ => [1500.0, 1080.0],
    }
}

/// `θo = 45°`, and the azimuth where it is not zero; nothing where series differ in their view.
fn view_of<K: Family>(series: &[Series<K>]) -> Vec<String> {
    if several_views(series) {
        return Vec::new();
    }
    let first = series[0].wo_deg;
    let mut parts = vec![format!("θ_{{o}} = {}°", first[0])];
    if first[1].abs() > 0.0 {
        parts.push(format!("φ_{{o}} = {}°", first[1]));
    }
    parts
}

/// `name: quantity`, as a column of a table; what the name of a series holds besides its model and parameters is the view.
fn column<K: Family>(series: &Series<K>, several_views: bool, what: &str) -> String {
    if several_views {
        format!("{} wo={}: {what}", series.name(), series.wo_deg[0])
    } else {
        format!("{}: {what}", series.name())
    }
}

/// The series differ in their view.
fn several_views<K: Family>(series: &[Series<K>]) -> bool {
    series.iter().any(|s| !s.same_view(&series[0]))
}
