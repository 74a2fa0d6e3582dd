//! Vertices of one material, worked off together: [`Batch`].

use sparrow_geometry::{Hit, Ray};
use sparrow_math::in_lanes;
use sparrow_models::ModelKind;
use sparrow_models::batch::{DirColumns, EvalColumns, SampleColumns, f_cos_pdf, sample};
use sparrow_spectra::{N_LAMBDA, Wavelengths};

use super::column::{Column, pad, padded, put_spectrum, put_vector, spectrum, vector};
use super::lanes::{ToLocal, ToWorld};
use super::lights::LightSamples;
use super::onward::{Blind, Decide, Directions, Leave, Next, Onward};
use super::paths::{Paths, Steps};
use super::shadow::Shadows;
use super::vertices::Vertices;
use crate::integrator::path::{light_dimension, scatter_dimension};
use crate::integrator::{PathIntegrator, Record};
use crate::material::{MaterialColumns, Points};
use crate::roulette::Roulette;
use crate::sampler::{Draw, PixelSampler, Sampler};
use crate::scatter::{Density, Scatter};
use crate::scene::{Scene, fibre_offset};
use crate::texture::TextureContext;

/// Fewer vertices than this are worked off one by one.
pub(super) const FEW: usize = 4;

/// What vertices of a batch have in common: the material, and whether its narrow lobes are widened.
pub(super) fn key(material: u32, regularized: bool) -> u32 {
    2 * material + u32::from(regularized)
}

/// The key, behind all others, of paths that meet surfaces of no material.
pub(super) fn passes(scene: &Scene) -> u32 {
    2 * scene.n_materials() as u32
}

/// Vertices of one material.
#[derive(Default)]
pub(super) struct Batch {
    vertices: Box<Vertices>,
    lights: Box<LightSamples>,
    /// The models of vertices that are scattered one by one; empty where that is done in lanes.
    models: Vec<Scatter>,
    kind: Option<ModelKind>,
    /// For textures.
    lambda: Vec<Wavelengths>,
    contexts: Vec<TextureContext>,
    columns: Box<Columns>,
}

/// What is worked out at the vertices, in columns.
#[derive(Default)]
struct Columns {
    material: MaterialColumns,
    /// Offsets across fibres.
    h: Column,
    frame: [[Column; 3]; 3],
    wo_local: [Column; 3],
    wi_light_local: [Column; 3],
    f_cos: [Column; N_LAMBDA],
    pdf: Column,
    numbers: Numbers,
    /// Where paths go on.
    wi_local: [Column; 3],
    drawn: Directions,
    next: Next,
}

/// The uniform numbers of vertices.
#[derive(Default)]
struct Numbers {
    light: Column,
    on_light: [Column; 2],
    lobe: Column,
    direction: [Column; 2],
    roulette: Column,
}

impl Batch {
    /// Takes the vertices of `paths` numbered `which`, all with that key, and draws their uniform numbers.
    pub(super) fn begin<R: Record + Default>(
        &mut self,
        scene: &Scene,
        how: &PathIntegrator,
        sampler: &Sampler,
        (paths, hits): (&mut Paths<R>, &[Option<Hit>]),
        (key, which): (u32, &[u32]),
    ) {
        let (numbers, steps) = (&paths.numbers[..], &paths.steps[..paths.numbers.len()]);
        let at = |k: usize| {
            let i = which[k] as usize;
            sampler.resume(numbers[i], light_dimension(steps[i].depth))
        };
        let choices = scene.lights().len() > 1 || how.mis.takes_turns();
        let roulette = which.iter().any(|&i| paths.steps[i as usize].depth > 0);
        self.columns.numbers.fill(sampler, which.len(), at, (choices, roulette));
        self.vertices.gather(scene, how, paths, hits, (scene.material(key / 2), which));
    }

    /// Samples a light at each vertex.
    pub(super) fn sample_lights<R>(&mut self, scene: &Scene, how: &PathIntegrator, paths: &Paths<R>) {
        let (vertices, numbers, n) = (&*self.vertices, &mut self.columns.numbers, self.vertices.len());
        self.lights.clear(n);
        if how.mis.takes_turns() {
            for (k, u) in numbers.light[..n].iter_mut().enumerate() {
                let turn = how.mis.turn(*u);
                *u = turn.u;
                (self.lights.asked[k], self.lights.looks[k]) = (turn.light, f32::from(u8::from(turn.bsdf)));
            }
        } else {
            let turn = how.mis.turn(0.0);
            self.lights.asked.fill(turn.light);
            self.lights.looks[..n].fill(f32::from(u8::from(turn.bsdf)));
        }
        if how.splits > 1 {
            // The light of a first vertex belongs to the first way on.
            let path = |k: usize| vertices.paths()[k] as usize;
            let own = |k: usize| paths.steps[path(k)].depth > 0 || paths.way[path(k)] == 0;
            self.lights.asked.iter_mut().enumerate().for_each(|(k, asked)| *asked &= own(k));
        }
        numbers.on_light.iter_mut().for_each(|c| pad(c, n));
        pad(&mut numbers.light, n);
        let lambda = |path: u32| paths.lambda(path as usize);
        self.lights.sample(scene, lambda, vertices, (&numbers.light, &numbers.on_light));
    }

    /// Evaluates the parameters of the material, and turns directions to local frames.
    pub(super) fn bind<R>(
        &mut self,
        scene: &Scene,
        (paths, hits): (&mut Paths<R>, &[Option<Hit>]),
        key: u32,
    ) {
        let (material, regularized) = (scene.material(key / 2), key % 2 == 1);
        let (vertices, n) = (&*self.vertices, self.vertices.len());
        self.models.clear();
        self.lambda.clear();
        self.contexts.clear();
        self.kind = (n >= FEW && !regularized).then_some(material.kind);
        if self.kind.is_none() || material.textured {
            for (k, &path) in vertices.paths().iter().enumerate() {
                let i = path as usize;
                let Some(hit) = &hits[i] else { continue };
                let point = vertices.point(k, hit);
                if self.kind.is_some() {
                    self.lambda.push(paths.lambda(i));
                    self.contexts.push(scene.texture_context_of(material, &point));
                } else if let Some(model) = scene.scatter(&point, &mut paths.lambda(i)) {
                    self.models.push(if regularized { model.regularized() } else { model });
                }
            }
        }
        let Some(kind) = self.kind else { return };
        let points = Points { n, nm: &vertices.nm, lambda: &self.lambda, contexts: &self.contexts };
        self.columns.material.bind(material, scene.textures(), &points);
        let fibre = matches!(kind, ModelKind::Fibre(_));
        if fibre {
            self.columns.h.iter_mut().zip(&vertices.v()[..n]).for_each(|(h, v)| *h = fibre_offset(*v));
            pad(&mut self.columns.h, n);
        }
        let Columns { frame, wo_local, wi_light_local, .. } = &mut *self.columns;
        self.lights.wi.iter_mut().for_each(|c| pad(c, n));
        in_lanes(ToLocal {
            n: padded(n),
            fibre,
            ns: &vertices.ns,
            tangent: &vertices.tangent,
            world: [&vertices.wo, &self.lights.wi],
            frame,
            local: [wo_local, wi_light_local],
        });
    }

    /// Hands over what arrives from the light samples, by way of shadow rays.
    pub(super) fn direct(&mut self, how: &PathIntegrator, shadows: &mut Shadows) {
        let (n, columns) = (self.vertices.len(), &mut *self.columns);
        if self.lights.order.is_empty() {
            return;
        }
        for (k, model) in self.models.iter().enumerate() {
            let (f_cos, pdf) = model.f_cos_pdf(vector(&self.vertices.wo, k), vector(&self.lights.wi, k));
            put_spectrum(&mut columns.f_cos, k, f_cos);
            columns.pdf[k] = pdf;
        }
        if let Some(kind) = self.kind {
            columns.f_cos_pdf(kind, &self.vertices.nm, padded(n));
        }
        shadows.push(how, &self.vertices, &self.lights, (&columns.f_cos, &columns.pdf));
    }

    /// The next direction of each path; the path is among those `ended` where there is none, where roulette says so, or where its last
    /// ray can meet no light. Says how many such rays there are.
    pub(super) fn scatter<'b, R: Record + Default>(
        &mut self,
        (scene, how): (&Scene, &PathIntegrator),
        (paths, ended): (&mut Paths<R>, &mut Vec<u32>),
        roulette: Option<impl Fn([u32; 2]) -> Roulette<'b>>,
    ) -> u64 {
        let (columns, vertices, n) = (&mut *self.columns, &*self.vertices, self.vertices.len());
        match self.kind {
            Some(kind) => columns.sample(kind, &vertices.nm, n),
            None => columns.sample_alone(&self.models, vertices),
        }
        let Columns { drawn, next, numbers, .. } = columns;
        in_lanes(Onward { n: padded(n), vertices, drawn, next });
        if let Some(roulette) = roulette {
            for (k, &path) in vertices.paths().iter().enumerate() {
                let (p, beta) = (vector(&vertices.at.p, k), spectrum(&next.beta, k));
                let here = roulette(paths.place[path as usize].pixel);
                next.survival[k] = here.at_least(next.survival[k], p, beta);
            }
        }
        let (depth, max_depth) = (&vertices.depth, how.max_depth);
        in_lanes(Decide { n: padded(n), depth, u: &numbers.roulette, next });
        let emitters =
            scene.lights().emitters().filter(|_| depth[..n].iter().any(|d| *d as u32 + 1 >= max_depth));
        if let Some(emitters) = emitters {
            in_lanes(Blind { n: padded(n), emitters, max_depth, depth, drawn, next });
        }
        in_lanes(Leave {
            vertices,
            looks: &self.lights.looks,
            drawn,
            next,
            rays: Ray::rows_mut(&mut paths.ray),
            carried: &mut paths.carried,
            behind: &mut paths.behind,
        });
        let mut n_blind = 0;
        for (k, &path) in vertices.paths().iter().enumerate() {
            let i = path as usize;
            if next.goes_on[k] <= 0.0 {
                ended.push(path);
                if emitters.is_some() && next.blind[k] > 0.0 {
                    paths.record[i].goes_on(vector(&vertices.at.p, k), spectrum(&next.beta, k));
                    n_blind += 1;
                }
                continue;
            }
            let Steps { depth, n_smooth, .. } = paths.steps[i];
            let smooth = u32::from(drawn.delta[k] <= 0.0);
            let eta_scale = next.eta_scale[k];
            paths.steps[i] = Steps { depth: depth + 1, n_smooth: n_smooth + smooth, eta_scale };
            paths.record[i].goes_on(vector(&vertices.at.p, k), spectrum(&next.beta, k));
        }
        n_blind
    }
}

impl Numbers {
    /// Those of `n` vertices, whose dimensions begin where `at` gives; those that choose lights, and those that end paths, only where asked.
    fn fill<'p>(
        &mut self,
        sampler: &Sampler,
        n: usize,
        at: impl Fn(usize) -> PixelSampler<'p>,
        (choices, roulette): (bool, bool),
    ) {
        let scatter = scatter_dimension(0) - light_dimension(0);
        let Numbers { light, on_light: [u, v], lobe, direction, roulette: last } = self;
        let light = if choices {
            Draw::Three(0, [&mut light[..], &mut u[..], &mut v[..]])
        } else {
            Draw::Two(1, [&mut u[..], &mut v[..]])
        };
        let [x, y] = direction;
        let mut draws = [
            light,
            Draw::Three(scatter, [&mut lobe[..], &mut x[..], &mut y[..]]),
            Draw::One(scatter + 3, &mut last[..]),
        ];
        let n_draws = draws.len() - usize::from(!roulette);
        sampler.fill(n, at, &mut draws[..n_draws]);
    }
}

impl Columns {
    /// Evaluates the model at the first `n` vertices.
    fn f_cos_pdf(&mut self, kind: ModelKind, nm: &[Column; N_LAMBDA], n: usize) {
        let params = self.material.params(n, nm, &self.h);
        let (wo, wi) = (directions(&self.wo_local, n), directions(&self.wi_light_local, n));
        let out =
            &mut EvalColumns { f_cos: self.f_cos.each_mut().map(|c| &mut c[..n]), pdf: &mut self.pdf[..n] };
        match kind {
            ModelKind::Surface(kind) => f_cos_pdf(kind, &params, &wo, &wi, out),
            ModelKind::Fibre(kind) => f_cos_pdf(kind, &params, &wo, &wi, out),
        }
    }

    /// Samples the model at `n` vertices.
    fn sample(&mut self, kind: ModelKind, nm: &[Column; N_LAMBDA], n: usize) {
        let Numbers { lobe, direction: [u, v], .. } = &mut self.numbers;
        [&mut *lobe, &mut *u, &mut *v].into_iter().for_each(|c| pad(c, n));
        let n = padded(n);
        let params = self.material.params(n, nm, &self.h);
        let wo = directions(&self.wo_local, n);
        let u = [&lobe[..n], &u[..n], &v[..n]];
        let drawn = &mut self.drawn;
        let out = &mut SampleColumns {
            wi: self.wi_local.each_mut().map(|c| &mut c[..n]),
            weight: drawn.weight.each_mut().map(|c| &mut c[..n]),
            density: &mut drawn.density[..n],
            eta: &mut drawn.eta[..n],
            delta: &mut drawn.delta[..n],
        };
        match kind {
            ModelKind::Surface(kind) => sample(kind, &params, &wo, &u, out),
            ModelKind::Fibre(kind) => sample(kind, &params, &wo, &u, out),
        }
        in_lanes(ToWorld { n, frame: &self.frame, local: &self.wi_local, world: &mut drawn.wi });
    }

    /// Samples models one by one.
    fn sample_alone(&mut self, models: &[Scatter], vertices: &Vertices) {
        let Columns { numbers: Numbers { lobe, direction: [u, v], .. }, drawn, .. } = self;
        for (k, model) in models.iter().enumerate() {
            drawn.density[k] = 0.0;
            let Some(s) = model.sample(vector(&vertices.wo, k), lobe[k], [u[k], v[k]]) else { continue };
            put_vector(&mut drawn.wi, k, s.wi);
            put_spectrum(&mut drawn.weight, k, s.weight);
            drawn.eta[k] = s.eta;
            (drawn.density[k], drawn.delta[k]) = match s.density {
                Density::SolidAngle(pdf) => (pdf, 0.0),
                Density::Delta(probability) => (probability, 1.0),
            };
        }
    }
}

fn directions(columns: &[Column; 3], n: usize) -> DirColumns<'_> {
    DirColumns { x: &columns[0][..n], y: &columns[1][..n], z: &columns[2][..n] }
}
