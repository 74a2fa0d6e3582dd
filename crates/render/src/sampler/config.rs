//! What a sampler is asked to be: [`SamplerConfig`].

/// The point set, under pbrt's names.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SamplerKind {
    /// Independent uniform numbers.
    Independent,
    /// A grid of `x * y` strata per pixel, in shuffled order per dimension.
    Stratified {
        /// Strata along the first axis.
        x: u32,
        /// Strata along the second axis.
        y: u32,
        /// A random place in the stratum, else its centre.
        jitter: bool,
    },
    /// One Halton sequence over image plane and path.
    Halton,
    /// One Sobol sequence over image plane and path.
    Sobol,
    /// A pair of Sobol dimensions, scrambled afresh per pixel and dimension.
    PaddedSobol,
    /// A pair of Sobol dimensions along a shuffled Morton curve: blue-noise error over the image.
    ZSobol,
    /// Progressive multi-jittered points; runs as [`SamplerKind::ZSobol`], see [`crate::sampler::Sampler::notes`].
    Pmj02bn,
}

impl SamplerKind {
    /// The randomisation pbrt takes where the scene names none.
    pub fn default_randomize(self) -> Randomize {
        if self == SamplerKind::Halton { Randomize::PermuteDigits } else { Randomize::FastOwen }
    }
}

/// How a low-discrepancy point set is randomised; pbrt's parameter "randomization".
///
/// The independent and the stratified kind are random by themselves and ignore it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Randomize {
    /// Not at all: the same points for every seed, as far as the kind allows.
    None,
    /// Each digit permuted on its own; in base 2 an exclusive or.
    PermuteDigits,
    /// Nested uniform scrambling by a hash that propagates upwards in the bits. [Vegdahl2021]
    FastOwen,
    /// Nested uniform scrambling, digit by digit. [Owen1995]
    Owen,
}

/// What [`crate::sampler::Sampler::new`] builds from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SamplerConfig {
    /// The point set.
    pub kind: SamplerKind,
    /// Its randomisation.
    pub randomize: Randomize,
    /// Samples per pixel of the whole render, all runs together; 0 counts as 1.
    pub samples_per_pixel: u32,
    /// Renders with different seeds are independent.
    pub seed: u64,
    /// Width and height of the full image (not of a crop window), in pixels.
    pub resolution: [u32; 2],
}

impl SamplerConfig {
    /// Whether another seed gives other points.
    pub fn is_random(&self) -> bool {
        matches!(self.kind, SamplerKind::Independent | SamplerKind::Stratified { .. })
            || self.randomize != Randomize::None
    }
}
