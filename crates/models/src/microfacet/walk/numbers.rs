//! Random numbers that two directions stand for: [`Numbers`].

use sparrow_math::LocalDir;

/// Uniform numbers in [0, 1) that depend on two directions, whichever comes first. [Steele2014]
pub(super) struct Numbers(u64);

impl Numbers {
    /// For the directions as single precision knows them, so that all number types draw the same.
    pub(super) fn of(a: LocalDir<f64>, b: LocalDir<f64>) -> Self {
        Numbers(word(a).wrapping_add(word(b)))
    }
    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        (mixed(self.0) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Stirs all bits.
fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A word that stands for a direction.
fn word(w: LocalDir<f64>) -> u64 {
    // Adding zero makes no difference between its signs.
    let bits = |x: f64| u64::from((x as f32 + 0.0).to_bits());
    mixed(mixed(bits(w.x()) << 32 | bits(w.y())).wrapping_add(bits(w.z())))
}
