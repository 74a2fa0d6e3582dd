//! Lambert's diffuse reflection: the same radiance in every direction. [Lambert1760]

use sparrow_math::{LocalDir, Mask, Real, warp};
use sparrow_spectra::Spectrum;

use crate::{About, Bsdf, BsdfSample, Model, ParamBlock, ParamInfo, Uniforms};

/// Diffuse reflection on the side it is seen from.
#[derive(Clone, Copy, Debug)]
pub struct Lambert<R> {
    reflectance: Spectrum<R>,
}

impl<R: Real> Model<R> for Lambert<R> {
    const ABOUT: About = About::new("the same radiance in every direction", "Lambert1760");
    const PARAMS: &'static [ParamInfo] =
        &[ParamInfo::albedo("reflectance").default(0.5).doc("Share of the light that is reflected.")];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        Lambert { reflectance: p.spectra[0] }
    }
}

impl<R: Real> Bsdf<R> for Lambert<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let pdf = warp::cosine_hemisphere_pdf(wi.abs_cos_theta()).only_where(wo.same_side(wi));
        (self.reflectance * pdf, pdf)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let wi = LocalDir::new(warp::cosine_hemisphere(u.dir)).flip_to(wo);
        let density = warp::cosine_hemisphere_pdf(wi.abs_cos_theta());
        BsdfSample {
            wi,
            weight: self.reflectance,
            density,
            eta: R::ONE,
            delta: R::Mask::of(false),
            valid: density.gt(R::ZERO) & wo.same_side(wi),
        }
    }
}
