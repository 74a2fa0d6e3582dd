//! The path tracer: next-event estimation and BSDF sampling joined by MIS.

use sparrow_geometry::{Ray, SurfacePoint};
use sparrow_math::{Real, Vec3};
use sparrow_mis::Mis;
use sparrow_scene::{IntegratorDesc, IntegratorName, RouletteName};
use sparrow_spectra::{Spectrum, Wavelengths};

use super::{Finder, RayCounts, Record};
use crate::light::LitPoint;
use crate::roulette::Roulette;
use crate::sampler::PixelSampler;
use crate::scatter::{Density, Scatter};
use crate::scene::{LastVertex, Scene};

/// Dimensions of the sampler that come before the first bounce: wavelength, time and lens.
const FIRST_BOUNCE: u32 = 4;
/// Dimensions of one bounce: light (3), direction (3), roulette (1).
const PER_BOUNCE: u32 = 7;

/// Dimensions of the bounce at a vertex: the choice of a light and a point of it, drawn as one point.
pub(super) fn light_dimension(depth: u32) -> u32 {
    FIRST_BOUNCE + depth * PER_BOUNCE
}

/// Dimensions of the way on from a vertex: lobe and direction, drawn as one point, and roulette.
pub(super) fn scatter_dimension(depth: u32) -> u32 {
    light_dimension(depth) + 3
}

/// One path at a time. [Kajiya1986], [Veach1997, ch. 9, 10]
#[derive(Clone, Copy, Debug)]
pub struct PathIntegrator {
    /// Most scattering events.
    pub max_depth: u32,
    /// Most scattering events by lobes that are no delta: 1 for direct lighting.
    pub max_smooth: u32,
    /// How light and BSDF sampling share the work.
    pub mis: Mis,
    /// Narrow lobes are widened after the first one that is no delta.
    pub regularize: bool,
    /// What Russian roulette goes by.
    pub roulette: RouletteName,
    /// Ways on from the first vertex of each camera sample.
    pub splits: u32,
}

impl PathIntegrator {
    /// From a description.
    pub fn new(desc: &IntegratorDesc) -> PathIntegrator {
        let direct = desc.name == IntegratorName::DirectLighting;
        PathIntegrator {
            max_depth: desc.max_depth,
            max_smooth: if direct { 1 } else { u32::MAX },
            mis: desc.mis,
            regularize: desc.regularize,
            roulette: desc.roulette,
            splits: 1,
        }
    }

    /// Directions that a vertex draws, as a number.
    #[inline]
    pub(super) fn ways_on(&self, depth: u32) -> f32 {
        if depth == 0 { self.splits as f32 } else { 1.0 }
    }

    /// Radiance that arrives along `ray`, at the path's wavelengths; `record` is told of each light that is found.
    #[allow(clippy::too_many_arguments, reason = "what a path needs and what it leaves behind")]
    pub fn radiance(
        &self,
        scene: &Scene,
        ray: Ray,
        lambda: &mut Wavelengths,
        sampler: &mut PixelSampler<'_>,
        rays: &mut RayCounts,
        record: &mut impl Record,
        roulette: Roulette<'_>,
    ) -> Spectrum<f32> {
        let one = PathIntegrator { splits: 1, ..*self };
        one.radiance_of_way(0, scene, ray, lambda, sampler, rays, record, roulette)
    }

    /// The part of one way on of [`splits`](Self::splits); the light of the first vertex belongs to the first way.
    #[allow(clippy::too_many_arguments, reason = "which part, and what a path needs")]
    pub(crate) fn radiance_of_way(
        &self,
        way: u32,
        scene: &Scene,
        mut ray: Ray,
        lambda: &mut Wavelengths,
        sampler: &mut PixelSampler<'_>,
        rays: &mut RayCounts,
        record: &mut impl Record,
        roulette: Roulette<'_>,
    ) -> Spectrum<f32> {
        let (mut l, mut beta) = (Spectrum::ZERO, Spectrum::ONE);
        let mut last: Option<LastVertex> = None;
        let (mut depth, mut n_smooth, mut eta_scale) = (0u32, 0, 1.0);
        loop {
            let hit = scene.intersect(&ray);
            // The light of the first vertex belongs to the first way on; a vertex has `n` of them.
            let (own, n) = (depth > 0 || way == 0, self.ways_on(depth));
            rays.scattered += u64::from(own);
            let by = depth.checked_sub(1).map_or(Finder::Camera, Finder::Bsdf);
            let found = |light, w| record.found(by, beta * light, w);
            if own {
                l += beta * scene.emitted(&ray, hit.as_ref(), last.as_ref(), self.mis, lambda, found);
            }

            let Some(point) = hit else { break };
            if depth == self.max_depth || n_smooth == self.max_smooth {
                break;
            }
            let wo = -ray.d;
            let Some(mut bsdf) = scene.scatter(&point, lambda) else {
                ray = point.spawn(ray.d);
                continue;
            };
            if self.regularize && n_smooth > 0 {
                bsdf = bsdf.regularized();
            }

            // Direct light.
            sampler.set_dimension(light_dimension(depth));
            let [choice, u, v] = sampler.get_3d();
            let turn = self.mis.turn(choice);
            if own && turn.light && bsdf.has_smooth_lobe() {
                let found = |light, w| record.found(Finder::Light(depth), beta * light, w);
                l += beta * self.direct(scene, &point, &bsdf, wo, n, lambda, turn.u, [u, v], rays, found);
            }

            // Next vertex.
            sampler.set_dimension(scatter_dimension(depth));
            let [lobe, u, v] = sampler.get_3d();
            let Some(s) = bsdf.sample(wo, lobe, [u, v]) else { break };
            (beta, eta_scale) = carried((beta, eta_scale), s.weight, s.eta, n);
            match s.density {
                Density::SolidAngle(pdf) => {
                    n_smooth += 1;
                    let pdf = if turn.bsdf { n * pdf } else { 0.0 };
                    last = Some(LastVertex { at: LitPoint { p: point.p, n: point.ns }, pdf });
                }
                Density::Delta(_) => last = None,
            }
            ray = point.spawn(s.wi);
            depth += 1;

            // Roulette.
            let survival = roulette.survival(point.p, beta, eta_scale);
            if survival < 1.0 && depth > 1 {
                if sampler.get_1d() >= survival {
                    break;
                }
                beta *= 1.0 / survival;
            }
            record.goes_on(point.p, beta);
        }
        l
    }

    /// Light from one sampled light, scattered into `wo`; `found` is told what it is before its weight, and that weight.
    #[allow(clippy::too_many_arguments, reason = "the state of one path vertex")]
    #[inline]
    fn direct(
        &self,
        scene: &Scene,
        point: &SurfacePoint,
        bsdf: &Scatter,
        wo: Vec3<f32>,
        n: f32,
        lambda: &Wavelengths,
        choice: f32,
        on_light: [f32; 2],
        rays: &mut RayCounts,
        found: impl FnOnce(Spectrum<f32>, f32),
    ) -> Spectrum<f32> {
        let at = LitPoint { p: point.p, n: point.ns };
        let Some(light) = scene.sample_light(&at, choice, on_light, lambda) else {
            return Spectrum::ZERO;
        };
        let (f_cos, pdf) = bsdf.f_cos_pdf(wo, light.wi);
        if f_cos.is_black() {
            return Spectrum::ZERO;
        }
        rays.shadow += 1;
        if !scene.unoccluded(point, &light) {
            return Spectrum::ZERO;
        }
        let s = Scattered::new(self.mis, (light.pdf, light.delta), light.radiance, f_cos, n * pdf);
        found(s.unweighted, s.weight);
        s.weighted
    }
}

/// What a path carries behind a vertex, and the factor that undoes the squeeze of refraction, where it draws one of `ways` directions.
#[inline(always)]
pub(super) fn carried<R: Real>(
    (beta, eta_scale): (Spectrum<R>, R),
    weight: Spectrum<R>,
    eta: R,
    ways: R,
) -> (Spectrum<R>, R) {
    (beta * (weight * (R::ONE / ways)), eta_scale * (eta * eta * ways))
}

/// What a light that is seen adds at a vertex.
pub(super) struct Scattered<R> {
    /// `f_cos L / p_light`
    pub(super) unweighted: Spectrum<R>,
    /// The MIS weight.
    pub(super) weight: R,
    /// Their product.
    pub(super) weighted: Spectrum<R>,
}

impl<R: Real> Scattered<R> {
    /// From the density of the light sample, and whether no direction finds it by chance; its radiance; value times cosine towards it;
    /// and the density with which the BSDF draws that direction, times how often.
    #[inline(always)]
    pub(super) fn new(
        mis: Mis,
        (p_light, delta): (R, R::Mask),
        radiance: Spectrum<R>,
        f_cos: Spectrum<R>,
        p_bsdf: R,
    ) -> Scattered<R> {
        let shared = mis.light_weight(p_light, p_bsdf);
        let weight = R::select(delta, R::of(f64::from(mis.delta_weight())), shared);
        let arrives = f_cos * radiance;
        Scattered { unweighted: arrives * (R::ONE / p_light), weight, weighted: arrives * (weight / p_light) }
    }
}
