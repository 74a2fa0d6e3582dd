//! A small generator with a fixed sequence.

use core::f64::consts::TAU;

use sparrow_math::{LocalDir, Real, vec3};

/// Uniform numbers from a seed, the same on every machine. [Steele2014]
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Random {
        Random(seed)
    }
    /// The sequence of a seed and a name: equal names give equal sequences, whatever else is asked.
    pub fn named(seed: u64, name: &str) -> Random {
        // FNV-1a, a hash that is the same in every release of the compiler.
        let hash = |h: u64, b: u8| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3);
        let mut r = Random(name.bytes().fold(0xcbf2_9ce4_8422_2325 ^ seed.wrapping_mul(0x9e37_79b9), hash));
        r.bits();
        r
    }
    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// Uniform in [0, 1), with 53 bits.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }
    /// Uniform in [0, 1), with the 24 bits that an `f32` holds exactly.
    pub fn uniform_f32(&mut self) -> f64 {
        (self.bits() >> 40) as f64 / (1u64 << 24) as f64
    }
    /// Uniform in [`lo`, `hi`).
    pub fn within(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.uniform()
    }
    /// One of `0..n`; 0 where n is 0.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.uniform() * n as f64) as usize).min(n.saturating_sub(1))
    }
    /// Uniform over the sphere.
    pub fn direction(&mut self) -> LocalDir<f64> {
        let z = self.within(-1.0, 1.0);
        let (s, c) = Real::sin_cos(self.within(0.0, TAU));
        let r = (1.0 - z * z).sqrt();
        LocalDir::new(vec3(r * c, r * s, z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequence_is_the_published_one() {
        // First outputs of SplitMix64 for the seed 1234567, from the reference code of its authors.
        let mut r = Random::new(1_234_567);
        assert_eq!(r.bits(), 6_457_827_717_110_365_317);
        assert_eq!(r.bits(), 3_203_168_211_198_807_973);
    }

    #[test]
    fn names_and_seeds_part_sequences() {
        let first = |seed, name| Random::named(seed, name).bits();
        assert_eq!(first(1, "lambert"), first(1, "lambert"));
        assert_ne!(first(1, "lambert"), first(2, "lambert"));
        assert_ne!(first(1, "lambert"), first(1, "lambers"));
    }
}
