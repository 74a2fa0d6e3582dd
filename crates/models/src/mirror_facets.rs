//! GGX facets that only reflect, whatever their reflectance: value, density and sampling of a metal.
//!
//! Height-correlated Smith masking, sampled by visible normals; a mirror where both slope widths are below 1e-3. The same
//! from both sides. Sources: [Walter2007], [Heitz2014], [DupuyBenyoub2023].

use sparrow_math::{LocalDir, Real, Vec3, vec3};
use sparrow_spectra::Spectrum;

use crate::ggx::Ggx;
use crate::{Bsdf, BsdfSample, Uniforms};

/// What one facet reflects.
pub(crate) trait FacetReflectance<R: Real>: Copy {
    /// `F(cos)`, the cosine between either direction and the facet's normal.
    fn at(&self, cos: R) -> Spectrum<R>;
}

/// Facets that reflect by `F`.
#[derive(Clone, Copy, Debug)]
pub struct MirrorFacets<R, F> {
    pub(crate) ggx: Ggx<R>,
    pub(crate) reflectance: F,
}

#[allow(private_bounds, reason = "what reflects is the business of this crate")]
impl<R: Real, F: FacetReflectance<R>> Bsdf<R> for MirrorFacets<R, F> {
    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let lit = wo.same_side(wi) & !self.ggx.is_smooth();
        let m = wo.half(wi);
        let D = self.ggx.d(m); // [Heitz2014, eq. 85]
        let (G, visible) = self.ggx.g2_over_4cos_and_density(wo, wi); // [Heitz2014, eq. 99]
        let F = self.reflectance.at(wo.dot(m).abs().min(R::ONE));
        let f_cos = F * (D * G * wi.abs_cos_theta());
        (f_cos.only_where(lit), (D * visible).only_where(lit))
    }

    /// Reflects `wo` at a visible facet.
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
        let F = self.reflectance.at(up.dot(m).clamp(R::ZERO, R::ONE));
        let (G, visible) = self.ggx.g2_over_4cos_and_density(up, wi_up);
        // G2 / G1 = (G2 / 4 cos cos) cos_i over the density, both over D.
        let masking = R::select(delta, R::ONE, G * wi_up.z() / visible);
        let density = R::select(delta, R::ONE, self.ggx.d(m) * visible);
        BsdfSample {
            wi: LocalDir::new(Vec3 { z: wi_up.z().copysign(wo.z()), ..wi_up.v() }),
            weight: (F * masking).only_where(valid),
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
        MirrorFacets { ggx: self.ggx.regularized(), ..self }
    }
}
