//! Where a path begins and what becomes of its light: [`CameraSample`], [`Exposed`].

use sparrow_geometry::Ray;
use sparrow_spectra::{Spectrum, Wavelengths};

use crate::film::FilmTile;
use crate::observe::{Sample, TileObserver};
use crate::plan::RenderPlan;
use crate::sampler::{PixelSampler, Sampler};
use crate::scene::Scene;

/// The place of a camera sample on the film.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilmPlace {
    /// Column and row in the film's window.
    pub(crate) pixel: [u32; 2],
    /// Weight of the pixel filter.
    pub(crate) weight: f32,
}

/// A path before its first ray is traced.
pub(crate) struct CameraSample<'a> {
    pub(crate) place: FilmPlace,
    pub(crate) sampler: PixelSampler<'a>,
    pub(crate) lambda: Wavelengths,
    pub(crate) ray: Ray,
}

impl<'a> CameraSample<'a> {
    /// Wavelengths, time, place on film and lens of one sample of a pixel of the film's window.
    #[inline]
    pub(crate) fn new(
        scene: &Scene,
        plan: &RenderPlan,
        sampler: &'a Sampler,
        pixel: [u32; 2],
        sample: u32,
    ) -> CameraSample<'a> {
        let [x, y] = [pixel[0] + plan.bounds[0], pixel[1] + plan.bounds[2]];
        let mut sampler = sampler.start([x, y], sample);
        let lambda = plan.sensor.wavelengths(sampler.get_1d());
        let time = if scene.moves { scene.camera.time(sampler.get_1d()) } else { 0.0 };
        let f = plan.filter.sample(sampler.get_pixel_2d());
        sampler.set_dimension(2);
        let lens = sampler.get_2d();
        let film = [x as f32 + 0.5 + f.offset[0], y as f32 + 0.5 + f.offset[1]];
        let ray = scene.camera.ray(film, lens, time);
        CameraSample { place: FilmPlace { pixel, weight: f.weight }, sampler, lambda, ray }
    }
}

/// A tile of the film with who looks on.
pub(crate) struct Exposed<'a, T> {
    pub(crate) plan: &'a RenderPlan,
    pub(crate) film: FilmTile,
    pub(crate) observer: T,
}

impl<T: TileObserver> Exposed<'_, T> {
    /// Takes the radiance `l` that a path found.
    #[inline]
    pub(crate) fn take(
        &mut self,
        place: FilmPlace,
        l: Spectrum<f32>,
        lambda: &Wavelengths,
        record: &T::Record,
    ) {
        let sensor = &self.plan.sensor;
        let FilmPlace { pixel, weight } = place;
        let sample = Sample { pixel, rgb: sensor.rgb(l, lambda), weight };
        let rgb = self.observer.take(sample, record, |part| sensor.rgb(part, lambda));
        self.film.add(pixel[0], pixel[1], rgb, weight);
    }
}
