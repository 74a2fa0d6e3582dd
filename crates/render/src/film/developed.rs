//! From sums to the numbers that files have: [`Developed`].

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::halves::Picture;
use super::pixels::PixelView;

/// The pixels of a finished picture, from the top left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Developed {
    /// Linear RGB of the film's colour space.
    pub rgb: Vec<[f32; 3]>,
    /// Pixels whose colour was cut.
    pub n_clipped: usize,
    /// Empty where it is not wanted or the film keeps none.
    pub variance: Vec<[f32; 3]>,
    /// Number of samples of each pixel; empty where it is not wanted.
    pub samples: Vec<f32>,
}

impl Developed {
    /// Reads a picture, in parallel on the current rayon pool. Colours are cut to what lies between `-limit` and `limit`.
    pub fn new(picture: &dyn Picture, limit: f32, variance: bool, samples: bool) -> Developed {
        let [width, height] = picture.size();
        let (width, n) = (width as usize, width as usize * height as usize);
        let pixels = || (0..n).into_par_iter().map(|i| picture.pixel((i % width) as u32, (i / width) as u32));
        let n_clipped = AtomicUsize::new(0);
        let cut = |pixel: PixelView| {
            let exact = pixel.rgb.map(|v| v as f32);
            let cut = exact.map(|v| v.clamp(-limit, limit));
            if exact.iter().zip(cut).any(|(a, b)| a.abs() > b.abs()) {
                n_clipped.fetch_add(1, Ordering::Relaxed);
            }
            cut
        };
        let mut developed = Developed { rgb: pixels().map(cut).collect(), ..Developed::default() };
        if variance && picture.has_variance() {
            developed.variance = pixels().map(|p| p.variance.map(|v| v as f32)).collect();
        }
        if samples {
            developed.samples = pixels().map(|p| p.n as f32).collect();
        }
        Developed { n_clipped: n_clipped.into_inner(), ..developed }
    }
}
