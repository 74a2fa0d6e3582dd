//! Metal: GGX microfacets that reflect by Fresnel's equations for a complex index of refraction.
//!
//! Height-correlated Smith masking, sampled by visible normals; a mirror where both slope widths are
//! below 1e-3. Single scattering: rough surfaces lose the light that meets a second facet.
//!
//! Sources: [Walter2007] for the family, [Heitz2014] for masking, [Heitz2018] and [DupuyBenyoub2023] for sampling.

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::{
    About, Bsdf, BsdfSample, Model, ParamBlock, ParamInfo, Uniforms, fresnel, ggx::Ggx, mirror_facets,
};

/// A rough or smooth conductor.
#[derive(Clone, Copy, Debug)]
pub struct Conductor<R> {
    ggx: Ggx<R>,
    eta: Spectrum<R>,
    k: Spectrum<R>,
}

impl<R: Real> Model<R> for Conductor<R> {
    const ABOUT: About = About::new(
        "rough or smooth metal: GGX facets, exact Fresnel",
        "Walter2007, Heitz2014, DupuyBenyoub2023",
    )
    .anisotropic();
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::real("alpha_x").default(0.0).soft(0.0, 0.7).doc("Slope width along the grain."),
        ParamInfo::real("alpha_y").default(0.0).soft(0.0, 0.7).doc("Slope width across the grain."),
        ParamInfo::unbounded("eta").default(0.2).doc("Real part of the index of refraction."),
        ParamInfo::unbounded("k").default(3.9).doc("Imaginary part of the index of refraction."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        Conductor { ggx: Ggx::new(p.reals[0], p.reals[1]), eta: p.spectra[0], k: p.spectra[1] }
    }
}

impl<R: Real> Conductor<R> {
    /// `F(wo.m)`
    #[inline(always)]
    fn fresnel(&self, cos_d: R) -> Spectrum<R> {
        self.eta.zip(
            self.k,
            #[inline(always)]
            |eta, k| fresnel::conductor(cos_d, eta, k),
        )
    }
}

impl<R: Real> Bsdf<R> for Conductor<R> {
    #[inline(always)]
    fn f(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> Spectrum<R> {
        mirror_facets::f(
            &self.ggx,
            wo,
            wi,
            #[inline(always)]
            |cos| self.fresnel(cos),
        )
    }

    #[inline(always)]
    fn pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        mirror_facets::pdf(&self.ggx, wo, wi)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        mirror_facets::sample(
            &self.ggx,
            wo,
            u,
            #[inline(always)]
            |cos| self.fresnel(cos),
        )
    }

    #[inline(always)]
    fn has_smooth_lobe(&self) -> R::Mask {
        !self.ggx.is_smooth()
    }

    #[inline(always)]
    fn regularized(self) -> Self {
        Conductor { ggx: self.ggx.regularized(), ..self }
    }
}
