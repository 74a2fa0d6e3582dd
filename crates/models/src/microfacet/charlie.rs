//! Charlie: upright fibres as facets, for the sheen of cloth. [ContyKulla2017]
//!
//! The distribution is a power of the sine, brightest where normals lie flat; masking is Smith's by a fit of the authors.

use core::f64::consts::FRAC_1_PI;

use sparrow_math::{LocalDir, Real};

use crate::cosine_lobe;

/// `D(m) = (2 + 1/r) sin^(1/r) theta_m / (2 pi)`, per steradian; `r` in (0, 1]. [ContyKulla2017]
#[inline(always)]
pub fn d<R: Real>(m: LocalDir<R>, r: R) -> R {
    let inv = R::ONE / r;
    let sin_to = cosine_lobe::power(m.sin2_theta().min(R::ONE), R::of(0.5) * inv);
    (R::of(2.0) + inv) * R::of(0.5 * FRAC_1_PI) * sin_to
}

/// Coefficients a to e of the masking's fit, at `r = 1` and at `r = 0`. [ContyKulla2017]
const FIT: [(f64, f64); 5] =
    [(21.5473, 25.3245), (3.82987, 3.32435), (0.19823, 0.16801), (-1.97760, -1.27393), (-4.32054, -4.85967)];

/// The logarithm of `Lambda` below one half; `t = (1 - r)^2` blends the coefficients. [ContyKulla2017]
#[inline(always)]
fn log_lambda<R: Real>(x: R, t: R) -> R {
    let mut at = [R::ZERO; 5];
    for (slot, (rough, smooth)) in at.iter_mut().zip(FIT) {
        *slot = R::of(rough).lerp(R::of(smooth), t);
    }
    let [a, b, c, d, e] = at;
    a / (R::ONE + b * cosine_lobe::power(x, c)) + d * x + e
}

/// Smith's `Lambda` of a cosine in [0, 1]: above one half it continues point-symmetrically in its logarithm.
/// [ContyKulla2017]
#[inline(always)]
pub fn lambda<R: Real>(mu: R, r: R) -> R {
    let t = (R::ONE - r).sqr();
    let half = R::of(0.5);
    let low = mu.lt(half);
    let l = log_lambda(R::select(low, mu, R::ONE - mu), t);
    R::select(low, l, R::of(2.0) * log_lambda(half, t) - l).exp()
}

/// What `Lambda` of the light is raised to where the shadow's edge is softened. [ContyKulla2017]
#[inline(always)]
pub fn softening<R: Real>(mu: R) -> R {
    let x4 = (R::ONE - mu).sqr().sqr();
    R::ONE + R::of(2.0) * x4.sqr()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_have_unit_projected_area() {
        for r in [0.07, 0.3, 1.0] {
            // int D cos domega = int (2 + 1/r) sin^(1/r) cos sin dtheta, with s = sin theta.
            let n = 20_000;
            let sum: f64 = (0..n)
                .map(|i| {
                    let s: f64 = (f64::from(i) + 0.5) / f64::from(n);
                    d(LocalDir::from_angles(Real::asin(s), 0.3), r) * s * 2.0 * core::f64::consts::PI
                        / f64::from(n)
                })
                .sum();
            assert!((sum - 1.0).abs() < 1e-6, "r {r}: {sum}");
        }
    }

    #[test]
    fn masking_is_continuous_where_its_halves_meet() {
        for r in [0.07, 0.4, 1.0] {
            let (a, b): (f64, f64) = (lambda(0.5 - 1e-9, r), lambda(0.5 + 1e-9, r));
            assert!((a - b).abs() < 1e-7 * a, "r {r}: {a} {b}");
        }
    }
}
