//! Drawing the normals of a Beckmann surface that are visible from one side.
//!
//! After stretching to width one, with the view `(sin, 0, cos)`, visible slopes along x have the integral
//! `F(x) = cos (1 + erf x) / 2 + sin e^(-x^2) / (2 sqrt(pi))` up to `x = cot`; slopes along y are Gaussian.
//! The normal is `(-x, -y, 1)`. [HeitzDEon2014, sec. 4.1], start value [Jakob2014, eq. 4]

use sparrow_math::{LocalDir, Real, vec3};

use super::smith::FRAC_1_SQRT_PI;
use super::special::{erfcx, exp_m1_over, gauss_quantile};

/// `F(x) e^(x^2)` and whether `e^(x^2)` had to be multiplied: `F` itself is returned, with `e^(-x^2)`.
#[inline(always)]
fn integral<R: Real>(x: R, sin: R, cos: R) -> (R, R) {
    let half = R::of(0.5);
    let g = (-(x * x)).exp();
    let tail = half * cos * erfcx(x.abs()) * g;
    let part = R::select(x.lt(R::ZERO), tail, cos - tail);
    (part + half * sin * R::of(FRAC_1_SQRT_PI) * g, g)
}

/// The slope along x below which the share `u` of what is visible lies.
///
/// Six steps of Halley's rule, kept within brackets; error below 1e-9 in double precision.
#[inline(always)]
pub fn visible_slope<R: Real>(sin: R, cos: R, u: R) -> R {
    let two = R::of(2.0);
    let cot = (cos / sin.max(R::of(1e-6))).min(R::of(6.0));
    let wanted = u.max(R::of(1e-10)) * integral(cot, sin, cos).0;

    // Jakob's fit, in shares of the Gaussian: p = Phi(cot) (1 - (1 - u)^fit).
    let theta = sin.atan2(cos);
    let fit = R::ONE + theta * (R::of(-0.876) + theta * (R::of(0.4265) - R::of(0.0594) * theta));
    let top = R::ONE - R::of(0.5) * erfcx(cot) * (-(cot * cot)).exp();
    let log = fit * (R::ONE - u).max(R::of(1e-12)).ln();
    let mut x = gauss_quantile(-top * (log * exp_m1_over(log))).min(cot);

    let (mut lo, mut hi) = (R::of(-6.0), cot);
    for _ in 0..6 {
        let (f, g) = integral(x, sin, cos);
        let off = f - wanted;
        let above = off.gt(R::ZERO);
        hi = R::select(above, x, hi);
        lo = R::select(above, lo, x);
        // F' = a g', F'' = b g' with g' = e^(-x^2) / sqrt(pi).
        let a = cos - x * sin;
        let b = -sin - two * x * a;
        let f = off / (g * R::of(FRAC_1_SQRT_PI)).max(R::of(1e-30));
        let next = x - two * f * a / (two * a * a - f * b);
        let inside = next.ge(lo) & next.le(hi);
        x = R::select(inside, next, R::of(0.5) * (lo + hi));
    }
    x
}

/// A normal among those visible from `wo`, which lies above; `u[0]` for the slope towards the view.
#[inline(always)]
pub(super) fn sample_visible<R: Real>(alpha_x: R, alpha_y: R, wo: LocalDir<R>, u: [R; 2]) -> LocalDir<R> {
    let w = vec3(alpha_x * wo.x(), alpha_y * wo.y(), wo.z()).normalized();
    let sin = (w.x * w.x + w.y * w.y).sqrt();
    let tilted = sin.gt(R::of(1e-7));
    let inv = R::ONE / R::select(tilted, sin, R::ONE);
    let (cos_phi, sin_phi) = (R::select(tilted, w.x * inv, R::ONE), R::select(tilted, w.y * inv, R::ZERO));
    let x = visible_slope(sin, w.z, u[0]);
    let y = gauss_quantile(u[1]);
    let (sx, sy) = (cos_phi * x - sin_phi * y, sin_phi * x + cos_phi * y);
    LocalDir::new(vec3(-(alpha_x * sx), -(alpha_y * sy), R::ONE).normalized())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_invert_the_integral() {
        for deg in [0.0_f64, 5.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9] {
            let (sin, cos) = Real::sin_cos(deg.to_radians());
            let total = integral((cos / sin.max(1e-6)).min(6.0), sin, cos).0;
            for k in 0..400 {
                let u = (f64::from(k) + 0.5) / 400.0;
                let x = visible_slope(sin, cos, u);
                let got = integral(x, sin, cos).0 / total;
                assert!((got - u).abs() < 1e-11, "{deg} degrees, u {u}: {got}");
            }
        }
    }

    #[test]
    fn single_precision_stays_close() {
        for deg in [0.0_f64, 20.0, 60.0, 85.0, 89.9] {
            let (sin, cos) = Real::sin_cos(deg.to_radians());
            for u in [1e-4, 0.01, 0.2, 0.5, 0.9, 0.99] {
                let x = visible_slope(sin, cos, u);
                let y = f64::from(visible_slope(sin as f32, cos as f32, u as f32));
                assert!((x - y).abs() < 5e-4, "{deg} {u}: {x} {y}");
            }
        }
    }
}
