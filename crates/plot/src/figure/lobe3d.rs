//! The whole lobe as a surface in space.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use sparrow_math::LocalDir;

use super::delta::deltas;
use super::options::Options;
use super::{Figure, page, panel_size, view_of};
use crate::draw::axis::Axis;
use crate::draw::mesh::{Body, Facet, Pointer, Space};
use crate::draw::table::Table;
use crate::draw::ticks::{pow10, short};
use crate::series::{Labels, Series};

/// Decades that logarithmic lengths show below the greatest value.
const DECADES: i32 = 3;
/// Directions at which values are asked for before lines are placed: over the polar angle of one side, over the azimuth.
const PROBES: [usize; 2] = [180, 360];

/// Values over a net of directions whose lines crowd where the lobe is narrow.
struct Net {
    /// Polar angles in radians, from the normal to the last line.
    theta: Vec<f64>,
    /// Azimuths in radians, once around; the last equals the first but for a turn.
    phi: Vec<f64>,
    /// A row of values for each polar angle.
    values: Vec<Vec<f64>>,
}

pub(super) fn figure(series: &[Series], o: &Options) -> Figure {
    let below = series.iter().any(|s| s.kind.about().transmits || s.wo_deg[0] > 90.0);
    let n = [38.0, 76.0].map(|n: f64| (n / (series.len() as f64).sqrt().min(1.8)) as usize);
    let nets: Vec<Net> = series.iter().map(|s| Net::new(s, o, below, n)).collect();
    let all = || nets.iter().flat_map(|n| n.values.iter().flatten()).copied().filter(|v| v.is_finite());
    let hi = all().fold(0.0, f64::max);
    let lo = all().filter(|v| *v > 0.0).fold(f64::INFINITY, f64::min).max(hi / pow10(DECADES));
    let title = format!("{}  [1/sr]", o.quantity.symbol());
    let colour = if o.log { Axis::log(&title, lo, hi, 8) } else { Axis::linear(&title, 0.0, hi, 6) };
    let labels = Labels::new(series);
    let mut table = Table::new([
        "series".to_owned(),
        "theta_i_deg".to_owned(),
        "phi_i_deg".to_owned(),
        format!("{} [1/sr]", o.quantity.name()),
    ]);
    let mut bodies = Vec::new();
    for ((s, net), own) in series.iter().zip(&nets).zip(&labels.own) {
        net.list(&s.name(), &mut table);
        bodies.push(Body { title: own.clone(), facets: net.facets(&colour), pointers: pointers(s), below });
    }
    let mut page = page(series, o, &view_of(series), false, panel_size(series.len()));
    if bodies.iter().any(|b| b.pointers.iter().any(|p| p.series.is_some())) {
        page.notes.push(
            "Arrows δ: mirror-like (delta) lobes, with their share of the light; they have no value in 1/sr."
                .to_owned(),
        );
    }
    let azimuth = series[0].wo_deg[1] + 118.0;
    Figure { svg: Space { page, colour, azimuth, elevation: 24.0, bodies }.svg(), table }
}

/// Viewer, normal and delta lobes.
fn pointers(s: &Series) -> Vec<Pointer> {
    let pointer =
        |w: LocalDir<f64>, length: f64, label: String, series| Pointer { tip: w.v() * length, label, series };
    let up = LocalDir::from_angles(0.0, 0.0);
    let mut all = vec![pointer(s.wo(), 1.15, "ω_{o}".to_owned(), None)];
    if s.wo_deg[0] > 12.0 {
        all.push(pointer(up, 1.15, "n".to_owned(), None));
    }
    let mirrors = deltas(&s.model(), s.wo()).into_iter();
    all.extend(mirrors.map(|d| pointer(d.wi, 1.0, format!("δ {}", short(d.share)), Some(1))));
    all
}

impl Net {
    fn new(s: &Series, o: &Options, below: bool, n: [usize; 2]) -> Net {
        let (model, wo) = (s.model(), s.wo());
        let value = |theta: f64, phi: f64| o.quantity.of(&model, wo, LocalDir::from_angles(theta, phi));
        let sides = if below { 2 } else { 1 };
        let rows = sides * PROBES[0];
        let (mut over_theta, mut over_phi) = (vec![0.0f64; rows], vec![0.0f64; PROBES[1]]);
        for (j, most_theta) in over_theta.iter_mut().enumerate() {
            let theta = (j as f64 + 0.5) / PROBES[0] as f64 * FRAC_PI_2;
            for (i, most_phi) in over_phi.iter_mut().enumerate() {
                let v = value(theta, i as f64 / PROBES[1] as f64 * TAU);
                if v.is_finite() {
                    *most_theta = most_theta.max(v);
                    *most_phi = most_phi.max(v);
                }
            }
        }
        // The surface itself is a line of the net: nothing reaches through it.
        let mut theta: Vec<f64> = crowded(&over_theta[..PROBES[0]], n[0]);
        theta.iter_mut().for_each(|t| *t *= FRAC_PI_2);
        if below {
            let lower = crowded(&over_theta[PROBES[0]..], n[0]);
            theta.extend(lower.iter().skip(1).map(|t| FRAC_PI_2 + t * FRAC_PI_2));
        }
        let phi: Vec<f64> = crowded(&over_phi, n[1]).iter().map(|t| t * TAU).collect();
        let row = |t: &f64| {
            // Just off the surface and the axis, where values are defined.
            let t = if (*t - FRAC_PI_2).abs() < 1e-9 { FRAC_PI_2 - 1e-4 } else { t.min(PI - 1e-6) };
            phi.iter().map(|p| value(t, *p)).collect()
        };
        Net { values: theta.iter().map(row).collect(), theta, phi }
    }

    fn facets(&self, colour: &Axis) -> Vec<Facet> {
        let corner = |j: usize, i: usize| {
            let v = self.values[j][i];
            let length = if v.is_finite() { colour.place(v).clamp(0.0, 1.0) } else { 0.0 };
            (LocalDir::from_angles(self.theta[j], self.phi[i]).v() * length, length)
        };
        let mut facets = Vec::new();
        for j in 1..self.theta.len() {
            for i in 1..self.phi.len() {
                let four = [corner(j - 1, i - 1), corner(j - 1, i), corner(j, i), corner(j, i - 1)];
                let tone = 0.25 * four.iter().map(|c| c.1).sum::<f64>();
                facets.push(Facet { corners: four.map(|c| c.0), tone });
            }
        }
        facets
    }

    fn list(&self, name: &str, table: &mut Table) {
        for (theta, row) in self.theta.iter().zip(&self.values) {
            for (phi, v) in self.phi.iter().zip(row) {
                table.named(name, [theta.to_degrees(), phi.to_degrees(), *v]);
            }
        }
    }
}

/// `n + 1` places from 0 to 1 that divide the length of a curve evenly: they crowd where it is steep.
fn crowded(profile: &[f64], n: usize) -> Vec<f64> {
    let greatest = profile.iter().copied().fold(0.0, f64::max);
    let scale = if greatest > 0.0 { 1.0 / greatest } else { 0.0 };
    let across = 1.0 / profile.len() as f64;
    let mut lengths = vec![0.0];
    let mut sum = 0.0;
    for k in 0..profile.len() {
        let next = profile.get(k + 1).copied().unwrap_or(profile[k]);
        // Half of the lines follow the slope, half lie evenly.
        sum += across + 0.6 * scale * (next - profile[k]).abs();
        lengths.push(sum);
    }
    let mut places = Vec::with_capacity(n + 1);
    let mut k = 0;
    for i in 0..=n {
        let want = sum * i as f64 / n as f64;
        while k + 2 < lengths.len() && lengths[k + 1] < want {
            k += 1;
        }
        let u = ((want - lengths[k]) / (lengths[k + 1] - lengths[k])).clamp(0.0, 1.0);
        places.push((k as f64 + u) * across);
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_rise_and_crowd_at_a_peak() {
        let profile: Vec<f64> = (0..100).map(|i| if (48..52).contains(&i) { 1.0 } else { 0.0 }).collect();
        let p = crowded(&profile, 20);
        assert!(p.windows(2).all(|w| w[1] > w[0]) && p.len() == 21, "{p:?}");
        assert!((p[0]).abs() < 1e-12 && (p[20] - 1.0).abs() < 1e-12);
        assert!(p.iter().filter(|x| **x > 0.46 && **x < 0.54).count() > 8, "{p:?}");
    }
}
