//! New paths of a block: [`Fresh`].

use sparrow_math::{InLanes, Real, in_lanes};
use sparrow_spectra::Wavelengths;

use super::column::{BATCH, Column, load, padded, put_vector, store_vector, vector};
use crate::camera::Camera;
use crate::integrator::start::{CameraNumbers, CameraSample, FilmPlace, film_point};
use crate::plan::RenderPlan;
use crate::sampler::{Draw, PixelSampler, Sampler};
use crate::samples::{OfPixel, Samples};
use crate::scene::Scene;

/// Camera samples that are drawn together.
#[derive(Default)]
pub(super) struct Fresh<'a> {
    places: Vec<FilmPlace>,
    samplers: Vec<PixelSampler<'a>>,
    lambda: Vec<Wavelengths>,
    columns: Box<Columns>,
}

/// Uniform numbers, and the rays made of them.
#[derive(Default)]
struct Columns {
    wavelength: Column,
    time: Column,
    pixel: [Column; 2],
    lens: [Column; 2],
    /// Column and row in the full picture.
    place: [Column; 2],
    weight: Column,
    o: [Column; 3],
    d: [Column; 3],
}

impl<'a> Fresh<'a> {
    /// Draws the next of `samples`, at most a batch of them, and `most`; false where there are none.
    pub(super) fn draw(
        &mut self,
        scene: &Scene,
        sampler: &'a Sampler,
        plan: &RenderPlan,
        samples: &mut Samples,
        most: usize,
    ) -> bool {
        self.start(sampler, plan, samples, most.min(BATCH));
        let (n, columns) = (self.places.len(), &mut *self.columns);
        columns.fill(sampler, &self.samplers, scene);
        self.lambda.clear();
        plan.sensor.wavelengths_many(&columns.wavelength[..n], &mut self.lambda);
        if scene.camera.moves() {
            self.one_by_one(scene, plan);
        } else {
            if scene.moves {
                columns.time[..n].iter_mut().for_each(|time| *time = scene.camera.time(*time));
            }
            in_lanes(Rays { n: padded(n), plan, camera: &scene.camera, columns });
        }
        n > 0
    }

    /// Takes samples, pixel by pixel.
    fn start(&mut self, sampler: &'a Sampler, plan: &RenderPlan, samples: &mut Samples, most: usize) {
        self.places.clear();
        self.samplers.clear();
        while self.places.len() < most {
            let left = most - self.places.len();
            let Some(OfPixel { pixel, samples }) = samples.of_pixel(left as u32) else { break };
            let place = plan.in_full_picture(pixel);
            let here = self.places.len()..self.places.len() + samples.len();
            for (column, x) in self.columns.place.iter_mut().zip(place) {
                column[here.clone()].fill(x as f32);
            }
            sampler.pixel(place).start_all(samples.clone(), &mut self.samplers);
            self.places.extend(samples.map(|sample| FilmPlace { pixel, weight: 1.0, sample }));
        }
    }

    /// Rays of a camera that moves.
    fn one_by_one(&mut self, scene: &Scene, plan: &RenderPlan) {
        let columns = &mut *self.columns;
        for (k, FilmPlace { pixel, sample, .. }) in self.places.iter().copied().enumerate() {
            let start = CameraSample::new(scene, plan, pixel, sample, &columns.numbers(k));
            put_vector(&mut columns.o, k, start.ray.o);
            put_vector(&mut columns.d, k, start.ray.d);
            columns.time[k] = start.ray.time;
            columns.weight[k] = start.place.weight;
        }
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }
    /// The place of one on the film.
    #[inline(always)]
    pub(super) fn place(&self, k: usize) -> FilmPlace {
        FilmPlace { weight: self.columns.weight[k], ..self.places[k] }
    }
    /// The numbers of each.
    pub(super) fn samplers(&self) -> &[PixelSampler<'a>] {
        &self.samplers
    }
    /// The wavelengths of each.
    pub(super) fn lambda(&self) -> &[Wavelengths] {
        &self.lambda
    }
    /// Puts their rays to those places.
    pub(super) fn put_rays(&self, rays: &mut [[f32; 8]], places: &[u32]) {
        let Columns { o, d, time, .. } = &*self.columns;
        in_lanes(PutRays { o, d, time, rays, places });
    }
}

impl Columns {
    /// Draws what the scene needs.
    fn fill(&mut self, sampler: &Sampler, paths: &[PixelSampler<'_>], scene: &Scene) {
        let [wavelength, time, lens] = CameraNumbers::DIMENSIONS;
        let n = paths.len();
        let at = |k: usize| paths[k];
        let pixel = Draw::Pixel(self.pixel.each_mut().map(|c| &mut c[..]));
        sampler.fill(n, at, &mut [Draw::One(wavelength, &mut self.wavelength[..]), pixel]);
        if scene.moves {
            sampler.fill(n, at, &mut [Draw::One(time, &mut self.time[..])]);
        } else {
            self.time[..padded(n)].fill(0.0);
        }
        if scene.camera.has_lens() {
            sampler.fill(n, at, &mut [Draw::Two(lens, self.lens.each_mut().map(|c| &mut c[..]))]);
        }
    }
    fn numbers(&self, k: usize) -> CameraNumbers {
        CameraNumbers {
            wavelength: self.wavelength[k],
            time: self.time[k],
            pixel: self.pixel.each_ref().map(|c| c[k]),
            lens: self.lens.each_ref().map(|c| c[k]),
        }
    }
}

/// Points on the film and rays through them, from a camera at rest.
struct Rays<'a> {
    n: usize,
    plan: &'a RenderPlan,
    camera: &'a Camera,
    columns: &'a mut Columns,
}

impl InLanes for Rays<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Rays { n, plan, camera, columns } = self;
        let Columns { pixel: [u, v], lens: [lens_u, lens_v], place: [x, y], weight, o, d, .. } = columns;
        for k in (0..n).step_by(R::WIDTH) {
            let (film, w) = film_point(plan, [load(x, k), load(y, k)], [load(u, k), load(v, k)]);
            let (from, to) = camera.at_rest::<R>(film, [load(lens_u, k), load(lens_v, k)]);
            w.store(&mut weight[..], k);
            store_vector(from, o, k);
            store_vector(to, d, k);
        }
    }
}

/// Writes rays without end to their places.
struct PutRays<'a> {
    o: &'a [Column; 3],
    d: &'a [Column; 3],
    time: &'a Column,
    rays: &'a mut [[f32; 8]],
    places: &'a [u32],
}

impl InLanes for PutRays<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let PutRays { o, d, time, rays, places } = self;
        let end = R::of(f64::INFINITY);
        for (k, places) in (0..).step_by(R::WIDTH).zip(places.chunks(R::WIDTH)) {
            let (o, d) = (vector::<R>(o, k), vector::<R>(d, k));
            R::scatter_rows([o.x, o.y, o.z, d.x, d.y, d.z, end, load(time, k)], rays, places);
        }
    }
}
