//! Where a path begins and what becomes of its light: [`CameraSample`], [`Exposed`].

use sparrow_geometry::Ray;
use sparrow_math::Real;
use sparrow_spectra::{Spectrum, Wavelengths};

use super::PathIntegrator;
use crate::film::FilmTile;
use crate::observe::{Sample, TileObserver};
use crate::plan::RenderPlan;
use crate::roulette::{Learned, Roulette};
use crate::sampler::PixelSampler;
use crate::scene::Scene;

/// The place of a camera sample on the film.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FilmPlace {
    /// Column and row in the film's window.
    pub(crate) pixel: [u32; 2],
    /// Weight of the pixel filter.
    pub(crate) weight: f32,
    /// The number of the sample.
    pub(crate) sample: u32,
}

/// The uniform numbers of a camera sample.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CameraNumbers {
    pub(crate) wavelength: f32,
    pub(crate) time: f32,
    /// For the filter.
    pub(crate) pixel: [f32; 2],
    pub(crate) lens: [f32; 2],
}

impl CameraNumbers {
    /// Dimensions of the sampler: wavelength, time, lens.
    pub(super) const DIMENSIONS: [u32; 3] = [0, 1, 2];

    /// Of one pixel sample.
    pub(crate) fn new(sampler: &PixelSampler<'_>) -> CameraNumbers {
        let [wavelength, time, lens] = Self::DIMENSIONS.map(|d| sampler.at(d));
        CameraNumbers {
            wavelength: { wavelength }.get_1d(),
            time: { time }.get_1d(),
            pixel: { *sampler }.get_pixel_2d(),
            lens: { lens }.get_2d(),
        }
    }
}

/// A path before its first ray is traced.
pub(crate) struct CameraSample {
    pub(crate) place: FilmPlace,
    pub(crate) lambda: Wavelengths,
    pub(crate) ray: Ray,
}

impl CameraSample {
    /// Wavelengths, time, place on film and lens of a sample of a pixel of the film's window.
    #[inline]
    pub(crate) fn new(
        scene: &Scene,
        plan: &RenderPlan,
        pixel: [u32; 2],
        sample: u32,
        u: &CameraNumbers,
    ) -> CameraSample {
        let start = CameraSample::of_picture(scene, plan, plan.in_full_picture(pixel), u);
        CameraSample { place: FilmPlace { pixel, sample, ..start.place }, ..start }
    }

    /// The same for the first sample of a pixel of the full picture.
    pub(crate) fn of_picture(
        scene: &Scene,
        plan: &RenderPlan,
        pixel: [u32; 2],
        u: &CameraNumbers,
    ) -> CameraSample {
        let lambda = plan.sensor.wavelengths(u.wavelength);
        let time = if scene.moves { scene.camera.time(u.time) } else { 0.0 };
        let (film, weight) = film_point(plan, pixel.map(|x| x as f32), u.pixel);
        let ray = scene.camera.ray(film, u.lens, time);
        CameraSample { place: FilmPlace { pixel, weight, sample: 0 }, lambda, ray }
    }
}

/// A point on the film for a pixel of the full picture, and the filter's weight.
#[inline(always)]
pub(super) fn film_point<R: Real>(plan: &RenderPlan, pixel: [R; 2], u: [R; 2]) -> ([R; 2], R) {
    let f = plan.filter.sample(u);
    let half = R::of(0.5);
    ([pixel[0] + half + f.offset[0], pixel[1] + half + f.offset[1]], f.weight)
}

/// A tile of the film with who looks on.
pub(crate) struct Exposed<'a, T> {
    pub(crate) plan: &'a RenderPlan,
    pub(crate) how: PathIntegrator,
    pub(crate) learned: Option<&'a Learned>,
    pub(crate) film: FilmTile,
    pub(crate) observer: T,
}

impl<'a, T: TileObserver> Exposed<'a, T> {
    /// How paths of a pixel are ended.
    #[inline]
    pub(crate) fn roulette(&self, pixel: [u32; 2]) -> Roulette<'a> {
        Roulette::of_pixel(self.learned, self.plan.in_full_picture(pixel))
    }

    /// Takes the radiance `l` that a path found.
    #[inline]
    pub(crate) fn take(
        &mut self,
        place: FilmPlace,
        l: Spectrum<f32>,
        lambda: &Wavelengths,
        record: &T::Record,
    ) {
        self.take_rgb(place, self.plan.sensor.rgb(l, lambda), || *lambda, record);
    }

    /// Takes what a path found, as [`FilmSensor::rgb`](crate::plan::FilmSensor::rgb) shows it; `lambda` is asked by those who look on.
    #[inline(always)]
    pub(crate) fn take_rgb(
        &mut self,
        place: FilmPlace,
        rgb: [f32; 3],
        lambda: impl Fn() -> Wavelengths,
        record: &T::Record,
    ) {
        let sensor = &self.plan.sensor;
        let FilmPlace { pixel, weight, .. } = place;
        let sample = Sample { pixel, rgb, weight };
        let rgb = self.observer.take(sample, record, |part| sensor.rgb(part, &lambda()));
        self.film.add(pixel[0], pixel[1], rgb, weight);
    }

    /// What a way on adds to a camera sample, for the film.
    #[inline]
    pub(crate) fn part(&self, l: Spectrum<f32>, lambda: &Wavelengths) -> [f32; 3] {
        self.plan.sensor.rgb(l, lambda)
    }
    /// Takes a camera sample whose ways on give these parts; nobody looks at those.
    #[inline]
    pub(crate) fn take_parts(&mut self, place: FilmPlace, parts: &[[f32; 3]]) {
        let rgb = [0, 1, 2].map(|c| parts.iter().map(|rgb| rgb[c]).sum());
        self.film.add(place.pixel[0], place.pixel[1], rgb, place.weight);
    }
}
