//! The two estimators of [VeachGuibas1995]: several samples of every technique, or one sample of one.

use crate::{Heuristic, Technique};

/// A sample: who drew it, what the integrand is there, and the density of every technique there.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'a> {
    /// The technique that drew it.
    pub by: usize,
    /// The integrand.
    pub f: f64,
    /// Densities, one for each technique.
    pub pdf: &'a [f64],
}

/// What one sample of the multi-sample estimator adds: `w_k f / (n_k p_k)`. [VeachGuibas1995]
///
/// `counts` holds the samples of each technique; the estimate is the sum over all samples of all techniques.
pub fn multi_sample(heuristic: Heuristic, counts: &[f64], x: Drawn<'_>) -> f64 {
    let all = techniques(counts, x.pdf);
    let w = heuristic.weight(&all, x.by);
    if w > 0.0 { w * x.f / (counts[x.by] * x.pdf[x.by]) } else { 0.0 }
}

/// The one-sample estimate `w_k f / (c_k p_k)`, for a technique that was chosen with probability `chances[k]`; with the balance
/// heuristic `f / sum c p`, the best there is. [VeachGuibas1995]
pub fn one_sample(heuristic: Heuristic, chances: &[f64], x: Drawn<'_>) -> f64 {
    multi_sample(heuristic, chances, x)
}

fn techniques(counts: &[f64], pdf: &[f64]) -> Vec<Technique<f64>> {
    counts.iter().zip(pdf).map(|(&count, &pdf)| Technique { count, pdf }).collect()
}
