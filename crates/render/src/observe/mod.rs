//! What is made of a render's paths beside the picture: [`Observer`], for all tiles, and [`TileObserver`], for one.

mod optimal;
mod strategies;

use sparrow_spectra::Spectrum;

use crate::film::FilmError;
use crate::integrator::Record;

pub(crate) use optimal::Learning;
pub(crate) use strategies::Sorting;
pub use strategies::{Strategies, Technique};

/// A camera sample as it goes to the film.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// Column and row in the film's window.
    pub(crate) pixel: [u32; 2],
    /// Linear RGB of the output colour space.
    pub(crate) rgb: [f32; 3],
    /// Weight of the pixel filter.
    pub(crate) weight: f32,
}

/// Looks at the samples of one tile, on one thread.
pub(crate) trait TileObserver {
    /// What a path is to write down.
    type Record: Record + Default + Send;
    /// Takes a sample; `rgb` turns a part of its radiance into what the film would show.
    ///
    /// Returns what the film gets for it, in linear RGB: the sample itself, or an estimate of the same mean.
    fn take(
        &mut self,
        sample: Sample,
        record: &Self::Record,
        rgb: impl Fn(Spectrum<f32>) -> [f32; 3],
    ) -> [f32; 3];
}

/// Looks at a render. What it makes of the samples depends on neither threads nor tiles.
pub(crate) trait Observer: Sync {
    /// For one tile.
    type Tile: TileObserver;
    /// Passes get points of their own: what is learned in one is independent of the samples of the next.
    const LEARNS: bool = false;
    /// Has to see each camera sample as one path.
    const WHOLE_PATHS: bool = true;
    /// Begins a tile.
    fn tile(&self, origin: [u32; 2], size: [u32; 2]) -> Self::Tile;
    /// Takes over what a tile has seen.
    fn absorb(&self, tile: &Self::Tile) -> Result<(), FilmError>;
}

/// Nobody looks.
impl TileObserver for () {
    type Record = ();
    #[inline(always)]
    fn take(&mut self, s: Sample, (): &(), _: impl Fn(Spectrum<f32>) -> [f32; 3]) -> [f32; 3] {
        s.rgb
    }
}
impl Observer for () {
    type Tile = ();
    const WHOLE_PATHS: bool = false;
    fn tile(&self, _: [u32; 2], _: [u32; 2]) {}
    fn absorb(&self, (): &()) -> Result<(), FilmError> {
        Ok(())
    }
}
