//! The lobe `cos^n` about an axis, which Phong's model and its descendants are made of.

use core::f64::consts::PI;

use sparrow_math::{Real, Vec3, vec3};

/// `x^n` for `n >= 0`, zero where `x` is not above zero.
#[inline(always)]
pub(crate) fn power<R: Real>(x: R, n: R) -> R {
    x.max(R::of(1e-30)).pow(n).only_where(x.gt(R::ZERO))
}

/// A direction about z with the density `(n + 1) / (2 pi) cos^n` in 1/sr. [LafortuneWillems1994]
#[inline(always)]
pub(crate) fn sample<R: Real>(u: [R; 2], n: R) -> Vec3<R> {
    let cos = power(R::ONE - u[0], R::ONE / (n + R::ONE)).min(R::ONE);
    about_z(cos, u[1])
}

/// The direction with that cosine from z, at the azimuth `2 pi u`.
#[inline(always)]
pub(crate) fn about_z<R: Real>(cos: R, u: R) -> Vec3<R> {
    let sin = ((R::ONE - cos) * (R::ONE + cos)).safe_sqrt();
    let (s, c) = (R::of(2.0 * PI) * u).sin_cos();
    vec3(sin * c, sin * s, cos)
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
