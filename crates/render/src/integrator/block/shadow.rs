//! Shadow rays of a block: [`Shadows`].

use sparrow_geometry::{Ray, SHADOW_END};
use sparrow_math::{InLanes, Real, Vec3, in_lanes};
use sparrow_mis::Mis;
use sparrow_spectra::{N_LAMBDA, Spectrum};

use super::column::{Column, load, padded, spectrum, store_spectrum, store_vector, vector};
use super::lights::LightSamples;
use super::paths::Paths;
use super::vertices::Vertices;
use crate::integrator::path::Scattered;
use crate::integrator::{Finder, PathIntegrator, Record};
use crate::scene::Scene;

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
    columns: Box<Columns>,
    rays: Vec<Ray>,
    pending: Vec<Pending>,
    occluded: Vec<bool>,
}

/// Shadow rays of a batch, and what they bring.
#[derive(Default)]
struct Columns {
    o: [Column; 3],
    d: [Column; 3],
    t_max: Column,
    unweighted: [Column; N_LAMBDA],
    weight: Column,
    weighted: [Column; N_LAMBDA],
    /// 1 where there is something to bring, else 0.
    lit: Column,
}

impl Shadows {
    /// Takes over the light samples of the first `n` vertices that the BSDF scatters to the viewer; it does so by `f_cos`, and draws
    /// these directions with density `pdf`.
    pub(super) fn push<R>(
        &mut self,
        how: &PathIntegrator,
        vertices: &Vertices,
        lights: &LightSamples,
        (f_cos, pdf): (&[Column; N_LAMBDA], &Column),
        (n, paths): (usize, &Paths<'_, R>),
    ) {
        let out = &mut *self.columns;
        in_lanes(Arrive { n: padded(n), mis: how.mis, vertices, lights, f_cos, pdf, out });
        for (k, &path) in vertices.path[..n].iter().enumerate() {
            if out.lit[k] > 0.0 {
                let i = path as usize;
                self.rays.push(Ray {
                    o: vector(&out.o, k),
                    d: vector(&out.d, k),
                    t_max: out.t_max[k],
                    time: paths.ray[i].time,
                });
                self.pending.push(Pending {
                    path,
                    depth: paths.depth[i],
                    unweighted: spectrum(&out.unweighted, k),
                    weight: out.weight[k],
                    weighted: spectrum(&out.weighted, k),
                });
            }
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

/// Shadow rays, and what arrives if nothing is in their way.
struct Arrive<'a> {
    n: usize,
    mis: Mis,
    vertices: &'a Vertices,
    lights: &'a LightSamples,
    f_cos: &'a [Column; N_LAMBDA],
    pdf: &'a Column,
    out: &'a mut Columns,
}

impl InLanes for Arrive<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Arrive { n, mis, vertices, lights, f_cos, pdf, out } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let (f_cos, p_light) = (spectrum::<R>(f_cos, k), load::<R>(&lights.pdf, k));
            let lit = p_light.gt(R::ZERO) & !f_cos.is_black();
            let delta = load::<R>(&lights.delta, k).gt(R::ZERO);
            let p_bsdf = load::<R>(&vertices.ways, k) * load(pdf, k);
            let s = Scattered::new(mis, (p_light, delta), spectrum(&lights.radiance, k), f_cos, p_bsdf);
            let beta = spectrum::<R>(&vertices.beta, k);
            store_spectrum(beta * s.unweighted, &mut out.unweighted, k);
            store_spectrum(beta * s.weighted, &mut out.weighted, k);
            s.weight.store(&mut out.weight[..], k);
            R::ONE.only_where(lit).store(&mut out.lit[..], k);

            let (from, wi) = (vertices.at.get::<R>(k), vector::<R>(&lights.wi, k));
            let (o, d) = from.segment_to(&lights.end.get(k));
            let endless = load::<R>(&lights.endless, k).gt(R::ZERO);
            store_vector(Vec3::select(endless, from.towards(wi), o), &mut out.o, k);
            store_vector(Vec3::select(endless, wi, d), &mut out.d, k);
            let t_max = R::select(endless, R::of(f64::INFINITY), R::of(f64::from(SHADOW_END)));
            t_max.store(&mut out.t_max[..], k);
        }
    }
}
