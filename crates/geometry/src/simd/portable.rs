//! What every target has: halves of four numbers, one machine instruction for each operation.

use wide::{f32x4, f32x8};

use core::ops::{BitAnd, BitOr, Not};

use super::{Floats, Mask, Simd};

/// SSE2, NEON, or single numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Simd for Portable {
    const EIGHT_IN_ONE: bool = false;
    type F4 = f32x4;
    type F8 = f32x8;
}

/// `N` answers, one bit each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bits<const N: usize>(u32);

impl<const N: usize> BitAnd for Bits<N> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, o: Self) -> Self {
        Bits(self.0 & o.0)
    }
}
impl<const N: usize> BitOr for Bits<N> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, o: Self) -> Self {
        Bits(self.0 | o.0)
    }
}
impl<const N: usize> Not for Bits<N> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Bits(!self.0 & ((1 << N) - 1))
    }
}
impl<const N: usize> Mask for Bits<N> {
    #[inline(always)]
    fn none() -> Self {
        Bits(0)
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0
    }
}

macro_rules! floats {
    ($type:ident, $n:literal) => {
        impl Floats<$n> for $type {
            type Mask = Bits<$n>;
            #[inline(always)]
            fn splat(x: f32) -> $type {
                $type::splat(x)
            }
            #[inline(always)]
            fn load(x: &[f32; $n]) -> $type {
                $type::new(*x)
            }
            #[inline(always)]
            fn to_array(self) -> [f32; $n] {
                self.to_array()
            }
            #[inline(always)]
            fn abs(self) -> $type {
                self.abs()
            }
            #[inline(always)]
            fn min(self, o: $type) -> $type {
                self.fast_min(o)
            }
            #[inline(always)]
            fn max(self, o: $type) -> $type {
                self.fast_max(o)
            }
            #[inline(always)]
            fn le(self, o: $type) -> Bits<$n> {
                Bits(self.simd_le(o).to_bitmask())
            }
            #[inline(always)]
            fn lt(self, o: $type) -> Bits<$n> {
                Bits(self.simd_lt(o).to_bitmask())
            }
            #[inline(always)]
            fn only_where(self, mask: Bits<$n>, o: $type) -> $type {
                let (mut a, b) = (self.to_array(), o.to_array());
                for (i, a) in a.iter_mut().enumerate() {
                    *a = if mask.0 >> i & 1 == 1 { *a } else { b[i] };
                }
                $type::new(a)
            }
            #[inline(always)]
            fn sqrt(self) -> $type {
                self.sqrt()
            }
            #[inline(always)]
            fn signed(self, o: $type) -> $type {
                self ^ (o & $type::splat(-0.0))
            }
        }
    };
}
floats!(f32x4, 4);
floats!(f32x8, 8);
