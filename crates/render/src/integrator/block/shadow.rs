//! Shadow rays of a block: [`Shadows`].

use sparrow_geometry::{Ray, SHADOW_END};
use sparrow_math::{InLanes, Real, Vec3, in_lanes, vec3};
use sparrow_mis::Mis;
use sparrow_spectra::{N_LAMBDA, Spectrum};

use super::column::{Column, load, padded, spectrum, store_spectrum, store_vector, vector};
use super::lights::LightSamples;
use super::paths::Paths;
use super::vertices::Vertices;
use crate::integrator::path::Scattered;
use crate::integrator::{Finder, PathIntegrator, Record};
use crate::scene::Scene;

/// Whose shadow ray it is, and the MIS weight of what arrives.
#[derive(Clone, Copy, Default)]
struct Pending {
    path: u32,
    /// Scattering events before this vertex.
    depth: f32,
    weight: f32,
}

/// Shadow rays to be traced, and what depends on them.
#[derive(Default)]
pub(super) struct Shadows {
    columns: Box<Columns>,
    /// How many there are; there is room for more.
    n: usize,
    rays: Vec<Ray>,
    pending: Vec<Pending>,
    /// What arrives along each, with its MIS weight and before.
    arrives: Vec<[f32; 8]>,
    occluded: Vec<bool>,
    /// Which of them the rays of a batch are.
    places: Vec<u32>,
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
    /// Takes over the light samples of vertices that the BSDF scatters to the viewer; it does so by `f_cos`, and draws these directions
    /// with density `pdf`. Rays follow each other in the order of the samples.
    pub(super) fn push(
        &mut self,
        how: &PathIntegrator,
        vertices: &Vertices,
        lights: &LightSamples,
        (f_cos, pdf): (&[Column; N_LAMBDA], &Column),
    ) {
        let (n, out) = (vertices.len(), &mut *self.columns);
        in_lanes(Arrive { n: padded(n), mis: how.mis, vertices, lights, f_cos, pdf, out });
        // The last place is for what is not lit.
        let (first, nowhere) = (self.n, n as u32);
        let room = first + n + 1;
        if room > self.rays.len() {
            self.rays.resize(room, Ray::new(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 0.0)));
            self.arrives.resize(room, [0.0; 8]);
            self.pending.resize(room, Pending::default());
        }
        self.places.clear();
        self.places.resize(n, nowhere);
        let (mut next, pending) = (0, &mut self.pending[first..room]);
        for k in lights.order.iter().map(|k| *k as usize) {
            if out.lit[k] > 0.0 {
                self.places[k] = next;
                let path = vertices.paths()[k];
                pending[next as usize] = Pending { path, depth: vertices.depth[k], weight: out.weight[k] };
                next += 1;
            }
        }
        self.n += next as usize;
        let (rays, arrives) = (Ray::rows_mut(&mut self.rays[first..]), &mut self.arrives[first..]);
        in_lanes(Ask { columns: out, time: &vertices.time, places: &self.places, rays, arrives });
    }

    /// Traces them, and adds the light that arrives.
    pub(super) fn trace<R: Record>(&mut self, scene: &Scene, paths: &mut Paths<R>) -> u64 {
        let n = core::mem::take(&mut self.n);
        scene.occluded_many(&self.rays[..n], &mut self.occluded);
        let arrived =
            self.pending.iter().zip(&self.arrives).zip(&self.occluded).filter(|(_, occluded)| !**occluded);
        for ((p, [a, b, c, d, unweighted @ ..]), _) in arrived {
            let i = p.path as usize;
            paths.record[i].found(Finder::Light(p.depth as u32), Spectrum(*unweighted), p.weight);
            paths.add(i, Spectrum([*a, *b, *c, *d]));
        }
        n as u64
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

/// Puts shadow rays, and what arrives along them, to their places.
struct Ask<'a> {
    columns: &'a Columns,
    time: &'a Column,
    places: &'a [u32],
    rays: &'a mut [[f32; 8]],
    arrives: &'a mut [[f32; 8]],
}

impl InLanes for Ask<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Ask { columns, time, places, rays, arrives } = self;
        let Columns { o, d, t_max, unweighted, weighted, .. } = columns;
        for (k, places) in (0..).step_by(R::WIDTH).zip(places.chunks(R::WIDTH)) {
            let (o, d) = (vector::<R>(o, k), vector::<R>(d, k));
            R::scatter_rows([o.x, o.y, o.z, d.x, d.y, d.z, load(t_max, k), load(time, k)], rays, places);
            let ([a, b, c, d], u) = (spectrum::<R>(weighted, k).0, spectrum::<R>(unweighted, k).0);
            R::scatter_rows([a, b, c, d, u[0], u[1], u[2], u[3]], arrives, places);
        }
    }
}
