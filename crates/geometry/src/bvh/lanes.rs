//! Four `f32` side by side: what a node's children or a leaf's triangles are tested with.
//!
//! Plain arrays, spelt out element by element: the compiler makes one SSE2 or NEON instruction of each
//! operation. A later wider kernel replaces this file and the two tests that use it.

use core::ops::{Add, Div, Mul, Sub};

/// Four numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(16))]
pub(crate) struct F4(pub(crate) [f32; 4]);

/// One expression per element, unrolled.
macro_rules! each {
    ($x:expr, $y:expr; $a:ident, $b:ident => $e:expr) => {{
        let one = |i: usize| {
            let ($a, $b) = ($x.0[i], $y.0[i]);
            $e
        };
        F4([one(0), one(1), one(2), one(3)])
    }};
}

impl F4 {
    #[inline(always)]
    pub(crate) fn splat(v: f32) -> F4 {
        F4([v; 4])
    }
    /// The smaller; `o` where either is NaN, as the machine instruction does.
    #[inline(always)]
    pub(crate) fn min(self, o: F4) -> F4 {
        each!(self, o; a, b => if a < b { a } else { b })
    }
    /// The larger; `o` where either is NaN.
    #[inline(always)]
    pub(crate) fn max(self, o: F4) -> F4 {
        each!(self, o; a, b => if a > b { a } else { b })
    }
    /// Bit i says whether `self[i] <= o[i]`.
    #[inline(always)]
    pub(crate) fn le(self, o: F4) -> u32 {
        let (a, b) = (self.0, o.0);
        u32::from(a[0] <= b[0])
            | u32::from(a[1] <= b[1]) << 1
            | u32::from(a[2] <= b[2]) << 2
            | u32::from(a[3] <= b[3]) << 3
    }
    /// Bit i says whether `self[i] < o[i]`.
    #[inline(always)]
    pub(crate) fn lt(self, o: F4) -> u32 {
        let (a, b) = (self.0, o.0);
        u32::from(a[0] < b[0])
            | u32::from(a[1] < b[1]) << 1
            | u32::from(a[2] < b[2]) << 2
            | u32::from(a[3] < b[3]) << 3
    }
}

macro_rules! op {
    ($($t:ident $f:ident $o:tt),*) => { $(
        impl $t for F4 {
            type Output = F4;
            #[inline(always)]
            fn $f(self, o: F4) -> F4 {
                each!(self, o; a, b => a $o b)
            }
        }
    )* }
}
op!(Add add +, Sub sub -, Mul mul *, Div div /);
