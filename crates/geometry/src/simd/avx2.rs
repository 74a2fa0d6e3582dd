//! AVX2: eight numbers in one register.
//!
//! A value of [`F8`] can only be made inside [`run`], that is, with a [`Found`] in hand: the type is private and
//! reached through [`Kernel::run`] alone. This is why the intrinsics below may be called.

#![allow(unsafe_code, reason = "vector registers; every operation is tested against f32")]

use core::arch::x86_64::{
    __m256, _CMP_LE_OQ, _CMP_LT_OQ, _MM_HINT_T0, _mm_loadu_ps, _mm_prefetch, _mm256_add_ps, _mm256_and_ps,
    _mm256_andnot_ps, _mm256_blendv_ps, _mm256_castps_si256, _mm256_castps128_ps256, _mm256_castsi256_ps,
    _mm256_cmp_ps, _mm256_div_ps, _mm256_insertf128_ps, _mm256_loadu_ps, _mm256_max_epi32, _mm256_max_ps,
    _mm256_min_epi32, _mm256_min_ps, _mm256_movemask_ps, _mm256_mul_ps, _mm256_or_ps, _mm256_set1_epi32,
    _mm256_set1_ps, _mm256_setzero_ps, _mm256_shuffle_ps, _mm256_sqrt_ps, _mm256_storeu_ps, _mm256_sub_ps,
    _mm256_unpackhi_ps, _mm256_unpacklo_ps, _mm256_xor_ps,
};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use wide::f32x4;

use super::{Floats, Kernel, Mask, Simd};

/// The processor has AVX2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found(());

impl Found {
    pub(super) fn find() -> Option<Found> {
        std::arch::is_x86_feature_detected!("avx2").then_some(Found(()))
    }
}

/// Runs `kernel` with AVX2.
#[inline(always)]
pub(super) fn run<K: Kernel>(_: Found, kernel: K) -> K::Output {
    // SAFETY: AVX2 was found.
    unsafe { in_avx2(kernel) }
}

#[target_feature(enable = "avx2")]
fn in_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Avx2>()
}

/// The unit.
struct Avx2;

impl Simd for Avx2 {
    const EIGHT_IN_ONE: bool = true;
    type F4 = f32x4;
    type F8 = F8;
    #[inline(always)]
    fn columns(rows: [&[f32; 8]; 8]) -> [F8; 8] {
        // Rows i and i + 4 in the halves of one register, so that nothing crosses between halves later.
        let row = |i: usize| (F8::halves(rows[i], rows[i + 4], 0), F8::halves(rows[i], rows[i + 4], 4));
        let [(a, e), (b, f), (c, g), (d, h)] = [row(0), row(1), row(2), row(3)];
        let ([k0, k1, k2, k3], [k4, k5, k6, k7]) = (F8::columns(a, b, c, d), F8::columns(e, f, g, h));
        [k0, k1, k2, k3, k4, k5, k6, k7]
    }
    #[inline(always)]
    fn rows([a, b, c, d]: [F8; 4]) -> [[f32; 8]; 4] {
        F8::columns(a, b, c, d).map(Floats::to_array)
    }
}

/// Eight numbers in one register.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
struct F8(__m256);

/// Eight answers in one register: all bits of a lane set, or none.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
struct M8(__m256);

/// Calls an intrinsic.
macro_rules! avx {
    ($e:expr) => {
        // SAFETY: values of these types exist only where AVX2 was found, see the head of the module.
        unsafe { $e }
    };
}

impl F8 {
    /// Four numbers of each of two rows, from number `at` on, which is 0 or 4.
    #[inline(always)]
    fn halves(low: &[f32; 8], high: &[f32; 8], at: usize) -> F8 {
        let at = at & 4;
        // SAFETY: four numbers follow in each row.
        F8(avx!({
            let low = _mm256_castps128_ps256(_mm_loadu_ps(low.as_ptr().add(at)));
            _mm256_insertf128_ps::<1>(low, _mm_loadu_ps(high.as_ptr().add(at)))
        }))
    }
    /// Transposes both halves, which are 4 x 4 each.
    #[inline(always)]
    fn columns(a: F8, b: F8, c: F8, d: F8) -> [F8; 4] {
        avx!({
            let (ab, cd) = (_mm256_unpacklo_ps(a.0, b.0), _mm256_unpacklo_ps(c.0, d.0));
            let (ab2, cd2) = (_mm256_unpackhi_ps(a.0, b.0), _mm256_unpackhi_ps(c.0, d.0));
            [
                F8(_mm256_shuffle_ps::<0x44>(ab, cd)),
                F8(_mm256_shuffle_ps::<0xee>(ab, cd)),
                F8(_mm256_shuffle_ps::<0x44>(ab2, cd2)),
                F8(_mm256_shuffle_ps::<0xee>(ab2, cd2)),
            ]
        })
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
    Add add F8 _mm256_add_ps,
    Sub sub F8 _mm256_sub_ps,
    Mul mul F8 _mm256_mul_ps,
    Div div F8 _mm256_div_ps,
    BitAnd bitand M8 _mm256_and_ps,
    BitOr bitor M8 _mm256_or_ps
);

impl Not for M8 {
    type Output = M8;
    #[inline(always)]
    fn not(self) -> M8 {
        M8(avx!(_mm256_xor_ps(self.0, _mm256_castsi256_ps(_mm256_set1_epi32(-1)))))
    }
}

impl Mask for M8 {
    #[inline(always)]
    fn none() -> M8 {
        M8(avx!(_mm256_setzero_ps()))
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        avx!(_mm256_movemask_ps(self.0)) as u32
    }
}

impl Floats<8> for F8 {
    type Mask = M8;
    #[inline(always)]
    fn splat(x: f32) -> F8 {
        F8(avx!(_mm256_set1_ps(x)))
    }
    #[inline(always)]
    fn load(x: &[f32; 8]) -> F8 {
        // SAFETY: `x` holds eight numbers.
        F8(avx!(_mm256_loadu_ps(x.as_ptr())))
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 8] {
        let mut a = [0.0; 8];
        // SAFETY: `a` holds eight numbers.
        avx!(_mm256_storeu_ps(a.as_mut_ptr(), self.0));
        a
    }
    #[inline(always)]
    fn abs(self) -> F8 {
        F8(avx!(_mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0)))
    }
    #[inline(always)]
    fn min(self, o: F8) -> F8 {
        F8(avx!(_mm256_min_ps(self.0, o.0)))
    }
    #[inline(always)]
    fn max(self, o: F8) -> F8 {
        F8(avx!(_mm256_max_ps(self.0, o.0)))
    }
    #[inline(always)]
    fn min_nonneg(self, o: F8) -> F8 {
        F8(avx!(_mm256_castsi256_ps(_mm256_min_epi32(_mm256_castps_si256(self.0), _mm256_castps_si256(o.0)))))
    }
    #[inline(always)]
    fn max_nonneg(self, o: F8) -> F8 {
        F8(avx!(_mm256_castsi256_ps(_mm256_max_epi32(_mm256_castps_si256(self.0), _mm256_castps_si256(o.0)))))
    }
    #[inline(always)]
    fn le(self, o: F8) -> M8 {
        M8(avx!(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, o.0)))
    }
    #[inline(always)]
    fn lt(self, o: F8) -> M8 {
        M8(avx!(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, o.0)))
    }
    #[inline(always)]
    fn only_where(self, mask: M8, o: F8) -> F8 {
        F8(avx!(_mm256_blendv_ps(o.0, self.0, mask.0)))
    }
    #[inline(always)]
    fn sqrt(self) -> F8 {
        F8(avx!(_mm256_sqrt_ps(self.0)))
    }
    #[inline(always)]
    fn signed(self, o: F8) -> F8 {
        F8(avx!(_mm256_xor_ps(self.0, _mm256_and_ps(o.0, _mm256_set1_ps(-0.0)))))
    }
}

/// Asks for the cache lines of what `p` points to, which need not exist. Every x86-64 processor can do this.
#[inline(always)]
pub(super) fn prefetch<T>(p: *const T) {
    let line = p.cast::<i8>();
    for at in (0..size_of::<T>()).step_by(64) {
        // SAFETY: a hint; it reads nothing that the program could see, and no address makes it fault.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(line.wrapping_add(at)) };
    }
}
