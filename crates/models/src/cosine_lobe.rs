//! The lobe `cos^n` about an axis, which Phong's model and its descendants are made of.

use core::f64::consts::PI;

use sparrow_math::{Real, Vec3, vec3};

use crate::microfacet::special::{exp_m1_over, ln_cos};

/// `cos^n` from the cosine and the square of the sine, for `n >= 0`; zero where the cosine is not above zero.
///
/// An exponent of 1e5 magnifies the rounding of a cosine near one to half a percent in single precision; the sine has the digits.
#[inline(always)]
pub(crate) fn lobe<R: Real>(cos: R, sin2: R, n: R) -> R {
    (n * ln_cos(cos, sin2)).exp().only_where(cos.gt(R::ZERO))
}

/// `x^n` for `n >= 0`, zero where `x` is not above zero.
#[inline(always)]
pub(crate) fn power<R: Real>(x: R, n: R) -> R {
    x.max(R::of(1e-30)).pow(n).only_where(x.gt(R::ZERO))
}

/// A direction about z with the density `(n + 1) / (2 pi) cos^n` in 1/sr. [LafortuneWillems1994]
#[inline(always)]
pub(crate) fn sample<R: Real>(u: [R; 2], n: R) -> Vec3<R> {
    let (sin, cos) = angle(u[0], n);
    let (s, c) = (R::of(2.0 * PI) * u[1]).sin_cos();
    vec3(sin * c, sin * s, cos)
}

/// The direction with that cosine from z, at the azimuth `2 pi u`.
#[inline(always)]
pub(crate) fn about_z<R: Real>(cos: R, u: R) -> Vec3<R> {
    let sin = ((R::ONE - cos) * (R::ONE + cos)).safe_sqrt();
    let (s, c) = (R::of(2.0 * PI) * u).sin_cos();
    vec3(sin * c, sin * s, cos)
}

/// Sine and cosine of the angle `a` with `cos^(n+1) a = 1 - u`.
#[inline(always)]
pub(crate) fn angle<R: Real>(u: R, n: R) -> (R, R) {
    // sin^2 = 1 - e^(2 ln cos), which keeps the digits of narrow lobes.
    let ln_cos = (R::ONE - u).max(R::of(1e-30)).ln() / (n + R::ONE);
    let twice = ln_cos + ln_cos;
    ((-twice * exp_m1_over(twice)).safe_sqrt(), ln_cos.exp())
}

/// A direction about z whose azimuth is stretched: `tan phi = (b / a) tan phi'`, phi' uniform, in the same quadrant.
///
/// Returns cosine and sine of the azimuth. `a` and `b` are above zero.
#[inline(always)]
pub(crate) fn stretched_azimuth<R: Real>(u: R, a: R, b: R) -> (R, R) {
    let (s, c) = (R::of(2.0 * PI) * u).sin_cos();
    let (x, y) = (a * c, b * s);
    let scale = R::ONE / (x * x + y * y).sqrt();
    (x * scale, y * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_have_the_mean_height_of_the_density() {
        // The mean of cos under (n + 1) cos^n is (n + 1) / (n + 2).
        for n in [0.0, 1.0, 20.0, 500.0] {
            let count = 4000;
            let mean: f64 = (0..count)
                .map(|i| sample([(f64::from(i) + 0.5) / f64::from(count), 0.3], n).z / f64::from(count))
                .sum();
            assert!((mean - (n + 1.0) / (n + 2.0)).abs() < 1e-4, "n {n}: {mean}");
        }
    }

    #[test]
    fn narrow_lobes_keep_their_digits_in_single_precision() {
        // sin^2 a = 1 - (1 - u)^(2 / (n + 1)), in double precision from the same 1 - u.
        for u in [1e-3_f32, 0.3, 0.9] {
            for n in [1e2_f32, 1e5] {
                let (sin, cos) = angle(u, n);
                let power = 2.0 * Real::ln(f64::from(1.0 - u)) / (f64::from(n) + 1.0);
                let want = (-f64::exp_m1(power)).sqrt();
                assert!((f64::from(sin) - want).abs() < 1e-6 * want, "{u} {n}: {sin} {want}");
                let sin2 = sin * sin;
                let value = lobe(cos, sin2, n + 1.0);
                assert!((value - (1.0 - u)).abs() < 3e-6, "{u} {n}: {value}");
            }
        }
    }

    #[test]
    fn power_is_zero_behind_the_axis_and_one_for_exponent_zero() {
        assert!(power(-0.5f64, 3.0).abs() < 1e-300);
        assert!(power(0.0f64, 3.0).abs() < 1e-300);
        assert!((power(0.5f64, 0.0) - 1.0).abs() < 1e-15);
        assert!((power(0.5f64, 3.0) - 0.125).abs() < 1e-15);
    }

    #[test]
    fn azimuth_keeps_its_quadrant() {
        for i in 0..16 {
            let u = (f64::from(i) + 0.5) / 16.0;
            let (c, s) = stretched_azimuth(u, 0.2, 3.0);
            let (s0, c0) = Real::sin_cos(2.0 * PI * u);
            assert!(c * c0 > 0.0 && s * s0 > 0.0 && (c * c + s * s - 1.0).abs() < 1e-14);
            assert!((s / c - 15.0 * s0 / c0).abs() < 1e-12 * (s / c).abs());
        }
    }
}
