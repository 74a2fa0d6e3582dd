//! Values at the wavelengths of one path: [`Spectrum`].

use core::ops::{Add, AddAssign, Div, Index, Mul, MulAssign, Sub};

use sparrow_math::Real;

/// Wavelengths a path carries: the hero and three companions.
pub const N_LAMBDA: usize = 4;

/// A spectral quantity at the [`N_LAMBDA`] wavelengths of a path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spectrum<R>(pub [R; N_LAMBDA]);

/// Spells out one expression per wavelength: a loop or closure over lanes may not be unrolled.
macro_rules! per_lambda {
    ($i:ident => $e:expr) => {{
        Spectrum([
            { const $i: usize = 0; $e },
            { const $i: usize = 1; $e },
            { const $i: usize = 2; $e },
            { const $i: usize = 3; $e },
        ])
    }};
}

impl<R: Real> Spectrum<R> {
    /// 0 at every wavelength.
    pub const ZERO: Self = Spectrum([R::ZERO; N_LAMBDA]);
    /// 1 at every wavelength.
    pub const ONE: Self = Spectrum([R::ONE; N_LAMBDA]);

    /// The same value at every wavelength.
    #[inline(always)]
    pub fn splat(v: R) -> Self {
        Spectrum([v; N_LAMBDA])
    }
    /// Applies `f` to each wavelength's value. `f` must be `#[inline(always)]` where R is a lane type.
    #[inline(always)]
    pub fn map(self, f: impl Fn(R) -> R) -> Self {
        per_lambda!(I => f(self.0[I]))
    }
    /// Applies `f` to each wavelength's pair of values.
    #[inline(always)]
    pub fn zip(self, o: Self, f: impl Fn(R, R) -> R) -> Self {
        per_lambda!(I => f(self.0[I], o.0[I]))
    }
    /// `self` where the mask is true, else zero.
    #[inline(always)]
    pub fn only_where(self, m: R::Mask) -> Self {
        per_lambda!(I => R::select(m, self.0[I], R::ZERO))
    }
    /// `a` where the mask is true, else `b`.
    #[inline(always)]
    pub fn select(m: R::Mask, a: Self, b: Self) -> Self {
        per_lambda!(I => R::select(m, a.0[I], b.0[I]))
    }
    /// The largest value.
    #[inline(always)]
    pub fn max_value(self) -> R {
        self.0[0].max(self.0[1]).max(self.0[2].max(self.0[3]))
    }
    /// The mean over the wavelengths.
    #[inline(always)]
    pub fn average(self) -> R {
        ((self.0[0] + self.0[1]) + (self.0[2] + self.0[3])) * R::of(0.25)
    }
    /// Zero at every wavelength: the path carries nothing any more.
    #[inline(always)]
    pub fn is_black(self) -> R::Mask {
        let [a, b, c, d] = self.0;
        a.abs().le(R::ZERO) & b.abs().le(R::ZERO) & c.abs().le(R::ZERO) & d.abs().le(R::ZERO)
    }
    /// No value is NaN or infinite.
    #[inline(always)]
    pub fn is_finite(self) -> R::Mask {
        let ([a, b, c, d], end) = (self.0, R::of(f64::INFINITY));
        a.abs().lt(end) & b.abs().lt(end) & c.abs().lt(end) & d.abs().lt(end)
    }
}

macro_rules! elementwise {
    ($($t:ident $f:ident $op:tt),*) => { $(
        impl<R: Real> $t for Spectrum<R> {
            type Output = Self;
            #[inline(always)]
            fn $f(self, o: Self) -> Self {
                per_lambda!(I => self.0[I] $op o.0[I])
            }
        }
    )* };
}
elementwise!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<R: Real> Mul<R> for Spectrum<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: R) -> Self {
        per_lambda!(I => self.0[I] * o)
    }
}
impl<R: Real> Div<R> for Spectrum<R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: R) -> Self {
        per_lambda!(I => self.0[I] / o)
    }
}
impl<R: Real> AddAssign for Spectrum<R> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<R: Real> MulAssign for Spectrum<R> {
    #[inline(always)]
    fn mul_assign(&mut self, o: Self) {
        *self = *self * o;
    }
}
impl<R: Real> MulAssign<R> for Spectrum<R> {
    #[inline(always)]
    fn mul_assign(&mut self, o: R) {
        *self = *self * o;
    }
}
impl<R> Index<usize> for Spectrum<R> {
    type Output = R;
    #[inline(always)]
    fn index(&self, i: usize) -> &R {
        &self.0[i]
    }
}
