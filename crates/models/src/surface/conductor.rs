//! Metal: GGX microfacets that reflect by Fresnel's equations for a complex index of refraction.
//!
//! Height-correlated Smith masking, sampled by visible normals; a mirror where both slope widths are
//! below 1e-3. Single scattering: rough surfaces lose the light that meets a second facet.
//!
//! Sources: [Walter2007] for the family, [Heitz2014] for masking, [Heitz2018] and [DupuyBenyoub2023] for sampling.

use sparrow_math::Real;
use sparrow_spectra::Spectrum;

use crate::mirror_facets::{FacetReflectance, MirrorFacets};
use crate::{About, Model, ParamBlock, ParamInfo, fresnel, ggx::Ggx};

/// A rough or smooth conductor.
pub(super) type Conductor<R> = MirrorFacets<R, Metal<R>>;

/// The complex index of refraction of a metal.
#[derive(Clone, Copy, Debug)]
pub struct Metal<R> {
    eta: Spectrum<R>,
    k: Spectrum<R>,
}

impl<R: Real> FacetReflectance<R> for Metal<R> {
    #[inline(always)]
    fn at(&self, cos: R) -> Spectrum<R> {
        self.eta.zip(
            self.k,
            #[inline(always)]
            |eta, k| fresnel::conductor(cos, eta, k),
        )
    }
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
        let reflectance = Metal { eta: p.spectra[0], k: p.spectra[1] };
        MirrorFacets { ggx: Ggx::new(p.reals[0], p.reals[1]), reflectance }
    }
}
