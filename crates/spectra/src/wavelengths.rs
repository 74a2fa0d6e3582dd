//! The wavelengths of one path: [`Wavelengths`].

use sparrow_math::{InLanes, Real, in_lanes};

use crate::visible::Visible;
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
    /// Four wavelengths, drawn by what they weigh in a picture, from one uniform number in [0, 1).
    ///
    /// The companions stand at `u + i/4`, wrapped, so the four stratify the range. [Wilkie2014]
    ///
    /// Departs from pbrt-v4, whose density follows luminance alone and neglects blue; see [`visible_pdf`].
    #[inline]
    pub fn sample_visible(u: f32) -> Self {
        let (lambda, pdf) = Visible::get().sample(u);
        Self::with_pdf(lambda, pdf)
    }

    /// [`sample_visible`](Self::sample_visible) of each of the first `n` of `u`, to the bit, in lanes: wavelengths in nm and their
    /// densities in 1/nm. All columns are as long as `n`, rounded up to whole registers.
    pub fn sample_visible_many(u: &[f32], n: usize, nm: [&mut [f32]; N_LAMBDA], pdf: [&mut [f32]; N_LAMBDA]) {
        in_lanes(Draw { density: Visible::get(), u, n, nm, pdf });
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
        Self { lambda, pdf, index: lambda.map(nearest) }
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

/// Where a dense table holds a wavelength of the range: the whole part is the nearest whole nanometre less 360.
#[inline(always)]
pub fn table_index<R: Real>(lambda: R) -> R {
    lambda - R::of(f64::from(LAMBDA_MIN)) + R::of(0.5)
}

#[inline(always)]
fn nearest(lambda: f32) -> u16 {
    table_index(lambda) as u16
}

/// Draws many.
struct Draw<'a> {
    density: &'a Visible,
    u: &'a [f32],
    n: usize,
    nm: [&'a mut [f32]; N_LAMBDA],
    pdf: [&'a mut [f32]; N_LAMBDA],
}

impl InLanes for Draw<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Draw { density, u, n, nm, pdf } = self;
        let ([nm0, nm1, nm2, nm3], [pdf0, pdf1, pdf2, pdf3]) = (nm, pdf);
        for i in (0..n).step_by(R::WIDTH) {
            let ([a, b, c, d], [p, q, r, s]) = density.sample(R::load(u, i));
            a.store(nm0, i);
            b.store(nm1, i);
            c.store(nm2, i);
            d.store(nm3, i);
            p.store(pdf0, i);
            q.store(pdf1, i);
            r.store(pdf2, i);
            s.store(pdf3, i);
        }
    }
}

/// Density of [`Wavelengths::sample_visible`] at `lambda` nm, in 1/nm; zero outside 360..830 nm.
///
/// In proportion to the length of the vector that the wavelength adds to a linear RGB picture under D65, smoothed over
/// 20 nm: white light then has next to no colour noise.
#[inline]
pub fn visible_pdf(lambda: f32) -> f32 {
    Visible::get().pdf(lambda)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn visible_pdf_integrates_to_one() {
        // Cells end anywhere: each end errs by half a step of the density that changes there.
        let n = 940_000;
        let h = 470.0 / n as f64;
        let sum: f64 = (0..n).map(|i| f64::from(visible_pdf((360.0 + (i as f64 + 0.5) * h) as f32))).sum();
        assert!((sum * h - 1.0).abs() < 1e-6, "{}", sum * h);
    }

    #[test]
    fn visible_samples_follow_their_density() {
        let n = 200_000;
        let mut counts = [0u32; 47];
        for i in 0..n {
            let w = Wavelengths::sample_visible((i as f32 + 0.5) / n as f32);
            for k in 0..N_LAMBDA {
                counts[(((w.lambda[k] - 360.0) / 10.0) as usize).min(46)] += 1;
                // On the border of two bins either may answer; neighbours differ by less than 4 %.
                assert!((w.pdf[k] / visible_pdf(w.lambda[k]) - 1.0).abs() < 0.04, "{w:?}");
            }
        }
        for (i, &c) in counts.iter().enumerate() {
            let at = |k: usize| visible_pdf(360.005 + 10.0 * i as f32 + 0.01 * k as f32);
            let expected = 0.01 * (0..1000).map(at).sum::<f32>();
            // Equidistant numbers: each bin's end errs by one draw of each of the four.
            assert!((c as f32 - expected * (4 * n) as f32).abs() < 50.0, "bin {i}: {c} {expected}");
        }
    }

    #[test]
    fn many_are_drawn_as_one_by_one() {
        let u: Vec<f32> =
            (0..991).map(|i| i as f32 / 991.0).chain([sparrow_math::ONE_MINUS_EPSILON; 17]).collect();
        let (mut nm, mut pdf) = ([[0.0; 1008]; N_LAMBDA], [[0.0; 1008]; N_LAMBDA]);
        let n = 992;
        Wavelengths::sample_visible_many(
            &u,
            n,
            nm.each_mut().map(|c| &mut c[..]),
            pdf.each_mut().map(|c| &mut c[..]),
        );
        for (i, &u) in u[..n].iter().enumerate() {
            let many = Wavelengths::with_pdf(nm.map(|c| c[i]), pdf.map(|c| c[i]));
            assert_eq!(many, Wavelengths::sample_visible(u));
        }
    }

    #[test]
    fn white_light_has_little_colour_noise() {
        // The second moment of what one path shows of D65 light, against the square of the mean.
        let (light, m) = (crate::ColorSpace::Srgb.illuminant(), crate::ColorSpace::Srgb.xyz_to_rgb());
        let n = 4000;
        let (mut sum, mut sum2) = ([0.0f64; 3], [0.0f64; 3]);
        for i in 0..n {
            let w = Wavelengths::sample_visible((i as f32 + 0.5) / n as f32);
            let l = light.at(&w) / w.pdf_spectrum();
            let xyz =
                [crate::cie::x(), crate::cie::y(), crate::cie::z()].map(|bar| (bar.at(&w) * l).average());
            for c in 0..3 {
                let v = f64::from(m[c][0] * xyz[0] + m[c][1] * xyz[1] + m[c][2] * xyz[2]);
                sum[c] += v / f64::from(n);
                sum2[c] += v * v / f64::from(n);
            }
        }
        let excess: f64 = (0..3).map(|c| sum2[c] / (sum[c] * sum[c]) - 1.0).sum();
        assert!(excess < 0.05, "{excess}");
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
