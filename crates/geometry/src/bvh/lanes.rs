//! Four `f32` side by side: what a node's children or a leaf's triangles are tested with.
//!
//! On the crate `wide`, which writes one machine instruction for each operation: plain arrays were tried, and the
//! compiler put them together across the wrong elements. A later wider kernel replaces this file and the two tests
//! that use it.

use core::ops::{Add, Div, Mul, Sub};

use wide::f32x4;

/// Four numbers.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub(crate) struct F4(f32x4);

impl F4 {
    #[inline(always)]
    pub(crate) fn splat(v: f32) -> F4 {
        F4(f32x4::splat(v))
    }
    #[inline(always)]
    pub(crate) fn to_array(self) -> [f32; 4] {
        self.0.to_array()
    }
    /// Changes one of the numbers.
    pub(crate) fn set(&mut self, i: usize, v: f32) {
        self.0.as_mut_array()[i] = v;
    }
    /// The smaller; either where one is NaN.
    #[inline(always)]
    pub(crate) fn min(self, o: F4) -> F4 {
        F4(self.0.fast_min(o.0))
    }
    /// The larger; either where one is NaN.
    #[inline(always)]
    pub(crate) fn max(self, o: F4) -> F4 {
        F4(self.0.fast_max(o.0))
    }
    /// Bit i says whether `self[i] <= o[i]`.
    #[inline(always)]
    pub(crate) fn le(self, o: F4) -> u32 {
        self.0.simd_le(o.0).to_bitmask()
    }
    /// Bit i says whether `self[i] < o[i]`.
    #[inline(always)]
    pub(crate) fn lt(self, o: F4) -> u32 {
        self.0.simd_lt(o.0).to_bitmask()
    }
}

macro_rules! op {
    ($($t:ident $f:ident $o:tt),*) => { $(
        impl $t for F4 {
            type Output = F4;
            #[inline(always)]
            fn $f(self, o: F4) -> F4 {
                F4(self.0 $o o.0)
            }
        }
    )* }
}
op!(Add add +, Sub sub -, Mul mul *, Div div /);
