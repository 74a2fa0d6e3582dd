//! The weights of least variance, by the control variates they amount to. [Kondapaneni2019]
//!
//! With `a_ij = int p_i p_j / sum n p` and `b_i = int f p_i / sum n p`, the numbers `alpha` that solve `A alpha = b` make
//!
//! ```text
//! F = sum_i alpha_i + sum over samples (f - sum_m alpha_m p_m) / sum_k n_k p_k
//! ```
//!
//! the estimate of least variance `int (f - sum alpha p)^2 / sum n p`; its weights may be negative. `alpha` sums to the integral.

use crate::Drawn;
use crate::linear::solve;

/// Eigenvalues of A below this part of the largest count as zero: the techniques coincide there.
const TINY: f64 = 1e-9;

/// `A` and `b`, as sums over samples of all techniques.
#[derive(Clone, Debug)]
pub struct Moments {
    counts: Vec<f64>,
    a: Vec<f64>,
    b: Vec<f64>,
    rounds: f64,
}

impl Moments {
    /// Of techniques that take `counts` samples a round.
    pub fn new(counts: &[f64]) -> Moments {
        let n = counts.len();
        Moments { counts: counts.to_vec(), a: vec![0.0; n * n], b: vec![0.0; n], rounds: 0.0 }
    }
    /// Adds a sample.
    pub fn add(&mut self, x: Drawn<'_>) {
        let inverse = 1.0 / mixture(&self.counts, x.pdf);
        if !inverse.is_finite() {
            return;
        }
        let n = self.counts.len();
        for i in 0..n {
            let share = x.pdf[i] * inverse;
            for j in 0..n {
                self.a[i * n + j] += share * x.pdf[j] * inverse;
            }
            self.b[i] += share * x.f * inverse;
        }
    }
    /// Ends a round: every technique has taken its samples.
    pub fn end_round(&mut self) {
        self.rounds += 1.0;
    }
    /// Rounds so far.
    pub fn rounds(&self) -> f64 {
        self.rounds
    }
    /// `alpha`; zeros before the first round has ended.
    ///
    /// Their sum is the direct estimate of the integral: consistent, and biased by as much as the same samples judge
    /// themselves. [Kondapaneni2019]
    pub fn alpha(&self) -> Vec<f64> {
        let scale = if self.rounds > 0.0 { 1.0 / self.rounds } else { 0.0 };
        let scaled = |v: &[f64]| v.iter().map(|x| x * scale).collect::<Vec<f64>>();
        solve(&scaled(&self.a), &scaled(&self.b), TINY)
    }
}

/// `sum_k n_k p_k`
fn mixture(counts: &[f64], pdf: &[f64]) -> f64 {
    counts.iter().zip(pdf).map(|(n, p)| n * p).sum()
}

/// What one sample adds to `sum alpha`: unbiased for any `alpha` that comes from other samples, such as those of earlier rounds.
/// [Kondapaneni2019]
pub fn control_variate(counts: &[f64], alpha: &[f64], x: Drawn<'_>) -> f64 {
    let q = mixture(counts, x.pdf);
    let known: f64 = alpha.iter().zip(x.pdf).map(|(a, p)| a * p).sum();
    if q > 0.0 && q.is_finite() { (x.f - known) / q } else { 0.0 }
}
