//! New paths of a block: [`Fresh`].

use sparrow_math::{InLanes, Real, in_lanes};
use sparrow_spectra::N_LAMBDA;

use super::column::{BATCH, Column, load, padded, put_vector, spectrum, store_vector, vector};
use crate::camera::Camera;
use crate::integrator::start::{CameraNumbers, CameraSample, FilmPlace, film_point};
use crate::plan::RenderPlan;
use crate::sampler::{Draw, SampleKey, Sampler};
use crate::samples::{OfPixel, Samples};
use crate::scene::Scene;

/// Camera samples that are drawn together.
#[derive(Default)]
pub(super) struct Fresh {
    places: Vec<FilmPlace>,
    keys: Vec<SampleKey>,
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
    /// Wavelengths in nm, and their densities.
    nm: [Column; N_LAMBDA],
    pdf: [Column; N_LAMBDA],
}

impl Fresh {
    /// Draws the next of `samples`, at most a batch of them, and `most`; false where there are none.
    pub(super) fn draw(
        &mut self,
        scene: &Scene,
        sampler: &Sampler,
        plan: &RenderPlan,
        samples: &mut Samples,
        most: usize,
    ) -> bool {
        self.start(sampler, plan, samples, most.min(BATCH));
        let (n, columns) = (self.places.len(), &mut *self.columns);
        columns.fill(sampler, &self.keys, (scene, plan));
        let (nm, pdf) =
            (columns.nm.each_mut().map(|c| &mut c[..]), columns.pdf.each_mut().map(|c| &mut c[..]));
        plan.sensor.wavelengths_many(&columns.wavelength[..], n, nm, pdf);
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
    fn start(&mut self, sampler: &Sampler, plan: &RenderPlan, samples: &mut Samples, most: usize) {
        self.places.clear();
        self.keys.clear();
        while self.places.len() < most {
            let left = most - self.places.len();
            let Some(OfPixel { pixel, samples }) = samples.of_pixel(left as u32) else { break };
            let place = plan.in_full_picture(pixel);
            let here = self.places.len()..self.places.len() + samples.len();
            for (column, x) in self.columns.place.iter_mut().zip(place) {
                column[here.clone()].fill(x as f32);
            }
            sampler.pixel(place).start_all(samples.clone(), &mut self.keys);
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
    /// The place of each on the film.
    #[inline(always)]
    pub(super) fn places(&self) -> impl Iterator<Item = FilmPlace> {
        self.places
            .iter()
            .zip(&self.columns.weight[..])
            .map(|(place, &weight)| FilmPlace { weight, ..*place })
    }
    /// The numbers of each.
    pub(super) fn keys(&self) -> &[SampleKey] {
        &self.keys
    }
    /// Puts their rays to those places, what they carry with their wavelengths, and what they have found with the densities of these.
    pub(super) fn put(
        &self,
        places: &[u32],
        rays: &mut [[f32; 8]],
        carried: &mut [[f32; 8]],
        found: &mut [[f32; 8]],
    ) {
        in_lanes(Put { columns: &self.columns, places, rays, carried, found });
    }
}

impl Columns {
    /// Draws what the scene needs.
    fn fill(&mut self, sampler: &Sampler, keys: &[SampleKey], (scene, plan): (&Scene, &RenderPlan)) {
        let [wavelength, time, lens] = CameraNumbers::DIMENSIONS;
        let n = keys.len();
        let at = |k: usize| sampler.resume(keys[k], 0);
        let pixel = Draw::Pixel(self.pixel.each_mut().map(|c| &mut c[..]));
        let draws = &mut [Draw::One(wavelength, &mut self.wavelength[..]), pixel];
        sampler.fill(n, at, if plan.sensor.draws_wavelengths() { draws } else { &mut draws[1..] });
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

/// Writes rays without end to their places, and what goes with them.
struct Put<'a> {
    columns: &'a Columns,
    places: &'a [u32],
    rays: &'a mut [[f32; 8]],
    carried: &'a mut [[f32; 8]],
    found: &'a mut [[f32; 8]],
}

impl InLanes for Put<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Put { columns: Columns { o, d, time, nm, pdf, .. }, places, rays, carried, found } = self;
        let (end, zero, one) = (R::of(f64::INFINITY), R::ZERO, R::ONE);
        for (k, places) in (0..).step_by(R::WIDTH).zip(places.chunks(R::WIDTH)) {
            let (o, d) = (vector::<R>(o, k), vector::<R>(d, k));
            R::scatter_rows([o.x, o.y, o.z, d.x, d.y, d.z, end, load(time, k)], rays, places);
            let (nm, pdf) = (spectrum::<R>(nm, k), spectrum::<R>(pdf, k));
            R::scatter_rows([one, one, one, one, nm[0], nm[1], nm[2], nm[3]], carried, places);
            R::scatter_rows([zero, zero, zero, zero, pdf[0], pdf[1], pdf[2], pdf[3]], found, places);
        }
    }
}
