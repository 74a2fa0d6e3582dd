//! GGX facets that only reflect, whatever their reflectance: value, density and sampling of a metal.
//!
//! Height-correlated Smith masking, sampled by visible normals; a mirror where both slope widths are below 1e-3. The same
//! from both sides. Sources: [Walter2007], [Heitz2014], [DupuyBenyoub2023].

use sparrow_math::{LocalDir, Real, Vec3, vec3};
use sparrow_spectra::Spectrum;

use crate::ggx::Ggx;
use crate::{BsdfSample, Uniforms};

/// `f`, with the reflectance `F(cos)` of a facet.
#[allow(non_snake_case, reason = "names of the formula")]
#[inline(always)]
pub(crate) fn f<R: Real>(
    ggx: &Ggx<R>,
    wo: LocalDir<R>,
    wi: LocalDir<R>,
    F: impl Fn(R) -> Spectrum<R>,
) -> Spectrum<R> {
    let lit = wo.same_side(wi) & !ggx.is_smooth();
    let m = wo.half(wi);
    let D = ggx.d(m); // [Heitz2014, eq. 85]
    let G = ggx.g2_over_4cos(wo, wi); // [Heitz2014, eq. 99]
    let F = F(wo.dot(m).abs().min(R::ONE));
    (F * (D * G)).only_where(lit)
}

/// Density of [`sample`], zero for mirrors.
#[inline(always)]
pub(crate) fn pdf<R: Real>(ggx: &Ggx<R>, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
    let lit = wo.same_side(wi) & !ggx.is_smooth();
    let m = wo.half(wi);
    (ggx.visible_over_cos(wo, m) * R::of(0.25)).only_where(lit)
}

/// Reflects `wo` at a visible facet.
#[allow(non_snake_case, reason = "names of the formula")]
#[inline(always)]
pub(crate) fn sample<R: Real>(
    ggx: &Ggx<R>,
    wo: LocalDir<R>,
    u: Uniforms<R>,
    F: impl Fn(R) -> Spectrum<R>,
) -> BsdfSample<R> {
    let delta = ggx.is_smooth();
    // Sampled above; a metal looks the same from behind.
    let up = LocalDir::new(Vec3 { z: wo.z().abs(), ..wo.v() });
    let rough = ggx.sample_visible(up, u.dir);
    let m = LocalDir::new(Vec3::select(delta, vec3(R::ZERO, R::ZERO, R::ONE), rough.v()));
    let wi_up = up.reflect(m);
    let valid = up.above() & wi_up.above();
    let F = F(up.dot(m).clamp(R::ZERO, R::ONE));
    let G = R::select(delta, R::ONE, ggx.g2_over_g1(up, wi_up));
    let density = R::select(delta, R::ONE, ggx.visible_over_cos(up, m) * R::of(0.25));
    BsdfSample {
        wi: LocalDir::new(Vec3 { z: wi_up.z().copysign(wo.z()), ..wi_up.v() }),
        weight: (F * G).only_where(valid),
        density: density.only_where(valid),
        eta: R::ONE,
        delta,
        valid: valid & (delta | density.gt(R::ZERO)),
    }
}
