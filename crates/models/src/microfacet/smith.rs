//! Smith's `Lambda` for the distributions of slopes, as `|cos theta| Lambda(w)`.
//!
//! `s` is the slope width along the azimuth of `w` times `sin theta`, `mu = |cos theta|`; `s / mu = alpha tan theta`.

use sparrow_math::Real;

use super::special::{erfcx, gamma_ratio};

/// `1 / sqrt(pi)`
pub(super) const FRAC_1_SQRT_PI: f64 = 0.564_189_583_547_756_3;

/// GGX. [Heitz2014, eq. 72]
#[inline(always)]
pub(super) fn ggx<R: Real>(mu: R, s: R) -> R {
    let r = (mu.sqr() + s.sqr()).sqrt();
    s.sqr() / (R::of(2.0) * (r + mu)).max(R::of(1e-30))
}

/// Beckmann: `Lambda = e^(-c^2) / 2 (1 / (c sqrt(pi)) - erfcx(c))`, `c = mu / s`. [Walter2007, sec. 5.2]
#[inline(always)]
pub(super) fn beckmann<R: Real>(mu: R, s: R) -> R {
    // Beyond c = 9 it is below 1e-36.
    let c = (mu / s.max(R::of(1e-18))).min(R::of(9.0));
    let open = s * R::of(FRAC_1_SQRT_PI) - mu * erfcx(c);
    (R::of(0.5) * (-(c * c)).exp() * open).max(R::ZERO)
}

/// Student-t with exponent `g > 3/2`: the defining integral over slopes, by Gauss's rule. [Ribardiere2017, eq. 11]
///
/// With slope `q = r cot psi`, `r = sqrt(g - 1)`, and slopes counted in widths,
/// `c Lambda = k / sin psi_0 int_0^psi_0 sin(psi_0 - psi) sin^(2g-4) psi dpsi`, `tan psi_0 = r / c`. Substituting
/// `psi = psi_0 v^(4/(2g-3))` turns the power at 0 into `v^3`, which stands in the weights.
#[inline(always)]
pub(super) fn student_t<R: Real>(mu: R, s: R, g: R) -> R {
    let two = R::of(2.0);
    let r2 = g - R::ONE;
    let rs = r2.sqrt() * s;
    let psi_0 = rs.atan2(mu).max(R::of(1e-6));
    let (sin_0, cos_0) = psi_0.sin_cos();
    let m = R::of(4.0) / (two * g - R::of(3.0));
    let mut sum = R::ZERO;
    for (ln_v, weight) in LN_V.iter().zip(&V3_WEIGHTS) {
        let psi = (psi_0 * (m * R::of(*ln_v)).exp()).max(R::of(1e-9));
        let (sin, cos) = psi.sin_cos();
        let rest = ((two * g - R::of(4.0)) * (sin / psi).ln()).exp();
        sum = sum + R::of(*weight) * (sin_0 * cos - cos_0 * sin) * rest;
    }
    let k = r2 * r2.sqrt() * R::of(FRAC_1_SQRT_PI) * gamma_ratio(g);
    let power = ((two * g - R::of(3.0)) * psi_0.ln()).exp();
    s * k * m * power * sum / sin_0
}

/// Logarithms of the points of Gauss's rule with 24 points in (0, 1). [AbramowitzStegun, table 25.4]
const LN_V: [f64; 24] = [
    -6.029627579183582,
    -4.3712273957821335,
    -3.478206166382262,
    -2.868355643973552,
    -2.407956641901088,
    -2.0406986025599103,
    -1.7375373759824668,
    -1.4815317806267572,
    -1.2619436203564545,
    -1.0715459293467504,
    -0.9052504846432344,
    -0.7593477678847194,
    -0.63105832033447,
    -0.5182540904032046,
    -0.4192780594141936,
    -0.3328234462225252,
    -0.2578505103971465,
    -0.19352792305563413,
    -0.13919069541011042,
    -0.0943095882773845,
    -0.05846869876846499,
    -0.03134900942522333,
    -0.012716231667131256,
    -0.002409290011212731,
];
/// The rule's weights times the cubes of its points.
const V3_WEIGHTS: [f64; 24] = [
    8.598575061394483e-11,
    2.878015326045757e-08,
    6.50811563817748e-07,
    5.431018085377853e-06,
    2.673390757409948e-05,
    9.454428286989573e-05,
    0.0002658851778203594,
    0.000630797601116334,
    0.0013104119601671201,
    0.002443744221543468,
    0.004162402412822186,
    0.0065558436633013015,
    0.00963329335935474,
    0.013290926619868408,
    0.017293574044036465,
    0.02127860448452772,
    0.024785866310201896,
    0.02731231318864979,
    0.0283843168489003,
    0.027635981140205008,
    0.02487920131099283,
    0.020151546941044308,
    0.013731726536425548,
    0.006126175292790215,
];

/// `G_2 = B(1 + Lambda_o, 1 + Lambda_i)`: masking for two directions on opposite sides. [Heitz2016, eq. 23]
#[inline(always)]
pub(super) fn transmission_g2<R: Real>(lambda_o: R, lambda_i: R) -> R {
    super::special::beta(R::ONE + lambda_o, R::ONE + lambda_i)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;

    /// `Lambda` by its definition, `1/c int_c^inf (q - c) P(q) dq` with the density `p` of slopes counted in widths.
    fn by_definition(c: f64, p: impl Fn(f64) -> f64) -> f64 {
        // q = c + (t / (1 - t))^3, Simpson's rule.
        let n = 200_000;
        let f = |t: f64| {
            let y = (t / (1.0 - t)).powi(3);
            y * p(c + y) * 3.0 * t * t / (1.0 - t).powi(4)
        };
        let h = 1.0 / f64::from(n);
        let mut sum = 0.0;
        for i in 0..n {
            let t = f64::from(i) * h;
            sum += (f(t) + 4.0 * f(t + 0.5 * h) + if i + 1 == n { 0.0 } else { f(t + h) }) * h / 6.0;
        }
        sum / c
    }

    #[test]
    fn lambda_is_the_integral_that_defines_it() {
        for c in [0.05, 0.4, 1.0, 2.5] {
            let want = by_definition(c, |q| Real::exp(-q * q) / Real::sqrt(PI));
            let got = beckmann(c, 1.0) / c;
            assert!((got - want).abs() < 1e-9 + 1e-7 * want, "Beckmann {c}: {got} {want}");
            let want = by_definition(c, |q: f64| 0.5 * Real::pow(1.0 + q * q, -1.5));
            let got = ggx(c, 1.0) / c;
            assert!((got - want).abs() < 1e-6 * want, "GGX {c}: {got} {want}");
            for g in [1.75, 2.0, 3.5, 8.0] {
                let k = Real::sqrt((g - 1.0) / PI) * gamma_ratio(g);
                let want = by_definition(c, |q: f64| k * Real::pow(1.0 + q * q / (g - 1.0), 0.5 - g));
                let got = student_t(c, 1.0, g) / c;
                assert!((got - want).abs() < 2e-4 * want, "Student-t {g}, {c}: {got} {want}");
            }
        }
    }

    #[test]
    fn student_t_with_exponent_two_is_ggx() {
        for (mu, s) in [(0.9, 0.1), (0.5, 0.5), (0.1, 1.0), (1e-3, 0.7)] {
            let (a, b) = (student_t(mu, s, 2.0_f64), ggx(mu, s));
            assert!((a - b).abs() < 1e-7 * b, "{mu} {s}: {a} {b}");
        }
    }
}
