//! The Halton sequence over image plane and path: radical inverses in prime bases.

use super::config::Randomize;
use super::hash::{GOLDEN, below_one, join, mix};

/// Dimensions with a base of their own: two of the image plane, the rest of the path.
pub(crate) const N_DIMENSIONS: u32 = 128;

/// The image is tiled by blocks at most this wide, within which pixels share one sequence.
const MAX_SIDE: u32 = 128;

/// One dimension: its base, and the digit permutations of this render.
struct Base {
    prime: u32,
    /// `2^64 / prime`, rounded up: a multiplication divides every 32-bit number exactly. [Lemire2019]
    reciprocal: u64,
    /// Digits that reach down to 2^-25.
    n_digits: usize,
    /// Permutation of digit `k` at `k * prime ..`; empty where digits are not permuted.
    permutations: Vec<u16>,
    /// What the permuted zeros from digit `k` on add up to.
    tails: Vec<f64>,
}

/// Tables of the sequence for one image size and seed; about 360 KiB with digit permutations.
pub(crate) struct HaltonTables {
    bases: Vec<Base>,
    /// Width and height of the block, `2^e` and `3^f`.
    scale: [u64; 2],
    /// Digits of the block's width and height.
    digits: [u32; 2],
    /// Multiples that combine the two residues into the index.
    combine: [u64; 2],
    randomize: Randomize,
    seed: u64,
}

fn primes() -> impl Iterator<Item = u32> {
    (2u32..).filter(|n| (2..).take_while(|d| d * d <= *n).all(|d| n % d != 0))
}

/// The digits of a base in random order. [Knuth1997, sec. 3.4.2, algorithm P]
fn shuffled(prime: u32, key: u64) -> Vec<u16> {
    let mut digits: Vec<u16> = (0..prime as u16).collect();
    for i in (1..prime).rev() {
        let h = mix(key.wrapping_add(u64::from(i).wrapping_mul(GOLDEN))) >> 32;
        digits.swap(i as usize, ((h * u64::from(i + 1)) >> 32) as usize);
    }
    digits
}

impl Base {
    fn new(prime: u32, permuted: bool, key: u64) -> Base {
        let mut n_digits = 0;
        let mut power = 1u64;
        while power < 1 << 25 {
            power *= u64::from(prime);
            n_digits += 1;
        }
        let n_permuted = if permuted { n_digits } else { 0 };
        let permutations: Vec<u16> =
            (0..n_permuted).flat_map(|k| shuffled(prime, join(key, k as u64))).collect();
        let mut tails = vec![0.0; n_digits + 1];
        if permuted {
            for k in (0..n_digits).rev() {
                let zero = f64::from(permutations[k * prime as usize]);
                tails[k] = (tails[k + 1] + zero) / f64::from(prime);
            }
        }
        Base { prime, reciprocal: u64::MAX / u64::from(prime) + 1, n_digits, permutations, tails }
    }

    /// Quotient and digit.
    #[inline(always)]
    fn split(&self, n: u64) -> (u64, u32) {
        let p = u64::from(self.prime);
        let q =
            if n >> 32 == 0 { ((u128::from(self.reciprocal) * u128::from(n)) >> 64) as u64 } else { n / p };
        (q, (n - q * p) as u32)
    }

    /// The digits of the index, each permuted, mirrored at the point.
    fn inverse(&self, index: u64) -> f32 {
        let mut rest = index;
        let mut mirrored = 0u64;
        let mut power = 1.0f64;
        let mut k = 0;
        while rest != 0 && k < self.n_digits {
            let (q, digit) = self.split(rest);
            let shown = match self.permutations.get(k * self.prime as usize + digit as usize) {
                Some(d) => u64::from(*d),
                None => u64::from(digit),
            };
            mirrored = mirrored * u64::from(self.prime) + shown;
            power *= f64::from(self.prime);
            rest = q;
            k += 1;
        }
        // A tail is stored relative to its own first digit.
        below_one(((mirrored as f64 + self.tails[k]) / power) as f32)
    }

    /// The same with every digit's permutation chosen by the digits before it.
    ///
    /// The permutations are `a d + b` modulo the prime. Any two digits go to any two different ones
    /// equally often, and the variance of a nested scrambling depends on no more than pairs [Owen1997].
    fn scrambled_inverse(&self, index: u64, key: u64) -> f32 {
        let p = u64::from(self.prime);
        let mut rest = index;
        let mut mirrored = 0u64;
        let mut prefix = 0u64;
        let mut power = 1.0f64;
        for k in 0..self.n_digits as u64 {
            let (q, digit) = self.split(rest);
            let h = mix(key ^ join(k, prefix));
            let a = 1 + (((h & 0xffff_ffff) * (p - 1)) >> 32);
            let b = ((h >> 32) * p) >> 32;
            prefix = prefix * p + u64::from(digit);
            mirrored = mirrored * p + (a * u64::from(digit) + b) % p;
            power *= p as f64;
            rest = q;
        }
        below_one((mirrored as f64 / power) as f32)
    }
}

/// Reverses the lowest `n` digits of `v`.
fn mirror(mut v: u64, base: u64, n: u32) -> u64 {
    let mut out = 0;
    for _ in 0..n {
        out = out * base + v % base;
        v /= base;
    }
    out
}

impl HaltonTables {
    /// Tables for an image of this size.
    pub(crate) fn new(resolution: [u32; 2], randomize: Randomize, seed: u64) -> HaltonTables {
        let permuted = randomize == Randomize::PermuteDigits;
        let bases =
            primes().zip(0..u64::from(N_DIMENSIONS)).map(|(p, d)| Base::new(p, permuted, join(seed, d)));
        let mut scale = [1u64; 2];
        let mut digits = [0; 2];
        for (axis, base) in [(0, 2), (1, 3)] {
            while scale[axis] < u64::from(resolution[axis].min(MAX_SIDE)) {
                scale[axis] *= base;
                digits[axis] += 1;
            }
        }
        // Residue r of one side is carried by the multiple of the other side that is 1 modulo this one.
        let carrier =
            |own: u64, other: u64| (0..own).map(|k| k * other).find(|c| c % own == 1 % own).unwrap_or(0);
        let combine = [carrier(scale[0], scale[1]), carrier(scale[1], scale[0])];
        HaltonTables { bases: bases.collect(), scale, digits, combine, randomize, seed }
    }

    /// Index of the `sample`-th point that falls into `pixel` of its block.
    #[inline]
    pub(crate) fn index(&self, pixel: [u32; 2], sample: u32) -> u64 {
        let stride = self.stride();
        let x = mirror(u64::from(pixel[0]) % u64::from(MAX_SIDE), 2, self.digits[0]);
        let y = mirror(u64::from(pixel[1]) % u64::from(MAX_SIDE), 3, self.digits[1]);
        (x * self.combine[0] + y * self.combine[1]) % stride + u64::from(sample) * stride
    }

    /// Number of points between two of the same pixel.
    #[inline]
    pub(crate) fn stride(&self) -> u64 {
        self.scale[0] * self.scale[1]
    }

    /// Place within the pixel: the digits below those that chose it.
    ///
    /// pbrt leaves these two unscrambled; here they follow the seed too, so that renders with
    /// different seeds average to an unbiased image.
    #[inline]
    pub(crate) fn offset(&self, index: u64) -> [f32; 2] {
        [self.value(index >> self.digits[0], 0), self.value(index / self.scale[1], 1)]
    }

    /// The sequence's value.
    #[inline]
    pub(crate) fn value(&self, index: u64, dimension: u32) -> f32 {
        let base = &self.bases[dimension as usize];
        match self.randomize {
            Randomize::None | Randomize::PermuteDigits => base.inverse(index),
            Randomize::FastOwen | Randomize::Owen => {
                base.scrambled_inverse(index, join(self.seed, u64::from(dimension)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_values_are_radical_inverses() {
        let t = HaltonTables::new([1, 1], Randomize::None, 0);
        for (i, d, want) in [(1u64, 0, 0.5), (6, 0, 0.375), (5, 1, 7.0 / 9.0), (8, 2, 16.0 / 25.0)] {
            assert!((t.value(i, d) - want as f32).abs() < 1e-6, "index {i} dimension {d}");
        }
        assert_eq!(t.bases[127].prime, 719);
    }

    #[test]
    fn the_index_falls_into_its_pixel() {
        let t = HaltonTables::new([500, 90], Randomize::None, 0);
        assert_eq!(t.scale, [128, 243]);
        for (x, y, s) in [(0, 0, 0), (127, 89, 3), (300, 17, 70_000)] {
            let i = t.index([x, y], s);
            assert_eq!((f64::from(t.value(i, 0)) * 128.0) as u32, x % 128);
            assert_eq!((f64::from(t.value(i, 1)) * 243.0) as u32, y);
        }
    }

    #[test]
    fn reciprocals_divide_exactly() {
        for prime in [3, 7, 719] {
            let b = Base::new(prime, false, 0);
            for n in [0u64, 1, 718, 719, 4_294_967_295, 4_294_967_294, 1 << 40, (1 << 33) + 5] {
                assert_eq!(b.split(n), (n / u64::from(prime), (n % u64::from(prime)) as u32));
            }
        }
    }

    #[test]
    fn permuted_points_stay_stratified() {
        for how in [Randomize::PermuteDigits, Randomize::Owen] {
            let t = HaltonTables::new([1, 1], how, 3);
            for d in [0u32, 1, 2, 9] {
                let p = u64::from(t.bases[d as usize].prime);
                let mut seen = vec![0; (p * p) as usize];
                for i in 0..p * p {
                    seen[(f64::from(t.value(i + 5 * p * p, d)) * (p * p) as f64) as usize] += 1;
                }
                assert!(seen.iter().all(|c| *c == 1), "{how:?} dimension {d}: {seen:?}");
            }
        }
    }
}
