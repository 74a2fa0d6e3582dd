//! The albedo of GGX facets that reflect everything, single scattering: what energy compensation starts from.
//!
//! `E(mu, alpha)` with height-correlated Smith masking and F = 1, and its mean `2 int E mu dmu`. A table of 48 by 32
//! numbers, built at first use by quadrature in double precision, the same on every machine. The first axis is
//! `t = mu (1 + alpha) / (mu + alpha)`: as a function of it, `E` is smooth down to mirrors, whose dip at grazing angles
//! is as wide as `alpha`. The second is `sqrt(alpha)`. Error 1e-3 for cosines
//! from 0.01, 3e-3 below.

use std::sync::OnceLock;

use sparrow_math::{LocalDir, Real, vec3};

use crate::ggx::Ggx;
use crate::table::{Place, interpolate};

const N_T: usize = 48;
const N_ALPHA: usize = 32;
/// Nodes of the mean, finer because its distance from 1 is divided by.
const N_MEAN: usize = 256;
/// Points of the quadrature in azimuth (half a turn) and height.
const QUADRATURE: [usize; 2] = [24, 32];

/// Table of [`single`] and its means.
#[derive(Debug)]
pub struct AlbedoTable {
    albedo: Box<[f32]>,
    mean: [f32; N_MEAN],
}

/// The albedo at one pair of cosine and width, by quadrature over normals visible from there.
///
/// `n` points in half the azimuth and, twice, in height: the height where directions first cross the horizon is found
/// before, because the light drops to zero within a thin layer there on smooth surfaces.
pub fn single(mu: f64, alpha: f64, n: [usize; 2]) -> f64 {
    let ggx = Ggx::new(alpha, alpha);
    let wo = LocalDir::new(vec3((1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu));
    let mut sum = 0.0;
    for i in 0..n[0] {
        // Both halves of the azimuth are alike.
        let u = 0.5 * (i as f64 + 0.5) / n[0] as f64;
        let mirrored = |height: f64| wo.reflect(ggx.sample_visible(wo, [u, height]));
        let (mut end, mut out) = (0.0, 1.0);
        while out - end > 1e-9 {
            let middle = 0.5 * (end + out);
            if mirrored(middle).above() { end = middle } else { out = middle }
        }
        // Beyond the first crossing some azimuths come up again.
        for (from, width) in [(0.0, end), (end, 1.0 - end)] {
            for j in 0..n[1] {
                // Points crowd at both ends.
                let v = (j as f64 + 0.5) / n[1] as f64;
                let wi = mirrored(from + width * v * v * (3.0 - 2.0 * v));
                let weight = width * 6.0 * v * (1.0 - v);
                sum += if wi.above() { weight * ggx.g2_over_g1(wo, wi) } else { 0.0 };
            }
        }
    }
    sum / (n[0] * n[1]) as f64
}

/// The table, built at first use.
pub fn ggx() -> &'static AlbedoTable {
    static TABLE: OnceLock<AlbedoTable> = OnceLock::new();
    TABLE.get_or_init(AlbedoTable::build)
}

/// The width at a row of the table.
fn alpha_at(row: f64) -> f64 {
    (row / (N_ALPHA - 1) as f64).powi(2).max(1e-4)
}

impl AlbedoTable {
    fn build() -> Self {
        let mut albedo = vec![0.0; N_T * N_ALPHA];
        for row in 0..N_ALPHA {
            let alpha = alpha_at(row as f64);
            for col in 0..N_T {
                let t = col as f64 / (N_T - 1) as f64;
                let mu = (t * alpha / (1.0 + alpha - t)).clamp(1e-6, 1.0);
                albedo[row * N_T + col] = single(mu, alpha, QUADRATURE) as f32;
            }
        }
        let mut table = AlbedoTable { albedo: albedo.into_boxed_slice(), mean: [0.0; N_MEAN] };
        for row in 0..N_MEAN {
            // The mean of what look-ups return, so that compensation adds up with them.
            let n = 1024;
            let alpha = (row as f64 / (N_MEAN - 1) as f64).powi(2).max(1e-4);
            let sum: f64 = (0..n)
                .map(|i| {
                    let mu = (f64::from(i) + 0.5) / f64::from(n);
                    2.0 * mu * table.albedo(mu, alpha) / f64::from(n)
                })
                .sum();
            table.mean[row] = sum as f32;
        }
        table
    }

    /// `E(mu, alpha)`, `mu` in [0, 1], `alpha` in [0, 1].
    #[inline(always)]
    pub fn albedo<R: Real>(&self, mu: R, alpha: R) -> R {
        let alpha = alpha.max(R::of(1e-4));
        let t = (mu * (R::ONE + alpha) / (mu + alpha)).min(R::ONE);
        interpolate(&self.albedo, [Place::unit(N_ALPHA, alpha.sqrt()), Place::unit(N_T, t)])
    }

    /// `2 int E(mu, alpha) mu dmu`
    #[inline(always)]
    pub fn mean<R: Real>(&self, alpha: R) -> R {
        interpolate(&self.mean, [Place::unit(N_MEAN, alpha.max(R::of(1e-4)).sqrt())])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrature_agrees_with_counting() {
        for (mu, alpha) in [(1.0, 0.11), (0.02, 0.05), (0.3, 0.2), (0.01, 1.0), (0.6, 0.9)] {
            let ggx = Ggx::new(alpha, alpha);
            let wo = LocalDir::new(vec3(Real::safe_sqrt(1.0 - mu * mu), 0.0, mu));
            let n = 1000;
            let mut sum = 0.0;
            for i in 0..n * n {
                let u = [(f64::from(i % n) + 0.5) / f64::from(n), (f64::from(i / n) + 0.5) / f64::from(n)];
                let wi = wo.reflect(ggx.sample_visible(wo, u));
                sum += if wi.above() { ggx.g2_over_g1(wo, wi) } else { 0.0 };
            }
            let want = sum / f64::from(n * n);
            for points in [[96, 192], QUADRATURE] {
                let got = single(mu, alpha, points);
                assert!((got - want).abs() < 3e-4, "{mu} {alpha} {points:?}: {got} {want}");
            }
        }
    }

    #[test]
    fn look_ups_agree_with_quadrature() {
        let mut worst = (0.0, 0.0, 0.0);
        for alpha in [0.002, 0.013, 0.05, 0.11, 0.2, 0.37, 0.5, 0.83, 1.0] {
            for mu in [0.01, 0.04, 0.1, 0.23, 0.5, 0.71, 0.9, 1.0] {
                let want = single(mu, alpha, [96, 192]);
                let got = ggx().albedo(mu, alpha);
                if (got - want).abs() > worst.0 {
                    worst = ((got - want).abs(), mu, alpha);
                }
            }
        }
        assert!(worst.0 < 1e-3, "{worst:?}");
    }
}
