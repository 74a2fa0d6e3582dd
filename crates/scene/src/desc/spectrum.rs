//! Spectra and colours as a file gives them.

use std::sync::Arc;

use sparrow_spectra::ColorSpace;

/// A spectrum as the file gives it. What RGB means is decided by where it is used.
#[derive(Clone, Debug, PartialEq)]
pub enum SpectrumDesc {
    /// The same value at every wavelength.
    Constant(f32),
    /// Linear RGB in a colour space.
    Rgb([f32; 3], ColorSpace),
    /// Planck's law at a temperature in kelvin, its maximum scaled to one.
    Blackbody(f32),
    /// A spectrum known by name, such as `metal-Cu-eta`; the name has been checked.
    Named(String),
    /// Wavelength in nm and value, ascending; linear between, zero outside.
    Samples(Arc<[(f32, f32)]>),
}

/// How a light's colour is given.
///
/// Scales in pbrt's light statements act on light spectra that are divided by their photometric integral,
/// so that an RGB of (1, 1, 1) is as bright as any illuminant.
#[derive(Clone, Debug, PartialEq)]
pub struct Emission {
    /// Colour; for [`SpectrumDesc::Rgb`] an illuminant of the colour space is meant.
    pub spectrum: SpectrumDesc,
    /// The statement's `scale`, 1 unless given.
    pub scale: f32,
}
