//! The weights of least variance for two techniques that take one sample each: [`PairMoments`]. [Kondapaneni2019]
//!
//! With balance weights `w_1 + w_2 = 1` the control variate of [`control_variate`](crate::control_variate) is
//!
//! ```text
//! F = sum_i alpha_i + sum_k (f - sum_i alpha_i p_i) / (p_1 + p_2)  at X_k
//!   = B - c Z,    c = alpha_2 - alpha_1,   Z = w_2(X_1) - w_1(X_2)
//! ```
//!
//! where `B` is the balance estimate: of both alphas only the difference is left. Z has the mean zero, since both of its terms have
//! the mean `int p_1 p_2 / (p_1 + p_2)`, so that `F` is unbiased for any c that comes from other samples, and of least variance for
//! `c = E[B Z] / E[Z^2]`. That also holds for an integral over further variables that both techniques share, such as the place in a
//! pixel, where the system `A alpha = b` would take them for drawn apart.
//!
//! A place where `f` is zero may count as one that no other technique finds, `w = 1`; its term of Z is then zero. All techniques
//! have to agree on such places, and the densities have to be those of sampling, or Z has another mean than zero.

/// Sums over pairs of samples, from which `c` follows for each of `C` channels of the integrand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairMoments<const C: usize> {
    n: f64,
    z: f64,
    zz: f64,
    b: [f64; C],
    bb: [f64; C],
    bz: [f64; C],
}

impl<const C: usize> Default for PairMoments<C> {
    fn default() -> Self {
        PairMoments { n: 0.0, z: 0.0, zz: 0.0, b: [0.0; C], bb: [0.0; C], bz: [0.0; C] }
    }
}

impl<const C: usize> PairMoments<C> {
    /// Adds a pair: the balance estimate of each channel, and Z.
    pub fn add(&mut self, b: [f64; C], z: f64) {
        self.n += 1.0;
        self.z += z;
        self.zz += z * z;
        for (c, b) in b.into_iter().enumerate() {
            self.b[c] += b;
            self.bb[c] += b * b;
            self.bz[c] += b * z;
        }
    }
    /// Adds the pairs of another.
    pub fn merge(&mut self, o: &Self) {
        self.n += o.n;
        self.z += o.z;
        self.zz += o.zz;
        for c in 0..C {
            self.b[c] += o.b[c];
            self.bb[c] += o.bb[c];
            self.bz[c] += o.bz[c];
        }
    }
    /// Pairs so far.
    pub fn pairs(&self) -> f64 {
        self.n
    }
    /// `c` of each channel; zero, which is the balance heuristic, where nothing is known.
    ///
    /// `E[B Z]` is estimated less `mean B mean Z`, which has the mean zero and takes away most of the noise. Two cautions are for few
    /// pairs. The noise of a line fitted to n pairs costs `s^2 / n`, where `s^2` is the variance about the line; c is drawn towards
    /// zero by what that is of what it gains. [JamesStein1961] And one pair with the largest Z there can be, 1, is added that says
    /// nothing of B: where all Z so far were tiny, the next need not be.
    pub fn slope(&self) -> [f64; C] {
        core::array::from_fn(|c| {
            let covariance = self.bz[c] - self.b[c] * self.z / self.n;
            let explained = covariance * covariance / self.zz;
            let about_line = (self.bb[c] - self.b[c] * self.b[c] / self.n - explained) / (self.n - 2.0);
            let gain = (1.0 - about_line.max(0.0) / explained).max(0.0);
            let slope = covariance / (self.zz + 1.0) * gain;
            if self.n > 2.0 && slope.is_finite() { slope } else { 0.0 }
        })
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "zero is meant exactly")]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_a_line() {
        let mut whole = PairMoments::<2>::default();
        let mut parts = [whole; 2];
        for (i, z) in (0..4_000_000).map(|i| (i, [-1.0, -0.25, 0.25, 1.0][i % 4])) {
            let b = [7.0 + 3.0 * z, -0.5 * z];
            whole.add(b, z);
            parts[i % 2].add(b, z);
        }
        let [mut both, other] = parts;
        both.merge(&other);
        for m in [whole, both] {
            let [a, b] = m.slope();
            assert!((a - 3.0).abs() < 2e-6 && (b + 0.5).abs() < 1e-6, "{m:?}");
        }
        assert!((whole.pairs() - 4e6).abs() < 1e-12);
    }

    #[test]
    fn a_slope_that_noise_explains_is_drawn_to_zero() {
        let mut m = PairMoments::<1>::default();
        for (b, z) in [(1.0, 0.1), (-1.0, 0.1), (1.2, -0.1), (-1.0, -0.1), (1.0, 0.0)] {
            m.add([b], z);
        }
        assert_eq!(m.slope(), [0.0]);
    }

    #[test]
    fn tiny_z_make_no_large_slope() {
        let mut m = PairMoments::<1>::default();
        (0..30).for_each(|i| m.add([f64::from(i % 2)], 1e-6 * (f64::from(i % 2) - 0.5)));
        let [c] = m.slope();
        assert!(c > 0.0 && c < 1e-4, "{c}, and 1e6 by the line alone");
    }

    #[test]
    fn where_nothing_is_known_it_is_the_balance_heuristic() {
        let mut m = PairMoments::<1>::default();
        assert_eq!(m.slope(), [0.0]);
        (0..2).for_each(|i| m.add([f64::from(i)], 0.5));
        assert_eq!(m.slope(), [0.0], "two pairs tell nothing");
        let mut m = PairMoments::<1>::default();
        (0..9).for_each(|_| m.add([1.0], 0.0));
        assert_eq!(m.slope(), [0.0], "there is nothing to vary");
    }
}
