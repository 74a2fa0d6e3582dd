//! Albedo over the angle of the view, and over a parameter too.

use sparrow_models::suggest::remedy;
use sparrow_models::{ParamInfo, ParamKind, SurfaceKind};

use super::energy::albedo;
use super::options::Options;
use super::{Figure, column, page, panel_size};
use crate::draw::axis::{Axis, Scale};
use crate::draw::cartesian::{Cartesian, Line};
use crate::draw::heat::{Grid, Heat, Panel};
use crate::draw::table::{Field, Table};
use crate::error::PlotError;
use crate::series::{Labels, Series, direction, targets};

/// The last angle at which albedo is asked for, in degrees: at 90 a surface is not seen.
const LAST: u32 = 89;

/// The series with the angle of the view free: those that differ in it alone are one.
fn without_view(series: &[Series]) -> Vec<Series> {
    distinct(series.iter().map(|s| Series { wo_deg: [0.0, s.wo_deg[1]], ..s.clone() }))
}

/// The series with a parameter free: those that differ in it alone are one.
fn without(series: &[Series], over: &str) -> Vec<Series> {
    distinct(series.iter().cloned().map(|mut s| {
        let (kind, free) = (s.kind, targets(s.kind, over));
        s.pins.retain(|(name, _)| !targets(kind, name).iter().any(|t| free.contains(t)));
        s
    }))
}

fn distinct(series: impl Iterator<Item = Series>) -> Vec<Series> {
    let mut out: Vec<Series> = Vec::new();
    for s in series {
        if !out.iter().any(|o| o.name() == s.name() && o.same_view(&s)) {
            out.push(s);
        }
    }
    out
}

/// What both figures say of the azimuth.
fn azimuth(series: &[Series]) -> Vec<String> {
    let phi = series[0].wo_deg[1];
    if phi.abs() > 0.0 { vec![format!("φ_{{o}} = {phi}°")] } else { Vec::new() }
}

/// Albedo over the angle.
pub(super) fn curves(series: &[Series], o: &Options) -> Figure {
    let series = without_view(series);
    let mut table = Table::new(
        core::iter::once("theta_o_deg".to_owned()).chain(series.iter().map(|s| column(s, false, "albedo"))),
    );
    let mut lines: Vec<Line> =
        (0..series.len()).map(|i| Line { series: i, points: Vec::new(), spikes: Vec::new() }).collect();
    let models: Vec<_> = series.iter().map(Series::model).collect();
    for theta in (0..=LAST).map(f64::from) {
        let values: Vec<f64> =
            series.iter().zip(&models).map(|(s, m)| albedo(m, direction([theta, s.wo_deg[1]]))).collect();
        for (line, v) in lines.iter_mut().zip(&values) {
            line.points.push([theta, *v]);
        }
        table.numbers(core::iter::once(theta).chain(values));
    }
    let all = || lines.iter().flat_map(|l| &l.points).map(|p| p[1]).filter(|v| v.is_finite());
    let (lo, hi) = (all().filter(|v| *v > 0.0).fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
    let y = if o.log {
        Axis::log("albedo", lo, hi, 8)
    } else {
        // Some room above, so that a curve at one does not lie on the frame.
        let hi = if (0.5..=1.0 + 1e-3).contains(&hi) { 1.0 } else { hi.min(10.0) };
        Axis::fixed("albedo", 0.0, 1.06 * hi, 6)
    };
    let mut about = vec!["directional albedo, all light that leaves".to_owned()];
    about.extend(azimuth(&series));
    let figure = Cartesian {
        page: page(&series, o, &about, true, [960.0, 680.0]),
        x: Axis::degrees("θ_{o}  [deg]", 0.0, 90.0),
        y,
        lines,
        rules: Vec::new(),
    };
    Figure { svg: figure.svg(), table }
}

/// Nodes of a map, over the angle and over the parameter.
const NODES: [usize; 2] = [31, 25];
/// Cells drawn between two nodes.
const FINER: usize = 4;

/// Albedo over angle and parameter.
pub(super) fn map(series: &[Series], o: &Options) -> Result<Figure, PlotError> {
    let series = without_view(series);
    let over = match &o.over {
        Some(name) => name.clone(),
        None => roughness(series[0].kind)?,
    };
    let given: usize = series.iter().map(|s| s.pins.len()).sum();
    let series = without(&series, &over);
    let unused = given > series.iter().map(|s| s.pins.len()).sum();
    let mut axis: Option<Axis> = None;
    for s in &series {
        let info = parameter(s, &over)?;
        axis.get_or_insert_with(|| parameter_axis(&over, info));
    }
    let Some(y) = axis else { return Err(PlotError::plain("there is no model to plot; name one")) };
    let x = Axis::degrees("θ_{o}  [deg]", 0.0, f64::from(LAST));
    let labels = Labels::new(&series);
    let mut table =
        Table::new(["series".to_owned(), "theta_o_deg".to_owned(), over.clone(), "albedo".to_owned()]);
    let mut panels = Vec::new();
    for (s, own) in series.iter().zip(&labels.own) {
        let nodes = nodes(s, &over, &x, &y, &mut table);
        panels.push(Panel { title: own.clone(), grid: finer(&nodes) });
    }
    let values = || panels.iter().flat_map(|p| &p.grid.values).copied().filter(|v| v.is_finite());
    let (lo, hi) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let colour = if o.log && lo > 0.0 {
        Axis::log("albedo", lo, hi, 8)
    } else if hi - lo < 1e-6 {
        Axis::linear("albedo", 0.0, 1.0, 5)
    } else {
        Axis::linear("albedo", lo, hi, 6)
    };
    let mut about = vec!["directional albedo, all light that leaves".to_owned()];
    about.extend(azimuth(&series));
    let mut page = page(&series, o, &about, false, panel_size(panels.len()));
    if unused {
        page.notes
            .push(format!("{over} is the axis of the map; values that were given for it are not used."));
    }
    Ok(Figure { svg: Heat { page, x, y, colour, panels }.svg(), table })
}

/// Albedo at the nodes, row by row from the least value of the parameter.
fn nodes(s: &Series, over: &str, x: &Axis, y: &Axis, table: &mut Table) -> Vec<Vec<f64>> {
    let mut rows = Vec::new();
    for j in 0..NODES[1] {
        let v = y.at(j as f64 / (NODES[1] - 1) as f64).clamp(y.lo, y.hi);
        let mut s = s.clone();
        s.set(over, v);
        let model = s.model();
        let mut row = Vec::new();
        for i in 0..NODES[0] {
            let theta = x.at(i as f64 / (NODES[0] - 1) as f64);
            let a = albedo(&model, direction([theta, s.wo_deg[1]]));
            let numbers = [theta, v, a].map(Field::Number);
            table.rows.push(core::iter::once(Field::Text(s.name())).chain(numbers).collect());
            row.push(a);
        }
        rows.push(row);
    }
    rows
}

/// Cells between the nodes, bilinear.
fn finer(nodes: &[Vec<f64>]) -> Grid {
    let [nx, ny] = [(NODES[0] - 1) * FINER, (NODES[1] - 1) * FINER];
    let mut values = Vec::with_capacity(nx * ny);
    let split = |k: usize| {
        let t = (k as f64 + 0.5) / FINER as f64;
        (t as usize, t - t.floor())
    };
    for j in 0..ny {
        let (row, v) = split(j);
        for i in 0..nx {
            let (at, u) = split(i);
            let along = |r: &[f64]| (1.0 - u) * r[at] + u * r[at + 1];
            values.push((1.0 - v) * along(&nodes[row]) + v * along(&nodes[row + 1]));
        }
    }
    Grid { nx, ny, values }
}

/// The parameter that models call their roughness, in one way or another.
fn roughness(kind: SurfaceKind) -> Result<String, PlotError> {
    const NAMES: [&str; 6] = ["alpha", "roughness", "sigma", "exponent", "c_per_deg", "beta"];
    let found = NAMES.into_iter().find(|n| !targets(kind, n).is_empty());
    found.map(str::to_owned).ok_or_else(|| {
        PlotError::plain(format!(
            "{} has no roughness; name a parameter with --over, or use --kind albedo; {}",
            kind.name(),
            remedy("", numbers(kind))
        ))
    })
}

fn numbers(kind: SurfaceKind) -> Vec<&'static str> {
    kind.params().iter().filter(|p| !matches!(p.kind, ParamKind::Choice(_))).map(|p| p.name).collect()
}

/// The table's row of a parameter that takes a number.
fn parameter<'a>(s: &'a Series, over: &str) -> Result<&'a ParamInfo, PlotError> {
    let found = targets(s.kind, over);
    let table = s.kind.params();
    let info = found.first().map(|i| &table[*i]).filter(|p| !matches!(p.kind, ParamKind::Choice(_)));
    let Some(info) = info else {
        let remedy = remedy(over, numbers(s.kind));
        return Err(PlotError::plain(format!(
            "{} has no number `{over}` to plot over; {remedy}",
            s.kind.name()
        )));
    };
    Ok(info)
}

/// An axis over the range that a slider would offer; logarithmic where that spans more than a decade and a half.
fn parameter_axis(name: &str, info: &ParamInfo) -> Axis {
    let [lo, hi] = info.soft;
    let hi = if hi.is_finite() { hi } else { 5.0 };
    let unit = if info.unit == "1" { String::new() } else { format!("  [{}]", info.unit) };
    let title = format!("{name}{unit}");
    let wide = lo > 0.0 && hi / lo > 70.0 && hi > 2.0;
    let axis = if wide { Axis::log_fixed(&title, lo, hi, 8) } else { Axis::fixed(&title, lo, hi, 7) };
    debug_assert!(axis.scale == Scale::Linear || axis.lo > 0.0, "a logarithm needs numbers above zero");
    axis
}
