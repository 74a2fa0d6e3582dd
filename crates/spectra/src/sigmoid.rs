//! Smooth spectra with three numbers: [`Sigmoid`].

use sparrow_math::Real;

use crate::{LAMBDA_MAX, LAMBDA_MIN, N_LAMBDA, Spectrum, Wavelengths};

/// A sigmoid of a quadratic polynomial of the wavelength: a smooth spectrum within [0, 1].
///
/// `s(x) = 1/2 + x / (2 sqrt(1 + x²))`, `x = c_0 λ² + c_1 λ + c_2`, λ in nm.
///
/// Source: [Jakob2019, eq. 2 and 3]; the coefficients are those of pbrt-v4.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sigmoid {
    /// Coefficients of λ², λ and 1.
    pub c: [f32; 3],
}

/// A polynomial of this size is as good as infinite: its sigmoid is exactly 0 or 1 in `f32`, yet
/// interpolating between such coefficients makes no NaN.
const HUGE: f32 = 1e30;

impl Sigmoid {
    /// The constant spectrum `v`; values outside [0, 1] are clamped, NaN counts as 0.
    pub fn constant(v: f32) -> Self {
        let v = if v > 0.0 { f64::from(v.min(1.0)) } else { 0.0 };
        let x = ((v - 0.5) / (v * (1.0 - v)).sqrt()) as f32;
        Self { c: [0.0, 0.0, x.clamp(-HUGE, HUGE)] }
    }

    /// The value at `lambda` nm for coefficients `c`, for any number type.
    ///
    /// The small one of `s` and `1 - s` is computed without cancellation, so dark spectra keep their
    /// precision and no finite coefficients yield NaN.
    #[inline(always)]
    pub fn eval<R: Real>(c: [R; 3], lambda: R) -> R {
        let x = (c[0] * lambda + c[1]) * lambda + c[2];
        let root = (R::ONE + x * x).sqrt();
        let small = R::of(0.5) / (root * (root + x.abs()));
        R::select(x.lt(R::ZERO), small, R::ONE - small)
    }

    /// The values at a path's wavelengths.
    #[inline(always)]
    pub fn at(&self, w: &Wavelengths) -> Spectrum<f32> {
        let mut out = [0.0; N_LAMBDA];
        for (o, &lambda) in out.iter_mut().zip(&w.lambda) {
            *o = Self::eval(self.c, lambda);
        }
        Spectrum(out)
    }

    /// The value at `lambda` nm.
    #[inline]
    pub fn value(&self, lambda: f32) -> f32 {
        Self::eval(self.c, lambda)
    }

    /// The largest value between 360 and 830 nm.
    pub fn max_value(&self) -> f32 {
        let ends = self.value(LAMBDA_MIN).max(self.value(LAMBDA_MAX));
        let top = -self.c[1] / (2.0 * self.c[0]);
        if self.c[0] < 0.0 && (LAMBDA_MIN..=LAMBDA_MAX).contains(&top) {
            ends.max(self.value(top))
        } else {
            ends
        }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn constants_are_exactly_constant() {
        for v in [0.0, 1e-6, 0.01, 0.18, 0.5, 0.8, 0.999, 1.0] {
            let s = Sigmoid::constant(v);
            for nm in [360.0, 444.4, 600.0, 830.0] {
                assert_eq!(s.value(nm), s.value(500.0));
            }
            assert!((s.value(500.0) - v).abs() <= 2e-7 * v, "{v}: {}", s.value(500.0));
            assert_eq!(s.max_value(), s.value(500.0));
        }
        assert_eq!(Sigmoid::constant(0.0).value(500.0), 0.0);
        assert_eq!(Sigmoid::constant(1.0).value(500.0), 1.0);
        assert_eq!(Sigmoid::constant(f32::NAN), Sigmoid::constant(0.0));
    }

    #[test]
    fn extreme_coefficients_stay_within_zero_and_one() {
        for c in
            [[1e20, -1e20, 1e20], [f32::MAX, f32::MAX, f32::MAX], [-1e30, 1.0, 0.0], [0.0, 0.0, f32::MIN]]
        {
            let s = Sigmoid { c };
            for nm in [360.0, 500.0, 830.0] {
                assert!((0.0..=1.0).contains(&s.value(nm)), "{c:?} at {nm}: {}", s.value(nm));
            }
        }
    }

    #[test]
    fn the_maximum_is_found_inside() {
        // x = 3 - (λ - 550)² / 1000
        let s = Sigmoid { c: [-1e-3, 1.1, 3.0 - 302.5] };
        assert!((s.max_value() - s.value(550.0)).abs() < 1e-6);
        let direct = 0.5 + 3.0 / (2.0 * 10f32.sqrt());
        assert!((s.value(550.0) - direct).abs() < 1e-4, "{} {direct}", s.value(550.0));
        let w = Wavelengths::sample_visible(0.6);
        assert_eq!(s.at(&w)[2], s.value(w.lambda[2]));
    }
}
