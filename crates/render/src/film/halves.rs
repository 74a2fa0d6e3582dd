//! Two independent films of the same picture: [`Halves`]; and what any finished render shows: [`Picture`].

use super::pixels::{Film, PixelView};

/// A finished picture, pixel by pixel.
pub trait Picture: Sync {
    /// Width and height.
    fn size(&self) -> [u32; 2];
    /// Whether [`PixelView::variance`] is known.
    fn has_variance(&self) -> bool;
    /// What a pixel shows; all zero outside the picture.
    fn pixel(&self, x: u32, y: u32) -> PixelView;
    /// Bytes of the sums.
    fn bytes(&self) -> usize;
}

impl Picture for Film {
    fn size(&self) -> [u32; 2] {
        [self.width(), self.height()]
    }
    fn has_variance(&self) -> bool {
        Film::has_variance(self)
    }
    fn pixel(&self, x: u32, y: u32) -> PixelView {
        Film::pixel(self, x, y)
    }
    fn bytes(&self) -> usize {
        Film::bytes(self)
    }
}

/// Two films of one picture, filled with independent points.
///
/// The picture is the mean of both, each with weight 1/2 whatever their numbers of samples, so that a number that
/// depends on the samples of *one* half may set the number of the *other* without moving the mean.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Halves(pub [Film; 2]);

impl Picture for Halves {
    fn size(&self) -> [u32; 2] {
        self.0[0].size()
    }
    fn has_variance(&self) -> bool {
        self.0[0].has_variance()
    }
    fn pixel(&self, x: u32, y: u32) -> PixelView {
        let [a, b] = [0, 1].map(|i| self.0[i].pixel(x, y));
        // A render that was stopped may have samples in one half only.
        match (a.n, b.n) {
            (_, 0) => a,
            (0, _) => b,
            _ => PixelView {
                rgb: [0, 1, 2].map(|c| 0.5 * (a.rgb[c] + b.rgb[c])),
                weight: a.weight + b.weight,
                n: a.n + b.n,
                variance: [0, 1, 2].map(|c| 0.25 * (a.variance[c] + b.variance[c])),
            },
        }
    }
    fn bytes(&self) -> usize {
        self.0[0].bytes() + self.0[1].bytes()
    }
}
