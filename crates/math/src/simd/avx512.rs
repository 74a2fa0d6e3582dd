//! Lanes as AVX-512 registers.
//!
//! A value of [`F32x16`] can only be named inside [`InLanes::run`] as called from here, that is, after AVX-512 was found:
//! the type is private. This is why the intrinsics below may be called.
#![allow(unsafe_code, reason = "vector registers; every operation is tested against f32")]

use core::arch::x86_64::{
    __m512, _CMP_LE_OQ, _CMP_LT_OQ, _mm512_abs_ps, _mm512_add_epi32, _mm512_add_ps, _mm512_and_si512,
    _mm512_andnot_si512, _mm512_castps_si512, _mm512_castsi512_ps, _mm512_cmp_ps_mask, _mm512_cvtepi32_ps,
    _mm512_cvttps_epi32, _mm512_div_ps, _mm512_i32gather_ps, _mm512_loadu_ps, _mm512_mask_blend_ps,
    _mm512_max_ps, _mm512_min_epu32, _mm512_min_ps, _mm512_mul_ps, _mm512_or_si512, _mm512_set1_epi32,
    _mm512_set1_ps, _mm512_setzero_ps, _mm512_slli_epi32, _mm512_sqrt_ps, _mm512_srli_epi32,
    _mm512_storeu_ps, _mm512_sub_epi32, _mm512_sub_ps, _mm512_xor_si512,
};
use core::fmt::{Debug, Formatter};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::InLanes;
use crate::{Mask, Real};

/// Runs `work` with AVX-512, which the caller has found.
pub(super) fn run<W: InLanes>(work: W) -> W::Output {
    // SAFETY: `in_lanes` found AVX-512.
    unsafe { kernel(work) }
}

#[target_feature(enable = "avx512f")]
fn kernel<W: InLanes>(work: W) -> W::Output {
    work.run::<F32x16>()
}

/// Sixteen numbers in one register.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(super) struct F32x16(__m512);

/// Sixteen truth values, one bit each.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(super) struct Bits(u16);

/// Calls an intrinsic.
macro_rules! avx {
    ($e:expr) => {
        // SAFETY: values of these types exist only where AVX-512 was found, see the head of the module.
        unsafe { $e }
    };
}

/// Rounds as the scalar twin does, see there.
const ROUNDER: f32 = 12_582_912.0;

impl F32x16 {
    #[inline(always)]
    fn splat(x: f32) -> F32x16 {
        F32x16(avx!(_mm512_set1_ps(x)))
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 16] {
        let mut a = [0.0; 16];
        // SAFETY: `a` holds sixteen numbers.
        avx!(_mm512_storeu_ps(a.as_mut_ptr(), self.0));
        a
    }
}

impl Debug for F32x16 {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        self.to_array().fmt(f)
    }
}
impl Debug for Bits {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        write!(f, "{:016b}", self.0)
    }
}
impl Default for F32x16 {
    #[inline(always)]
    fn default() -> F32x16 {
        F32x16::ZERO
    }
}

macro_rules! operator {
    ($($trait:ident $f:ident $type:ident $intrinsic:ident),*) => { $(
        impl $trait for $type {
            type Output = $type;
            #[inline(always)]
            fn $f(self, o: $type) -> $type {
                $type(avx!($intrinsic(self.0, o.0)))
            }
        }
    )* }
}
operator!(
    Add add F32x16 _mm512_add_ps,
    Sub sub F32x16 _mm512_sub_ps,
    Mul mul F32x16 _mm512_mul_ps,
    Div div F32x16 _mm512_div_ps
);

impl Neg for F32x16 {
    type Output = F32x16;
    #[inline(always)]
    fn neg(self) -> F32x16 {
        F32x16(avx!({
            let flipped = _mm512_xor_si512(_mm512_castps_si512(self.0), _mm512_set1_epi32(i32::MIN));
            _mm512_castsi512_ps(flipped)
        }))
    }
}
impl BitAnd for Bits {
    type Output = Bits;
    #[inline(always)]
    fn bitand(self, o: Bits) -> Bits {
        Bits(self.0 & o.0)
    }
}
impl BitOr for Bits {
    type Output = Bits;
    #[inline(always)]
    fn bitor(self, o: Bits) -> Bits {
        Bits(self.0 | o.0)
    }
}
impl Not for Bits {
    type Output = Bits;
    #[inline(always)]
    fn not(self) -> Bits {
        Bits(!self.0)
    }
}

impl Mask for Bits {
    #[inline(always)]
    fn of(b: bool) -> Bits {
        Bits(if b { u16::MAX } else { 0 })
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0 != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.0 == u16::MAX
    }
}

impl Real for F32x16 {
    type Mask = Bits;
    const WIDTH: usize = 16;
    // SAFETY: sixteen numbers have the size and the bits of a register.
    const ZERO: F32x16 = F32x16(unsafe { core::mem::transmute::<[f32; 16], __m512>([0.0; 16]) });
    // SAFETY: as above.
    const ONE: F32x16 = F32x16(unsafe { core::mem::transmute::<[f32; 16], __m512>([1.0; 16]) });
    #[inline(always)]
    fn of(x: f64) -> F32x16 {
        F32x16::splat(x as f32)
    }
    #[inline(always)]
    fn load(s: &[f32], i: usize) -> F32x16 {
        let s = &s[i..i + 16];
        // SAFETY: `s` holds sixteen numbers.
        F32x16(avx!(_mm512_loadu_ps(s.as_ptr())))
    }
    #[inline(always)]
    fn store(self, s: &mut [f32], i: usize) {
        let s = &mut s[i..i + 16];
        // SAFETY: `s` holds sixteen numbers.
        avx!(_mm512_storeu_ps(s.as_mut_ptr(), self.0));
    }
    #[inline(always)]
    fn look_up(self, table: &[f32]) -> F32x16 {
        assert!(!table.is_empty(), "look_up in an empty table");
        let last = table.len().min(i32::MAX as usize) - 1;
        // SAFETY: no index is larger than the last: what does not fit into an i32 converts to 2^31.
        F32x16(avx!({
            let index = _mm512_cvttps_epi32(_mm512_max_ps(self.0, _mm512_setzero_ps()));
            let index = _mm512_min_epu32(index, _mm512_set1_epi32(last as i32));
            _mm512_i32gather_ps::<4>(index, table.as_ptr())
        }))
    }
    #[inline(always)]
    fn sqrt(self) -> F32x16 {
        F32x16(avx!(_mm512_sqrt_ps(self.0)))
    }
    #[inline(always)]
    fn abs(self) -> F32x16 {
        F32x16(avx!(_mm512_abs_ps(self.0)))
    }
    #[inline(always)]
    fn min(self, o: F32x16) -> F32x16 {
        F32x16(avx!(_mm512_min_ps(self.0, o.0)))
    }
    #[inline(always)]
    fn max(self, o: F32x16) -> F32x16 {
        F32x16(avx!(_mm512_max_ps(self.0, o.0)))
    }
    #[inline(always)]
    fn copysign(self, s: F32x16) -> F32x16 {
        F32x16(avx!({
            let sign = _mm512_set1_epi32(i32::MIN);
            let size = _mm512_andnot_si512(sign, _mm512_castps_si512(self.0));
            _mm512_castsi512_ps(_mm512_or_si512(size, _mm512_and_si512(sign, _mm512_castps_si512(s.0))))
        }))
    }
    #[inline(always)]
    fn fma(self, b: F32x16, c: F32x16) -> F32x16 {
        self * b + c
    }
    #[inline(always)]
    fn lt(self, o: F32x16) -> Bits {
        Bits(avx!(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, o.0)))
    }
    #[inline(always)]
    fn le(self, o: F32x16) -> Bits {
        Bits(avx!(_mm512_cmp_ps_mask::<_CMP_LE_OQ>(self.0, o.0)))
    }
    #[inline(always)]
    fn select(m: Bits, a: F32x16, b: F32x16) -> F32x16 {
        F32x16(avx!(_mm512_mask_blend_ps(m.0, b.0, a.0)))
    }
    #[inline(always)]
    fn round(self) -> F32x16 {
        let r = F32x16::splat(ROUNDER);
        (self + r) - r
    }
    #[inline(always)]
    fn pow2(self) -> F32x16 {
        let n = self + F32x16::splat(ROUNDER);
        F32x16(avx!({
            let exponent = _mm512_slli_epi32::<23>(_mm512_castps_si512(n.0));
            _mm512_castsi512_ps(_mm512_add_epi32(exponent, _mm512_set1_epi32(127 << 23)))
        }))
    }
    #[inline(always)]
    fn frexp(self) -> (F32x16, F32x16) {
        avx!({
            let mantissa = _mm512_set1_epi32(0x007f_ffff);
            let half = _mm512_castps_si512(_mm512_set1_ps(0.5));
            let exponent = _mm512_srli_epi32::<23>(_mm512_castps_si512(self.0));
            (
                F32x16(_mm512_castsi512_ps(_mm512_or_si512(
                    _mm512_and_si512(_mm512_castps_si512(self.0), mantissa),
                    half,
                ))),
                F32x16(_mm512_cvtepi32_ps(_mm512_sub_epi32(exponent, _mm512_set1_epi32(126)))),
            )
        })
    }
}
