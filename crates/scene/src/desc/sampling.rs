//! Sampler and integrator.

use sparrow_mis::Mis;

use super::LightSamplerName;

/// Names of samplers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SamplerName {
    /// Uncorrelated numbers.
    Independent,
    /// One sample per cell of a grid.
    Stratified,
    /// Halton sequence.
    Halton,
    /// Sobol sequence over the whole picture.
    Sobol,
    /// Two-dimensional Sobol points, shuffled per dimension.
    PaddedSobol,
    /// Sobol points along a Morton curve: blue-noise error on the screen.
    ZSobol,
    /// Progressive multi-jittered points.
    Pmj02bn,
}

/// How a sequence is randomised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RandomizeName {
    /// Not at all.
    None,
    /// Digits are permuted.
    PermuteDigits,
    /// Hashed Owen scrambling.
    FastOwen,
    /// Owen scrambling.
    Owen,
}

/// A sampler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SamplerDesc {
    /// Which.
    pub name: SamplerName,
    /// Samples per pixel.
    pub samples_per_pixel: u32,
    /// Cells of [`SamplerName::Stratified`] along x and y.
    pub strata: [u32; 2],
    /// Jittered within cells.
    pub jitter: bool,
    /// Randomisation.
    pub randomize: RandomizeName,
    /// The sampler's own seed; overrides the scene's.
    pub seed: Option<u64>,
}

/// An integrator.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegratorDesc {
    /// `path`, `reference` or `directlighting`, after aliases are resolved.
    pub name: IntegratorName,
    /// Most scattering events of a path.
    pub max_depth: u32,
    /// Light sampler.
    pub light_sampler: LightSamplerName,
    /// Widens narrow lobes after the first rough one.
    pub regularize: bool,
    /// Ways on from the first vertex of each camera sample, from 1 to [`MAX_SPLITS`](Self::MAX_SPLITS); none: as many as are efficient.
    pub splits: Option<u32>,
    /// How light sampling and BSDF sampling share direct light.
    pub mis: Mis,
    /// MIS compensation of environment lights.
    pub mis_compensation: bool,
    /// How the end of paths is decided.
    pub roulette: RouletteName,
}

/// What Russian roulette goes by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RouletteName {
    /// What a path carries of what it began with.
    Throughput,
    /// The same, and what going on is worth and costs, as a pilot finds.
    Efficiency,
}

impl IntegratorDesc {
    /// Most ways on from a vertex.
    pub const MAX_SPLITS: u32 = 64;
}

/// Names of integrators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntegratorName {
    /// The path tracer.
    Path,
    /// The path tracer, one path at a time: slower, and the same picture to the bit.
    Reference,
    /// Paths with one bounce of light, and specular chains.
    DirectLighting,
}
