//! Special functions that microfacet terms need, one text for every number type.
//!
//! The long ones are not inlined: models have many choices, and every copy costs build time in each number type.

use core::f64::consts::PI;

use sparrow_math::Real;
use sparrow_math::elementary::poly;

/// `e^(x^2) erfc(x)` for `x >= 0`.
///
/// Polynomial in `(x - 3) / (x + 3)` for `(1 + 2 x) erfcx(x)`, the form of [ShepherdLaframboise1981], with coefficients
/// fitted by us to 50 digits; largest relative error in double precision 6e-16.
#[inline(always)]
pub fn erfcx<R: Real>(x: R) -> R {
    let three = R::of(3.0);
    let t = (x - three) / (x + three);
    let p = poly(
        t,
        [
            9.862_533_510_345_587e-10,
            -3.181_354_143_496_927e-9,
            -1.331_291_966_103_868_7e-8,
            2.784_388_126_550_222e-8,
            1.018_362_060_384_273_6e-7,
            -1.205_414_228_648_938e-7,
            -6.166_011_460_398_726e-7,
            3.366_979_080_640_759_5e-7,
            3.472_370_944_977_168e-6,
            -7.187_883_834_404_266e-7,
            -2.010_054_226_852_561_2e-5,
            4.944_124_342_223_66e-6,
            0.000_125_099_342_458_372_9,
            -0.000_105_158_312_978_131_28,
            -0.000_779_832_269_654_330_6,
            0.001_888_690_097_744_149_5,
            0.002_529_391_815_693_969_6,
            -0.023_770_514_891_530_075,
            0.068_308_027_344_009_9,
            -0.119_273_663_416_760_02,
            0.129_645_158_702_759_4,
            -0.047_562_294_353_420_38,
            -0.135_621_106_124_581_17,
            1.253_008_058_269_729_6,
        ],
    );
    p / (R::ONE + x + x)
}

/// The `x` below which a share `v` of the weight `e^(-x^2) / sqrt(pi)` lies, `erfinv(2 v - 1)`; `v` in [0, 1].
///
/// Start value [Giles2012, table 5], then one step of Halley's rule. `v` within 1e-12 of the ends counts as 1e-12.
#[inline(always)]
pub fn gauss_quantile<R: Real>(v: R) -> R {
    let p = v.min(R::ONE - v).max(R::of(1e-12));
    let x = R::ONE - p - p;
    let w = -(R::of(4.0) * p * (R::ONE - p)).ln();
    let near = poly(
        w - R::of(2.5),
        [
            2.810_226_36e-8,
            3.432_739_39e-7,
            -3.523_387_7e-6,
            -4.391_506_54e-6,
            0.000_218_580_87,
            -0.001_253_725_03,
            -0.004_177_681_64,
            0.246_640_727,
            1.501_409_41,
        ],
    );
    let far = poly(
        w.safe_sqrt() - R::of(3.0),
        [
            -0.000_200_214_257,
            0.000_100_950_558,
            0.001_349_343_22,
            -0.003_673_428_44,
            0.005_739_507_73,
            -0.007_622_461_3,
            0.009_438_870_47,
            1.001_674_06,
            2.832_976_82,
        ],
    );
    let y = (R::select(w.lt(R::of(5.0)), near, far) * x).max(R::ZERO);
    let r = R::of(0.5 * 1.772_453_850_905_516) * (erfcx(y) - (p + p) * (y * y).exp());
    let y = y + r / (R::ONE - r * y);
    y.copysign(v - R::of(0.5))
}

/// `(e^x - 1) / x`, 1 at 0.
#[inline(always)]
pub fn exp_m1_over<R: Real>(x: R) -> R {
    // 1 / (k + 1)! from k = 13 down: below 0.6 the first term left out is 1e-14 of the sum.
    let series = poly(
        x,
        [
            1.147_074_559_772_972_5e-11,
            1.605_904_383_682_161_3e-10,
            2.087_675_698_786_81e-9,
            2.505_210_838_544_172e-8,
            2.755_731_922_398_589e-7,
            2.755_731_922_398_589e-6,
            2.480_158_730_158_73e-5,
            1.984_126_984_126_984e-4,
            1.388_888_888_888_889e-3,
            8.333_333_333_333_333e-3,
            4.166_666_666_666_666_4e-2,
            1.666_666_666_666_666_6e-1,
            0.5,
            1.0,
        ],
    );
    let small = x.abs().lt(R::of(0.6));
    let safe = R::select(small, R::ONE, x);
    R::select(small, series, (safe.exp() - R::ONE) / safe)
}

/// [`ln_1p_over`] for `|y| < 0.4`.
#[inline(always)]
fn ln_1p_over_small<R: Real>(y: R) -> R {
    // ln(1 + y) = 2 artanh(z), z = y / (2 + y); |z| < 1/4.
    let z2 = (y / (R::of(2.0) + y)).sqr();
    let artanh_over = poly(
        z2,
        [
            1.0 / 25.0,
            1.0 / 23.0,
            1.0 / 21.0,
            1.0 / 19.0,
            1.0 / 17.0,
            1.0 / 15.0,
            1.0 / 13.0,
            1.0 / 11.0,
            1.0 / 9.0,
            1.0 / 7.0,
            1.0 / 5.0,
            1.0 / 3.0,
            1.0,
        ],
    );
    R::of(2.0) * artanh_over / (R::of(2.0) + y)
}

/// `ln(1 + y) / y`, 1 at 0; `y > -1`.
#[inline(always)]
pub fn ln_1p_over<R: Real>(y: R) -> R {
    let small = y.abs().lt(R::of(0.4));
    let series = ln_1p_over_small(R::select(small, y, R::ZERO));
    let far = R::select(small, R::ONE, y);
    R::select(small, series, (R::ONE + far).max(R::of(1e-30)).ln() / far)
}

/// `ln cos` of an angle below a right one, from its cosine and the square of its sine: in narrow lobes the sine has the digits,
/// towards the horizon the cosine.
#[inline(always)]
pub fn ln_cos<R: Real>(cos: R, sin2: R) -> R {
    let narrow = sin2.lt(R::of(0.3));
    let y = -R::select(narrow, sin2, R::ZERO);
    R::select(narrow, R::of(0.5) * y * ln_1p_over_small(y), cos.max(R::of(1e-30)).ln())
}

/// What Stirling's formula for `ln Gamma(x)` leaves, for `x >= 7`: error below 1e-11. [AbramowitzStegun, 6.1.41]
#[inline(always)]
fn stirling_rest<R: Real>(x: R) -> R {
    let y = R::ONE / x;
    y * poly(y * y, [1.0 / 1188.0, -1.0 / 1680.0, 1.0 / 1260.0, -1.0 / 360.0, 1.0 / 12.0])
}

/// Euler's beta function `B(p, q)` for `p, q >= 1`. [AbramowitzStegun, 6.2.2]
///
/// Both arguments are raised by 6 and Stirling's formula is taken there, with the large logarithms cancelled by hand.
#[inline(always)]
pub fn beta<R: Real>(p: R, q: R) -> R {
    let (mut p, mut q) = (p, q);
    let mut lifted = R::ONE;
    for _ in 0..6 {
        // B(p, q) = B(p+1, q+1) (p+q) (p+q+1) / (p q)
        let s = p + q;
        lifted = lifted * ((s / p) * ((s + R::ONE) / q));
        p = p + R::ONE;
        q = q + R::ONE;
    }
    let s = p + q;
    let half = R::of(0.5);
    // ln(s / p) = ln(1 + q / p)
    let (a, b) = (q / p, p / q);
    let log = -((p - half) * (a * ln_1p_over(a)) + (q - half) * (b * ln_1p_over(b)))
        + (stirling_rest(p) + stirling_rest(q) - stirling_rest(s));
    lifted * log.exp() * (R::of(2.0 * PI) / s).sqrt()
}

/// `Gamma(g - 1/2) / Gamma(g)` for `g > 1/2`; relative error below 1e-11.
///
/// Raised by 12, then the asymptotic series of the ratio. [TricomiErdelyi1951, eq. 1]
#[inline(always)]
pub fn gamma_ratio<R: Real>(g: R) -> R {
    let half = R::of(0.5);
    let mut up = R::ONE;
    let mut g = g;
    for _ in 0..12 {
        up = up * (g / (g - half));
        g = g + R::ONE;
    }
    // Gamma(y + 1/2) / Gamma(y) with y = g - 1/2.
    let y = g - half;
    let r = R::ONE / y;
    let series = poly(
        r,
        [
            869.0 / 4_194_304.0,
            -399.0 / 262_144.0,
            -21.0 / 32_768.0,
            5.0 / 1024.0,
            1.0 / 128.0,
            -1.0 / 8.0,
            1.0,
        ],
    );
    up / (y.sqrt() * series)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64, tol: f64) {
        assert!((a - b).abs() <= tol * b.abs(), "{a} {b}");
    }

    #[test]
    fn erfcx_agrees_with_high_precision() {
        // By mpmath, 50 digits.
        for (x, want) in [
            (0.0, 1.0),
            (0.5, 0.615_690_344_192_925_9),
            (1.0, 0.427_583_576_155_807),
            (5.0, 0.110_704_637_733_068_64),
        ] {
            close(erfcx(x), want, 1e-14);
        }
        // The first term of the asymptotic series.
        close(erfcx(1e6_f64), 1e-6 / Real::sqrt(PI), 1e-11);
    }

    #[test]
    fn quantile_inverts_the_integral() {
        for v in [1e-9_f64, 1e-4, 0.1, 0.3, 0.499, 0.5, 0.6, 0.97, 0.999_999] {
            let x = gauss_quantile(v);
            let tail = 0.5 * Real::exp(-x * x) * erfcx(x.abs());
            close(tail, v.min(1.0 - v), 1e-9);
            assert!((x > 0.0) == (v > 0.5) || x.abs() < 1e-12);
        }
        assert!((gauss_quantile(0.9_f32) - gauss_quantile(0.9_f64) as f32).abs() < 1e-6);
    }

    #[test]
    fn differences_keep_their_digits() {
        close(exp_m1_over(1e-9_f64), 1.0 + 5e-10, 1e-15);
        close(exp_m1_over(0.59_f64) * 0.59, f64::exp_m1(0.59), 1e-14);
        close(exp_m1_over(-3.0_f64) * -3.0, f64::exp_m1(-3.0), 1e-14);
        for y in [1e-9_f64, 0.1, 0.39, 0.41, 7.0, -0.3, -0.9] {
            close(ln_1p_over(y) * y, f64::ln_1p(y), 1e-14);
        }
    }

    #[test]
    fn the_logarithm_of_a_cosine_keeps_its_digits_in_single_precision() {
        for theta in [1e-6_f64, 1e-3, 0.1, 0.57, 0.59, 1.2, 1.57] {
            let (sin, cos) = Real::sin_cos(theta);
            let want = 0.5 * f64::ln_1p(-sin * sin);
            let got = f64::from(ln_cos(cos as f32, (sin * sin) as f32));
            // A rounding of the cosine of 1.57, and some of the result.
            assert!((got - want).abs() < 1e-6 * want.abs() + 6e-8, "{theta}: {got} {want}");
        }
    }

    #[test]
    fn beta_and_gamma_at_known_places() {
        close(beta(1.0_f64, 1.0), 1.0, 1e-10);
        close(beta(2.0_f64, 3.0), 1.0 / 12.0, 1e-10);
        close(beta(1.5_f64, 1.5), PI / 8.0, 1e-10);
        close(beta(1.0_f64, 1e4), 1e-4, 1e-10);
        close(gamma_ratio(1.0_f64), Real::sqrt(PI), 1e-9);
        close(gamma_ratio(3.0_f64), 0.375 * Real::sqrt(PI), 1e-9);
        close(gamma_ratio(2.0_f64), 0.5 * Real::sqrt(PI), 1e-9);
        close(gamma_ratio(1.5_f64), 2.0 / Real::sqrt(PI), 1e-9);
    }
}
