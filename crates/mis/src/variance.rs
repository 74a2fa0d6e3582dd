//! Heuristics that know how noisy each technique is. [Grittmann2019]

/// `E[F^2] / V[F] = 1 + mean^2 / variance` of what a technique alone would give: large for one whose samples are stratified or
/// nearly perfect. Its count times this factor stands for the count in a [`Heuristic`](crate::Heuristic), and leaves a technique
/// the share that it deserves. [Grittmann2019]
///
/// At most `1e6`: nothing is learned about a variance of zero.
pub fn variance_factor(mean: f64, variance: f64) -> f64 {
    const MOST: f64 = 1e6;
    let ratio = mean * mean / variance;
    if ratio.is_nan() { 1.0 } else { (1.0 + ratio).min(MOST) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steady_techniques_have_large_factors() {
        assert!((variance_factor(2.0, 4.0) - 2.0).abs() < 1e-15);
        assert!((variance_factor(0.0, 4.0) - 1.0).abs() < 1e-15);
        assert!((variance_factor(0.0, 0.0) - 1.0).abs() < 1e-15);
        assert!((variance_factor(1.0, 0.0) - 1e6).abs() < 1e-9);
    }
}
