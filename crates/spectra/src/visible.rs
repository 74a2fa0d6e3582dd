//! The density with which paths draw their wavelengths: [`Visible`].

use std::sync::OnceLock;

use sparrow_math::{Mask, Real};

use crate::{ColorSpace, LAMBDA_MIN, N_DENSE, cie};

/// Bins of one nanometre between 360 and 830.
const N_BINS: usize = N_DENSE - 1;
/// Entries of the table that says where to begin looking.
const N_GUIDE: usize = 2048;
/// Width of the smoothing, in nm.
const SIGMA: f32 = 20.0;

/// A density over wavelengths in proportion to what they weigh in a linear RGB picture.
///
/// For light of the illuminant D65 a wavelength adds to red, green and blue in proportion to the sRGB matching
/// functions times D65; the density is the length of that vector, smoothed with a Gaussian of 20 nm, so that
/// coloured light too finds no wavelength neglected. Four stratified draws from it leave white light with a variance
/// of 0.043 (summed over the channels, relative to white), where pbrt-v4's density for luminance leaves 0.365, most of
/// that in blue; for incandescent light 0.12 against 0.15, for saturated red 0.34 against 1.6.
///
/// Constant within each nanometre.
pub(crate) struct Visible {
    /// Density of each bin, in 1/nm.
    pdf: [f32; N_BINS],
    /// Share below each bin's lower end; the last is 1.
    cdf: [f32; N_DENSE],
    /// For each of `N_GUIDE` equal steps of the uniform number, a bin at or before the one sought.
    guide: [f32; N_GUIDE],
}

impl Visible {
    /// The one table, made at first use.
    pub(crate) fn get() -> &'static Visible {
        static TABLE: OnceLock<Visible> = OnceLock::new();
        TABLE.get_or_init(Visible::new)
    }

    fn new() -> Visible {
        let weight = smoothed(&rgb_weight());
        let total: f64 = weight.iter().sum();
        let mut v = Visible { pdf: [0.0; N_BINS], cdf: [0.0; N_DENSE], guide: [0.0; N_GUIDE] };
        let mut sum = 0.0;
        for (i, w) in weight.iter().enumerate() {
            sum += w / total;
            v.cdf[i + 1] = sum as f32;
        }
        v.cdf[N_BINS] = 1.0;
        // The density that sampling has after its shares were rounded.
        for (i, p) in v.pdf.iter_mut().enumerate() {
            *p = v.cdf[i + 1] - v.cdf[i];
        }
        let mut bin = 0;
        for (k, g) in v.guide.iter_mut().enumerate() {
            while v.cdf[bin + 1] <= k as f32 / N_GUIDE as f32 {
                bin += 1;
            }
            *g = bin as f32;
        }
        v
    }

    /// The wavelength in nm that `u` in [0, 1) stands for, and its density in 1/nm.
    #[inline(always)]
    pub(crate) fn sample<R: Real>(&self, u: R) -> (R, R) {
        let mut bin = (u * R::of(N_GUIDE as f64)).look_up(&self.guide);
        let above = loop {
            let next = bin + R::ONE;
            let above = next.look_up(&self.cdf);
            let beyond = next.lt(R::of(N_BINS as f64)) & above.le(u);
            if !beyond.any() {
                break above;
            }
            bin = R::select(beyond, next, bin);
        };
        let below = bin.look_up(&self.cdf);
        let pdf = above - below;
        let inside = ((u - below) / pdf).clamp(R::ZERO, R::ONE);
        (R::of(f64::from(LAMBDA_MIN)) + bin + inside, pdf)
    }

    /// Density of a wavelength, in 1/nm; zero outside 360..830 nm.
    #[inline]
    pub(crate) fn pdf(&self, lambda: f32) -> f32 {
        let x = lambda - LAMBDA_MIN;
        if (0.0..=N_BINS as f32).contains(&x) { self.pdf[(x as usize).min(N_BINS - 1)] } else { 0.0 }
    }
}

/// Length of the RGB vector that D65 light of a wavelength adds to a picture.
fn rgb_weight() -> [f64; N_BINS] {
    let space = ColorSpace::Srgb;
    let (light, m) = (space.illuminant(), space.xyz_to_rgb());
    core::array::from_fn(|i| {
        // The middle of the bin lies between two entries.
        let mid = |t: &[f32; N_DENSE]| 0.5 * f64::from(t[i] + t[i + 1]);
        let xyz = [mid(cie::x().values()), mid(cie::y().values()), mid(cie::z().values())];
        let rgb = m.map(|row| row.iter().zip(xyz).map(|(&a, b)| f64::from(a) * b).sum::<f64>());
        mid(light.values()) * rgb.iter().map(|c| c * c).sum::<f64>().sqrt()
    })
}

/// Convolved with a Gaussian; nothing lies beyond the ends.
fn smoothed(w: &[f64; N_BINS]) -> [f64; N_BINS] {
    let kernel = |d: usize| Real::exp(-0.5 * (d as f64 / f64::from(SIGMA)) * (d as f64 / f64::from(SIGMA)));
    core::array::from_fn(|i| w.iter().enumerate().map(|(j, v)| v * kernel(i.abs_diff(j))).sum())
}
