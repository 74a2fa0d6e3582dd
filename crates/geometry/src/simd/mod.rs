//! Vector registers behind one interface: [`Floats`], [`Simd`]; and the choice between them: [`Unit`].
//!
//! Every operation rounds as scalar `f32` does, and none is fused, so the same query gives the same bits on every unit.

#[cfg(target_arch = "x86_64")]
mod avx2;
mod portable;

use core::fmt::Debug;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

pub(crate) use portable::Portable;

/// Answers of comparisons side by side.
pub(crate) trait Mask:
    Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// True nowhere.
    fn none() -> Self;
    /// Bit i says what answer i is.
    fn bits(self) -> u32;
    /// One is true.
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
}

/// `N` numbers side by side.
pub(crate) trait Floats<const N: usize>:
    Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// What comparisons answer.
    type Mask: Mask;
    fn splat(x: f32) -> Self;
    fn load(x: &[f32; N]) -> Self;
    fn to_array(self) -> [f32; N];
    fn abs(self) -> Self;
    /// The smaller; either where one is NaN.
    fn min(self, o: Self) -> Self;
    /// The larger; either where one is NaN, `o` where both are zero.
    fn max(self, o: Self) -> Self;
    /// The smaller where neither is negative, else something that is not positive.
    #[inline(always)]
    fn min_nonneg(self, o: Self) -> Self {
        self.min(o)
    }
    /// The larger where one is positive or zero without sign, else something negative.
    #[inline(always)]
    fn max_nonneg(self, o: Self) -> Self {
        self.max(o)
    }
    /// Whether `self[i] <= o[i]`.
    fn le(self, o: Self) -> Self::Mask;
    /// Whether `self[i] < o[i]`.
    fn lt(self, o: Self) -> Self::Mask;
    /// `self[i]` where the mask is true, else `o[i]`.
    fn only_where(self, mask: Self::Mask, o: Self) -> Self;
    fn sqrt(self) -> Self;
    /// The number, negated where `o` has a minus sign.
    fn signed(self, o: Self) -> Self;
}

/// A vector unit: its registers of four and of eight numbers.
pub(crate) trait Simd {
    /// Eight numbers fill one register.
    const EIGHT_IN_ONE: bool;
    type F4: Floats<4>;
    type F8: Floats<8>;
    /// Number k of each of eight rows, for each k.
    #[inline(always)]
    fn columns(rows: [&[f32; 8]; 8]) -> [Self::F8; 8] {
        let mut columns = [[0.0; 8]; 8];
        for (i, row) in rows.iter().enumerate() {
            for (column, x) in columns.iter_mut().zip(*row) {
                column[i] = *x;
            }
        }
        let column = |k: usize| Self::F8::load(&columns[k]);
        [column(0), column(1), column(2), column(3), column(4), column(5), column(6), column(7)]
    }
    /// Rows of four numbers, given number k of each of eight rows for each k: rows i and i + 4, one after the other, for each i.
    #[inline(always)]
    fn rows(columns: [Self::F8; 4]) -> [[f32; 8]; 4] {
        let (columns, mut rows) = (columns.map(Floats::to_array), [[0.0; 8]; 4]);
        for (i, row) in rows.iter_mut().enumerate() {
            for (k, column) in columns.iter().enumerate() {
                (row[k], row[k + 4]) = (column[i], column[i + 4]);
            }
        }
        rows
    }
}

/// Something to be computed with a vector unit that is only known when the program runs.
///
/// `run`, and every generic function that it calls in its loops, has to be `#[inline(always)]`: what is not inlined is compiled
/// without the unit.
pub(crate) trait Kernel {
    /// What it gives.
    type Output;
    /// Does the work.
    fn run<S: Simd>(self) -> Self::Output;
}

/// A vector unit that this processor has.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Unit {
    /// Eight lanes as two halves in whatever the target always has: SSE2, NEON, or single numbers.
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2(avx2::Found),
}

impl Unit {
    /// The best there is, or what the environment variable `SPARROW_SIMD` names: `portable` or `avx2`.
    pub(crate) fn choose() -> Unit {
        let wanted = std::env::var("SPARROW_SIMD");
        Unit::named(wanted.as_deref().unwrap_or(""))
    }
    /// The unit of that name if this processor has it, else the best there is.
    pub(crate) fn named(name: &str) -> Unit {
        match name {
            "portable" => Unit::Portable,
            #[cfg(target_arch = "x86_64")]
            _ => avx2::Found::find().map_or(Unit::Portable, Unit::Avx2),
            #[cfg(not(target_arch = "x86_64"))]
            _ => Unit::Portable,
        }
    }
    /// Runs `kernel` with this unit.
    #[inline(always)]
    pub(crate) fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self {
            Unit::Portable => portable(kernel),
            #[cfg(target_arch = "x86_64")]
            Unit::Avx2(found) => avx2::run(found, kernel),
        }
    }
}

#[inline(never)]
fn portable<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Portable>()
}

/// Asks for the cache lines of `list[i]` ahead of their use, where the target has an instruction for it; `i` may lie beyond.
#[inline(always)]
pub(crate) fn prefetch<T>(list: &[T], i: usize) {
    #[cfg(target_arch = "x86_64")]
    avx2::prefetch(list.as_ptr().wrapping_add(i));
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (list, i);
}
