//! The whole lobe as a surface in space.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use sparrow_math::{Frame, LocalDir, Real};

use super::delta::deltas;
use super::options::Options;
use super::{Figure, page, panel_size, view_of};
use crate::draw::axis::Axis;
use crate::draw::mesh::{Body, Facet, Pointer, Space};
use crate::draw::table::Table;
use crate::draw::ticks::{pow10, short};
use crate::series::{Labels, Series};

/// Colour of arrows of delta lobes, among those of series: one that the colour map has not.
const MIRROR: usize = 3;
/// Decades that logarithmic lengths show below the greatest value.
const DECADES: i32 = 3;
/// Directions at which values are asked for before lines are placed: away from the normal or the peak, and around.
const PROBES: [usize; 2] = [120, 360];

/// Values over a net of directions: rays from the peak of the lobe to the horizon, and rings around the peak, both closer
/// where the lobe is narrow. The horizon is a line of the net.
struct Net {
    /// Directions ring by ring, the first all at the peak, the last on the horizon.
    rings: Vec<Vec<(LocalDir<f64>, f64)>>,
}

pub(super) fn figure(series: &[Series], o: &Options) -> Figure {
    let below = series.iter().any(|s| s.kind.about().transmits || s.wo_deg[0] > 90.0);
    let n = [40.0, 76.0].map(|n: f64| (n / (series.len() as f64).sqrt().min(1.8)) as usize);
    let sides: &[f64] = if below { &[1.0, -1.0] } else { &[1.0] };
    let nets: Vec<Vec<Net>> =
        series.iter().map(|s| sides.iter().map(|side| Net::new(s, o, *side, n)).collect()).collect();
    let points = || nets.iter().flatten().flat_map(|n| n.rings.iter().flatten());
    let all = || points().map(|p| p.1).filter(|v| v.is_finite());
    let hi = all().fold(0.0, f64::max);
    let lo = all().filter(|v| *v > 0.0).fold(f64::INFINITY, f64::min).max(hi / pow10(DECADES));
    let title = format!("{}  [1/sr]", o.quantity.symbol());
    let colour = if o.log { Axis::log(&title, lo, hi, 8) } else { Axis::fixed(&title, 0.0, hi, 6) };
    let labels = Labels::new(series);
    let mut table = Table::new([
        "series".to_owned(),
        "theta_i_deg".to_owned(),
        "phi_i_deg".to_owned(),
        format!("{} [1/sr]", o.quantity.name()),
    ]);
    let mut bodies = Vec::new();
    for ((s, net), own) in series.iter().zip(&nets).zip(&labels.own) {
        net.iter().for_each(|n| n.list(&s.name(), &mut table));
        let facets = net.iter().flat_map(|n| n.facets(&colour)).collect();
        bodies.push(Body { title: own.clone(), facets, pointers: pointers(s), below });
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
    all.extend(mirrors.map(|d| pointer(d.wi, 1.15, format!("δ {}", short(d.share)), Some(MIRROR))));
    all
}

/// The direction in which a value is greatest on one side of the surface; the normal where none stands out.
fn peak(value: &impl Fn(LocalDir<f64>) -> f64, side: f64) -> LocalDir<f64> {
    let at = |theta: f64, phi: f64| LocalDir::from_angles(if side > 0.0 { theta } else { PI - theta }, phi);
    let score = |t: f64, p: f64| Some(value(at(t, p))).filter(|v| v.is_finite()).unwrap_or(0.0);
    let mut best = [0.0, 0.0, score(0.0, 0.0) * (1.0 + 1e-9)];
    let step = FRAC_PI_2 / PROBES[0] as f64;
    // Not to the very horizon, where values may grow without limit.
    for j in 1..PROBES[0] - 4 {
        for i in 0..PROBES[1] {
            let [t, p] = [j as f64 * step, i as f64 / PROBES[1] as f64 * TAU];
            let v = score(t, p);
            if v > best[2] {
                best = [t, p, v];
            }
        }
    }
    let mut reach = step;
    while reach > 1e-5 {
        let [t, p, _] = best;
        for [dt, dp] in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
            let [t, p] = [(t + dt * reach).clamp(0.0, 1.5), p + dp * reach];
            let v = score(t, p);
            if v > best[2] {
                best = [t, p, v];
            }
        }
        reach *= 0.7;
    }
    at(best[0], best[1])
}

impl Net {
    fn new(s: &Series, o: &Options, side: f64, n: [usize; 2]) -> Net {
        let (model, wo) = (s.model(), s.wo());
        let value = |w: LocalDir<f64>| o.quantity.of(&model, wo, w);
        let frame = Frame::from_z(peak(&value, side).v());
        // From the peak along the azimuth `psi` around it, `u` of the way to the horizon.
        let at = |psi: f64, u: f64| {
            let (s, c) = Real::sin_cos(psi);
            let e = frame.x * c + frame.y * s;
            let to_horizon = Real::atan2(frame.z.z.abs(), -e.z * side);
            let (s, c) = Real::sin_cos(u * to_horizon);
            LocalDir::new(frame.z * c + e * s)
        };
        let probe = |psi: f64| -> Vec<f64> {
            let along = (0..PROBES[0]).map(|j| value(at(psi, (j as f64 + 0.5) / PROBES[0] as f64)));
            along.map(|v| if v.is_finite() { v } else { 0.0 }).collect()
        };
        // How much of the lobe lies at each azimuth, and along each azimuth where it ends.
        let share = |i: usize| probe(i as f64 / PROBES[1] as f64 * TAU).iter().sum();
        let around = crowded(&(0..PROBES[1]).map(share).collect::<Vec<f64>>(), n[1]);
        let rays: Vec<Vec<f64>> = around.iter().map(|t| crowded(&probe(t * TAU), n[0])).collect();
        let point = |t: &f64, ray: &Vec<f64>, j: usize| {
            // Just off the horizon, where values are defined.
            let w = at(t * TAU, ray[j].min(1.0 - 1e-5));
            (w, value(w))
        };
        let ring = |j: usize| around.iter().zip(&rays).map(|(t, ray)| point(t, ray, j)).collect();
        Net { rings: (0..=n[0]).map(ring).collect() }
    }

    fn facets(&self, colour: &Axis) -> Vec<Facet> {
        let corner = |j: usize, i: usize| {
            let (w, v) = self.rings[j][i];
            let length = if v.is_finite() { colour.place(v).clamp(0.0, 1.0) } else { 0.0 };
            (w.v() * length, length)
        };
        let mut facets = Vec::new();
        for j in 1..self.rings.len() {
            for i in 1..self.rings[j].len() {
                let four = [corner(j - 1, i - 1), corner(j, i - 1), corner(j, i), corner(j - 1, i)];
                let tone = 0.25 * four.iter().map(|c| c.1).sum::<f64>();
                facets.push(Facet { corners: four.map(|c| c.0), tone });
            }
        }
        facets
    }

    fn list(&self, name: &str, table: &mut Table) {
        for (w, v) in self.rings.iter().flatten() {
            let theta = Real::atan2(w.sin2_theta().sqrt(), w.z());
            table.named(name, [theta.to_degrees(), Real::atan2(w.y(), w.x()).to_degrees(), *v]);
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
        // A rise from nothing to the greatest value gets about as many lines as the whole width.
        sum += across + 1.2 * scale * (next - profile[k]).abs();
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
