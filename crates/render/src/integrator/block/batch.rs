//! Vertices of one material, worked off together: [`Batch`].

use sparrow_geometry::SurfacePoint;
use sparrow_math::in_lanes;
use sparrow_models::ModelKind;
use sparrow_models::batch::{DirColumns, EvalColumns, SampleColumns, f_cos_pdf, sample};
use sparrow_spectra::{N_LAMBDA, Spectrum, Wavelengths};

use super::column::{Column, pad, padded, put_spectrum, put_vector, spectrum, vector};
use super::lanes::{ToLocal, ToWorld};
use super::lights::{LightChoice, LightChoices};
use super::paths::Paths;
use crate::integrator::path::{light_dimension, scatter_dimension};
use crate::integrator::{PathIntegrator, Record};
use crate::light::{LightSample, LitPoint};
use crate::material::{MaterialColumns, Points};
use crate::roulette::Roulette;
use crate::sampler::{PixelSampler, Sampler};
use crate::scatter::{Density, Scatter, ScatterSample};
use crate::scene::{Scene, fibre_offset};
use crate::texture::TextureContext;

/// Fewer vertices than this are worked off one by one.
pub(super) const FEW: usize = 4;

/// What vertices of a batch have in common: the material, and whether its narrow lobes are widened.
pub(super) fn key(material: u32, regularized: bool) -> u32 {
    2 * material + u32::from(regularized)
}

/// Vertices of one material. Those that a light may reach come first.
#[derive(Default)]
pub(super) struct Batch<'a> {
    samplers: Vec<PixelSampler<'a>>,
    /// The path of each vertex.
    pub(super) path: Vec<u32>,
    /// Light samples of the first vertices.
    pub(super) lights: Vec<LightSample>,
    /// Where the numbers of each vertex stand.
    numbers_of: Vec<u32>,
    choices: LightChoices,
    /// Vertices without, and where their numbers stand.
    unlit: Vec<(u32, u32)>,
    /// The models of vertices that are scattered one by one; empty where that is done in lanes.
    models: Vec<Scatter>,
    kind: Option<ModelKind>,
    lambda: Vec<Wavelengths>,
    contexts: Vec<TextureContext>,
    columns: Box<Columns>,
}

/// What is known of the vertices, in columns.
#[derive(Default)]
struct Columns {
    material: MaterialColumns,
    /// Wavelengths in nm.
    nm: [Column; N_LAMBDA],
    /// Offsets across fibres.
    h: Column,
    ns: [Column; 3],
    tangent: [Column; 3],
    /// To the viewer and to the light.
    wo: [Column; 3],
    wi_light: [Column; 3],
    frame: [[Column; 3]; 3],
    wo_local: [Column; 3],
    wi_light_local: [Column; 3],
    f_cos: [Column; N_LAMBDA],
    pdf: Column,
    numbers: Numbers,
    u: [Column; 3],
    /// Where paths go on.
    wi_local: [Column; 3],
    wi: [Column; 3],
    weight: [Column; N_LAMBDA],
    density: Column,
    eta: Column,
    delta: Column,
}

/// The uniform numbers of vertices, in the order in which they came.
#[derive(Default)]
struct Numbers {
    light: Column,
    on_light: [Column; 2],
    lobe: Column,
    direction: [Column; 2],
    roulette: Column,
}

impl<'a> Batch<'a> {
    /// Draws the uniform numbers of each vertex.
    pub(super) fn draw<R>(
        &mut self,
        scene: &Scene,
        how: &PathIntegrator,
        sampler: &Sampler,
        paths: &Paths<'a, R>,
        vertices: &[u32],
    ) {
        let at = |&i: &u32| paths.sampler[i as usize].at(light_dimension(paths.depth[i as usize]));
        self.samplers.clear();
        self.samplers.extend(vertices.iter().map(at));
        let choices = scene.lights().len() > 1 || how.mis.takes_turns();
        self.columns.numbers.fill(sampler, &self.samplers, choices);
    }

    /// Draws a light for each vertex, and puts those first that got one.
    pub(super) fn sample_lights<R>(
        &mut self,
        scene: &Scene,
        how: &PathIntegrator,
        paths: &mut Paths<'_, R>,
        points: &[Option<SurfacePoint>],
        vertices: &[u32],
    ) {
        self.path.clear();
        self.lights.clear();
        self.unlit.clear();
        self.numbers_of.clear();
        self.choices.clear(scene.lights().len());
        let Columns { numbers, wi_light, .. } = &mut *self.columns;
        for (j, &path) in vertices.iter().enumerate() {
            let i = path as usize;
            let Some(point) = &points[i] else { continue };
            let turn = how.mis.turn(numbers.light[j]);
            paths.looks[i] = turn.bsdf;
            let at = LitPoint { p: point.p, n: point.ns };
            let choose = || scene.lights().choose(&at, turn.u);
            // The light of a first vertex belongs to the first way on.
            let own = paths.depth[i] > 0 || paths.way[i] == 0;
            match (own && turn.light).then(choose).flatten() {
                Some((light, probability)) => {
                    let u = numbers.on_light.each_ref().map(|c| c[j]);
                    self.choices.push(light, LightChoice { vertex: j as u32, path, at, u, probability });
                }
                None => self.unlit.push((path, j as u32)),
            }
        }
        self.choices.draw(scene, &paths.lambda, |choice, light| match light {
            Some(light) => {
                put_vector(wi_light, self.path.len(), light.wi);
                self.lights.push(light);
                self.path.push(choice.path);
                self.numbers_of.push(choice.vertex);
            }
            None => self.unlit.push((choice.path, choice.vertex)),
        });
        self.path.extend(self.unlit.iter().map(|(path, _)| path));
        self.numbers_of.extend(self.unlit.iter().map(|(_, j)| j));
    }

    /// Evaluates the parameters of the material, and turns directions to local frames.
    pub(super) fn bind<R>(
        &mut self,
        scene: &Scene,
        paths: &mut Paths<'_, R>,
        points: &[Option<SurfacePoint>],
        key: u32,
    ) {
        let (material, regularized) = (scene.material(key / 2), key % 2 == 1);
        self.models.clear();
        self.lambda.clear();
        self.contexts.clear();
        self.kind = (self.path.len() >= FEW && !regularized).then_some(material.kind);
        for (k, &path) in self.path.iter().enumerate() {
            let i = path as usize;
            let Some(point) = &points[i] else { continue };
            put_vector(&mut self.columns.wo, k, -paths.ray[i].d);
            if self.kind.is_none() {
                let Some(model) = scene.scatter(point, &mut paths.lambda[i]) else { continue };
                self.models.push(if regularized { model.regularized() } else { model });
                continue;
            }
            if material.dispersive {
                paths.lambda[i].terminate_secondary();
            }
            self.lambda.push(paths.lambda[i]);
            if material.textured {
                self.contexts.push(scene.texture_context_of(material, point));
            }
            self.columns.place(k, point, &paths.lambda[i]);
        }
        let Some(kind) = self.kind else { return };
        let points = Points { lambda: &self.lambda, contexts: &self.contexts };
        self.columns.material.bind(material, scene.textures(), &points);
        self.columns.turn(self.path.len(), self.lights.len(), matches!(kind, ModelKind::Fibre(_)));
    }

    /// Value times cosine towards the light samples, and the density with which the BSDF draws them.
    pub(super) fn f_cos_pdf(&mut self) {
        for (k, (model, light)) in self.models.iter().zip(&self.lights).enumerate() {
            let (f_cos, pdf) = model.f_cos_pdf(vector(&self.columns.wo, k), light.wi);
            put_spectrum(&mut self.columns.f_cos, k, f_cos);
            self.columns.pdf[k] = pdf;
        }
        if let Some(kind) = self.kind {
            self.columns.f_cos_pdf(kind, padded(self.lights.len()));
        }
    }
    /// What [`f_cos_pdf`](Self::f_cos_pdf) found.
    pub(super) fn value(&self, k: usize) -> (Spectrum<f32>, f32) {
        (spectrum(&self.columns.f_cos, k), self.columns.pdf[k])
    }

    /// The next direction of each path; the path ends where there is none, or where roulette says so.
    pub(super) fn scatter<'b, R: Record + Default>(
        &mut self,
        how: &PathIntegrator,
        paths: &mut Paths<'_, R>,
        points: &[Option<SurfacePoint>],
        roulette: impl Fn([u32; 2]) -> Roulette<'b>,
    ) {
        let columns = &mut self.columns;
        let numbers = &columns.numbers;
        for (k, &j) in self.numbers_of.iter().enumerate() {
            let [u, v] = &numbers.direction;
            let three = [&numbers.lobe, u, v].map(|c| c[j as usize]);
            columns.u.iter_mut().zip(three).for_each(|(column, u)| column[k] = u);
        }
        if let Some(kind) = self.kind {
            columns.sample(kind, self.path.len());
        }
        for (k, &path) in self.path.iter().enumerate() {
            let i = path as usize;
            let sample = match self.models.get(k) {
                Some(model) => {
                    let [lobe, u, v] = [0, 1, 2].map(|c| columns.u[c][k]);
                    model.sample(vector(&columns.wo, k), lobe, [u, v])
                }
                None => columns.scattered(k),
            };
            paths.ended[i] = true;
            if let (Some(s), Some(point)) = (sample, &points[i]) {
                let u = columns.numbers.roulette[self.numbers_of[k] as usize];
                let roulette = roulette(paths.place[i].pixel);
                paths.ended[i] = !paths.go_on(i, how, point, &s, u, roulette);
            }
        }
    }
}

impl Numbers {
    /// Those of vertices whose samplers stand where their dimensions begin; those that choose lights only where there are `choices`.
    fn fill(&mut self, sampler: &Sampler, paths: &[PixelSampler<'_>], choices: bool) {
        let scatter = scatter_dimension(0) - light_dimension(0);
        if choices {
            sampler.fill_1d(paths, 0, &mut self.light[..]);
        }
        sampler.fill_2d(paths, 1, self.on_light.each_mut().map(|c| &mut c[..]));
        sampler.fill_1d(paths, scatter, &mut self.lobe[..]);
        sampler.fill_2d(paths, scatter + 1, self.direction.each_mut().map(|c| &mut c[..]));
        sampler.fill_1d(paths, scatter + 3, &mut self.roulette[..]);
    }
}

impl Columns {
    /// Puts a vertex in its place.
    #[inline]
    fn place(&mut self, k: usize, point: &SurfacePoint, lambda: &Wavelengths) {
        put_vector(&mut self.ns, k, point.ns);
        put_vector(&mut self.tangent, k, point.tangent);
        self.h[k] = fibre_offset(point);
        self.nm.iter_mut().zip(lambda.lambda).for_each(|(column, nm)| column[k] = nm);
    }

    /// Makes the frames of `n` vertices and turns directions to them.
    fn turn(&mut self, n: usize, n_lit: usize, fibre: bool) {
        self.ns.iter_mut().chain(&mut self.tangent).chain(&mut self.wo).for_each(|c| pad(c, n));
        self.nm.iter_mut().for_each(|c| pad(c, n));
        pad(&mut self.h, n);
        self.wi_light.iter_mut().for_each(|c| pad(c, n_lit));
        in_lanes(ToLocal {
            n: padded(n),
            fibre,
            ns: &self.ns,
            tangent: &self.tangent,
            world: [&self.wo, &self.wi_light],
            frame: &mut self.frame,
            local: [&mut self.wo_local, &mut self.wi_light_local],
        });
    }

    /// Evaluates the model at the first `n` vertices.
    fn f_cos_pdf(&mut self, kind: ModelKind, n: usize) {
        let params = self.material.params(n, &self.nm, &self.h);
        let (wo, wi) = (directions(&self.wo_local, n), directions(&self.wi_light_local, n));
        let out =
            &mut EvalColumns { f_cos: self.f_cos.each_mut().map(|c| &mut c[..n]), pdf: &mut self.pdf[..n] };
        match kind {
            ModelKind::Surface(kind) => f_cos_pdf(kind, &params, &wo, &wi, out),
            ModelKind::Fibre(kind) => f_cos_pdf(kind, &params, &wo, &wi, out),
        }
    }

    /// Samples the model at `n` vertices.
    fn sample(&mut self, kind: ModelKind, n: usize) {
        self.u.iter_mut().for_each(|c| pad(c, n));
        let n = padded(n);
        let params = self.material.params(n, &self.nm, &self.h);
        let wo = directions(&self.wo_local, n);
        let u = self.u.each_ref().map(|c| &c[..n]);
        let out = &mut SampleColumns {
            wi: self.wi_local.each_mut().map(|c| &mut c[..n]),
            weight: self.weight.each_mut().map(|c| &mut c[..n]),
            density: &mut self.density[..n],
            eta: &mut self.eta[..n],
            delta: &mut self.delta[..n],
        };
        match kind {
            ModelKind::Surface(kind) => sample(kind, &params, &wo, &u, out),
            ModelKind::Fibre(kind) => sample(kind, &params, &wo, &u, out),
        }
        in_lanes(ToWorld { n, frame: &self.frame, local: &self.wi_local, world: &mut self.wi });
    }

    /// The sample of a vertex; none where the path ends.
    #[inline]
    fn scattered(&self, k: usize) -> Option<ScatterSample> {
        let (weight, density) = (spectrum(&self.weight, k), self.density[k]);
        if !(density > 0.0 && density.is_finite() && weight.is_finite()) {
            return None;
        }
        let delta = self.delta[k] > 0.0;
        Some(ScatterSample {
            wi: vector(&self.wi, k),
            weight,
            density: if delta { Density::Delta(density) } else { Density::SolidAngle(density) },
            eta: self.eta[k],
        })
    }
}

fn directions(columns: &[Column; 3], n: usize) -> DirColumns<'_> {
    DirColumns { x: &columns[0][..n], y: &columns[1][..n], z: &columns[2][..n] }
}
