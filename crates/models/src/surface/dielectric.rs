//! Glass: GGX microfacets that reflect and refract by Fresnel's equations.
//!
//! Height-correlated Smith masking for both, sampled by visible normals; smooth where both slope widths
//! are below 1e-3 or the two sides have the same index. Single scattering. The value is for radiance:
//! transmission carries the factor `1 / eta^2`, with eta from the side of `wo` to the other.
//!
//! Sources: [Walter2007, eq. 16, 17, 20, 21], masking [Heitz2014, eq. 99]; transmission uses the same correlated form as
//! reflection, as pbrt-v4 does, not the Beta function of correlated refraction.

use sparrow_math::{LocalDir, Real, Vec3, vec3};
use sparrow_spectra::Spectrum;

use crate::opaque::raised;
use crate::{About, Bsdf, BsdfSample, Model, ParamBlock, ParamInfo, Uniforms, fresnel, ggx::Ggx};

/// A rough or smooth boundary between two dielectrics.
#[derive(Clone, Copy, Debug)]
pub struct Dielectric<R> {
    pub(super) eta: R,
    pub(super) ggx: Ggx<R>,
}

impl<R: Real> Model<R> for Dielectric<R> {
    const ABOUT: About =
        About::new("rough or smooth glass: GGX facets that reflect and refract", "Walter2007, Heitz2014")
            .anisotropic()
            .transmits();
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::real("eta")
            .default(1.5)
            .range(0.1, 10.0)
            .soft(1.0, 2.5)
            .doc("Index of refraction of the side below, over that of the side above."),
        ParamInfo::real("alpha_x").default(0.0).soft(0.0, 0.7).doc("Slope width along the grain."),
        ParamInfo::real("alpha_y").default(0.0).soft(0.0, 0.7).doc("Slope width across the grain."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        Dielectric { eta: p.reals[0], ggx: Ggx::new(p.reals[1], p.reals[2]) }
    }
}

/// A pair of directions with the viewer above, and what the boundary does to it.
struct Facet<R: Real> {
    reflects: R::Mask,
    /// The facet is seen from its front by both directions.
    lit: R::Mask,
    m: LocalDir<R>,
    o_dot_m: R,
    i_dot_m: R,
    fresnel: R,
}

impl<R: Real> Dielectric<R> {
    #[inline(always)]
    fn is_delta(&self) -> R::Mask {
        self.ggx.is_smooth() | (self.eta - R::ONE).abs().lt(R::of(1e-5))
    }

    /// The relative index as met from the side of `wo`, transmitted over incident.
    #[inline(always)]
    fn eta_from(&self, wo: LocalDir<R>) -> R {
        R::select(wo.above(), self.eta, R::ONE / self.eta)
    }

    /// The facet that carries `wo` to `wi` by reflection or refraction; `wo` above, `eta` as met from its side.
    #[inline(always)]
    fn facet(&self, wo: LocalDir<R>, wi: LocalDir<R>, eta: R) -> Facet<R> {
        let reflects = wi.above();
        let h = (wo.v() + wi.v() * R::select(reflects, R::ONE, eta)).normalized(); // [Walter2007, eq. 13, 16]
        let m = LocalDir::new(h.facing(vec3(R::ZERO, R::ZERO, R::ONE)));
        let (o_dot_m, i_dot_m) = (wo.dot(m), wi.dot(m));
        Facet {
            reflects,
            lit: wo.above() & o_dot_m.gt(R::ZERO) & (i_dot_m * wi.z()).gt(R::ZERO),
            m,
            o_dot_m,
            i_dot_m,
            fresnel: fresnel::dielectric(o_dot_m.clamp(R::ZERO, R::ONE), eta).0,
        }
    }
}

impl<R: Real> Bsdf<R> for Dielectric<R> {
    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let eta = self.eta_from(wo);
        let (o, i) = (raised(wo, wo), raised(wo, wi));
        let facet = self.facet(o, i, eta);
        let lit = facet.lit & !self.is_delta();
        let D = self.ggx.d(facet.m);
        let (G, visible) = self.ggx.g2_over_4cos_and_density(o, i);
        let F = R::select(facet.reflects, facet.fresnel, R::ONE - facet.fresnel);
        // Over what reflection has, [Walter2007, eq. 20, 14], refraction has 4 |o.m| |i.m| / (eta i.m + o.m)^2 in the value, over
        // eta^2 for radiance, and eta^2 times that in the density. [Walter2007, eq. 21, 17]
        let bend = R::of(4.0) * facet.o_dot_m.abs() * facet.i_dot_m.abs()
            / (eta * facet.i_dot_m + facet.o_dot_m).sqr();
        let bend = R::select(facet.reflects, R::ONE, bend);
        let f = F * D * G * bend;
        let pdf = F * D * visible * bend * R::select(facet.reflects, R::ONE, eta.sqr());
        (Spectrum::splat(f * i.abs_cos_theta()).only_where(lit), pdf.only_where(lit))
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let eta = self.eta_from(wo);
        let o = raised(wo, wo);
        let delta = self.is_delta();
        let m = LocalDir::new(Vec3::select(
            delta,
            vec3(R::ZERO, R::ZERO, R::ONE),
            self.ggx.sample_visible(o, u.dir).v(),
        ));
        let cos_o = o.dot(m).clamp(R::ZERO, R::ONE);
        let (fresnel, cos_t) = fresnel::dielectric(cos_o, eta);
        let reflects = u.lobe.lt(fresnel);
        let refracted = m.v() * (cos_o / eta - cos_t) - o.v() * (R::ONE / eta);
        let i = LocalDir::new(Vec3::select(reflects, o.reflect(m).v(), refracted.normalized()));

        let chosen = R::select(reflects, fresnel, R::ONE - fresnel);
        let through = R::select(reflects, R::ONE, R::ONE / eta.sqr());
        let visible = self.ggx.visible_over_cos(o, m);
        let i_dot_m = i.dot(m);
        let per_wi = R::select(
            reflects,
            R::of(0.25),
            cos_o * i_dot_m.abs() * eta.sqr() / (eta * i_dot_m + cos_o).sqr(),
        );
        let density = R::select(delta, chosen, chosen * visible * per_wi);
        let weight = R::select(delta, R::ONE, self.ggx.g2_over_g1(o, i)) * through;
        // A facet may send light through the macrosurface the wrong way: that light is lost.
        let right_side = R::select(reflects, i.z(), -i.z()).gt(R::ZERO);
        let valid = o.above() & right_side & density.gt(R::ZERO);
        BsdfSample {
            wi: raised(wo, i),
            weight: Spectrum::splat(weight).only_where(valid),
            density: density.only_where(valid),
            eta: R::select(reflects, R::ONE, eta),
            delta,
            valid,
        }
    }

    #[inline(always)]
    fn has_smooth_lobe(&self) -> R::Mask {
        !self.is_delta()
    }

    #[inline(always)]
    fn regularized(self) -> Self {
        Dielectric { ggx: self.ggx.regularized(), ..self }
    }
}
