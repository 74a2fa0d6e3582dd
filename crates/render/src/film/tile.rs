//! A rectangle of the film with sums of its own, for one thread at a time: [`FilmTile`].

use super::error::FilmError;
use super::pixels::Film;

/// A rectangle of a film, filled without locks and absorbed when done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilmTile {
    origin: [u32; 2],
    film: Film,
}

impl FilmTile {
    /// First pixel of the rectangle, in the film's window.
    pub fn origin(&self) -> [u32; 2] {
        self.origin
    }
    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.film.width(), self.film.height()]
    }
    /// Adds a sample to the pixel (`x`, `y`) of the *film's* window; outside the tile nothing happens.
    ///
    /// A sample that is not finite is counted and left out.
    #[inline]
    pub fn add(&mut self, x: u32, y: u32, rgb: [f32; 3], weight: f32) {
        // What lies before the tile wraps to numbers beyond its size.
        self.film.add(x.wrapping_sub(self.origin[0]), y.wrapping_sub(self.origin[1]), rgb, weight);
    }
    /// Samples refused so far.
    pub fn rejected(&self) -> u64 {
        self.film.rejected()
    }
    /// Empties the tile and moves it, keeping its memory; the size stays.
    pub fn reuse(&mut self, origin: [u32; 2]) {
        self.film.clear();
        self.origin = origin;
    }
}

impl Film {
    /// An empty tile of this film, cut at the window's edge.
    pub fn tile(&self, origin: [u32; 2], size: [u32; 2]) -> FilmTile {
        let origin = [origin[0].min(self.width()), origin[1].min(self.height())];
        let width = size[0].min(self.width() - origin[0]);
        let height = size[1].min(self.height() - origin[1]);
        FilmTile { origin, film: Film::new(width, height, self.has_variance()) }
    }
    /// Adds the samples of a tile; exact.
    ///
    /// # Errors
    /// Where the tile was made for another film and does not fit; the film is then unchanged.
    pub fn absorb(&mut self, tile: &FilmTile) -> Result<(), FilmError> {
        self.merge_at(tile.origin, &tile.film)
    }
}
