//! The paths of a block: [`Paths`].

use sparrow_geometry::Ray;
use sparrow_spectra::{Spectrum, Wavelengths};

use super::column::{spectrum, vector};
use super::onward::{Directions, Next};
use super::vertices::Vertices;
use crate::integrator::start::FilmPlace;
use crate::integrator::{CameraSample, Record};
use crate::sampler::PixelSampler;
use crate::scene::LastVertex;

/// Paths under way, a column for each thing that is known of them.
pub(super) struct Paths<'a, R> {
    pub(super) place: Vec<FilmPlace>,
    pub(super) sampler: Vec<PixelSampler<'a>>,
    pub(super) lambda: Vec<Wavelengths>,
    pub(super) ray: Vec<Ray>,
    pub(super) l: Vec<Spectrum<f32>>,
    pub(super) beta: Vec<Spectrum<f32>>,
    pub(super) eta_scale: Vec<f32>,
    pub(super) last: Vec<Option<LastVertex>>,
    pub(super) depth: Vec<u32>,
    /// Which way on from the first vertex it takes.
    pub(super) way: Vec<u32>,
    /// Of the camera sample that it belongs to, where there are several ways.
    pub(super) family: Vec<u32>,
    pub(super) n_smooth: Vec<u32>,
    /// The direction from the BSDF looks for lights.
    pub(super) looks: Vec<bool>,
    pub(super) ended: Vec<bool>,
    pub(super) record: Vec<R>,
}

/// Writes the number of a path, or of one more.
#[inline(always)]
fn put<T>(column: &mut Vec<T>, i: usize, value: T) {
    match column.get_mut(i) {
        Some(place) => *place = value,
        None => column.push(value),
    }
}

impl<R> Default for Paths<'_, R> {
    fn default() -> Self {
        Paths {
            place: Vec::new(),
            sampler: Vec::new(),
            lambda: Vec::new(),
            ray: Vec::new(),
            l: Vec::new(),
            beta: Vec::new(),
            eta_scale: Vec::new(),
            last: Vec::new(),
            depth: Vec::new(),
            way: Vec::new(),
            family: Vec::new(),
            n_smooth: Vec::new(),
            looks: Vec::new(),
            ended: Vec::new(),
            record: Vec::new(),
        }
    }
}

impl<'a, R: Record + Default> Paths<'a, R> {
    pub(super) fn len(&self) -> usize {
        self.ray.len()
    }

    /// A new path in place `i`, the first one that is empty or one whose path has ended.
    pub(super) fn put(&mut self, i: usize, sampler: PixelSampler<'a>, start: CameraSample, family: u32) {
        put(&mut self.place, i, start.place);
        put(&mut self.sampler, i, sampler);
        put(&mut self.lambda, i, start.lambda);
        put(&mut self.ray, i, start.ray);
        put(&mut self.l, i, Spectrum::ZERO);
        put(&mut self.beta, i, Spectrum::ONE);
        put(&mut self.eta_scale, i, 1.0);
        put(&mut self.last, i, None);
        put(&mut self.depth, i, 0);
        put(&mut self.way, i, 0);
        put(&mut self.family, i, family);
        put(&mut self.n_smooth, i, 0);
        put(&mut self.looks, i, true);
        put(&mut self.ended, i, false);
        put(&mut self.record, i, R::default());
    }

    /// Another way on from the first vertex of path `i`; what the path has found up to there stays with the first.
    pub(super) fn branch(&mut self, i: usize, way: u32, sampler: PixelSampler<'a>) {
        let lambda = self.lambda[i];
        let start = CameraSample { place: self.place[i], lambda, ray: self.ray[i] };
        self.put(self.len(), sampler, start, self.family[i]);
        if let Some(last) = self.way.last_mut() {
            *last = way;
        }
    }

    /// Puts the last path in the place of one that has ended.
    pub(super) fn remove(&mut self, i: usize) {
        self.place.swap_remove(i);
        self.sampler.swap_remove(i);
        self.lambda.swap_remove(i);
        self.ray.swap_remove(i);
        self.l.swap_remove(i);
        self.beta.swap_remove(i);
        self.eta_scale.swap_remove(i);
        self.last.swap_remove(i);
        self.depth.swap_remove(i);
        self.way.swap_remove(i);
        self.family.swap_remove(i);
        self.n_smooth.swap_remove(i);
        self.looks.swap_remove(i);
        self.ended.swap_remove(i);
        self.record.swap_remove(i);
    }

    /// Takes path `i` from vertex `k` of a batch along the direction that was drawn.
    #[inline(always)]
    pub(super) fn go_on(&mut self, i: usize, vertices: &Vertices, drawn: &Directions, next: &Next, k: usize) {
        self.last[i] = None;
        if drawn.delta[k] <= 0.0 {
            self.n_smooth[i] += 1;
            let pdf = if self.looks[i] { vertices.ways[k] * drawn.density[k] } else { 0.0 };
            self.last[i] = Some(LastVertex { at: vertices.lit_point(k), pdf });
        }
        let beta = spectrum(&next.beta, k);
        self.record[i].goes_on(vector(&vertices.at.p, k), beta);
        self.beta[i] = beta;
        self.eta_scale[i] = next.eta_scale[k];
        self.depth[i] += 1;
        let ray = &mut self.ray[i];
        *ray = Ray { time: ray.time, ..Ray::new(vector(&next.o, k), vector(&drawn.wi, k)) };
    }
}
