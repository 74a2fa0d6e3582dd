//! Spectra for RGB values: which one, at which scale.

mod fit;
mod table;

pub use fit::fit_sigmoid;
pub use table::rgb_to_sigmoid;
#[doc(hidden)]
pub use table::table_bytes;

use crate::{ColorSpace, DenseSpectrum, Sigmoid, Spectrum, Wavelengths};

/// What an RGB value of a scene means; decides range and scale of its spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RgbRole {
    /// A reflectance: RGB within [0, 1] (clamped), spectrum within [0, 1].
    Albedo,
    /// Any quantity without an upper bound, such as an absorption: white is a constant spectrum.
    Unbounded,
    /// Light: as unbounded, times the illuminant of the colour space, so white is that illuminant.
    Illuminant,
}

/// The spectrum of an RGB value: `scale * sigmoid(λ)`, for light times the illuminant.
#[derive(Clone, Copy, Debug)]
pub struct RgbSpectrum {
    /// Twice the largest component, one for albedos.
    pub scale: f32,
    /// The shape, within [0, 1].
    pub sigmoid: Sigmoid,
    /// The illuminant of the colour space, for light.
    pub illuminant: Option<&'static DenseSpectrum>,
}

/// The spectrum that an RGB value of `space` stands for, as in pbrt-v4. Negative components count as zero.
///
/// The shape comes from the table; see [`rgb_to_sigmoid`] for its error.
pub fn rgb_spectrum(rgb: [f32; 3], role: RgbRole, space: ColorSpace) -> RgbSpectrum {
    scaled_spectrum(rgb, role, space, rgb_to_sigmoid)
}

/// [`rgb_spectrum`] with the shape solved for this colour alone, free of the table's interpolation error.
///
/// Takes tens of microseconds: for a scene's constants.
pub fn rgb_spectrum_exact(rgb: [f32; 3], role: RgbRole, space: ColorSpace) -> RgbSpectrum {
    scaled_spectrum(rgb, role, space, fit_sigmoid)
}

fn scaled_spectrum(
    rgb: [f32; 3],
    role: RgbRole,
    space: ColorSpace,
    shape: fn([f32; 3], ColorSpace) -> Sigmoid,
) -> RgbSpectrum {
    if role == RgbRole::Albedo {
        return RgbSpectrum { scale: 1.0, sigmoid: shape(rgb, space), illuminant: None };
    }
    let scale = 2.0 * rgb.into_iter().fold(0.0, f32::max).min(f32::MAX / 4.0);
    // The factor of two keeps the shape near 1/2, where the sigmoid is smooth.
    let unit = if scale > 0.0 { rgb.map(|v| v / scale) } else { [0.0; 3] };
    let illuminant = (role == RgbRole::Illuminant).then(|| space.illuminant());
    RgbSpectrum { scale, sigmoid: shape(unit, space), illuminant }
}

impl RgbSpectrum {
    /// The values at a path's wavelengths.
    #[inline(always)]
    pub fn at(&self, w: &Wavelengths) -> Spectrum<f32> {
        let s = self.sigmoid.at(w) * self.scale;
        match self.illuminant {
            Some(i) => s * i.at(w),
            None => s,
        }
    }

    /// The value at `lambda` nm.
    pub fn value(&self, lambda: f32) -> f32 {
        self.scale * self.sigmoid.value(lambda) * self.illuminant.map_or(1.0, |i| i.value(lambda))
    }

    /// The spectrum at every nanometre.
    pub fn to_dense(&self) -> DenseSpectrum {
        DenseSpectrum::from_fn(|l| self.value(l))
    }

    /// An upper bound of the values, reached where there is no illuminant.
    pub fn max_value(&self) -> f32 {
        self.scale * self.sigmoid.max_value() * self.illuminant.map_or(1.0, DenseSpectrum::max_value)
    }
}

#[cfg(test)]
mod tests;
