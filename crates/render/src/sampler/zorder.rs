//! The shuffled Morton curve of [Ahmed2020]: pixels that lie close get indices that lie close.
//!
//! The paper, and pbrt-v4, permute each base-4 digit of the index by one of 24 permutations, chosen
//! by the digits above it and by the dimension. Such a permutation is a choice of which neighbours
//! share the upper bit (across, down or diagonal) followed by a base-2 nested shuffle of two bits.
//! The choice of neighbours is made here, once per pixel sample and the same for all dimensions; the
//! shuffle, which differs per dimension, is the one that `padded_pair` makes anyway. So one pair is
//! distributed as in the paper (but for the weights of the three choices: 3/8, 3/8, 1/4), at the
//! cost of one hash per dimension in place of one per digit.

use super::hash::join;
use super::scramble::nested;

/// Spreads the 16 lower bits to the even places.
#[inline(always)]
fn spread(v: u32) -> u32 {
    let mut v = v & 0xffff;
    v = (v | (v << 8)) & 0x00ff_00ff;
    v = (v | (v << 4)) & 0x0f0f_0f0f;
    v = (v | (v << 2)) & 0x3333_3333;
    (v | (v << 1)) & 0x5555_5555
}

/// Bit-reversed Morton index of the pixel, with the quad's pairing chosen per level from the levels above.
#[inline(always)]
pub(crate) fn paired_morton(pixel: [u32; 2], seed: u64) -> u32 {
    const EVEN: u32 = 0x5555_5555;
    let reversed = (spread(pixel[0]) | (spread(pixel[1]) << 1)).reverse_bits();
    // In the reversed word coarse levels are low, so `nested` hashes exactly what lies above a digit;
    // the shift keeps the digit itself out of its own choice.
    let h1 = nested(reversed, seed as u32) << 2;
    let h2 = nested(reversed, (seed >> 32) as u32) << 2;
    let (y, x) = (reversed & EVEN, (reversed >> 1) & EVEN);
    let diagonal = h1 & (h1 >> 1) & EVEN;
    let down = h2 & EVEN & !diagonal;
    let across = EVEN & !diagonal & !down;
    let upper = ((x ^ y) & diagonal) | (x & down) | (y & across);
    let lower = (y & down) | (x & !down);
    upper | (lower << 1)
}

/// The lower 32 bits of a sample's index on the curve, reversed; `log2_spp` of them are the sample's own.
#[inline(always)]
pub(crate) fn reversed_index(morton: u32, sample: u32, log2_spp: u32) -> u32 {
    let mask = (1u32 << log2_spp) - 1;
    (morton >> log2_spp) | (sample & mask).reverse_bits()
}

/// Key of all that lies above: of the pixel, and of the `turn`-th power of two of its samples.
///
/// The upper bits only move a point by less than 2^-32, but two places that differ there must not share
/// their shuffle.
#[inline(always)]
pub(crate) fn key(pixel: [u32; 2], morton: u32, turn: u32, log2_spp: u32, seed: u64) -> u64 {
    let mask = (1u32 << log2_spp) - 1;
    let above = u64::from(morton & mask) | (u64::from(turn) << 32);
    let outside = u64::from(pixel[0] >> 16) | (u64::from(pixel[1] >> 16) << 16);
    join(join(seed, above), outside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_distinct_and_blocks_stay_together() {
        let index = |pixel, s| reversed_index(paired_morton(pixel, 99), s, 2).reverse_bits();
        let mut seen: Vec<u32> = Vec::new();
        for y in 0..16 {
            for x in 0..16 {
                for s in 0..4 {
                    let r = index([x, y], s);
                    // A quad of pixels with four samples each is one aligned block of sixteen.
                    assert_eq!(r >> 4, index([x & !1, y & !1], 0) >> 4);
                    seen.push(r);
                }
            }
        }
        seen.sort_unstable();
        assert!(seen.iter().enumerate().all(|(i, r)| *r == i as u32));
    }

    #[test]
    fn all_three_pairings_occur() {
        let mut count = [0u32; 3];
        for y in (0..64).step_by(2) {
            for x in (0..64).step_by(2) {
                let at = |dx: u32, dy: u32| paired_morton([x + dx, y + dy], 5).reverse_bits() >> 1;
                let partners = [at(1, 0), at(0, 1), at(1, 1)].map(|i| i == at(0, 0));
                count[partners.iter().position(|p| *p).unwrap()] += 1;
            }
        }
        // Of 1024 quads, 384, 384 and 256 are expected, each within 16 (one standard deviation).
        assert!(count[0].abs_diff(384) < 70 && count[1].abs_diff(384) < 70, "{count:?}");
    }
}
