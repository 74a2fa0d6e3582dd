//! How a picture is taken of a scene: everything a render needs beside the scene itself.

use sparrow_math::Real;
use sparrow_scene::{FilterDesc, IntegratorName, RandomizeName, SamplerDesc, SamplerName, SceneDesc};
use sparrow_spectra::{N_LAMBDA, Sensor, Spectrum, Wavelengths};

use crate::colour::Carrier;
use crate::filter::{Filter, FilterSampler};
use crate::integrator::PathIntegrator;
use crate::sampler::{Randomize, Sampler, SamplerConfig, SamplerKind};

/// Sampler, filter, sensor and integrator of a render.
pub struct RenderPlan {
    /// Uniform numbers.
    pub sampler: Sampler,
    /// Pixel filter.
    pub filter: FilterSampler,
    /// What paths carry, to RGB.
    pub sensor: FilmSensor,
    /// Light transport.
    pub integrator: PathIntegrator,
    /// Ways on from the first vertex of each camera sample; none: as many as are efficient. Renders that look at each technique or learn
    /// from it take one.
    pub splits: Option<u32>,
    /// Paths are followed one by one, by the loop that is the reference; to the same bits.
    pub one_by_one: bool,
    /// The part of the picture that is rendered: `x0 x1 y0 y1`, ends excluded.
    pub bounds: [u32; 4],
    /// Samples per pixel.
    pub samples_per_pixel: u32,
}

/// How what a path carries is measured.
#[derive(Clone, Debug)]
enum Response {
    /// By the sensor's sensitivity to each wavelength.
    Spectral(Box<Sensor>),
    /// As the CIE's observer sees RGB: by the matrix to XYZ, with the exposure.
    Rgb([[f32; 3]; 3]),
}

/// The sensor with what follows it: the clamp of single samples and the way to output RGB.
#[derive(Clone, Debug)]
pub struct FilmSensor {
    carrier: Carrier,
    response: Response,
    to_output: [[f32; 3]; 3],
    max_component: f32,
}

impl FilmSensor {
    /// The wavelengths of a path, from a uniform number.
    #[inline]
    pub fn wavelengths(&self, u: f32) -> Wavelengths {
        self.carrier.wavelengths(u)
    }

    /// Wavelengths depend on the uniform number.
    pub(crate) fn draws_wavelengths(&self) -> bool {
        self.carrier.space().is_none()
    }

    /// [`wavelengths`](Self::wavelengths) of each of the first `n` of `u`: in nm, and their densities. The columns are as long as `n`,
    /// rounded up to whole registers.
    pub(crate) fn wavelengths_many(
        &self,
        u: &[f32],
        n: usize,
        nm: [&mut [f32]; N_LAMBDA],
        pdf: [&mut [f32]; N_LAMBDA],
    ) {
        self.carrier.wavelengths_many(u, n, nm, pdf);
    }

    /// Linear RGB of the output colour space, for one sample.
    #[inline]
    pub fn rgb(&self, l: Spectrum<f32>, w: &Wavelengths) -> [f32; 3] {
        self.rgb_of(l, w.pdf_spectrum(), w.index.map(f32::from))
    }

    /// [`rgb`](Self::rgb) of one sample, or of lanes of them, whose [wavelengths](Wavelengths) have that density and index.
    #[inline(always)]
    pub(crate) fn rgb_of<R: Real>(&self, l: Spectrum<R>, pdf: Spectrum<R>, index: [R; N_LAMBDA]) -> [R; 3] {
        let s = match &self.response {
            Response::Spectral(sensor) => sensor.respond(l, pdf, index),
            Response::Rgb(to_xyz) => product(to_xyz, [l[0], l[1], l[2]]),
        };
        let (largest, most) = (s[0].max(s[1]).max(s[2]), R::of(f64::from(self.max_component)));
        let scale = R::select(largest.gt(most), most / largest, R::ONE);
        product(&self.to_output, [s[0] * scale, s[1] * scale, s[2] * scale])
    }
}

#[inline(always)]
fn product<R: Real>(m: &[[f32; 3]; 3], v: [R; 3]) -> [R; 3] {
    let mut out = [R::ZERO; 3];
    for (out, row) in out.iter_mut().zip(m) {
        let [a, b, c] = [row[0], row[1], row[2]];
        *out = R::of(f64::from(a)) * v[0] + R::of(f64::from(b)) * v[1] + R::of(f64::from(c)) * v[2];
    }
    out
}

impl RenderPlan {
    /// From a description.
    ///
    /// # Errors
    /// A sensor that does not exist, with those that do.
    pub fn new(desc: &SceneDesc) -> Result<RenderPlan, Vec<String>> {
        let film = &desc.film;
        let ratio = film.exposure_time * film.iso / 100.0;
        let sensor = Sensor::new(&film.sensor, film.color_space, ratio, film.white_balance);
        let Some(sensor) = sensor else {
            let known = Sensor::names().join(", ");
            return Err(vec![format!("there is no sensor `{}`; known are {known}", film.sensor)]);
        };
        let carrier = Carrier::new(film);
        if carrier != Carrier::Wavelengths && film.sensor != "cie1931" {
            return Err(vec![format!(
                "the sensor `{}` responds to wavelengths, and paths that carry RGB have none; take the sensor `cie1931`, or \
                 the colour mode `spectral`",
                film.sensor
            )]);
        }
        let to_output = sensor.output_rgb_from_sensor();
        let response = match carrier {
            Carrier::Wavelengths => Response::Spectral(Box::new(sensor)),
            Carrier::Rgb(space) => Response::Rgb(space.rgb_to_xyz().map(|row| row.map(|m| m * ratio))),
        };
        let sampler = Sampler::new(&sampler_config(&desc.sampler, desc.seed, film.resolution));
        Ok(RenderPlan {
            filter: FilterSampler::new(&filter(desc.filter)),
            sensor: FilmSensor { carrier, to_output, response, max_component: film.max_component_value },
            integrator: PathIntegrator::new(&desc.integrator),
            splits: desc.integrator.splits,
            one_by_one: desc.integrator.name == IntegratorName::Reference,
            bounds: film.pixel_bounds,
            samples_per_pixel: sampler.samples_per_pixel(),
            sampler,
        })
    }

    /// The number of the sample that a further way on of a camera sample takes its points from.
    #[inline]
    pub(crate) fn sample_of_way(&self, sample: u32, way: u32) -> u32 {
        sample.wrapping_add(way.wrapping_mul(self.samples_per_pixel))
    }

    /// A pixel of the part that is rendered, counted in the full picture.
    #[inline]
    pub(crate) fn in_full_picture(&self, pixel: [u32; 2]) -> [u32; 2] {
        [pixel[0] + self.bounds[0], pixel[1] + self.bounds[2]]
    }

    /// Width and height of the part that is rendered.
    pub fn size(&self) -> [u32; 2] {
        let [x0, x1, y0, y1] = self.bounds;
        [x1.saturating_sub(x0), y1.saturating_sub(y0)]
    }
}

fn filter(desc: FilterDesc) -> Filter {
    match desc {
        FilterDesc::Box { radius } => Filter::Box { radius },
        FilterDesc::Triangle { radius } => Filter::Triangle { radius },
        FilterDesc::Gaussian { radius, sigma } => Filter::Gaussian { radius, sigma },
        FilterDesc::Mitchell { radius, b, c } => Filter::Mitchell { radius, b, c },
        FilterDesc::Sinc { radius, tau } => Filter::Sinc { radius, tau },
    }
}

fn sampler_config(desc: &SamplerDesc, seed: u64, resolution: [u32; 2]) -> SamplerConfig {
    SamplerConfig {
        kind: match desc.name {
            SamplerName::Independent => SamplerKind::Independent,
            SamplerName::Stratified => {
                SamplerKind::Stratified { x: desc.strata[0], y: desc.strata[1], jitter: desc.jitter }
            }
            SamplerName::Halton => SamplerKind::Halton,
            SamplerName::Sobol => SamplerKind::Sobol,
            SamplerName::PaddedSobol => SamplerKind::PaddedSobol,
            SamplerName::ZSobol => SamplerKind::ZSobol,
            SamplerName::Pmj02bn => SamplerKind::Pmj02bn,
        },
        randomize: match desc.randomize {
            RandomizeName::None => Randomize::None,
            RandomizeName::PermuteDigits => Randomize::PermuteDigits,
            RandomizeName::FastOwen => Randomize::FastOwen,
            RandomizeName::Owen => Randomize::Owen,
        },
        samples_per_pixel: desc.samples_per_pixel,
        seed: desc.seed.unwrap_or(seed),
        resolution,
    }
}
