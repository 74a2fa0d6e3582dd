//! [`in_lanes`]: work in the widest lanes that this processor has.
//!
//! On x86-64 these are AVX2 registers of eight `f32`, or one `f32` where the processor has no AVX2; on other machines
//! [`Lanes`](crate::Lanes) of eight. With the feature `avx512`, [`only_in_lanes`] takes AVX-512 registers of sixteen where there are any:
//! that pays for loops over many points, and takes as long to build again. All equal scalar `f32` bit for bit, so no result depends on the processor.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(all(target_arch = "x86_64", feature = "avx512"))]
mod avx512;

use crate::Real;

/// Something to be computed over a number type that is only known when the program runs.
///
/// `run`, and every generic function that it calls, has to be `#[inline(always)]`: what is not inlined is compiled
/// without the vector unit, and is slow.
pub trait InLanes {
    /// What the work gives.
    type Output;
    /// Does the work; `R::WIDTH` says how many lanes there are.
    fn run<R: Real>(self) -> Self::Output;
}

/// Runs `work` in lanes of eight, if this processor has any.
#[inline]
pub fn in_lanes<W: InLanes>(work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    return if std::arch::is_x86_feature_detected!("avx2") { avx2::run(work) } else { one_by_one(work) };
    #[cfg(not(target_arch = "x86_64"))]
    work.run::<crate::Lanes<8>>()
}

/// Sixteen lanes can be had.
#[cfg(all(target_arch = "x86_64", feature = "avx512"))]
#[inline]
fn has_sixteen() -> bool {
    std::arch::is_x86_feature_detected!("avx512f")
}

/// Lanes of the number type that [`only_in_lanes`] takes; 1 where there are none.
#[inline]
pub fn widest() -> usize {
    #[cfg(all(target_arch = "x86_64", feature = "avx512"))]
    if has_sixteen() {
        return 16;
    }
    #[cfg(target_arch = "x86_64")]
    return if std::arch::is_x86_feature_detected!("avx2") { 8 } else { 1 };
    #[cfg(not(target_arch = "x86_64"))]
    8
}

/// [`in_lanes`], in the [`widest`] lanes, for work that has another way without: gives it back where this processor has none.
///
/// Spares the copy of the work in `f32`, which takes as long to build as that in lanes.
///
/// # Errors
/// The work, where there are no lanes.
#[inline]
pub fn only_in_lanes<W: InLanes>(work: W) -> Result<W::Output, W> {
    #[cfg(all(target_arch = "x86_64", feature = "avx512"))]
    if has_sixteen() {
        return Ok(avx512::run(work));
    }
    #[cfg(target_arch = "x86_64")]
    return if std::arch::is_x86_feature_detected!("avx2") { Ok(avx2::run(work)) } else { Err(work) };
    #[cfg(not(target_arch = "x86_64"))]
    Ok(work.run::<crate::Lanes<8>>())
}

/// Runs `work` in `f32`.
#[inline(never)]
fn one_by_one<W: InLanes>(work: W) -> W::Output {
    work.run::<f32>()
}
