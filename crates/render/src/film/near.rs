//! Sums of the samples of a pixel that are small and of weight ±1, as nearly all are: [`Near`].

use super::fixed::{PARTS_MAX, VALUE_BITS, WEIGHT_BITS, parts, whole};
use super::pixels::Sums;

/// Most samples, so that no sum of [`parts`] can wrap.
const MOST: i64 = 1 << 11;

/// Sums of red, green, blue and weight, in the two [`parts`] of each term. The weight is a whole number, which leaves nothing to the
/// lower part: there samples are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(align(64))]
pub(super) struct Near {
    upper: [i64; 4],
    lower: [i64; 4],
}

impl Near {
    /// Takes a sample, unless it is another one.
    #[inline(always)]
    pub(super) fn add(&mut self, [r, g, b]: [f32; 3], weight: f32) -> bool {
        let small = r.abs() + g.abs() + b.abs() < PARTS_MAX as f32;
        if !(small & (weight.abs().to_bits() == 1f32.to_bits()) & (self.lower[3] < MOST)) {
            return false;
        }
        // A sign changes no digit of the products.
        let terms = [r * weight, g * weight, b * weight, weight].map(f64::from);
        let sums = self.upper.iter_mut().zip(&mut self.lower);
        for ((upper, lower), [u, l]) in sums.zip(terms.map(parts)) {
            *upper += u;
            *lower += l;
        }
        self.lower[3] += 1;
        true
    }

    /// The same sums on the grids of the film.
    #[inline]
    pub(super) fn sums(&self) -> Sums {
        let Near { upper: [r, g, b, weight], lower: [r_lower, g_lower, b_lower, n] } = *self;
        Sums {
            rgb: [[r, r_lower], [g, g_lower], [b, b_lower]].map(whole),
            weight: (whole([weight, 0]) >> (VALUE_BITS - WEIGHT_BITS)) as i64,
            n: n as u32,
        }
    }
}
