//! A rectangle of the film with sums of its own, for one thread at a time: [`FilmTile`].

use super::error::FilmError;
use super::near::Near;
use super::pixels::Film;

/// A rectangle of a film, filled without locks and absorbed when done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilmTile {
    origin: [u32; 2],
    size: [u32; 2],
    /// Of samples as nearly all are; empty where variances are kept.
    near: Vec<Near>,
    /// Of all other samples, once there are any.
    rest: Option<Box<Film>>,
    with_variance: bool,
}

impl FilmTile {
    /// First pixel of the rectangle, in the film's window.
    pub fn origin(&self) -> [u32; 2] {
        self.origin
    }
    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }
    /// Adds a sample to the pixel (`x`, `y`) of the *film's* window; outside the tile nothing happens.
    ///
    /// A sample that is not finite is counted and left out.
    #[inline(always)]
    pub fn add(&mut self, x: u32, y: u32, rgb: [f32; 3], weight: f32) {
        // What lies before the tile wraps to numbers beyond its size.
        let (x, y) = (x.wrapping_sub(self.origin[0]), y.wrapping_sub(self.origin[1]));
        if x >= self.size[0] || y >= self.size[1] {
            return;
        }
        let i = y as usize * self.size[0] as usize + x as usize;
        if !self.near.get_mut(i).is_some_and(|near| near.add(rgb, weight)) {
            self.add_to_rest([x, y], rgb, weight);
        }
    }
    #[cold]
    #[inline(never)]
    fn add_to_rest(&mut self, [x, y]: [u32; 2], rgb: [f32; 3], weight: f32) {
        let [width, height] = self.size;
        let film = || Box::new(Film::new(width, height, self.with_variance));
        self.rest.get_or_insert_with(film).add(x, y, rgb, weight);
    }
}

impl Film {
    /// An empty tile of this film, cut at the window's edge.
    pub fn tile(&self, origin: [u32; 2], size: [u32; 2]) -> FilmTile {
        let origin = [origin[0].min(self.width()), origin[1].min(self.height())];
        let size = [size[0].min(self.width() - origin[0]), size[1].min(self.height() - origin[1])];
        let n = if self.has_variance() { 0 } else { size[0] as usize * size[1] as usize };
        FilmTile {
            origin,
            size,
            near: vec![Near::default(); n],
            rest: None,
            with_variance: self.has_variance(),
        }
    }
    /// Adds the samples of a tile; exact.
    ///
    /// # Errors
    /// Where the tile was made for another film and does not fit; the film is then unchanged.
    pub fn absorb(&mut self, tile: &FilmTile) -> Result<(), FilmError> {
        self.check_fits(tile.origin, tile.size, tile.with_variance)?;
        self.merge_near(tile.origin, tile.size, &tile.near);
        tile.rest.as_ref().map_or(Ok(()), |rest| self.merge_at(tile.origin, rest))
    }
}
