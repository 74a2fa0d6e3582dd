//! The names of things in scene files, for reports.

use sparrow_scene::{
    ColourMode, FilterDesc, IntegratorName, LightSamplerName, Projection, RandomizeName, SamplerName,
};

pub(crate) fn sampler(name: SamplerName) -> &'static str {
    match name {
        SamplerName::Independent => "independent",
        SamplerName::Stratified => "stratified",
        SamplerName::Halton => "halton",
        SamplerName::Sobol => "sobol",
        SamplerName::PaddedSobol => "paddedsobol",
        SamplerName::ZSobol => "zsobol",
        SamplerName::Pmj02bn => "pmj02bn",
    }
}

pub(crate) fn randomization(name: RandomizeName) -> &'static str {
    match name {
        RandomizeName::None => "none",
        RandomizeName::PermuteDigits => "permutedigits",
        RandomizeName::FastOwen => "fastowen",
        RandomizeName::Owen => "owen",
    }
}

pub(crate) fn integrator(name: IntegratorName) -> &'static str {
    match name {
        IntegratorName::Path => "path",
        IntegratorName::Reference => "reference",
        IntegratorName::DirectLighting => "directlighting",
    }
}

pub(crate) fn light_sampler(name: LightSamplerName) -> &'static str {
    match name {
        LightSamplerName::Uniform => "uniform",
        LightSamplerName::Power => "power",
        LightSamplerName::Bvh => "bvh",
    }
}

pub(crate) fn colour(mode: ColourMode) -> &'static str {
    match mode {
        ColourMode::Spectral => "spectral",
        ColourMode::Rgb => "rgb",
    }
}

pub(crate) fn projection(projection: Projection) -> &'static str {
    match projection {
        Projection::Perspective { .. } => "perspective",
        Projection::Orthographic => "orthographic",
    }
}

/// Name and half widths of a filter.
pub(crate) fn filter(filter: FilterDesc) -> (&'static str, [f32; 2]) {
    match filter {
        FilterDesc::Box { radius } => ("box", radius),
        FilterDesc::Triangle { radius } => ("triangle", radius),
        FilterDesc::Gaussian { radius, .. } => ("gaussian", radius),
        FilterDesc::Mitchell { radius, .. } => ("mitchell", radius),
        FilterDesc::Sinc { radius, .. } => ("sinc", radius),
    }
}
