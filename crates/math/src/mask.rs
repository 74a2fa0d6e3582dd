//! What comparisons answer: [`Mask`].

use core::fmt::Debug;
use core::ops::{BitAnd, BitOr, Not};

/// The answer of a comparison, one truth value per lane.
pub trait Mask:
    Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> + 'static
{
    /// The same truth value in every lane.
    fn of(b: bool) -> Self;
    /// True where at least one lane is true.
    fn any(self) -> bool;
    /// True where every lane is true.
    fn all(self) -> bool;
}

impl Mask for bool {
    #[inline(always)]
    fn of(b: bool) -> bool {
        b
    }
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
}
