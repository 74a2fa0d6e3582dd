//! The plane of incidence: directions by one angle, and curves over it.

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::{Bsdf, Surface, Uniforms};
use sparrow_stats::Random;

use super::delta::{Delta, deltas};
use super::options::Quantity;
use crate::draw::ticks::log10;
use crate::series::Series;

/// An angle in millionths of a degree: such angles are told apart exactly, and short when written.
type Micro = i64;
const DEGREE: Micro = 1_000_000;

fn degrees(a: Micro) -> f64 {
    a as f64 / DEGREE as f64
}

/// The direction in the plane of the normal and `wo` at a signed angle from the normal, in degrees: `wo` itself lies at
/// minus its polar angle, its mirror image at plus that angle, the lower side beyond 90.
pub fn plane_direction(wo_deg: [f64; 2], theta_deg: f64) -> LocalDir<f64> {
    let (s, c) = Real::sin_cos(theta_deg.to_radians());
    let (sp, cp) = Real::sin_cos(wo_deg[1].to_radians());
    LocalDir::new(vec3(-s * cp, -s * sp, c))
}

/// The signed angle of a direction that lies in the plane or near it, in degrees.
pub(crate) fn plane_angle(wo_deg: [f64; 2], w: LocalDir<f64>) -> f64 {
    let (sp, cp) = Real::sin_cos(wo_deg[1].to_radians());
    let along = -(w.x() * cp + w.y() * sp);
    Real::atan2(w.sin2_theta().sqrt().copysign(along), w.z()).to_degrees()
}

/// Curves over the same angles.
pub(crate) struct Curves {
    /// Signed angles in degrees, rising.
    pub(crate) theta: Vec<f64>,
    /// A value for each angle, per series.
    pub(crate) values: Vec<Vec<f64>>,
    /// What has no value, per series: signed angle in degrees, and share of the light.
    pub(crate) deltas: Vec<Vec<(f64, f64)>>,
    /// Something may be seen below the surface.
    pub(crate) full: bool,
}

/// Curves of all series, with more angles where any of them bends.
pub(crate) fn curves(series: &[Series], quantity: Quantity, log: bool) -> Curves {
    let full = series.iter().any(|s| s.kind.about().transmits || s.wo_deg[0] > 90.0);
    let end = if full { 180 } else { 90 };
    let mut grid: Vec<Micro> = (-end..=end).map(|d| d * DEGREE).collect();
    // The surface itself: seen from both sides it has no value, and curves end just before it.
    for horizon in [-90 * DEGREE, 90 * DEGREE] {
        grid.extend([horizon - DEGREE / 100, horizon + DEGREE / 100]);
    }
    grid.retain(|a| a.abs() <= end * DEGREE && a.abs() != 90 * DEGREE);
    let models: Vec<Surface<f64>> = series.iter().map(Series::model).collect();
    for (s, model) in series.iter().zip(&models) {
        grid.extend(likely(s, model));
        grid.extend([s.wo_deg[0], -s.wo_deg[0]].map(|t| (t * DEGREE as f64).round() as Micro));
    }
    grid.retain(|a| a.abs() <= end * DEGREE);
    grid.sort_unstable();
    grid.dedup();
    let mut all = grid.clone();
    for (s, model) in series.iter().zip(&models) {
        let value = |a: Micro| quantity.of(model, s.wo(), plane_direction(s.wo_deg, degrees(a)));
        all.extend(bends(&grid, value, log));
    }
    all.sort_unstable();
    all.dedup();
    let theta: Vec<f64> = all.iter().map(|a| degrees(*a)).collect();
    let values = series.iter().zip(&models).map(|(s, model)| {
        let at = |t: &f64| quantity.of(model, s.wo(), plane_direction(s.wo_deg, *t));
        theta.iter().map(at).collect()
    });
    let spikes = series.iter().zip(&models).map(|(s, model)| {
        let place = |d: &Delta| (plane_angle(s.wo_deg, d.wi), d.share);
        deltas(model, s.wo()).iter().map(place).collect()
    });
    Curves { values: values.collect(), deltas: spikes.collect(), theta, full }
}

/// Angles at which a narrow lobe may lie: those of a few samples.
fn likely(s: &Series, model: &Surface<f64>) -> Vec<Micro> {
    let mut random = Random::named(0, "plane");
    let mut angles = Vec::new();
    for _ in 0..64 {
        let (lobe, dir) = (random.uniform(), [random.uniform(), random.uniform()]);
        let sample = model.sample(s.wo(), Uniforms { lobe, dir });
        if sample.valid && !sample.delta {
            let angle = plane_angle(s.wo_deg, sample.wi);
            // Thousandths of a degree, so that tables stay short.
            angles.push((angle * 1e3).round() as Micro * (DEGREE / 1000));
        }
    }
    angles
}

/// Least distance of angles, and most angles that are added for one curve.
const FINEST: Micro = DEGREE / 512;
const MOST: usize = 4000;

/// Angles between those of `grid` that a curve needs to look smooth.
fn bends(grid: &[Micro], value: impl Fn(Micro) -> f64, log: bool) -> Vec<Micro> {
    let at: Vec<f64> = grid.iter().map(|a| value(*a)).collect();
    let mut greatest = at.iter().copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
    let height = |v: f64, greatest: f64| {
        if greatest <= 0.0 || !v.is_finite() {
            0.0
        } else if log {
            1.0 + log10((v / greatest).max(1e-6)) / 6.0
        } else {
            v / greatest
        }
    };
    let mut added = Vec::new();
    let mut open: Vec<[(Micro, f64); 2]> =
        (1..grid.len()).map(|i| [(grid[i - 1], at[i - 1]), (grid[i], at[i])]).rev().collect();
    while let Some([a, b]) = open.pop() {
        if b.0 - a.0 < 2 * FINEST || added.len() >= MOST {
            continue;
        }
        let middle = (a.0 + b.0) / 2;
        let m = (middle, value(middle));
        if m.1.is_finite() {
            greatest = greatest.max(m.1);
        }
        let line = 0.5 * (height(a.1, greatest) + height(b.1, greatest));
        if (height(m.1, greatest) - line).abs() > 1.5e-3 {
            added.push(middle);
            open.push([m, b]);
            open.push([a, m]);
        }
    }
    added
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_models::SurfaceKind;

    #[test]
    fn angles_and_directions_agree() {
        for theta in [-170.0, -45.0, 0.0, 30.0, 89.0, 120.0] {
            let w = plane_direction([40.0, 70.0], theta);
            assert!((plane_angle([40.0, 70.0], w) - theta).abs() < 1e-12, "{theta}");
        }
        let s = Series { wo_deg: [40.0, 70.0], ..Series::new(SurfaceKind::Lambert) };
        assert!(plane_direction(s.wo_deg, -40.0).dot(s.wo()) > 1.0 - 1e-14);
    }

    #[test]
    fn narrow_lobes_are_found() {
        let mut s = Series::new(SurfaceKind::Conductor);
        s.set("alpha", 0.002);
        let c = curves(&[s.clone()], Quantity::F, false);
        let greatest = c.values[0].iter().copied().fold(0.0, f64::max);
        let peak = Quantity::F.of(&s.model(), s.wo(), plane_direction(s.wo_deg, 45.0));
        assert!(greatest >= peak && greatest < 1.01 * peak, "{greatest} {peak}");
        assert!(c.theta.len() > 250 && c.theta.len() < 3000, "{}", c.theta.len());
        assert!(!c.full && c.deltas[0].is_empty());
    }
}
