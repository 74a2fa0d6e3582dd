//! Means with their standard errors.

/// Running mean and variance. [Welford1962]
#[derive(Clone, Copy, Debug, Default)]
pub struct Mean {
    n: f64,
    mean: f64,
    m2: f64,
    largest: f64,
}

impl Mean {
    /// Takes one number.
    pub fn add(&mut self, x: f64) {
        self.n += 1.0;
        let d = x - self.mean;
        self.mean += d / self.n;
        self.m2 += d * (x - self.mean);
        self.largest = self.largest.max(x.abs());
    }
    /// How many there were.
    pub fn count(&self) -> f64 {
        self.n
    }
    /// Their mean; 0 without any.
    pub fn value(&self) -> f64 {
        self.mean
    }
    /// Unbiased estimate of their variance.
    pub fn variance(&self) -> f64 {
        if self.n > 1.0 { self.m2 / (self.n - 1.0) } else { 0.0 }
    }
    /// Standard error of the mean.
    ///
    /// A single number of the largest kind more or less is counted in: where few large ones carry the mean, the
    /// variance alone promises too much.
    pub fn standard_error(&self) -> f64 {
        if self.n > 0.0 {
            (self.variance() / self.n + (self.largest / self.n) * (self.largest / self.n)).sqrt()
        } else {
            f64::INFINITY
        }
    }
    /// The largest magnitude.
    pub fn largest(&self) -> f64 {
        self.largest
    }
}

/// Albedo by sampling: the mean of `n` weights, where the path ends a weight of zero.
pub fn albedo(n: usize, mut weight: impl FnMut(usize) -> f64) -> Mean {
    let mut mean = Mean::default();
    (0..n).for_each(|i| mean.add(weight(i)));
    mean
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Random;

    #[test]
    fn mean_and_variance_of_five_numbers() {
        let m = albedo(5, |i| [2.0, 4.0, 4.0, 5.0, 10.0][i]);
        assert!((m.value() - 5.0).abs() < 1e-14 && (m.variance() - 9.0).abs() < 1e-13);
        assert!((m.largest() - 10.0).abs() < 1e-14);
    }

    #[test]
    fn the_standard_error_covers_the_truth() {
        let mut r = Random::new(1);
        let within = (0..500)
            .filter(|_| {
                let m = albedo(200, |_| r.uniform());
                (m.value() - 0.5).abs() < 2.0 * m.standard_error()
            })
            .count();
        // 95.4 % of 500, a little more for the extra term.
        assert!((460..=496).contains(&within), "{within}");
    }
}
