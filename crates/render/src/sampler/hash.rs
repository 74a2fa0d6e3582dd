//! Hashes and the small permutations made from them.

use sparrow_math::ONE_MINUS_EPSILON;

/// 2^64 divided by the golden ratio: multiples of it are spread evenly over 64 bits.
pub(crate) const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// A bijection of 64 bits in which every bit of the input changes about half of the output.
///
/// Variant 13 of [Stafford2011], the finaliser of SplitMix64.
#[inline(always)]
pub(crate) fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// One key from a key and a word.
#[inline(always)]
pub(crate) fn join(key: u64, word: u64) -> u64 {
    mix(key ^ word.wrapping_mul(GOLDEN).wrapping_add(GOLDEN))
}

/// The upper 24 bits as a number in `[0, 1 - 2^-24]`.
///
/// Cut, not rounded: a point never crosses into the next stratum.
#[inline(always)]
pub(crate) fn to_unit(v: u32) -> f32 {
    (v >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// A number that rounding may have taken to one, back below it.
#[inline(always)]
pub(crate) fn below_one(x: f32) -> f32 {
    x.min(ONE_MINUS_EPSILON)
}

/// Where `i` goes in the permutation of `0..n` that `key` names; `i < n`.
///
/// A few invertible steps on the bits that `n - 1` needs, repeated until the result lies below `n`,
/// as in [Kensler2013].
#[inline]
pub(crate) fn permute(i: u32, n: u32, key: u64) -> u32 {
    debug_assert!(i < n, "a permutation of 0..{n} has no place {i}");
    let mask = u32::MAX.checked_shr((n - 1).leading_zeros()).unwrap_or(0);
    let half = (mask.count_ones() / 2).max(1);
    let mut i = i;
    loop {
        let mut k = key;
        for _ in 0..3 {
            i = i.wrapping_mul(k as u32 | 1).wrapping_add((k >> 32) as u32) & mask;
            i ^= i >> half;
            k = k.rotate_left(21).wrapping_mul(GOLDEN);
        }
        if i < n {
            return i;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permute_is_a_bijection_and_mixes() {
        for n in [1u32, 2, 3, 4, 5, 16, 31, 100] {
            let mut first = vec![0u32; n as usize];
            for seed in 0..400 {
                let mut seen = vec![false; n as usize];
                for i in 0..n {
                    seen[permute(i, n, mix(seed)) as usize] = true;
                }
                assert!(seen.iter().all(|s| *s), "n {n} seed {seed}");
                first[permute(0, n, mix(seed)) as usize] += 1;
            }
            // Each place expects 400/n visits; 30 is beyond six standard deviations for n = 16.
            let expected = 400 / n;
            assert!(first.iter().all(|c| c.abs_diff(expected) < 60), "n {n}: {first:?}");
        }
    }

    #[test]
    fn unit_numbers_stay_below_one() {
        assert!(to_unit(u32::MAX) <= ONE_MINUS_EPSILON && to_unit(0) == 0.0);
    }
}
