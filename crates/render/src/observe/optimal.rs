//! Optimal weights for the direct light of what the camera sees first: [`Learning`]. [Kondapaneni2019]
//!
//! At the first surface of a path, light and BSDF sampling are weighted by balance, and `c Z` is taken from the sample as
//! [`PairMoments`] has it. Each pixel learns its `c` from its own samples of the passes before, so that it knows nothing of the
//! sample that it serves, and depends on neither threads nor crops. Deeper vertices have balance weights alone: roulette ends paths
//! there, and a Z of each vertex would need a c of its own.
//!
//! A spectrum is no obstacle: red, green and blue of the film are three linear integrals over place, direction and wavelength, each
//! with its own c, and Z is the same for all three, since both techniques share the wavelengths.
//!
//! Places where the path finds no light count as found by one technique only, whatever hides the light, so that Z is known without
//! further rays.
//!
//! Stratified samples avoid each other, so that those of a pass would depend on the passes before, and Z on c: half a percent of bias
//! at 16 samples a pixel. Each pass therefore has points of its own, stratified among themselves; a sampler with one set of points,
//! without randomisation, is biased.

use std::sync::{PoisonError, RwLock};

use sparrow_mis::PairMoments;
use sparrow_spectra::Spectrum;

use super::{Observer, Sample, TileObserver};
use crate::film::FilmError;
use crate::integrator::{Finder, Record};

/// What the first surface scatters to the camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FirstVertex {
    /// Direct light with balance weights.
    direct: Spectrum<f32>,
    /// `Z = w_bsdf(X_light) - w_light(X_bsdf)`
    z: f32,
}

impl Default for FirstVertex {
    fn default() -> FirstVertex {
        FirstVertex { direct: Spectrum::ZERO, z: 0.0 }
    }
}

impl Record for FirstVertex {
    #[inline]
    fn found(&mut self, by: Finder, light: Spectrum<f32>, weight: f32) {
        // Both techniques agree on where no light comes from, whatever made it black.
        if light.is_black() {
            return;
        }
        self.z += match by {
            Finder::Light(0) => 1.0 - weight,
            Finder::Bsdf(0) => weight - 1.0,
            Finder::Camera | Finder::Light(_) | Finder::Bsdf(_) => return,
        };
        self.direct += light * weight;
    }
}

/// What is known of a pixel.
#[derive(Clone, Copy, Debug, Default)]
struct Pixel {
    moments: PairMoments<3>,
    c: [f32; 3],
}

/// What is known of all pixels.
pub(crate) struct Learning {
    size: [u32; 2],
    pixels: RwLock<Vec<Pixel>>,
}

/// The pixels of a tile.
pub(crate) struct LearningTile {
    origin: [u32; 2],
    width: u32,
    pixels: Vec<Pixel>,
}

impl Learning {
    /// For a picture of that size.
    pub(crate) fn new(size: [u32; 2]) -> Learning {
        let n = size[0] as usize * size[1] as usize;
        Learning { size, pixels: RwLock::new(vec![Pixel::default(); n]) }
    }
    /// The place of each pixel of a tile among all pixels.
    fn places(&self, origin: [u32; 2], [w, h]: [u32; 2]) -> impl Iterator<Item = usize> + use<> {
        let width = self.size[0];
        (origin[1]..origin[1] + h)
            .flat_map(move |y| (origin[0]..origin[0] + w).map(move |x| (y * width + x) as usize))
    }
}

impl Observer for Learning {
    type Tile = LearningTile;
    const LEARNS: bool = true;

    /// A pass begins: it is served by what was learned before it.
    fn tile(&self, origin: [u32; 2], size: [u32; 2]) -> LearningTile {
        let size = [0, 1].map(|i| size[i].min(self.size[i] - origin[i]));
        let known = self.pixels.read().unwrap_or_else(PoisonError::into_inner);
        let pixel = |i: usize| Pixel { c: known[i].moments.slope().map(|c| c as f32), ..known[i] };
        LearningTile { origin, width: size[0], pixels: self.places(origin, size).map(pixel).collect() }
    }

    fn absorb(&self, tile: &LearningTile) -> Result<(), FilmError> {
        let size = [tile.width, tile.pixels.len() as u32 / tile.width.max(1)];
        let mut known = self.pixels.write().unwrap_or_else(PoisonError::into_inner);
        self.places(tile.origin, size).zip(&tile.pixels).for_each(|(i, pixel)| known[i] = *pixel);
        Ok(())
    }
}

impl TileObserver for LearningTile {
    type Record = FirstVertex;

    fn take(&mut self, s: Sample, first: &FirstVertex, rgb: impl Fn(Spectrum<f32>) -> [f32; 3]) -> [f32; 3] {
        let [x, y] = [0, 1].map(|i| s.pixel[i] - self.origin[i]);
        let pixel = &mut self.pixels[(y * self.width + x) as usize];
        let direct = rgb(first.direct).map(f64::from);
        if direct.iter().all(|v| v.is_finite()) {
            pixel.moments.add(direct, f64::from(first.z));
        }
        core::array::from_fn(|i| s.rgb[i] - pixel.c[i] * first.z)
    }
}
