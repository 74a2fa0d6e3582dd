//! Spectra of Sparrow: the values a path carries, colour, and spectral data.

mod sampled;

pub use sampled::{N_LAMBDA, Spectrum};
