//! How uneven the weights of samples are: [`Weights`].

use sparrow_math::Real;

/// Bins, one per factor of two, around a weight of one.
const BINS: usize = 48;
const BELOW_ONE: f64 = 24.0;

/// A histogram of non-negative weights, one bin per factor of two.
#[derive(Clone, Debug)]
pub struct Weights {
    bins: [u64; BINS],
    zeros: u64,
    n: u64,
    sum: f64,
    sum2: f64,
    largest: f64,
}

impl Default for Weights {
    fn default() -> Self {
        Weights { bins: [0; BINS], zeros: 0, n: 0, sum: 0.0, sum2: 0.0, largest: 0.0 }
    }
}

impl Weights {
    /// Takes one weight.
    pub fn add(&mut self, w: f64) {
        self.n += 1;
        self.sum += w;
        self.sum2 += w * w;
        self.largest = self.largest.max(w);
        if w >= f64::MIN_POSITIVE && w.is_finite() {
            let (_, exponent) = Real::frexp(w);
            self.bins[(exponent + BELOW_ONE).clamp(0.0, (BINS - 1) as f64) as usize] += 1;
        } else {
            self.zeros += 1;
        }
    }
    /// The largest.
    pub fn largest(&self) -> f64 {
        self.largest
    }
    /// The mean.
    pub fn mean(&self) -> f64 {
        if self.n > 0 { self.sum / self.n as f64 } else { 0.0 }
    }
    /// How many samples of equal weight would give the mean the same error: `(sum w)^2 / sum w^2`. [Kong1994]
    pub fn effective_samples(&self) -> f64 {
        if self.sum2 > 0.0 { self.sum * self.sum / self.sum2 } else { 0.0 }
    }
    /// How many weights were zero.
    pub fn zeros(&self) -> u64 {
        self.zeros
    }
    /// How many weights were taken.
    pub fn count(&self) -> u64 {
        self.n
    }
    /// The bins that hold something: lower end, upper end, count. The outermost take what lies beyond them too.
    pub fn bins(&self) -> impl Iterator<Item = (f64, f64, u64)> + '_ {
        let end = |i: usize| Real::pow2(i as f64 - BELOW_ONE);
        self.bins.iter().enumerate().filter(|(_, n)| **n > 0).map(move |(i, n)| (end(i) * 0.5, end(i), *n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_weights_lose_nothing_and_one_among_zeros_nearly_all() {
        let mut w = Weights::default();
        (0..100).for_each(|_| w.add(0.7));
        assert!((w.effective_samples() - 100.0).abs() < 1e-9);
        let mut w = Weights::default();
        (0..100).for_each(|i| w.add(if i == 5 { 3.0 } else { 0.0 }));
        assert!(
            (w.effective_samples() - 1.0).abs() < 1e-12 && w.zeros() == 99 && (w.mean() - 0.03).abs() < 1e-12
        );
        assert_eq!(w.bins().collect::<Vec<_>>(), [(2.0, 4.0, 1)]);
    }

    #[test]
    fn a_bin_holds_its_lower_end() {
        let mut w = Weights::default();
        [1.0, 1.5, 0.5, 1e300, 1e-300].into_iter().for_each(|x| w.add(x));
        let bins: Vec<_> = w.bins().collect();
        assert!(bins.contains(&(1.0, 2.0, 2)) && bins.contains(&(0.5, 1.0, 1)));
        assert_eq!(bins.iter().map(|b| b.2).sum::<u64>(), 5);
    }
}
