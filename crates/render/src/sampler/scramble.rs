//! Base-2 randomisations: nested uniform scrambling and shuffling, and the padded Sobol pair.

use super::config::Randomize;
use super::hash::{GOLDEN, mix};

/// Nested uniform permutation of numbers whose *lowest* bit leads: bit `j` of the result is bit `j`
/// of `x`, flipped or not by `seed` and the bits below `j`.
///
/// Applied to a bit-reversed number it is an Owen scrambling [Laine2011]; applied to a bit-reversed
/// index it is a shuffle that keeps every aligned block of a power of two together [Burley2020].
/// The constants are those of [Vegdahl2021], which pbrt-v4 uses as well.
#[inline(always)]
pub(crate) fn nested(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// [`nested`] with an independent hash for every bit: thirty times slower, free of structure.
fn nested_by_bits(x: u32, seed: u32) -> u32 {
    let mut flips = 0;
    for bit in 0..32u32 {
        let below = x & ((1u32 << bit) - 1);
        let h = mix(u64::from(below) ^ (u64::from(seed) << 32) ^ u64::from(bit).wrapping_mul(GOLDEN));
        flips |= ((h >> 63) as u32) << bit;
    }
    x ^ flips
}

/// Randomises a number given with its lowest bit leading.
#[inline(always)]
pub(crate) fn randomize(x: u32, seed: u32, how: Randomize) -> u32 {
    match how {
        Randomize::FastOwen => nested(x, seed),
        Randomize::None => x,
        Randomize::PermuteDigits => x ^ seed,
        Randomize::Owen => nested_by_bits(x, seed),
    }
}

/// The second Sobol dimension, of an index, with the lowest bit of the result leading.
///
/// Its generator matrix is Pascal's triangle modulo 2: bit `j` is the sum of the index bits `k` that
/// contain `j` as a bit set, which five exclusive ors add up.
#[inline(always)]
pub(crate) fn second_dimension(mut i: u32) -> u32 {
    i ^= i >> 16;
    i ^= (i & 0xff00_ff00) >> 8;
    i ^= (i & 0xf0f0_f0f0) >> 4;
    i ^= (i & 0xcccc_cccc) >> 2;
    i ^ ((i & 0xaaaa_aaaa) >> 1)
}

/// A third dimension beside the radical inverse and [`second_dimension`], of an index, with the lowest bit of the result leading.
///
/// The index is read as a polynomial over two elements and written in base `p = x^2 + x + 1`, two bits a digit, as the first
/// two dimensions write it in base `x` and `x + 1` [Tezuka1993]. The bases have no factor in common, so each aligned block of
/// `2^(a + b + 2 c)` indices has one point in every box of sides `2^-a`, `2^-b` and `4^-c`.
#[inline(always)]
pub(crate) fn third_dimension(mut n: u32) -> u32 {
    // Divides blocks of 4 m bits by p^m = x^2m + x^m + 1, and leaves quotient and remainder in their halves.
    for (m, upper, last) in [
        (8, 0xffff_0000, 0x0000_00ff),
        (4, 0xff00_ff00, 0x000f_000f),
        (2, 0xf0f0_f0f0, 0x0303_0303),
        (1, 0xcccc_cccc, 0x1111_1111),
    ] {
        let down = (n & upper) >> m;
        n ^= down ^ (((down >> m) ^ (down >> (2 * m))) & last);
    }
    n
}

/// Random permutations of blocks of consecutive indices, sixteen at most.
///
/// A base-2 shuffle keeps neighbours neighbours: samples `2 k` and `2 k + 1` lie in opposite halves of
/// *every* padded dimension, which doubles the variance of what depends on two of them jointly. After
/// a permutation of blocks of `B` that excess is `1 / (B - 1)` of the variance: 7 % for sixteen, a third
/// for the base-4 digits of [Ahmed2020]. Blocks stay together, so larger powers of two remain nets.
pub(crate) struct Blocks(Box<[u8; 16 * 256]>);

impl Blocks {
    /// Permutations of sixteen places within aligned blocks of `2^log2_size` indices, `log2_size <= 4`, one after the other.
    pub(crate) fn new(log2_size: u32) -> Blocks {
        let size = 1u8 << log2_size;
        let mut places = Box::new([0; 16 * 256]);
        for (permutation, j) in places.as_chunks_mut::<16>().0.iter_mut().zip(0..) {
            let mut order: Vec<u8> = (0..size).collect();
            order.sort_unstable_by_key(|v| mix(j * 16 + u64::from(*v)));
            *permutation = core::array::from_fn(|v| v as u8 / size * size + order[v % order.len()]);
        }
        Blocks(places)
    }

    /// Moves an index within its block, as `key` and the block say.
    #[inline(always)]
    pub(crate) fn permute(&self, index: u32, key: u32) -> u32 {
        let block = (index | 15).wrapping_mul(0x9e37_79b9) ^ key;
        let place = self.0[(block >> 24 << 4 | index & 15) as usize];
        (index & !15) | u32::from(place)
    }
}

/// Where `key` takes the index whose bits are `reversed`.
///
/// The shuffle goes from the top bit of the index down, so that aligned blocks of a power of two stay together; without it the
/// dimensions would move in step.
#[inline(always)]
pub(super) fn shuffled(reversed: u32, key: u64, blocks: &Blocks) -> u32 {
    let index = nested(reversed, key as u32).reverse_bits();
    blocks.permute(index, key.wrapping_mul(GOLDEN) as u32)
}

/// First coordinate of the padded pair: [`padded_pair`] without the second.
#[inline(always)]
pub(crate) fn padded_single(reversed: u32, key: u64, blocks: &Blocks, how: Randomize) -> u32 {
    randomize(shuffled(reversed, key, blocks), (key >> 32) as u32, how).reverse_bits()
}

/// A point of the (0, 2)-sequence, shuffled and scrambled by `key`, as two binary fractions; `reversed` is the bit-reversed index.
#[inline(always)]
pub(crate) fn padded_pair(reversed: u32, key: u64, blocks: &Blocks, how: Randomize) -> [u32; 2] {
    let second_key = key.wrapping_mul(GOLDEN);
    let index = shuffled(reversed, key, blocks);
    let x = randomize(index, (key >> 32) as u32, how);
    let y = randomize(second_dimension(index), (second_key >> 32) as u32, how);
    // One reversal of 64 bits costs what one of 32 does, where the processor has no instruction for it.
    let both = ((u64::from(x) << 32) | u64::from(y)).reverse_bits();
    [both as u32, (both >> 32) as u32]
}

/// A point of three dimensions: the [third](third_dimension), then [`padded_pair`].
#[inline(always)]
pub(crate) fn padded_triple(reversed: u32, key: u64, blocks: &Blocks, how: Randomize) -> [u32; 3] {
    let third_key = key.wrapping_mul(GOLDEN).wrapping_mul(GOLDEN);
    let z = third_dimension(shuffled(reversed, key, blocks));
    let z = randomize(z, (third_key >> 32) as u32, how).reverse_bits();
    let [x, y] = padded_pair(reversed, key, blocks, how);
    [z, x, y]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Digits of the polynomial `n` in base `x^2 + x + 1`, by division.
    fn digits(mut n: u32) -> u32 {
        let mut digits = 0;
        for place in (0..32).step_by(2) {
            let mut quotient = 0;
            for bit in (2..32).rev() {
                if n >> bit & 1 == 1 {
                    n ^= 0b111 << (bit - 2);
                    quotient |= 1 << (bit - 2);
                }
            }
            digits |= n << place;
            n = quotient;
        }
        digits
    }

    #[test]
    fn third_dimension_is_written_in_its_base() {
        for i in [0u32, 1, 2, 3, 4, 7, 77, 0x8000_0000, 0xdead_beef, u32::MAX] {
            assert_eq!(third_dimension(i), digits(i), "index {i}");
        }
    }

    #[test]
    fn three_dimensions_are_a_net() {
        let log2_n = 8u32;
        for start in [0u32, 5 << 8, 0xdead_be00] {
            for c in 0..=log2_n / 2 {
                for b in 0..=log2_n - 2 * c {
                    let a = log2_n - 2 * c - b;
                    let low = |v: u32, bits: u32| v & ((1 << bits) - 1);
                    let mut seen = [false; 256];
                    for i in start..start + 256 {
                        let (x, y, z) =
                            (low(i, a), low(second_dimension(i), b), low(third_dimension(i), 2 * c));
                        seen[(x | (y << a) | (z << (a + b))) as usize] = true;
                    }
                    assert!(seen.iter().all(|s| *s), "boxes of {a}, {b}, {c} from {start}");
                }
            }
        }
    }

    #[test]
    fn second_dimension_matches_its_recurrence() {
        // Direction numbers of the polynomial x + 1: v_j = v_{j-1} ^ (v_{j-1} >> 1). [JoeKuo2008]
        let mut columns = [1u32 << 31; 32];
        for j in 1..32 {
            columns[j] = columns[j - 1] ^ (columns[j - 1] >> 1);
        }
        for i in [1u32, 2, 3, 77, 0x8000_0000, 0xdead_beef] {
            let expected = (0..32).filter(|j| i >> j & 1 == 1).fold(0, |v, j| v ^ columns[j]);
            assert_eq!(second_dimension(i).reverse_bits(), expected, "index {i}");
        }
    }

    #[test]
    fn nested_permutations_flip_by_lower_bits_only() {
        for how in [Randomize::FastOwen, Randomize::Owen] {
            for bit in 0..32u32 {
                let x = 0x9234_5671u32.rotate_left(bit);
                let low = (1u32 << bit) - 1;
                let a = randomize(x, 0xabcd_1234, how);
                let b = randomize(x ^ (1 << bit), 0xabcd_1234, how);
                assert_eq!(a & low, b & low, "{how:?}: bit {bit} reaches down");
                assert_ne!((a ^ b) >> bit & 1, 0, "{how:?}: bit {bit} is lost");
            }
        }
    }
}
