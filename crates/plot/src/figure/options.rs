//! What a figure shows and how: [`Options`].

use sparrow_math::LocalDir;
use sparrow_models::{Bsdf, Surface};

use crate::draw::theme::{DARK, LIGHT, Theme};

/// Kinds of figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Lobe in the plane of incidence, in polar coordinates.
    Polar,
    /// Lobe in the plane of incidence, in Cartesian coordinates.
    Cartesian,
    /// The whole lobe in space.
    Lobe3d,
    /// Value over half and difference angle.
    HalfDifference,
    /// Sampled directions over the density.
    Samples,
    /// Albedo over the angle of the view.
    Albedo,
    /// Albedo over the angle of the view and a parameter.
    AlbedoMap,
    /// Light of a fibre over the inclination, lobe by lobe.
    Longitudinal,
    /// Light of a fibre around it, lobe by lobe.
    Azimuthal,
    /// TRT of a fibre around it.
    Caustic,
    /// Value of a fibre over all directions.
    FibreMap,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Kind; 11] = [
        Kind::Polar,
        Kind::Cartesian,
        Kind::Lobe3d,
        Kind::HalfDifference,
        Kind::Samples,
        Kind::Albedo,
        Kind::AlbedoMap,
        Kind::Azimuthal,
        Kind::Longitudinal,
        Kind::Caustic,
        Kind::FibreMap,
    ];
    /// It shows fibres, not surfaces.
    pub fn of_fibres(self) -> bool {
        matches!(self, Kind::Longitudinal | Kind::Azimuthal | Kind::Caustic | Kind::FibreMap)
    }
    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Polar => "polar",
            Kind::Cartesian => "cartesian",
            Kind::Lobe3d => "lobe3d",
            Kind::HalfDifference => "half-difference",
            Kind::Samples => "samples",
            Kind::Albedo => "albedo",
            Kind::AlbedoMap => "albedo-map",
            Kind::Longitudinal => "longitudinal",
            Kind::Azimuthal => "azimuthal",
            Kind::Caustic => "caustic",
            Kind::FibreMap => "fibre-map",
        }
    }
    /// What it shows, in a line.
    pub fn about(self) -> &'static str {
        match self {
            Kind::Polar => "lobe in the plane of incidence, in polar coordinates",
            Kind::Cartesian => "lobe in the plane of incidence, over the angle",
            Kind::Lobe3d => "the whole lobe as a surface in space",
            Kind::HalfDifference => {
                "value over half and difference angle, for a difference azimuth of 90 degrees"
            }
            Kind::Samples => "sampled directions over the density, on a disc of equal area",
            Kind::Albedo => "albedo over the angle of the view",
            Kind::AlbedoMap => "albedo over the angle of the view and a parameter",
            Kind::Longitudinal => "light of a fibre over the inclination, lobe by lobe",
            Kind::Azimuthal => "light of a fibre around it, lobe by lobe",
            Kind::Caustic => "TRT of a fibre around it, with its caustics",
            Kind::FibreMap => "value of a fibre over inclination and azimuth",
        }
    }
}

/// What is shown of a lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The value, in 1/sr.
    F,
    /// The value times the cosine of the light, in 1/sr.
    FCos,
    /// The density of sampling, in 1/sr.
    Pdf,
}

impl Quantity {
    /// The quantity at a pair of directions, in 1/sr; the mean over the wavelengths, which are equal for grey parameters.
    pub fn of(self, model: &Surface<f64>, wo: LocalDir<f64>, wi: LocalDir<f64>) -> f64 {
        match self {
            Quantity::F => model.f(wo, wi).average(),
            Quantity::FCos => model.f_cos(wo, wi).average(),
            Quantity::Pdf => model.pdf(wo, wi),
        }
    }
    /// As axes name it.
    pub fn symbol(self) -> &'static str {
        match self {
            Quantity::F => "f",
            Quantity::FCos => "f |cos θ_{i}|",
            Quantity::Pdf => "pdf",
        }
    }
    /// As tables name it.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::F => "f",
            Quantity::FCos => "f_cos",
            Quantity::Pdf => "pdf",
        }
    }
}

/// What a figure shows and how.
#[derive(Clone, Debug)]
pub struct Options {
    /// The kind of figure.
    pub kind: Kind,
    /// What lobes show; other kinds know themselves what they show.
    pub quantity: Quantity,
    /// Logarithmic lengths, ordinates or colours.
    pub log: bool,
    /// Lobes in the plane over their own greatest value.
    pub normalize: bool,
    /// Width and height in pixels; none for what suits the kind.
    pub size: [Option<f64>; 2],
    /// Light on dark.
    pub dark: bool,
    /// Title; none for the names of the models.
    pub title: Option<String>,
    /// Parameter of the map of albedo; none for the model's roughness.
    pub over: Option<String>,
    /// Sampled directions of each series.
    pub samples: usize,
    /// Seed of what is sampled.
    pub seed: u64,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            kind: Kind::Polar,
            quantity: Quantity::F,
            log: false,
            normalize: false,
            size: [None, None],
            dark: false,
            title: None,
            over: None,
            samples: 500,
            seed: 0,
        }
    }
}

impl Options {
    pub(crate) fn theme(&self) -> Theme {
        if self.dark { DARK } else { LIGHT }
    }
}
