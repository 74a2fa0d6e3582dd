//! Spectra tabulated at every nanometre: [`DenseSpectrum`].

use sparrow_math::Real;

use crate::{N_LAMBDA, Spectrum, Wavelengths};

/// Entries of a [`DenseSpectrum`]: 360 to 830 nm in steps of 1 nm.
pub const N_DENSE: usize = 471;

/// 471 values from 360 to 830 nm, looked up at the nearest nanometre.
#[derive(Clone, Debug, PartialEq)]
pub struct DenseSpectrum(Box<[f32; N_DENSE]>);

impl DenseSpectrum {
    /// Tabulates `f` at 360, 361, ... 830 nm.
    pub fn from_fn(mut f: impl FnMut(f32) -> f32) -> Self {
        let mut values = Box::new([0.0; N_DENSE]);
        for (i, v) in values.iter_mut().enumerate() {
            *v = f(360.0 + i as f32);
        }
        Self(values)
    }

    /// The same value at every wavelength.
    pub fn constant(v: f32) -> Self {
        Self(Box::new([v; N_DENSE]))
    }

    /// The polyline through (wavelength in nm, value) pairs in ascending order, zero outside their range.
    ///
    /// Where two pairs share a wavelength the first one holds there. What the polyline does between
    /// whole nanometres is lost.
    pub fn from_samples(samples: &[(f32, f32)]) -> Self {
        Self::from_fn(|lambda| polyline(samples, lambda))
    }

    /// The values at a path's wavelengths.
    ///
    /// An index beyond the table, which only a hand-made [`Wavelengths`] can hold, reads the last value.
    #[inline(always)]
    pub fn at(&self, w: &Wavelengths) -> Spectrum<f32> {
        let mut out = [0.0; N_LAMBDA];
        for (o, &i) in out.iter_mut().zip(&w.index) {
            *o = self.0[usize::from(i).min(N_DENSE - 1)];
        }
        Spectrum(out)
    }

    /// The value at an index, or in lanes; indices beyond the table read the last value.
    #[inline(always)]
    pub fn look_up<R: Real>(&self, index: R) -> R {
        index.look_up(&self.0[..])
    }

    /// The value at the nanometre nearest to `lambda`; zero outside the table.
    pub fn value(&self, lambda: f32) -> f32 {
        let i = (lambda - 360.0 + 0.5).floor();
        if i >= 0.0 { self.0.get(i as usize).copied().unwrap_or(0.0) } else { 0.0 }
    }

    /// Every value multiplied by `s`.
    pub fn scaled(&self, s: f32) -> Self {
        self.map(|v| v * s)
    }

    /// `f` applied to every value.
    pub fn map(&self, mut f: impl FnMut(f32) -> f32) -> Self {
        let mut values = self.0.clone();
        for v in values.iter_mut() {
            *v = f(*v);
        }
        Self(values)
    }

    /// The product with another spectrum, wavelength by wavelength.
    pub fn mul(&self, o: &Self) -> Self {
        let mut values = self.0.clone();
        for (v, o) in values.iter_mut().zip(o.0.iter()) {
            *v *= o;
        }
        Self(values)
    }

    /// The integral of the product over wavelength, as the sum over whole nanometres (unit: nm).
    pub fn inner_product(&self, o: &Self) -> f64 {
        self.0.iter().zip(o.0.iter()).map(|(&a, &b)| f64::from(a) * f64::from(b)).sum()
    }

    /// The integral over wavelength, as the sum over whole nanometres (unit: nm).
    pub fn sum(&self) -> f64 {
        self.0.iter().map(|&v| f64::from(v)).sum()
    }

    /// The largest value.
    pub fn max_value(&self) -> f32 {
        self.0.iter().copied().fold(f32::NEG_INFINITY, f32::max)
    }

    /// The table.
    pub fn values(&self) -> &[f32; N_DENSE] {
        &self.0
    }
}

/// The polyline through ascending `samples` at `lambda`; zero outside.
fn polyline(samples: &[(f32, f32)], lambda: f32) -> f32 {
    let next = samples.partition_point(|s| s.0 < lambda);
    let Some(&(x1, y1)) = samples.get(next) else { return 0.0 };
    if x1 <= lambda {
        return y1;
    }
    let Some(&(x0, y0)) = next.checked_sub(1).and_then(|i| samples.get(i)) else { return 0.0 };
    let t = (lambda - x0) / (x1 - x0);
    (1.0 - t) * y0 + t * y1
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn polyline_is_linear_inside_and_zero_outside() {
        let s = DenseSpectrum::from_samples(&[(400.0, 1.0), (410.0, 3.0), (500.0, 3.0)]);
        assert_eq!(s.value(399.0), 0.0);
        assert_eq!(s.value(400.0), 1.0);
        assert!((s.value(405.0) - 2.0).abs() < 1e-6);
        assert_eq!(s.value(500.0), 3.0);
        assert_eq!(s.value(501.0), 0.0);
        assert_eq!(DenseSpectrum::from_samples(&[]).max_value(), 0.0);
        assert_eq!(DenseSpectrum::from_samples(&[(400.0, 2.0)]).sum(), 2.0);
    }

    #[test]
    fn lookup_takes_the_nearest_nanometre() {
        let s = DenseSpectrum::from_fn(|l| l);
        assert_eq!(s.value(500.4), 500.0);
        assert_eq!(s.value(500.6), 501.0);
        assert_eq!(s.value(359.4), 0.0);
        assert_eq!(s.value(830.4), 830.0);
        assert_eq!(s.value(f32::NAN), 0.0);
        let w = Wavelengths::sample_visible(0.37);
        for i in 0..N_LAMBDA {
            assert_eq!(s.at(&w)[i], s.value(w.lambda[i]), "{w:?}");
        }
    }

    #[test]
    fn products_agree() {
        let a = DenseSpectrum::from_fn(|l| l / 100.0);
        let b = DenseSpectrum::constant(2.0);
        assert!((a.inner_product(&b) - 2.0 * a.sum()).abs() < 1e-3);
        assert_eq!(a.mul(&b), a.scaled(2.0));
    }
}
