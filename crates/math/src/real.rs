//! The number type a formula is written for: [`Real`].

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::{Mask, double, elementary};

/// Most lanes of a number type.
pub const MAX_WIDTH: usize = 16;

/// A real number, or several side by side: `f32`, `f64`, [`Lanes`](crate::Lanes).
///
/// A model is written once over this trait. What scalar code does with an early return is done with
/// a mask and [`Real::select`], so that every lane runs the same instructions.
///
/// The elementary functions are the project's own: lanes agree with `f32` bit for bit, and platforms
/// agree with each other. Errors are stated in [`crate::elementary`] and [`crate::double`].
pub trait Real:
    Copy
    + Debug
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// What comparisons return.
    type Mask: Mask;
    /// Number of lanes.
    const WIDTH: usize;
    /// 0
    const ZERO: Self;
    /// 1
    const ONE: Self;

    /// The constant `x`, in every lane, rounded to the precision of the type.
    fn of(x: f64) -> Self;
    /// Reads `WIDTH` numbers from `s[i..]`.
    ///
    /// Panics where the slice is too short.
    fn load(s: &[f32], i: usize) -> Self;
    /// Writes `WIDTH` numbers to `s[i..]`.
    ///
    /// Panics where the slice is too short.
    fn store(self, s: &mut [f32], i: usize);
    /// Reads the number of `table` that stands at the whole number `self`, every lane its own; before the beginning the
    /// first, beyond the end the last.
    ///
    /// Panics where the table is empty.
    fn look_up(self, table: &[f32]) -> Self;
    /// Reads the four numbers side by side in the row of `table` that [`look_up`](Self::look_up) would find.
    ///
    /// Panics where the table is empty.
    #[inline(always)]
    fn look_up_fours(self, table: &[[f32; 4]]) -> [Self; 4] {
        let mut columns = [[0.0; MAX_WIDTH]; 4];
        for (lane, at) in self.places(table.len()).into_iter().enumerate().take(Self::WIDTH) {
            for (column, x) in columns.iter_mut().zip(table[at as usize]) {
                column[lane] = x;
            }
        }
        let [a, b, c, d] = &columns;
        [Self::load(a, 0), Self::load(b, 0), Self::load(c, 0), Self::load(d, 0)]
    }
    /// Reads the eight numbers side by side in the row of `table` that [`look_up`](Self::look_up) would find.
    ///
    /// Panics where the table is empty.
    #[inline(always)]
    fn look_up_rows(self, table: &[[f32; 8]]) -> [Self; 8] {
        Self::gather_rows(table, &self.places(table.len()))
    }
    /// Where [`look_up`](Self::look_up) reads in a table of that length, for each lane.
    #[inline(always)]
    fn places(self, len: usize) -> [u32; MAX_WIDTH] {
        self.to_doubles().map(|x| (x as usize).min(len - 1) as u32)
    }
    /// Reads eight numbers for every lane, which stand side by side in the row of `table` that its place of `at` names.
    ///
    /// Panics where `at` has fewer than `WIDTH` places, or one is not in the table.
    #[inline(always)]
    fn gather_rows(table: &[[f32; 8]], at: &[u32]) -> [Self; 8] {
        let mut columns = [[0.0; MAX_WIDTH]; 8];
        for (lane, &i) in at[..Self::WIDTH].iter().enumerate() {
            for (column, x) in columns.iter_mut().zip(table[i as usize]) {
                column[lane] = x;
            }
        }
        let [a, b, c, d, e, f, g, h] = &columns;
        let [a, b, c, d] = [Self::load(a, 0), Self::load(b, 0), Self::load(c, 0), Self::load(d, 0)];
        [a, b, c, d, Self::load(e, 0), Self::load(f, 0), Self::load(g, 0), Self::load(h, 0)]
    }
    /// Writes what [`gather_rows`](Self::gather_rows) reads, for as many lanes as `at` has places, one lane after the other.
    ///
    /// Panics where a place is not in the table.
    #[inline(always)]
    fn scatter_rows(columns: [Self; 8], table: &mut [[f32; 8]], at: &[u32]) {
        let mut numbers = [[0.0; MAX_WIDTH]; 8];
        for (x, s) in columns.into_iter().zip(&mut numbers) {
            x.store(s, 0);
        }
        for (lane, &i) in at.iter().take(Self::WIDTH).enumerate() {
            for (x, column) in table[i as usize].iter_mut().zip(&numbers) {
                *x = column[lane];
            }
        }
    }
    /// The number in every lane, for what is computed one by one; lanes beyond `WIDTH` are zero.
    #[inline(always)]
    fn to_doubles(self) -> [f64; MAX_WIDTH] {
        let mut s = [0.0; MAX_WIDTH];
        self.store(&mut s, 0);
        s.map(f64::from)
    }
    /// Takes a number for every lane, rounded to the precision of the type.
    #[inline(always)]
    fn from_doubles(x: &[f64; MAX_WIDTH]) -> Self {
        Self::load(&x.map(|x| x as f32), 0)
    }
    /// Square root, correctly rounded; NaN below zero.
    fn sqrt(self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// The smaller; `o` where either is NaN.
    fn min(self, o: Self) -> Self;
    /// The larger; `o` where either is NaN.
    fn max(self, o: Self) -> Self;
    /// The magnitude of `self` with the sign of `s`.
    fn copysign(self, s: Self) -> Self;
    /// `self * b + c`, fused where the type says that this is fast, else rounded twice.
    fn fma(self, b: Self, c: Self) -> Self;
    /// `self < o`
    fn lt(self, o: Self) -> Self::Mask;
    /// `self <= o`
    fn le(self, o: Self) -> Self::Mask;
    /// `self > o`
    #[inline(always)]
    fn gt(self, o: Self) -> Self::Mask {
        o.lt(self)
    }
    /// `self >= o`
    #[inline(always)]
    fn ge(self, o: Self) -> Self::Mask {
        o.le(self)
    }
    /// `a` where the mask is true, else `b`.
    fn select(m: Self::Mask, a: Self, b: Self) -> Self;
    /// Nearest whole number, for `|self| < 2^22`.
    fn round(self) -> Self;
    /// `2^n` for a whole number `n` in [-126, 127].
    fn pow2(self) -> Self;
    /// Mantissa in [0.5, 1) and exponent of a positive normal number.
    fn frexp(self) -> (Self, Self);

    /// `e^self`; the argument is clamped to what the type can hold.
    #[inline(always)]
    fn exp(self) -> Self {
        elementary::exp(self)
    }
    /// `e^self`, not above `e^88`, in two thirds of the time: to the digits that an argument which was rounded itself leaves to the
    /// result, a relative error of about one rounding for each unit of `self`.
    #[inline(always)]
    fn exp_coarse(self) -> Self {
        elementary::exp_coarse(self)
    }
    /// Natural logarithm of a positive normal number.
    #[inline(always)]
    fn ln(self) -> Self {
        elementary::ln(self)
    }
    /// Sine and cosine, `|self| < 8000`.
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }
    /// Angle of the point (`x`, `self`), in (-pi, pi]; 0 at the origin.
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        elementary::atan2(self, x)
    }
    /// `e^-x I_0(x)` for `x >= 0`.
    #[inline(always)]
    fn i0e(self) -> Self {
        elementary::i0e(self)
    }
    /// `m` and `k` with `e^-x I_0(x) = m e^k`, for products with other exponentials: one exponential is enough for both.
    #[inline(always)]
    fn i0e_parts(self) -> (Self, Self) {
        elementary::i0e_parts(self)
    }

    /// `self^2`
    #[inline(always)]
    fn sqr(self) -> Self {
        self * self
    }
    /// Square root of the positive part: for numbers that only rounding takes below zero.
    #[inline(always)]
    fn safe_sqrt(self) -> Self {
        self.max(Self::ZERO).sqrt()
    }
    /// `min(max(self, lo), hi)`
    #[inline(always)]
    fn clamp(self, lo: Self, hi: Self) -> Self {
        self.max(lo).min(hi)
    }
    /// Arc sine; arguments beyond 1 count as 1.
    #[inline(always)]
    fn asin(self) -> Self {
        self.atan2(((Self::ONE - self) * (Self::ONE + self)).safe_sqrt())
    }
    /// Arc cosine; arguments beyond 1 count as 1.
    #[inline(always)]
    fn acos(self) -> Self {
        ((Self::ONE - self) * (Self::ONE + self)).safe_sqrt().atan2(self)
    }
    /// Sine.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Tangent.
    #[inline(always)]
    fn tan(self) -> Self {
        let (s, c) = self.sin_cos();
        s / c
    }
    /// `self^y` for positive `self`.
    #[inline(always)]
    fn pow(self, y: Self) -> Self {
        (y * self.ln()).exp()
    }
    /// `(1 - t) self + t b`
    #[inline(always)]
    fn lerp(self, b: Self, t: Self) -> Self {
        (Self::ONE - t) * self + t * b
    }
    /// `self` where the mask is true, else zero.
    #[inline(always)]
    fn only_where(self, m: Self::Mask) -> Self {
        Self::select(m, self, Self::ZERO)
    }
}

/// Adding this to a small `f32` and taking it away again rounds to a whole number (1.5 * 2^23).
const ROUNDER: f32 = 12_582_912.0;

impl Real for f32 {
    type Mask = bool;
    const WIDTH: usize = 1;
    const ZERO: f32 = 0.0;
    const ONE: f32 = 1.0;
    #[inline(always)]
    fn of(x: f64) -> f32 {
        x as f32
    }
    #[inline(always)]
    fn load(s: &[f32], i: usize) -> f32 {
        s[i]
    }
    #[inline(always)]
    fn store(self, s: &mut [f32], i: usize) {
        s[i] = self;
    }
    #[inline(always)]
    fn gather_rows(table: &[[f32; 8]], at: &[u32]) -> [f32; 8] {
        table[at[0] as usize]
    }
    #[inline(always)]
    fn scatter_rows(columns: [f32; 8], table: &mut [[f32; 8]], at: &[u32]) {
        if let Some(&i) = at.first() {
            table[i as usize] = columns;
        }
    }
    #[inline(always)]
    fn look_up(self, table: &[f32]) -> f32 {
        table[(self as usize).min(table.len() - 1)]
    }
    #[inline(always)]
    fn look_up_fours(self, table: &[[f32; 4]]) -> [f32; 4] {
        table[(self as usize).min(table.len() - 1)]
    }
    #[inline(always)]
    fn look_up_rows(self, table: &[[f32; 8]]) -> [f32; 8] {
        table[(self as usize).min(table.len() - 1)]
    }
    #[inline(always)]
    fn sqrt(self) -> f32 {
        f32::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> f32 {
        f32::abs(self)
    }
    #[inline(always)]
    fn min(self, o: f32) -> f32 {
        if self < o { self } else { o }
    }
    #[inline(always)]
    fn max(self, o: f32) -> f32 {
        if self > o { self } else { o }
    }
    #[inline(always)]
    fn copysign(self, s: f32) -> f32 {
        f32::copysign(self, s)
    }
    #[inline(always)]
    fn fma(self, b: f32, c: f32) -> f32 {
        self * b + c
    }
    #[inline(always)]
    fn lt(self, o: f32) -> bool {
        self < o
    }
    #[inline(always)]
    fn le(self, o: f32) -> bool {
        self <= o
    }
    #[inline(always)]
    fn select(m: bool, a: f32, b: f32) -> f32 {
        if m { a } else { b }
    }
    #[inline(always)]
    fn round(self) -> f32 {
        (self + ROUNDER) - ROUNDER
    }
    #[inline(always)]
    fn pow2(self) -> f32 {
        f32::from_bits(((self + ROUNDER).to_bits() << 23).wrapping_add(127 << 23))
    }
    #[inline(always)]
    fn frexp(self) -> (f32, f32) {
        let b = self.to_bits();
        (f32::from_bits((b & 0x007f_ffff) | 0x3f00_0000), ((b >> 23) as i32 - 126) as f32)
    }
}

impl Real for f64 {
    type Mask = bool;
    const WIDTH: usize = 1;
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;
    #[inline(always)]
    fn of(x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn load(s: &[f32], i: usize) -> f64 {
        f64::from(s[i])
    }
    #[inline(always)]
    fn store(self, s: &mut [f32], i: usize) {
        s[i] = self as f32;
    }
    #[inline(always)]
    fn look_up(self, table: &[f32]) -> f64 {
        f64::from(table[(self as usize).min(table.len() - 1)])
    }
    #[inline(always)]
    fn to_doubles(self) -> [f64; MAX_WIDTH] {
        let mut x = [0.0; MAX_WIDTH];
        x[0] = self;
        x
    }
    #[inline(always)]
    fn from_doubles(x: &[f64; MAX_WIDTH]) -> f64 {
        x[0]
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }
    #[inline(always)]
    fn min(self, o: f64) -> f64 {
        if self < o { self } else { o }
    }
    #[inline(always)]
    fn max(self, o: f64) -> f64 {
        if self > o { self } else { o }
    }
    #[inline(always)]
    fn copysign(self, s: f64) -> f64 {
        f64::copysign(self, s)
    }
    #[inline(always)]
    fn fma(self, b: f64, c: f64) -> f64 {
        self * b + c
    }
    #[inline(always)]
    fn lt(self, o: f64) -> bool {
        self < o
    }
    #[inline(always)]
    fn le(self, o: f64) -> bool {
        self <= o
    }
    #[inline(always)]
    fn select(m: bool, a: f64, b: f64) -> f64 {
        if m { a } else { b }
    }
    #[inline(always)]
    fn round(self) -> f64 {
        f64::round_ties_even(self)
    }
    #[inline(always)]
    fn pow2(self) -> f64 {
        f64::from_bits(((1023 + self as i64) as u64) << 52)
    }
    #[inline(always)]
    fn frexp(self) -> (f64, f64) {
        let b = self.to_bits();
        (
            f64::from_bits((b & 0x000f_ffff_ffff_ffff) | 0x3fe0_0000_0000_0000),
            ((b >> 52) as i64 - 1022) as f64,
        )
    }
    #[inline]
    fn exp(self) -> f64 {
        double::exp(self)
    }
    #[inline]
    fn exp_coarse(self) -> f64 {
        double::exp(self)
    }
    #[inline]
    fn ln(self) -> f64 {
        double::ln(self)
    }
    #[inline]
    fn sin_cos(self) -> (f64, f64) {
        double::sin_cos(self)
    }
    #[inline]
    fn atan2(self, x: f64) -> f64 {
        double::atan2(self, x)
    }
    #[inline]
    fn i0e(self) -> f64 {
        double::i0e(self)
    }
    #[inline]
    fn i0e_parts(self) -> (f64, f64) {
        (double::i0e(self), 0.0)
    }
}
