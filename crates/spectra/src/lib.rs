//! Spectra of Sparrow: the values a path carries, colour, and spectral data.
//!
//! | what | where |
//! | --- | --- |
//! | values at a path's four wavelengths | [`Spectrum`], [`Wavelengths`] |
//! | spectra of a scene: tabulated, thermal, by name | [`DenseSpectrum`], [`blackbody`], [`named_spectrum`] |
//! | colour: matching functions, RGB spaces | [`cie`], [`ColorSpace`] |
//! | RGB to spectra | [`Sigmoid`], [`rgb_to_sigmoid`], [`rgb_spectrum`] |
//! | spectra to RGB | [`Sensor`] |
//!
//! Wavelengths are in nanometres, from 360 to 830, and integrals over them are sums over whole
//! nanometres. Meaning and scale of everything a scene can name are those of pbrt-v4.

mod blackbody;
pub mod cie;
mod color_space;
mod dense;
mod matrix;
mod named;
mod rgb;
mod sampled;
mod sensor;
mod sigmoid;
mod visible;
mod wavelengths;

pub use blackbody::{blackbody, blackbody_normalized, daylight};
pub use cie::{photometric, xyz_of};
pub use color_space::ColorSpace;
pub use dense::{DenseSpectrum, N_DENSE};
pub use named::{named_spectrum, spectrum_names};
#[doc(hidden)]
pub use rgb::table_bytes;
pub use rgb::{RgbRole, RgbSpectrum, fit_sigmoid, rgb_spectrum, rgb_spectrum_exact, rgb_to_sigmoid};
pub use sampled::{N_LAMBDA, Spectrum};
pub use sensor::Sensor;
pub use sigmoid::Sigmoid;
pub use wavelengths::{Wavelengths, table_index, visible_pdf};

/// The shortest wavelength, in nm.
pub const LAMBDA_MIN: f32 = 360.0;
/// The longest wavelength, in nm.
pub const LAMBDA_MAX: f32 = 830.0;
