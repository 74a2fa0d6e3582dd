//! Shadow rays of a block: [`Shadows`].

use sparrow_geometry::{Ray, SurfacePoint};
use sparrow_spectra::Spectrum;

use super::batch::Batch;
use super::paths::Paths;
use crate::integrator::path::Scattered;
use crate::integrator::{Finder, PathIntegrator, Record};
use crate::scene::{Scene, shadow_ray};

/// What a path gets where its shadow ray arrives.
struct Pending {
    path: u32,
    /// Scattering events before this vertex.
    depth: u32,
    /// Before the MIS weight.
    unweighted: Spectrum<f32>,
    weight: f32,
    weighted: Spectrum<f32>,
}

/// Shadow rays to be traced, and what depends on them.
#[derive(Default)]
pub(super) struct Shadows {
    rays: Vec<Ray>,
    pending: Vec<Pending>,
    occluded: Vec<bool>,
}

impl Shadows {
    /// Takes over the light samples of a batch that the BSDF scatters to the viewer.
    pub(super) fn push<R>(
        &mut self,
        how: &PathIntegrator,
        batch: &Batch<'_>,
        paths: &Paths<'_, R>,
        points: &[Option<SurfacePoint>],
    ) {
        for (k, light) in batch.lights.iter().enumerate() {
            let i = batch.path[k] as usize;
            let (f_cos, pdf) = batch.value(k);
            let Some(point) = points[i].as_ref().filter(|_| !f_cos.is_black()) else { continue };
            let s = Scattered::new(how.mis, light, f_cos, how.ways_on(paths.depth[i]) * pdf);
            let beta = paths.beta[i];
            self.rays.push(shadow_ray(point, light));
            self.pending.push(Pending {
                path: i as u32,
                depth: paths.depth[i],
                unweighted: beta * s.unweighted,
                weight: s.weight,
                weighted: beta * s.weighted,
            });
        }
    }

    /// Traces them, and adds the light that arrives.
    pub(super) fn trace<R: Record>(&mut self, scene: &Scene, paths: &mut Paths<'_, R>) -> u64 {
        scene.occluded_many(&self.rays, &mut self.occluded);
        for (p, _) in self.pending.iter().zip(&self.occluded).filter(|(_, occluded)| !**occluded) {
            let i = p.path as usize;
            paths.record[i].found(Finder::Light(p.depth), p.unweighted, p.weight);
            paths.l[i] += p.weighted;
        }
        let n = self.rays.len() as u64;
        self.rays.clear();
        self.pending.clear();
        n
    }
}
