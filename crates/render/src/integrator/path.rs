//! The path tracer: next-event estimation and BSDF sampling joined by MIS.

use sparrow_geometry::{Ray, SurfacePoint};
use sparrow_math::Vec3;
use sparrow_mis::Mis;
use sparrow_scene::{IntegratorDesc, IntegratorName};
use sparrow_spectra::{Spectrum, Wavelengths};

use super::RayCounts;
use crate::light::LitPoint;
use crate::sampler::PixelSampler;
use crate::scatter::{Density, Scatter};
use crate::scene::{LastVertex, Scene};

/// Dimensions of the sampler that come before the first bounce: wavelength, time and lens.
const FIRST_BOUNCE: u32 = 4;
/// Dimensions of one bounce: light (1 + 2), direction (1 + 2), roulette (1).
const PER_BOUNCE: u32 = 7;

/// Probability with which a path goes on that carries `carried` of what it began with.
///
/// Paths are ended only when they have lost more than half: ending them in proportion to what they lost, as pbrt-v4
/// does, costs a third more error on diffuse scenes for the same time (`docs/performance.md`).
fn roulette(carried: f32) -> f32 {
    if carried < 1.0 { (2.0 * carried).min(0.95) } else { 1.0 }
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
        }
    }

    /// Radiance that arrives along `ray`, at the path's wavelengths.
    pub fn radiance(
        &self,
        scene: &Scene,
        mut ray: Ray,
        lambda: &mut Wavelengths,
        sampler: &mut PixelSampler<'_>,
        rays: &mut RayCounts,
    ) -> Spectrum<f32> {
        let (mut l, mut beta) = (Spectrum::ZERO, Spectrum::ONE);
        let mut last: Option<LastVertex> = None;
        let (mut depth, mut n_smooth, mut eta_scale) = (0, 0, 1.0);
        loop {
            let hit = scene.intersect(&ray);
            rays.scattered += 1;
            l += beta * scene.emitted(&ray, hit.as_ref(), last.as_ref(), self.mis, lambda);

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
            sampler.set_dimension(FIRST_BOUNCE + depth * PER_BOUNCE);
            let turn = self.mis.turn(sampler.get_1d());
            if turn.light && bsdf.has_smooth_lobe() {
                l += beta * self.direct(scene, &point, &bsdf, wo, lambda, turn.u, sampler, rays);
            }

            // Next vertex.
            sampler.set_dimension(FIRST_BOUNCE + depth * PER_BOUNCE + 3);
            let (lobe, dir) = (sampler.get_1d(), sampler.get_2d());
            let Some(s) = bsdf.sample(wo, lobe, dir) else { break };
            beta *= s.weight;
            eta_scale *= s.eta * s.eta;
            match s.density {
                Density::SolidAngle(pdf) => {
                    n_smooth += 1;
                    let pdf = if turn.bsdf { pdf } else { 0.0 };
                    last = Some(LastVertex { at: LitPoint { p: point.p, n: point.ns }, pdf });
                }
                Density::Delta(_) => last = None,
            }
            ray = point.spawn(s.wi);
            depth += 1;

            // Roulette, on what the path carries apart from the squeeze of refraction.
            let survival = roulette((beta * eta_scale).max_value());
            if survival < 1.0 && depth > 1 {
                if sampler.get_1d() >= survival {
                    break;
                }
                beta *= 1.0 / survival;
            }
        }
        l
    }

    /// Light from one sampled light, scattered into `wo`.
    #[allow(clippy::too_many_arguments, reason = "the state of one path vertex")]
    #[inline]
    fn direct(
        &self,
        scene: &Scene,
        point: &SurfacePoint,
        bsdf: &Scatter,
        wo: Vec3<f32>,
        lambda: &Wavelengths,
        choice: f32,
        sampler: &mut PixelSampler<'_>,
        rays: &mut RayCounts,
    ) -> Spectrum<f32> {
        let at = LitPoint { p: point.p, n: point.ns };
        let Some(light) = scene.sample_light(&at, choice, sampler.get_2d(), lambda) else {
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
        let w = if light.delta { 1.0 } else { self.mis.light_weight(light.pdf, pdf) };
        f_cos * light.radiance * (w / light.pdf)
    }
}
