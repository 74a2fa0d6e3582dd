//! Pearson's chi-square with pooled cells, and corrections for asking many times.

use sparrow_math::Real;

use crate::special::chi_square_tail;

/// Cells that are expected to hold fewer are pooled: the law of chi-square is an approximation for full cells.
const LEAST_EXPECTED: f64 = 5.0;

/// How many samples a cell holds, and how many it should.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cell {
    /// Samples counted.
    pub observed: f64,
    /// Samples expected.
    pub expected: f64,
    /// How far the expectation itself may be off, in samples; that much difference does not count.
    pub slack: f64,
}

/// What the test found.
#[derive(Clone, Copy, Debug)]
pub struct ChiSquare {
    /// The statistic.
    pub statistic: f64,
    /// Degrees of freedom.
    pub dof: f64,
    /// Probability of a statistic at least as large, if samples follow the expectation.
    pub p: f64,
    /// Place among the given cells of the one that adds most; none where that is the pool, or there is nothing to test.
    pub worst: Option<usize>,
}

/// Chi-square of cells that cover everything that can happen: counts and expectations have the same sum.
///
/// Cells with an expectation below 5 count as one. Counts where nothing can fall give p = 0.
pub fn chi_square(cells: &[Cell]) -> ChiSquare {
    let mut pool = Cell::default();
    let (mut statistic, mut n, mut most, mut worst) = (0.0, 0.0, 0.0, None);
    for (i, c) in cells.iter().enumerate() {
        if c.expected < LEAST_EXPECTED {
            pool.observed += c.observed;
            pool.expected += c.expected.max(0.0);
            pool.slack += c.slack;
            continue;
        }
        let s = share(c);
        statistic += s;
        n += 1.0;
        if s > most {
            (most, worst) = (s, Some(i));
        }
    }
    if pool.observed > 0.0 || pool.expected > 0.0 {
        // A pool that is still small is judged as if it held one sample: its share stays finite, and impossible
        // counts still weigh with their square.
        let s = share(&Cell { expected: pool.expected.max(1.0), ..pool });
        statistic += s;
        n += 1.0;
        if s > most {
            worst = None;
        }
    }
    let dof = (n - 1.0f64).max(0.0);
    let p = if statistic.is_nan() { 0.0 } else { chi_square_tail(statistic, dof) };
    // With one cell left there is nothing to compare but the sum, which callers compare themselves.
    ChiSquare { statistic, dof, p, worst }
}

fn share(c: &Cell) -> f64 {
    let off = ((c.observed - c.expected).abs() - c.slack).max(0.0);
    off * off / c.expected
}

/// Level for each of `n` independent tests that keeps the chance of any false alarm at `level`.
pub fn sidak(level: f64, n: usize) -> f64 {
    // 1 - (1 - level)^(1/n), without the loss of digits.
    let l = if level < 1e-8 { -level } else { Real::ln(1.0 - level) };
    let x = l / n.max(1) as f64;
    if x > -1e-5 { -x * (1.0 + 0.5 * x) } else { 1.0 - Real::exp(x) }
}

/// Probability that the smallest of `n` independent probabilities is `p` or less: what [`sidak`] undoes.
pub fn sidak_p(p: f64, n: usize) -> f64 {
    if p >= 1.0 {
        return 1.0;
    }
    // 1 - (1 - p)^n, without the loss of digits.
    let l = if p < 1e-8 { -p } else { Real::ln(1.0 - p) };
    let x = l * n as f64;
    if x > -1e-5 { -x * (1.0 + 0.5 * x) } else { 1.0 - Real::exp(x) }
}

/// Level for each of `n` tests, independent or not, that keeps the chance of any false alarm below `level`.
pub fn bonferroni(level: f64, n: usize) -> f64 {
    level / n.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Random;

    #[test]
    fn a_table_worked_by_hand() {
        // A die thrown 60 times: 5 8 9 8 10 20 against 10 each gives 13.4 with 5 degrees of freedom, p = 0.0199.
        let cells = [5.0, 8.0, 9.0, 8.0, 10.0, 20.0].map(|observed| Cell {
            observed,
            expected: 10.0,
            ..Cell::default()
        });
        let t = chi_square(&cells);
        assert!((t.statistic - 13.4).abs() < 1e-12 && (t.dof - 5.0).abs() < 1e-12);
        assert!((t.p - 0.019_905_220).abs() < 1e-8, "{}", t.p);
        assert_eq!(t.worst, Some(5));
    }

    #[test]
    fn small_cells_are_pooled_and_impossible_counts_are_seen() {
        let full = Cell { observed: 100.0, expected: 100.0, slack: 0.0 };
        let rare = Cell { observed: 1.0, expected: 1.0, slack: 0.0 };
        let t = chi_square(&[full, full, rare, rare, rare]);
        assert!((t.dof - 2.0).abs() < 1e-12 && t.p > 0.99);
        let t = chi_square(&[full, full, Cell { observed: 50.0, expected: 0.0, slack: 0.0 }]);
        assert!(t.p < 1e-12);
    }

    #[test]
    fn p_values_of_fair_samples_are_uniform() {
        let mut r = Random::new(3);
        let mut low = 0;
        for _ in 0..2000 {
            let mut cells = [Cell { observed: 0.0, expected: 50.0, slack: 0.0 }; 20];
            (0..1000).for_each(|_| cells[r.below(20)].observed += 1.0);
            low += usize::from(chi_square(&cells).p < 0.1);
        }
        // 200 expected, standard deviation 13.
        assert!((140..260).contains(&low), "{low}");
    }

    #[test]
    fn corrections() {
        // 1 - 0.95^(1/3) = 0.016952
        assert!((sidak(0.05, 3) - 0.016_952_427_508).abs() < 1e-11);
        assert!((bonferroni(0.05, 5) - 0.01).abs() < 1e-15);
        assert!((sidak(1e-4, 1) - 1e-4).abs() < 1e-12);
        for (level, n) in [(0.05, 3), (1e-4, 1), (0.01, 1_000_000)] {
            assert!((sidak_p(sidak(level, n), n) / level - 1.0).abs() < 1e-7, "{level} {n}");
        }
        assert!((sidak_p(1.0, 5) - 1.0).abs() < 1e-15 && sidak_p(0.0, 5) <= 0.0);
        assert!(sidak(1e-3, 1000) > bonferroni(1e-3, 1000));
    }
}
