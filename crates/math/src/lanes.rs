//! [`Lanes`]: several `f32` side by side, left to the auto-vectoriser.
//!
//! Plain arrays and `#[inline(always)]` elementwise methods; inside a kernel compiled with
//! `#[target_feature(enable = "avx2,fma")]` they become vector instructions. Closures over lanes and
//! `array::from_fn` do not (3 to 20 times slower), hence the macro below.

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use crate::{Mask, Real};

/// `N` numbers side by side. `FMA` says whether the enclosing kernel has a fused multiply-add; with
/// `FMA = false` every lane equals scalar `f32` bit for bit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Lanes<const N: usize, const FMA: bool = false>(pub [f32; N]);

/// One truth value per lane: all bits set or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C, align(32))]
pub struct LaneMask<const N: usize>(pub [u32; N]);

macro_rules! each {
    ($n:ident, $i:ident => $e:expr) => {{
        let mut r = [Default::default(); $n];
        for $i in 0..$n {
            r[$i] = $e;
        }
        r
    }};
}

macro_rules! lane_op {
    ($($t:ident $f:ident $op:tt),*) => { $(
        impl<const N: usize, const F: bool> $t for Lanes<N, F> {
            type Output = Self;
            #[inline(always)]
            fn $f(self, o: Self) -> Self {
                Lanes(each!(N, i => self.0[i] $op o.0[i]))
            }
        }
    )* }
}
lane_op!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<const N: usize, const F: bool> Neg for Lanes<N, F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lanes(each!(N, i => -self.0[i]))
    }
}

impl<const N: usize, const F: bool> Default for Lanes<N, F> {
    #[inline(always)]
    fn default() -> Self {
        Lanes([0.0; N])
    }
}

impl<const N: usize> BitAnd for LaneMask<N> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, o: Self) -> Self {
        LaneMask(each!(N, i => self.0[i] & o.0[i]))
    }
}
impl<const N: usize> BitOr for LaneMask<N> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, o: Self) -> Self {
        LaneMask(each!(N, i => self.0[i] | o.0[i]))
    }
}
impl<const N: usize> Not for LaneMask<N> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        LaneMask(each!(N, i => !self.0[i]))
    }
}

impl<const N: usize> Mask for LaneMask<N> {
    #[inline(always)]
    fn of(b: bool) -> Self {
        LaneMask([if b { !0 } else { 0 }; N])
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0.iter().fold(0, |a, b| a | b) != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.0.iter().fold(!0, |a, b| a & b) != 0
    }
}

impl<const N: usize, const F: bool> Real for Lanes<N, F> {
    type Mask = LaneMask<N>;
    const WIDTH: usize = N;
    const ZERO: Self = Lanes([0.0; N]);
    const ONE: Self = Lanes([1.0; N]);
    #[inline(always)]
    fn of(x: f64) -> Self {
        Lanes([x as f32; N])
    }
    #[inline(always)]
    fn load(s: &[f32], i: usize) -> Self {
        let mut r = [0.0; N];
        r.copy_from_slice(&s[i..i + N]);
        Lanes(r)
    }
    #[inline(always)]
    fn store(self, s: &mut [f32], i: usize) {
        s[i..i + N].copy_from_slice(&self.0);
    }
    #[inline(always)]
    fn look_up(self, table: &[f32]) -> Self {
        Lanes(each!(N, i => self.0[i].look_up(table)))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes(each!(N, i => self.0[i].sqrt()))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Lanes(each!(N, i => self.0[i].abs()))
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        Lanes(each!(N, i => Real::min(self.0[i], o.0[i])))
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        Lanes(each!(N, i => Real::max(self.0[i], o.0[i])))
    }
    #[inline(always)]
    fn copysign(self, s: Self) -> Self {
        Lanes(each!(N, i => self.0[i].copysign(s.0[i])))
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        if F { Lanes(each!(N, i => self.0[i].mul_add(b.0[i], c.0[i]))) } else { self * b + c }
    }
    #[inline(always)]
    fn lt(self, o: Self) -> LaneMask<N> {
        LaneMask(each!(N, i => if self.0[i] < o.0[i] { !0u32 } else { 0 }))
    }
    #[inline(always)]
    fn le(self, o: Self) -> LaneMask<N> {
        LaneMask(each!(N, i => if self.0[i] <= o.0[i] { !0u32 } else { 0 }))
    }
    #[inline(always)]
    fn select(m: LaneMask<N>, a: Self, b: Self) -> Self {
        Lanes(each!(N, i => if m.0[i] != 0 { a.0[i] } else { b.0[i] }))
    }
    #[inline(always)]
    fn round(self) -> Self {
        Lanes(each!(N, i => Real::round(self.0[i])))
    }
    #[inline(always)]
    fn pow2(self) -> Self {
        Lanes(each!(N, i => Real::pow2(self.0[i])))
    }
    #[inline(always)]
    fn frexp(self) -> (Self, Self) {
        (Lanes(each!(N, i => Real::frexp(self.0[i]).0)), Lanes(each!(N, i => Real::frexp(self.0[i]).1)))
    }
}
