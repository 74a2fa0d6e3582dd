//! Does noise alone explain the difference? [`Noise`].

use serde::Serialize;
use sparrow_image::metrics::Pair;
use sparrow_stats::special::normal_tails;
use sparrow_stats::{ZTest, images_z_test, sidak, sidak_p};

/// At this chance of a false alarm the table says that pictures differ.
pub(super) const LEVEL: f64 = 0.01;

/// Outcome of the z-test over all pixels and channels.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Noise {
    /// Chance of a difference at least as odd, anywhere, where there is only noise.
    pub(super) p: f64,
    /// Values of pixels outside their noise at the level 0.01 for all together.
    pub(super) rejected: usize,
    /// For each channel, the sum of all deviations in units of its own: far from 0 where one picture is brighter.
    pub(super) bias: [f64; 3],
    /// Column, row and channel of the oddest value.
    pub(super) worst: Option<(usize, usize, char)>,
}

impl Noise {
    /// Channels are tested by themselves: within a pixel they share their paths, so that their sum has no known variance.
    /// Sidak's correction for all of them holds for dependent normal variables too.
    pub(super) fn between(pair: &Pair, variances: [&[[f32; 3]]; 2]) -> Noise {
        let channel =
            |pixels: &[[f32; 3]], c: usize| pixels.iter().map(|p| f64::from(p[c])).collect::<Vec<f64>>();
        let tests = [0, 1, 2].map(|c| {
            let [a, b] = [pair.picture(), pair.reference()].map(|v| channel(v, c));
            let [va, vb] = variances.map(|v| channel(v, c));
            images_z_test(&a, &va, &b, &vb, sidak(LEVEL, 3))
        });
        let smallest = |t: &ZTest| t.p.min(normal_tails(t.bias));
        let n_tests = 3 * (pair.picture().len() + 1);
        let oddest = (0..3).min_by(|a, b| tests[*a].p.total_cmp(&tests[*b].p)).unwrap_or(0);
        let place = |i: usize| (i % pair.width(), i / pair.width(), ['R', 'G', 'B'][oddest]);
        Noise {
            p: sidak_p(tests.iter().map(smallest).fold(1.0, f64::min), n_tests),
            rejected: tests.iter().map(|t| t.rejected).sum(),
            bias: [0, 1, 2].map(|c| tests[c].bias),
            worst: tests[oddest].worst.map(place),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_stats::Random;

    const N: usize = 4000;

    /// Means of 48 uniform numbers, standard deviation 1/24, the channels of a pixel alike.
    fn noisy(seed: u64, gain: f64) -> Vec<[f32; 3]> {
        let mut r = Random::new(seed);
        (0..N).map(|_| [(gain * (0..48).map(|_| r.uniform()).sum::<f64>() / 48.0) as f32; 3]).collect()
    }

    fn test(a: &[[f32; 3]], b: &[[f32; 3]]) -> Noise {
        let v = vec![[1.0 / 576.0; 3]; N];
        Noise::between(&Pair::new(50, a, b).unwrap(), [&v, &v])
    }

    #[test]
    fn noise_is_noise_also_where_channels_are_alike() {
        for seed in 0..20 {
            let n = test(&noisy(2 * seed, 1.0), &noisy(2 * seed + 1, 1.0));
            assert!(n.p > LEVEL && n.rejected == 0, "{n:?}");
        }
    }

    #[test]
    fn a_wrong_pixel_and_a_gain_are_told() {
        let (a, mut b) = (noisy(1, 1.0), noisy(2, 1.0));
        b[1234][1] += 0.5;
        let n = test(&a, &b);
        assert!(n.p < 1e-6 && n.rejected == 1 && n.worst == Some((34, 24, 'G')), "{n:?}");
        let n = test(&a, &noisy(3, 1.02));
        assert!(n.p < LEVEL && n.rejected == 0 && n.bias[0] < -5.0, "{n:?}");
    }
}
