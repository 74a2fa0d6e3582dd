//! Who won, and whether both render the same picture: [`Verdict`].

use serde::Serialize;
use sparrow_image::ImageError;
use sparrow_image::metrics::{BLOCK, EPSILON, Pair, relmse};
use sparrow_math::Real;
use sparrow_stats::{Mean, mean_interval, sidak_p, welch_p};

use super::runner::Run;

/// Chance that the interval misses the truth.
const LEVEL: f64 = 0.05;
/// Chance of a false alarm about bias.
const BIAS_LEVEL: f64 = 0.01;

/// All that was rendered.
pub(super) struct Pictures<'a> {
    pub(super) width: usize,
    /// Of A and of B, seed by seed.
    pub(super) runs: &'a [Vec<Run>; 2],
    pub(super) reference: Option<&'a [[f32; 3]]>,
}

/// The outcome of a race.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Verdict {
    /// relMSE of each run of A and of B.
    pub(super) relmse: [Vec<f64>; 2],
    /// Efficiency of A over that of B.
    pub(super) efficiency_ratio: f64,
    /// Where it lies with a confidence of 95 %.
    pub(super) interval: [f64; 2],
    /// Mean of A over mean of B, for red, green and blue.
    pub(super) mean_ratio: [f64; 3],
    /// Chance of means that differ so much somewhere, were both unbiased.
    pub(super) p_same_mean: f64,
    pub(super) means_differ: bool,
}

impl Verdict {
    /// # Errors
    /// Where the reference does not fit.
    pub(super) fn of(pictures: &Pictures) -> Result<Verdict, ImageError> {
        let relmse = match pictures.reference {
            Some(reference) => pictures.against(reference)?,
            None => pictures.scatter(),
        };
        // A black picture has no error at all.
        let cost =
            |i: usize, seed: usize| Real::ln(relmse[i][seed].max(1e-30) * pictures.runs[i][seed].cpu_seconds);
        let seeds = 0..relmse[0].len().min(relmse[1].len());
        let gains: Vec<f64> = seeds.map(|seed| cost(1, seed) - cost(0, seed)).collect();
        let (mean, reach) = mean_interval(&gains, LEVEL);
        let p_same_mean = pictures.same_mean();
        Ok(Verdict {
            relmse,
            efficiency_ratio: Real::exp(mean),
            interval: [mean - reach, mean + reach].map(Real::exp),
            mean_ratio: pictures.mean_ratio(),
            p_same_mean,
            means_differ: p_same_mean < BIAS_LEVEL,
        })
    }
}

impl Pictures<'_> {
    fn against(&self, reference: &[[f32; 3]]) -> Result<[Vec<f64>; 2], ImageError> {
        let of = |run: &Run| relmse(&Pair::new(self.width, &run.rgb, reference)?, 0.0);
        let all = |runs: &[Run]| runs.iter().map(of).collect::<Result<Vec<f64>, ImageError>>();
        Ok([all(&self.runs[0])?, all(&self.runs[1])?])
    }

    /// Squared distance of each run from the mean of its setting's other runs, relative to the mean of all others' means.
    ///
    /// The distance of one of `n` runs from the mean of the others has `n / (n - 1)` times the variance of a run.
    fn scatter(&self) -> [Vec<f64>; 2] {
        let sums = [0, 1].map(|i: usize| sum(&self.runs[i]));
        let n = self.runs[0].len();
        let others = |i: usize, seed: usize, at: usize, c: usize| {
            (sums[i][at][c] - f64::from(self.runs[i][seed].rgb[at][c])) / (n - 1) as f64
        };
        let of = |i: usize, seed: usize| {
            let mut total = 0.0;
            for (at, p) in self.runs[i][seed].rgb.iter().enumerate() {
                for (c, v) in p.iter().enumerate() {
                    let (own, other) = (others(i, seed, at, c), others(1 - i, seed, at, c));
                    let (d, r) = (f64::from(*v) - own, 0.5 * (own + other));
                    total += d * d / (r * r + EPSILON);
                }
            }
            total / (3 * sums[i].len()) as f64 * (n - 1) as f64 / n as f64
        };
        [0, 1].map(|i| (0..n).map(|seed| of(i, seed)).collect())
    }

    fn mean_ratio(&self) -> [f64; 3] {
        let total = |i: usize, c: usize| -> f64 {
            self.runs[i].iter().flat_map(|r| &r.rgb).map(|p| f64::from(p[c])).sum()
        };
        [0, 1, 2].map(|c| total(0, c) / total(1, c))
    }

    /// Smallest probability of Welch's test over blocks, the whole picture and channels, corrected for their number.
    fn same_mean(&self) -> f64 {
        let mut smallest = 1.0f64;
        let blocks =
            [0, 1].map(|i: usize| self.runs[i].iter().map(|r| self.blocks(&r.rgb)).collect::<Vec<_>>());
        let n_tests = blocks[0].first().map_or(0, Vec::len);
        for k in 0..n_tests {
            let [a, b] = blocks.each_ref().map(|runs| {
                let mut mean = Mean::default();
                runs.iter().filter_map(|r| r.get(k)).for_each(|v| mean.add(*v));
                mean
            });
            smallest = smallest.min(welch_p(&a, &b));
        }
        sidak_p(smallest, n_tests)
    }

    /// Means over blocks, cut at the edges, and over the picture, channel by channel.
    fn blocks(&self, rgb: &[[f32; 3]]) -> Vec<f64> {
        let columns = self.width.div_ceil(BLOCK);
        let rows = (rgb.len() / self.width).div_ceil(BLOCK);
        let mut sums = vec![[0.0; 3]; columns * rows + 1];
        let mut counts = vec![0.0; columns * rows + 1];
        for (i, p) in rgb.iter().enumerate() {
            let block = i / self.width / BLOCK * columns + i % self.width / BLOCK;
            for k in [block, columns * rows] {
                (0..3).for_each(|c| sums[k][c] += f64::from(p[c]));
                counts[k] += 1.0;
            }
        }
        sums.iter().zip(counts).flat_map(|(s, n)| s.map(|v| v / n)).collect()
    }
}

/// Sums over runs, pixel by pixel.
fn sum(runs: &[Run]) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; runs.first().map_or(0, |r| r.rgb.len())];
    for run in runs {
        for (s, p) in sums.iter_mut().zip(&run.rgb) {
            (0..3).for_each(|c| s[c] += f64::from(p[c]));
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_stats::Random;

    /// Runs of 32 x 24 pixels of brightness `gain`, with noise of this variance, each of one second.
    fn runs(seed: u64, n: usize, variance: f64, gain: f64) -> Vec<Run> {
        let mut r = Random::new(seed);
        let scale = (12.0 * variance).sqrt();
        (0..n)
            .map(|_| Run {
                rgb: (0..768).map(|_| [0; 3].map(|_| (gain + scale * (r.uniform() - 0.5)) as f32)).collect(),
                cpu_seconds: 1.0,
                samples_per_pixel: 1.0,
            })
            .collect()
    }

    fn verdict(runs: &[Vec<Run>; 2], reference: Option<&[[f32; 3]]>) -> Verdict {
        Verdict::of(&Pictures { width: 32, runs, reference }).unwrap()
    }

    #[test]
    fn the_ratio_of_known_variances_is_found() {
        let pictures = [runs(1, 8, 0.01, 1.0), runs(2, 8, 0.03, 1.0)];
        for reference in [None, Some(vec![[1.0; 3]; 768])] {
            let v = verdict(&pictures, reference.as_deref());
            assert!((v.efficiency_ratio - 3.0).abs() < 0.1, "{v:?}");
            assert!(v.interval[0] < 3.0 && 3.0 < v.interval[1] && v.interval[0] > 2.8, "{v:?}");
            assert!((v.relmse[0][0] - 0.01 / 1.01).abs() < 1e-3, "{v:?}");
            assert!(!v.means_differ, "{v:?}");
        }
    }

    #[test]
    fn time_counts_as_error_does() {
        let mut pictures = [runs(1, 8, 0.01, 1.0), runs(2, 8, 0.02, 1.0)];
        pictures[0].iter_mut().for_each(|r| r.cpu_seconds = 4.0);
        let v = verdict(&pictures, None);
        assert!((v.efficiency_ratio - 0.5).abs() < 0.02, "{v:?}");
    }

    #[test]
    fn a_bias_is_told_and_without_one_there_is_no_alarm() {
        // The ratio of the means is known to 4e-4.
        let biased = [runs(1, 8, 4e-4, 1.0), runs(2, 8, 4e-4, 1.005)];
        let v = verdict(&biased, None);
        assert!(v.means_differ && (v.mean_ratio[1] - 1.0 / 1.005).abs() < 1.5e-3, "{v:?}");
        let alarms = (0..100).filter(|s| {
            verdict(&[runs(2 * s, 4, 0.01, 1.0), runs(2 * s + 1, 4, 0.02, 1.0)], None).means_differ
        });
        assert!(alarms.count() <= 4);
    }
}
