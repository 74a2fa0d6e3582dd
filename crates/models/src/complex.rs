//! Complex numbers over any [`Real`], as far as waves in layers need them.

use core::ops::{Add, Mul, Sub};

use sparrow_math::Real;

/// `re + i im`
#[derive(Clone, Copy, Debug)]
pub(crate) struct Complex<R> {
    pub(crate) re: R,
    pub(crate) im: R,
}

impl<R: Real> Complex<R> {
    #[inline(always)]
    pub(crate) fn new(re: R, im: R) -> Self {
        Complex { re, im }
    }
    #[inline(always)]
    pub(crate) fn real(re: R) -> Self {
        Complex { re, im: R::ZERO }
    }
    /// `|z|^2`
    #[inline(always)]
    pub(crate) fn norm2(self) -> R {
        self.re.sqr() + self.im.sqr()
    }
    /// The root in the first quadrant of a number in the upper half plane.
    #[inline(always)]
    pub(crate) fn sqrt_upper(self) -> Self {
        let (long, short) = {
            let t = ((self.norm2().sqrt() + self.re.abs()) * R::of(0.5)).sqrt();
            (t, R::of(0.5) * self.im / t.max(R::of(1e-18)))
        };
        let right = self.re.ge(R::ZERO);
        Complex { re: R::select(right, long, short), im: R::select(right, short, long) }
    }
    /// `e^(i z)`
    #[inline(always)]
    pub(crate) fn exp_i(self) -> Self {
        let (sin, cos) = self.re.sin_cos();
        let size = (-self.im).exp();
        Complex { re: size * cos, im: size * sin }
    }
}

impl<R: Real> Add for Complex<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Complex { re: self.re + o.re, im: self.im + o.im }
    }
}

impl<R: Real> Sub for Complex<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Complex { re: self.re - o.re, im: self.im - o.im }
    }
}

impl<R: Real> Mul for Complex<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Complex { re: self.re * o.re - self.im * o.im, im: self.re * o.im + self.im * o.re }
    }
}

impl<R: Real> Mul<R> for Complex<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: R) -> Self {
        Complex { re: self.re * s, im: self.im * s }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_square_to_what_they_came_from() {
        for (re, im) in [(4.0, 0.0), (-4.0, 0.0), (3.0, 1e-9), (-3.0, 1e-9), (0.0, 2.0), (1e-8, 1e-8)] {
            let z = Complex::<f64>::new(re, im).sqrt_upper();
            let back = z * z;
            assert!((back.re - re).abs() < 1e-15 * (1.0 + re.abs()), "{re} {im}: {z:?}");
            assert!((back.im - im).abs() < 1e-15 * (1.0 + im.abs()) && z.re >= 0.0 && z.im >= 0.0, "{z:?}");
        }
    }
}
