//! Light by the technique that found it: [`Strategies`], the pictures of [VeachGuibas1995].

use std::sync::{Mutex, PoisonError};

use sparrow_mis::Mis;
use sparrow_spectra::Spectrum;

use super::{Observer, Sample, TileObserver};
use crate::film::{Film, FilmError, FilmTile};
use crate::integrator::{Finder, Record};

/// The light that one technique found, at all vertices of the paths.
#[derive(Clone, Debug)]
pub struct Technique<F = Film> {
    /// As if the technique were alone.
    pub unweighted: F,
    /// With MIS weights: its share of the picture.
    pub weighted: F,
}

/// The parts that a picture is the sum of: what the camera sees, and the weighted light of both techniques.
///
/// | light | is counted |
/// | --- | --- |
/// | emitters and backgrounds that the camera sees itself | as `seen` |
/// | found by light sampling at any vertex; points, spots and distant lights, weight 1 | as `light` |
/// | found along a direction from the BSDF at any vertex; along one of a delta lobe, weight 1 | as `bsdf` |
///
/// The films keep variances. Where the scene's `maxcomponentvalue` cuts samples, each part is cut for itself.
#[derive(Clone, Debug)]
pub struct Strategies<F = Film> {
    /// Seen by the camera.
    pub seen: F,
    /// Found by light sampling.
    pub light: Technique<F>,
    /// Found by BSDF sampling.
    pub bsdf: Technique<F>,
}

impl<F> Strategies<F> {
    fn of(mut film: impl FnMut() -> F) -> Strategies<F> {
        let mut technique = || Technique { unweighted: film(), weighted: film() };
        let (light, bsdf) = (technique(), technique());
        Strategies { seen: film(), light, bsdf }
    }
    fn each(&self) -> [&F; 5] {
        let (l, b) = (&self.light, &self.bsdf);
        [&self.seen, &l.unweighted, &l.weighted, &b.unweighted, &b.weighted]
    }
    fn each_mut(&mut self) -> [&mut F; 5] {
        let (l, b) = (&mut self.light, &mut self.bsdf);
        [&mut self.seen, &mut l.unweighted, &mut l.weighted, &mut b.unweighted, &mut b.weighted]
    }
}

impl Strategies {
    /// Bytes of the films.
    pub fn bytes(&self) -> usize {
        self.each().iter().map(|f| f.bytes()).sum()
    }
}

/// The parts of one path's radiance, in the order of [`Strategies::each`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parts([Spectrum<f32>; 5]);

impl Default for Parts {
    fn default() -> Parts {
        Parts([Spectrum::ZERO; 5])
    }
}

impl Record for Parts {
    #[inline]
    fn found(&mut self, by: Finder, light: Spectrum<f32>, weight: f32) {
        let [seen, light_alone, light_share, bsdf_alone, bsdf_share] = &mut self.0;
        let (alone, share) = match by {
            Finder::Camera => return *seen += light,
            Finder::Light(_) => (light_alone, light_share),
            Finder::Bsdf(_) => (bsdf_alone, bsdf_share),
        };
        *alone += light;
        *share += light * weight;
    }
}

/// Sorts the light of a render.
pub(crate) struct Sorting {
    films: Mutex<Strategies>,
    /// One over the chance that a technique has its turn.
    turns: f32,
}

impl Sorting {
    /// For a picture of that size.
    pub(crate) fn new([width, height]: [u32; 2], mis: Mis) -> Sorting {
        let films = Mutex::new(Strategies::of(|| Film::new(width, height, true)));
        Sorting { films, turns: if mis == Mis::OneSample { 2.0 } else { 1.0 } }
    }
    pub(crate) fn into_films(self) -> Strategies {
        self.films.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The films of one tile.
pub(crate) struct SortingTile {
    films: Strategies<FilmTile>,
    turns: f32,
}

impl Observer for Sorting {
    type Tile = SortingTile;
    fn tile(&self, origin: [u32; 2], size: [u32; 2]) -> SortingTile {
        let films = self.films.lock().unwrap_or_else(PoisonError::into_inner);
        SortingTile { films: Strategies::of(|| films.seen.tile(origin, size)), turns: self.turns }
    }
    fn absorb(&self, tile: &SortingTile) -> Result<(), FilmError> {
        let mut films = self.films.lock().unwrap_or_else(PoisonError::into_inner);
        films.each_mut().into_iter().zip(tile.films.each()).try_for_each(|(film, part)| film.absorb(part))
    }
}

impl TileObserver for SortingTile {
    type Record = Parts;
    fn take(&mut self, sample: Sample, parts: &Parts, rgb: impl Fn(Spectrum<f32>) -> [f32; 3]) -> [f32; 3] {
        let [x, y] = sample.pixel;
        let [seen, light_alone, light_share, bsdf_alone, bsdf_share] = parts.0;
        let parts = [seen, light_alone * self.turns, light_share, bsdf_alone * self.turns, bsdf_share];
        for (film, part) in self.films.each_mut().into_iter().zip(parts) {
            film.add(x, y, rgb(part), sample.weight);
        }
        sample.rgb
    }
}
