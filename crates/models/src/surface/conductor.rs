//! Metal: GGX microfacets that reflect by Fresnel's equations for a complex index of refraction.
//!
//! Height-correlated Smith masking, sampled by visible normals; a mirror where both slope widths are
//! below 1e-3. Single scattering: rough surfaces lose the light that meets a second facet.
//!
//! Sources: [Walter2007] for the family, [Heitz2014] for masking, [Heitz2018] and [DupuyBenyoub2023] for sampling.

use sparrow_math::{LocalDir, Real, Vec3, vec3};
use sparrow_spectra::Spectrum;

use crate::{About, Bsdf, BsdfSample, Model, ParamBlock, ParamInfo, Uniforms, fresnel, ggx::Ggx};

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
    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn f(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> Spectrum<R> {
        let lit = wo.same_side(wi) & !self.ggx.is_smooth();
        let m = wo.half(wi);
        let D = self.ggx.d(m); // [Heitz2014, eq. 85]
        let G = self.ggx.g2_over_4cos(wo, wi); // [Heitz2014, eq. 99]
        let F = self.fresnel(wo.dot(m).abs().min(R::ONE));
        (F * (D * G)).only_where(lit)
    }

    #[inline(always)]
    fn pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        let lit = wo.same_side(wi) & !self.ggx.is_smooth();
        let m = wo.half(wi);
        (self.ggx.visible_over_cos(wo, m) * R::of(0.25)).only_where(lit)
    }

    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let delta = self.ggx.is_smooth();
        // Sampled above; a metal looks the same from behind.
        let up = LocalDir::new(Vec3 { z: wo.z().abs(), ..wo.v() });
        let rough = self.ggx.sample_visible(up, u.dir);
        let m = LocalDir::new(Vec3::select(delta, vec3(R::ZERO, R::ZERO, R::ONE), rough.v()));
        let wi_up = up.reflect(m);
        let valid = up.above() & wi_up.above();
        let F = self.fresnel(up.dot(m).clamp(R::ZERO, R::ONE));
        let G = R::select(delta, R::ONE, self.ggx.g2_over_g1(up, wi_up));
        let density = R::select(delta, R::ONE, self.ggx.visible_over_cos(up, m) * R::of(0.25));
        BsdfSample {
            wi: LocalDir::new(Vec3 { z: wi_up.z().copysign(wo.z()), ..wi_up.v() }),
            weight: (F * G).only_where(valid),
            density: density.only_where(valid),
            eta: R::ONE,
            delta,
            valid: valid & (delta | density.gt(R::ZERO)),
        }
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
