//! What facets of a boundary between dielectrics send to either side, single scattering: `E = R + T` as light energy.
//!
//! Height-correlated GGX as in [`single`](super::albedo::single), with Fresnel's reflectance and correlated masking of
//! refraction [Heitz2016, eq. 23]. What `E` lacks of one is light that meets several facets; that is what the table holds, since
//! it may be so small that `1 - E` in single precision would be rounding. A table of 24 cosines, 20 widths and
//! 17 indices, 8 to either side of one, built at first use in double precision; the axes are those of
//! [`AlbedoTable`](super::albedo::AlbedoTable) and the root of `(eta - 1) / (eta + 1)`, up to an index of 3, which resolves
//! what happens at grazing angles when the index comes near one. Linear between nodes; error at most 0.014, at grazing
//! angles of indices near one.

use std::sync::OnceLock;

use sparrow_math::{LocalDir, Real, vec3};

use super::{Facets, Masking, Ndf, NdfKind, Sampling};
use crate::fresnel;
use crate::table::{Place, interpolate};

const N_T: usize = 24;
const N_ALPHA: usize = 20;
const N_ETA: usize = 17;
/// `(eta - 1) / (eta + 1)` at the ends of the axis: indices of 1/3 and 3.
const S_MAX: f64 = 0.5;
/// Points of the quadrature in half the azimuth and in height.
const QUADRATURE: [usize; 2] = [12, 32];

/// The table and its means.
#[derive(Debug)]
pub struct BoundaryTable {
    lost: Box<[f32]>,
    mean: [[f32; N_ALPHA]; N_ETA],
}

/// `E` at one cosine, width and index, transmitted over incident side, by quadrature over visible normals.
pub fn single(mu: f64, alpha: f64, eta: f64, n: [usize; 2]) -> f64 {
    let facets = Facets::new(Ndf::new(NdfKind::Ggx, alpha, alpha, 0.0), Masking::Smith, Sampling::Visible);
    let o = LocalDir::new(vec3((1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu));
    let lambda_o = facets.ndf().lambda(o);
    let mut sum = 0.0;
    for i in 0..n[0] {
        for j in 0..n[1] {
            let u = [0.5 * (i as f64 + 0.5) / n[0] as f64, (j as f64 + 0.5) / n[1] as f64];
            let m = facets.sample(o, u);
            let cos = o.dot(m).clamp(0.0, 1.0);
            let (reflectance, cos_t) = fresnel::dielectric(cos, eta);
            let up = o.reflect(m);
            if up.above() {
                sum += reflectance * facets.ndf().ggx().g2_over_g1(o, up);
            }
            let down = LocalDir::new(m.v() * (cos / eta - cos_t) - o.v() * (1.0 / eta));
            if down.z() < 0.0 {
                let g2 = facets.transmitted_g2_over_4cos(o, down) * 4.0 * mu * -down.z();
                sum += (1.0 - reflectance) * g2 * (1.0 + lambda_o);
            }
        }
    }
    sum / (n[0] * n[1]) as f64
}

/// The table, built at first use.
pub fn table() -> &'static BoundaryTable {
    static TABLE: OnceLock<BoundaryTable> = OnceLock::new();
    TABLE.get_or_init(BoundaryTable::build)
}

/// The place of an index on its axis.
#[inline(always)]
fn eta_place<R: Real>(eta: R) -> Place<R> {
    let s = (eta - R::ONE) / (eta + R::ONE);
    let x = (s.abs() * R::of(1.0 / S_MAX)).sqrt().copysign(s);
    Place::unit(N_ETA, (x + R::ONE) * R::of(0.5))
}

/// The index at a node of its axis.
fn eta_at(layer: usize) -> f64 {
    let x = 2.0 * layer as f64 / (N_ETA - 1) as f64 - 1.0;
    let s = S_MAX * x * x.abs();
    (1.0 + s) / (1.0 - s)
}

impl BoundaryTable {
    fn build() -> Self {
        let mut lost = vec![0.0; N_ETA * N_ALPHA * N_T];
        for (at, l) in lost.iter_mut().enumerate() {
            let (col, row, layer) = (at % N_T, at / N_T % N_ALPHA, at / (N_T * N_ALPHA));
            let alpha = (row as f64 / (N_ALPHA - 1) as f64).powi(2).max(1e-3);
            let t = col as f64 / (N_T - 1) as f64;
            let mu = (t * alpha / (1.0 + alpha - t)).clamp(1e-4, 1.0);
            *l = (1.0 - single(mu, alpha, eta_at(layer), QUADRATURE)).max(0.0) as f32;
        }
        let mut table = BoundaryTable { lost: lost.into_boxed_slice(), mean: [[0.0; N_ALPHA]; N_ETA] };
        for layer in 0..N_ETA {
            for row in 0..N_ALPHA {
                let alpha = (row as f64 / (N_ALPHA - 1) as f64).powi(2).max(1e-3);
                let n = 256;
                let sum: f64 = (0..n)
                    .map(|k| {
                        let mu = (f64::from(k) + 0.5) / f64::from(n);
                        2.0 * mu * table.lost(mu, alpha, eta_at(layer)) / f64::from(n)
                    })
                    .sum();
                table.mean[layer][row] = sum as f32;
            }
        }
        table
    }

    /// `1 - E`; `mu` and `alpha` in [0, 1], `eta` the transmitted over the incident side.
    #[inline(always)]
    pub fn lost<R: Real>(&self, mu: R, alpha: R, eta: R) -> R {
        let alpha = alpha.max(R::of(1e-3));
        let t = (mu * (R::ONE + alpha) / (mu + alpha)).min(R::ONE);
        interpolate(&self.lost, [eta_place(eta), Place::unit(N_ALPHA, alpha.sqrt()), Place::unit(N_T, t)])
    }

    /// `2 int (1 - E) mu dmu`
    #[inline(always)]
    pub fn mean_lost<R: Real>(&self, alpha: R, eta: R) -> R {
        let row = Place::unit(N_ALPHA, alpha.max(R::of(1e-3)).sqrt());
        interpolate(self.mean.as_flattened(), [eta_place(eta), row])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn look_ups_agree_with_quadrature() {
        let mut worst = (0.0, 0.0, 0.0, 0.0);
        for eta in [1.0 / 2.4, 1.0 / 1.5, 1.0 / 1.33, 1.1, 1.5, 2.4] {
            for alpha in [0.05, 0.2, 0.37, 0.8, 1.0] {
                for mu in [0.05, 0.1, 0.23, 0.5, 0.71, 0.9, 1.0] {
                    let want = single(mu, alpha, eta, [40, 160]);
                    let got = 1.0 - table().lost(mu, alpha, eta);
                    if (got - want).abs() > worst.0 {
                        worst = ((got - want).abs(), mu, alpha, eta);
                    }
                }
            }
        }
        assert!(worst.0 < 0.015, "{worst:?}");
    }
}
