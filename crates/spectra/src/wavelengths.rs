//! The wavelengths of one path: [`Wavelengths`].

use sparrow_math::Real;

use crate::{LAMBDA_MAX, LAMBDA_MIN, N_LAMBDA, Spectrum};

/// The wavelengths of one path, how likely they were, and where dense tables hold them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wavelengths {
    /// Wavelengths in nm, within 360 to 830.
    pub lambda: [f32; N_LAMBDA],
    /// Density of each wavelength in 1/nm. Zero for those that were given up.
    pub pdf: [f32; N_LAMBDA],
    /// Nearest whole nanometre less 360: 0 to 470.
    pub index: [u16; N_LAMBDA],
}

impl Wavelengths {
    /// Four wavelengths with the density of visible importance, from one uniform number in [0, 1).
    ///
    /// The companions stand at `u + i/4`, wrapped, so the four stratify the range.
    ///
    /// Source: [PBRT4, sec. 4.5.4]; constants fitted there to the sum of the CIE functions.
    #[inline]
    pub fn sample_visible(u: f32) -> Self {
        let mut lambda = [0.0; N_LAMBDA];
        for (i, l) in lambda.iter_mut().enumerate() {
            let shifted = u + i as f32 / N_LAMBDA as f32;
            *l = visible_lambda(if shifted > 1.0 { shifted - 1.0 } else { shifted });
        }
        Self::with_pdf(lambda, lambda.map(visible_pdf))
    }

    /// Four equidistant wavelengths, the first uniform over the whole range.
    #[inline]
    pub fn sample_uniform(u: f32) -> Self {
        let range = LAMBDA_MAX - LAMBDA_MIN;
        let mut lambda = [LAMBDA_MIN + u * range; N_LAMBDA];
        for i in 1..N_LAMBDA {
            let next = lambda[i - 1] + range / N_LAMBDA as f32;
            lambda[i] = if next > LAMBDA_MAX { next - range } else { next };
        }
        Self::with_pdf(lambda, [1.0 / range; N_LAMBDA])
    }

    /// The given wavelengths with the given densities. Wavelengths are clamped to 360..830 nm.
    #[inline]
    pub fn with_pdf(lambda: [f32; N_LAMBDA], pdf: [f32; N_LAMBDA]) -> Self {
        let lambda = lambda.map(|l| l.clamp(LAMBDA_MIN, LAMBDA_MAX));
        Self { lambda, pdf, index: lambda.map(|l| (l - LAMBDA_MIN + 0.5) as u16) }
    }

    /// The densities as a spectrum.
    #[inline(always)]
    pub fn pdf_spectrum(&self) -> Spectrum<f32> {
        Spectrum(self.pdf)
    }

    /// Gives up the companions, where a path bends by wavelength; the hero stands for all from then on.
    ///
    /// The densities are those of a draw that keeps any one of the four: the companions' are zero, the
    /// hero's is a quarter. A second call changes nothing.
    #[inline]
    pub fn terminate_secondary(&mut self) {
        if self.secondary_terminated() {
            return;
        }
        self.pdf = [self.pdf[0] / N_LAMBDA as f32, 0.0, 0.0, 0.0];
    }

    /// Only the hero wavelength is left.
    #[inline]
    pub fn secondary_terminated(&self) -> bool {
        self.pdf[1..].iter().all(|&p| p <= 0.0)
    }
}

/// Inverts the distribution function of [`visible_pdf`].
#[inline]
fn visible_lambda(u: f32) -> f32 {
    let x = 0.856_910_6 - 1.827_502 * u;
    let atanh = 0.5 * Real::ln((1.0 + x) / (1.0 - x));
    // The constants are rounded: the ends would fall a little outside.
    (538.0 - 138.888_9 * atanh).clamp(LAMBDA_MIN, LAMBDA_MAX)
}

/// Density of [`Wavelengths::sample_visible`] at `lambda` nm, in 1/nm; zero outside 360..830 nm.
#[inline]
pub fn visible_pdf(lambda: f32) -> f32 {
    if !(LAMBDA_MIN..=LAMBDA_MAX).contains(&lambda) {
        return 0.0;
    }
    let e = Real::exp(0.0072 * (lambda - 538.0));
    let cosh = 0.5 * (e + 1.0 / e);
    0.003_939_804 / (cosh * cosh)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn visible_pdf_integrates_to_one() {
        let n = 47_000;
        let h = 470.0 / n as f64;
        let sum: f64 = (0..n).map(|i| f64::from(visible_pdf((360.0 + (i as f64 + 0.5) * h) as f32))).sum();
        // The published constants have eight digits, and were rounded separately.
        assert!((sum * h - 1.0).abs() < 2e-5, "{}", sum * h);
    }

    #[test]
    fn visible_samples_follow_their_density() {
        // The derivative of lambda by u is one over the density.
        for i in 1..200 {
            let u = i as f32 / 200.0;
            let d = f64::from(visible_lambda(u + 0.002)) - f64::from(visible_lambda(u - 0.002));
            let pdf = f64::from(visible_pdf(visible_lambda(u)));
            if pdf > 0.0 && u > 0.01 && u < 0.99 {
                assert!((d / 0.004 * pdf - 1.0).abs() < 2e-3, "u {u}: {}", d / 0.004 * pdf);
            }
        }
    }

    #[test]
    fn samples_stay_in_range_with_matching_index() {
        for i in 0..1000 {
            let u = i as f32 / 1000.0;
            for w in [Wavelengths::sample_visible(u), Wavelengths::sample_uniform(u)] {
                for k in 0..N_LAMBDA {
                    assert!((360.0..=830.0).contains(&w.lambda[k]), "{w:?}");
                    assert!((w.lambda[k] - 360.0 - f32::from(w.index[k])).abs() <= 0.5, "{w:?}");
                    assert!(w.pdf[k] > 0.0, "{w:?}");
                }
            }
        }
        let last = Wavelengths::sample_visible(sparrow_math::ONE_MINUS_EPSILON);
        assert!(last.lambda.iter().all(|l| l.is_finite()));
    }

    #[test]
    fn companions_are_given_up_once() {
        let mut w = Wavelengths::sample_visible(0.3);
        let p = w.pdf[0];
        assert!(!w.secondary_terminated());
        w.terminate_secondary();
        w.terminate_secondary();
        assert!(w.secondary_terminated());
        assert_eq!(w.pdf, [p / 4.0, 0.0, 0.0, 0.0]);
    }
}
