//! Are two pictures the same but for noise? [`images_z_test`].

use crate::chi_square::sidak;
use crate::special::normal_tails;

/// What the test of a picture found.
#[derive(Clone, Copy, Debug)]
pub struct ZTest {
    /// Smallest probability over the pixels.
    pub p: f64,
    /// Its place.
    pub worst: Option<usize>,
    /// What each pixel's probability is to exceed, after correction for their number.
    pub limit: f64,
    /// Pixels below it.
    pub rejected: usize,
    /// Mean of z over the pixels, times the root of their number: a standard normal variable where pictures agree, far
    /// from zero where one is brighter by less than a pixel can show.
    pub bias: f64,
}

impl ZTest {
    /// No pixel lies outside its noise, nor do all together.
    pub fn holds(&self) -> bool {
        self.rejected == 0 && normal_tails(self.bias) >= self.limit
    }
}

/// Compares the means of pixels, each with the variance of that mean, at a chance of `level` for a false alarm.
///
/// Pixels whose variances are both zero are to be equal. Slices are cut to the shortest.
pub fn images_z_test(a: &[f64], variance_a: &[f64], b: &[f64], variance_b: &[f64], level: f64) -> ZTest {
    let n = a.len().min(b.len()).min(variance_a.len()).min(variance_b.len());
    // One test more for the bias.
    let limit = sidak(level, n + 1);
    let mut t = ZTest { p: 1.0, worst: None, limit, rejected: 0, bias: 0.0 };
    for i in 0..n {
        let (d, v) = (a[i] - b[i], variance_a[i] + variance_b[i]);
        let z = if v > 0.0 {
            d / v.sqrt()
        } else if d.abs() > 0.0 || d.is_nan() {
            f64::INFINITY
        } else {
            0.0
        };
        let p = if z.is_nan() { 0.0 } else { normal_tails(z) };
        if p < t.p {
            (t.p, t.worst) = (p, Some(i));
        }
        t.rejected += usize::from(p < limit);
        if z.is_finite() {
            t.bias += z / (n as f64).sqrt();
        }
    }
    t
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Random;

    fn picture(r: &mut Random, gain: f64) -> (Vec<f64>, Vec<f64>) {
        // The mean of 48 uniform numbers: standard deviation 1 / 24.
        let mean = |_| gain * (0..48).map(|_| r.uniform()).sum::<f64>() / 48.0;
        ((0..4000).map(mean).collect(), vec![gain * gain / 576.0; 4000])
    }

    #[test]
    fn noise_passes_and_what_is_no_noise_does_not() {
        let mut r = Random::new(5);
        let (a, va) = picture(&mut r, 1.0);
        let (mut b, vb) = picture(&mut r, 1.0);
        assert!(images_z_test(&a, &va, &b, &vb, 1e-3).holds());
        b[1234] += 0.5;
        let t = images_z_test(&a, &va, &b, &vb, 1e-3);
        assert!(!t.holds() && t.worst == Some(1234) && t.rejected == 1);
    }

    #[test]
    fn a_gain_that_no_pixel_shows_is_seen_in_all() {
        let mut r = Random::new(6);
        let (a, va) = picture(&mut r, 1.0);
        let (b, vb) = picture(&mut r, 1.015);
        let t = images_z_test(&a, &va, &b, &vb, 1e-3);
        assert!(t.rejected == 0 && !t.holds(), "{t:?}");
    }

    #[test]
    fn pixels_without_noise_are_equal() {
        assert!(images_z_test(&[1.0], &[0.0], &[1.0], &[0.0], 1e-3).holds());
        assert!(!images_z_test(&[1.0], &[0.0], &[1.1], &[0.0], 1e-3).holds());
    }
}
