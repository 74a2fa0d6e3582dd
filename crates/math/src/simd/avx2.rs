//! Lanes as AVX2 registers.
//!
//! A value of [`F32x8`] can only be named inside [`InLanes::run`] as called from here, that is, after AVX2 was found:
//! the type is private. This is why the intrinsics below may be called.
#![allow(unsafe_code, reason = "vector registers; every operation is tested against f32")]

use core::arch::x86_64::{
    __m256, _CMP_LE_OQ, _CMP_LT_OQ, _mm_loadu_ps, _mm256_add_epi32, _mm256_add_ps, _mm256_and_ps,
    _mm256_andnot_ps, _mm256_blendv_ps, _mm256_castps_si256, _mm256_castsi256_ps, _mm256_cmp_ps,
    _mm256_cvtepi32_ps, _mm256_cvttps_epi32, _mm256_div_ps, _mm256_i32gather_ps, _mm256_loadu_ps,
    _mm256_max_ps, _mm256_min_epu32, _mm256_min_ps, _mm256_movemask_ps, _mm256_mul_ps, _mm256_or_ps,
    _mm256_permute2f128_ps, _mm256_set_m128, _mm256_set1_epi32, _mm256_set1_ps, _mm256_setzero_ps,
    _mm256_shuffle_ps, _mm256_slli_epi32, _mm256_sqrt_ps, _mm256_srli_epi32, _mm256_storeu_ps,
    _mm256_storeu_si256, _mm256_sub_epi32, _mm256_sub_ps, _mm256_unpackhi_ps, _mm256_unpacklo_ps,
    _mm256_xor_ps,
};
use core::fmt::{Debug, Formatter};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::InLanes;
use crate::{MAX_WIDTH, Mask, Real};

/// Runs `work` with AVX2, which the caller has found.
pub(super) fn run<W: InLanes>(work: W) -> W::Output {
    // SAFETY: `in_lanes` found AVX2.
    unsafe { kernel(work) }
}

#[target_feature(enable = "avx2")]
fn kernel<W: InLanes>(work: W) -> W::Output {
    work.run::<F32x8>()
}

/// Eight numbers in one register.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(super) struct F32x8(__m256);

/// Eight truth values: all bits of a lane set, or none.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(super) struct Bits(__m256);

/// Calls an intrinsic.
macro_rules! avx {
    ($e:expr) => {
        // SAFETY: values of these types exist only where AVX2 was found, see the head of the module.
        unsafe { $e }
    };
}

/// Rounds as the scalar twin does, see there.
const ROUNDER: f32 = 12_582_912.0;

impl F32x8 {
    #[inline(always)]
    fn splat(x: f32) -> F32x8 {
        F32x8(avx!(_mm256_set1_ps(x)))
    }
    /// A row of a table.
    #[inline(always)]
    fn row(table: &[[f32; 8]], i: u32) -> F32x8 {
        F32x8::load(&table[i as usize], 0)
    }
    /// Two rows of a table.
    #[inline(always)]
    fn two(table: &[[f32; 4]], i: u32, j: u32) -> F32x8 {
        let (a, b) = (&table[i as usize], &table[j as usize]);
        // SAFETY: both rows hold four numbers.
        F32x8(avx!(_mm256_set_m128(_mm_loadu_ps(b.as_ptr()), _mm_loadu_ps(a.as_ptr()))))
    }
    /// Rows to columns, and back.
    #[inline(always)]
    fn transposed([a, b, c, d, e, f, g, h]: [F32x8; 8]) -> [F32x8; 8] {
        let ([ae, bf], [cg, dh]) =
            ([F32x8::halves(a, e), F32x8::halves(b, f)], [F32x8::halves(c, g), F32x8::halves(d, h)]);
        let [k0, k1, k2, k3] = F32x8::quarters([ae[0], bf[0], cg[0], dh[0]]);
        let [k4, k5, k6, k7] = F32x8::quarters([ae[1], bf[1], cg[1], dh[1]]);
        [k0, k1, k2, k3, k4, k5, k6, k7]
    }
    /// The lower halves of both, then the upper ones.
    #[inline(always)]
    fn halves(a: F32x8, b: F32x8) -> [F32x8; 2] {
        avx!([
            F32x8(_mm256_permute2f128_ps::<0x20>(a.0, b.0)),
            F32x8(_mm256_permute2f128_ps::<0x31>(a.0, b.0)),
        ])
    }
    /// Transposes both halves, which are 4 x 4 each.
    #[inline(always)]
    fn quarters([a, b, c, d]: [F32x8; 4]) -> [F32x8; 4] {
        avx!({
            let (ab, cd) = (_mm256_unpacklo_ps(a.0, b.0), _mm256_unpacklo_ps(c.0, d.0));
            let (ab2, cd2) = (_mm256_unpackhi_ps(a.0, b.0), _mm256_unpackhi_ps(c.0, d.0));
            [
                F32x8(_mm256_shuffle_ps::<0x44>(ab, cd)),
                F32x8(_mm256_shuffle_ps::<0xee>(ab, cd)),
                F32x8(_mm256_shuffle_ps::<0x44>(ab2, cd2)),
                F32x8(_mm256_shuffle_ps::<0xee>(ab2, cd2)),
            ]
        })
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 8] {
        let mut a = [0.0; 8];
        // SAFETY: `a` holds eight numbers.
        avx!(_mm256_storeu_ps(a.as_mut_ptr(), self.0));
        a
    }
}

impl Debug for F32x8 {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        self.to_array().fmt(f)
    }
}
impl Debug for Bits {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        write!(f, "{:08b}", avx!(_mm256_movemask_ps(self.0)))
    }
}
impl Default for F32x8 {
    #[inline(always)]
    fn default() -> F32x8 {
        F32x8::ZERO
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
    Add add F32x8 _mm256_add_ps,
    Sub sub F32x8 _mm256_sub_ps,
    Mul mul F32x8 _mm256_mul_ps,
    Div div F32x8 _mm256_div_ps,
    BitAnd bitand Bits _mm256_and_ps,
    BitOr bitor Bits _mm256_or_ps
);

impl Neg for F32x8 {
    type Output = F32x8;
    #[inline(always)]
    fn neg(self) -> F32x8 {
        F32x8(avx!(_mm256_xor_ps(self.0, _mm256_set1_ps(-0.0))))
    }
}
impl Not for Bits {
    type Output = Bits;
    #[inline(always)]
    fn not(self) -> Bits {
        Bits(avx!(_mm256_xor_ps(self.0, _mm256_castsi256_ps(_mm256_set1_epi32(-1)))))
    }
}

impl Mask for Bits {
    #[inline(always)]
    fn of(b: bool) -> Bits {
        Bits(avx!(_mm256_castsi256_ps(_mm256_set1_epi32(-i32::from(b)))))
    }
    #[inline(always)]
    fn any(self) -> bool {
        avx!(_mm256_movemask_ps(self.0)) != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        avx!(_mm256_movemask_ps(self.0)) == 0xff
    }
}

impl Real for F32x8 {
    type Mask = Bits;
    const WIDTH: usize = 8;
    // SAFETY: eight numbers have the size and the bits of a register.
    const ZERO: F32x8 = F32x8(unsafe { core::mem::transmute::<[f32; 8], __m256>([0.0; 8]) });
    // SAFETY: as above.
    const ONE: F32x8 = F32x8(unsafe { core::mem::transmute::<[f32; 8], __m256>([1.0; 8]) });
    #[inline(always)]
    fn of(x: f64) -> F32x8 {
        F32x8::splat(x as f32)
    }
    #[inline(always)]
    fn load(s: &[f32], i: usize) -> F32x8 {
        let s = &s[i..i + 8];
        // SAFETY: `s` holds eight numbers.
        F32x8(avx!(_mm256_loadu_ps(s.as_ptr())))
    }
    #[inline(always)]
    fn store(self, s: &mut [f32], i: usize) {
        let s = &mut s[i..i + 8];
        // SAFETY: `s` holds eight numbers.
        avx!(_mm256_storeu_ps(s.as_mut_ptr(), self.0));
    }
    #[inline(always)]
    fn gather_rows(table: &[[f32; 8]], at: &[u32]) -> [F32x8; 8] {
        let at = &at[..8];
        F32x8::transposed([
            F32x8::row(table, at[0]),
            F32x8::row(table, at[1]),
            F32x8::row(table, at[2]),
            F32x8::row(table, at[3]),
            F32x8::row(table, at[4]),
            F32x8::row(table, at[5]),
            F32x8::row(table, at[6]),
            F32x8::row(table, at[7]),
        ])
    }
    #[inline(always)]
    fn scatter_rows(columns: [F32x8; 8], table: &mut [[f32; 8]], at: &[u32]) {
        let [a, b, c, d, e, f, g, h] = F32x8::transposed(columns);
        let Some(at) = at.get(..8) else {
            let rows = [a, b, c, d, e, f, g];
            for (row, &i) in rows.into_iter().zip(at) {
                row.store(&mut table[i as usize], 0);
            }
            return;
        };
        a.store(&mut table[at[0] as usize], 0);
        b.store(&mut table[at[1] as usize], 0);
        c.store(&mut table[at[2] as usize], 0);
        d.store(&mut table[at[3] as usize], 0);
        e.store(&mut table[at[4] as usize], 0);
        f.store(&mut table[at[5] as usize], 0);
        g.store(&mut table[at[6] as usize], 0);
        h.store(&mut table[at[7] as usize], 0);
    }
    #[inline(always)]
    fn look_up(self, table: &[f32]) -> F32x8 {
        assert!(!table.is_empty(), "look_up in an empty table");
        let last = table.len().min(i32::MAX as usize) - 1;
        // SAFETY: no index is larger than the last: what does not fit into an i32 converts to 2^31.
        F32x8(avx!({
            let index = _mm256_cvttps_epi32(_mm256_max_ps(self.0, _mm256_setzero_ps()));
            let index = _mm256_min_epu32(index, _mm256_set1_epi32(last as i32));
            _mm256_i32gather_ps::<4>(table.as_ptr(), index)
        }))
    }
    #[inline(always)]
    fn look_up_fours(self, table: &[[f32; 4]]) -> [F32x8; 4] {
        let at = self.places(table.len());
        F32x8::quarters([
            F32x8::two(table, at[0], at[4]),
            F32x8::two(table, at[1], at[5]),
            F32x8::two(table, at[2], at[6]),
            F32x8::two(table, at[3], at[7]),
        ])
    }
    #[inline(always)]
    fn places(self, len: usize) -> [u32; MAX_WIDTH] {
        assert!(len > 0, "look_up in an empty table");
        let (last, mut at) = (len.min(i32::MAX as usize) - 1, [0; MAX_WIDTH]);
        // SAFETY: there is room for more than eight numbers.
        avx!({
            let index = _mm256_cvttps_epi32(_mm256_max_ps(self.0, _mm256_setzero_ps()));
            let index = _mm256_min_epu32(index, _mm256_set1_epi32(last as i32));
            _mm256_storeu_si256(at.as_mut_ptr().cast(), index);
        });
        at
    }
    #[inline(always)]
    fn sqrt(self) -> F32x8 {
        F32x8(avx!(_mm256_sqrt_ps(self.0)))
    }
    #[inline(always)]
    fn abs(self) -> F32x8 {
        F32x8(avx!(_mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0)))
    }
    #[inline(always)]
    fn min(self, o: F32x8) -> F32x8 {
        F32x8(avx!(_mm256_min_ps(self.0, o.0)))
    }
    #[inline(always)]
    fn max(self, o: F32x8) -> F32x8 {
        F32x8(avx!(_mm256_max_ps(self.0, o.0)))
    }
    #[inline(always)]
    fn copysign(self, s: F32x8) -> F32x8 {
        F32x8(avx!({
            let sign = _mm256_set1_ps(-0.0);
            _mm256_or_ps(_mm256_andnot_ps(sign, self.0), _mm256_and_ps(sign, s.0))
        }))
    }
    #[inline(always)]
    fn fma(self, b: F32x8, c: F32x8) -> F32x8 {
        self * b + c
    }
    #[inline(always)]
    fn lt(self, o: F32x8) -> Bits {
        Bits(avx!(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, o.0)))
    }
    #[inline(always)]
    fn le(self, o: F32x8) -> Bits {
        Bits(avx!(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, o.0)))
    }
    #[inline(always)]
    fn select(m: Bits, a: F32x8, b: F32x8) -> F32x8 {
        F32x8(avx!(_mm256_blendv_ps(b.0, a.0, m.0)))
    }
    #[inline(always)]
    fn round(self) -> F32x8 {
        let r = F32x8::splat(ROUNDER);
        (self + r) - r
    }
    #[inline(always)]
    fn pow2(self) -> F32x8 {
        let n = self + F32x8::splat(ROUNDER);
        F32x8(avx!({
            let exponent = _mm256_slli_epi32::<23>(_mm256_castps_si256(n.0));
            _mm256_castsi256_ps(_mm256_add_epi32(exponent, _mm256_set1_epi32(127 << 23)))
        }))
    }
    #[inline(always)]
    fn frexp(self) -> (F32x8, F32x8) {
        avx!({
            let mantissa = _mm256_castsi256_ps(_mm256_set1_epi32(0x007f_ffff));
            let half = _mm256_set1_ps(0.5);
            let exponent = _mm256_srli_epi32::<23>(_mm256_castps_si256(self.0));
            (
                F32x8(_mm256_or_ps(_mm256_and_ps(self.0, mantissa), half)),
                F32x8(_mm256_cvtepi32_ps(_mm256_sub_epi32(exponent, _mm256_set1_epi32(126)))),
            )
        })
    }
}
