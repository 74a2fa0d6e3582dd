//! [`Film`]: the sums of all pixels.

use super::error::FilmError;
use super::fixed::{VALUE_STEP, WEIGHT_STEP, square, value, weight};
use super::near::Near;

/// Sums kept for the variance, on the film's grids.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RawSquares {
    /// Sum of `w^2 rgb^2`, in steps of 2^-64.
    pub rgb_sqr: [u128; 3],
    /// Sum of `w^2 rgb`, in steps of 2^-64.
    pub rgb: [i128; 3],
    /// Sum of `w^2`, in steps of 2^-64.
    pub weight: u128,
}

/// The sums of one pixel, on the film's grids.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RawPixel {
    /// Sum of `w rgb`, in steps of 2^-64.
    pub rgb: [i128; 3],
    /// Sum of `w`, in steps of 2^-32.
    pub weight: i64,
    /// Number of samples.
    pub n: u32,
    /// Present where the film keeps variances.
    pub squares: Option<RawSquares>,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelView {
    /// Weighted mean of the samples; zero where the weights sum to zero.
    pub rgb: [f64; 3],
    /// Sum of the weights.
    pub weight: f64,
    /// Number of samples.
    pub n: u64,
    /// Variance of `rgb`, estimated from the scatter of the samples as if they were independent, which is
    /// too large for stratified ones. Zero without variances, infinite below two samples or where a sum
    /// of squares has reached its end.
    pub variance: [f64; 3],
}

/// Sums of a pixel as a [`RawPixel`] has them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Sums {
    pub(super) rgb: [i128; 3],
    pub(super) weight: i64,
    pub(super) n: u32,
}

/// Sums of the samples of each pixel; see the module's documentation for grids and ranges.
///
/// 64 bytes per pixel, with variances 176.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Film {
    width: u32,
    height: u32,
    sums: Vec<Sums>,
    /// Empty where no variances are kept.
    squares: Vec<RawSquares>,
    rejected: u64,
}

impl Sums {
    #[inline]
    fn merge(&mut self, o: &Sums) {
        for (a, b) in self.rgb.iter_mut().zip(o.rgb) {
            *a = a.saturating_add(b);
        }
        self.weight = self.weight.saturating_add(o.weight);
        self.n = self.n.saturating_add(o.n);
    }
}

impl RawSquares {
    #[inline]
    fn merge(&mut self, o: &RawSquares) {
        for c in 0..3 {
            self.rgb_sqr[c] = self.rgb_sqr[c].saturating_add(o.rgb_sqr[c]);
            self.rgb[c] = self.rgb[c].saturating_add(o.rgb[c]);
        }
        self.weight = self.weight.saturating_add(o.weight);
    }
}

impl Film {
    /// An empty film for a window of `width * height` pixels.
    pub fn new(width: u32, height: u32, with_variance: bool) -> Film {
        let n = width as usize * height as usize;
        let squares = vec![RawSquares::default(); if with_variance { n } else { 0 }];
        Film { width, height, sums: vec![Sums::default(); n], squares, rejected: 0 }
    }
    /// Pixels per row.
    pub fn width(&self) -> u32 {
        self.width
    }
    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }
    /// Whether the film keeps what variances need.
    pub fn has_variance(&self) -> bool {
        !self.squares.is_empty()
    }
    /// Samples refused because a value or the weight was not finite.
    pub fn rejected(&self) -> u64 {
        self.rejected
    }
    /// Bytes of the sums.
    pub fn bytes(&self) -> usize {
        self.sums.len() * size_of::<Sums>() + self.squares.len() * size_of::<RawSquares>()
    }

    #[inline]
    fn index(&self, x: u32, y: u32) -> Option<usize> {
        (x < self.width && y < self.height).then(|| y as usize * self.width as usize + x as usize)
    }

    /// Adds a sample to pixel (`x`, `y`) of the window; outside of it nothing happens.
    ///
    /// A sample with a value or weight that is not finite is counted in [`Film::rejected`] and left out.
    #[inline]
    pub fn add(&mut self, x: u32, y: u32, rgb: [f32; 3], sample_weight: f32) {
        let Some(i) = self.index(x, y) else { return };
        if !(rgb[0].is_finite() && rgb[1].is_finite() && rgb[2].is_finite() && sample_weight.is_finite()) {
            self.rejected = self.rejected.saturating_add(1);
            return;
        }
        let steps = weight(sample_weight);
        let w = steps as f64 * WEIGHT_STEP;
        let sums = &mut self.sums[i];
        for (sum, v) in sums.rgb.iter_mut().zip(rgb) {
            *sum = sum.saturating_add(value(w * f64::from(v)));
        }
        sums.weight = sums.weight.saturating_add(steps);
        sums.n = sums.n.saturating_add(1);
        if let Some(squares) = self.squares.get_mut(i) {
            for (c, v) in rgb.into_iter().map(f64::from).enumerate() {
                squares.rgb_sqr[c] = squares.rgb_sqr[c].saturating_add(square((w * v) * (w * v)));
                squares.rgb[c] = squares.rgb[c].saturating_add(value(w * w * v));
            }
            squares.weight = squares.weight.saturating_add(square(w * w));
        }
    }

    /// Mean, weight and variance of a pixel; all zero outside the window.
    pub fn pixel(&self, x: u32, y: u32) -> PixelView {
        let Some(i) = self.index(x, y) else { return PixelView::default() };
        let sums = &self.sums[i];
        let weight = sums.weight as f64 * WEIGHT_STEP;
        let mut view = PixelView { weight, n: u64::from(sums.n), ..PixelView::default() };
        if sums.weight != 0 {
            view.rgb = sums.rgb.map(|s| s as f64 * VALUE_STEP / weight);
        }
        if let Some(squares) = self.squares.get(i) {
            for c in 0..3 {
                view.variance[c] = variance(squares, c, view.rgb[c], weight, sums.n);
            }
        }
        view
    }

    /// The sums of a pixel, for files of partial renders; `None` outside the window.
    pub fn raw(&self, x: u32, y: u32) -> Option<RawPixel> {
        let i = self.index(x, y)?;
        let Sums { rgb, weight, n } = self.sums[i];
        Some(RawPixel { rgb, weight, n, squares: self.squares.get(i).copied() })
    }

    /// Adds sums that another film gave out; exact. Outside the window nothing happens.
    ///
    /// # Errors
    /// [`FilmError::Variance`] where only one of the two has squares.
    pub fn add_raw(&mut self, x: u32, y: u32, raw: &RawPixel) -> Result<(), FilmError> {
        if raw.squares.is_some() != self.has_variance() {
            return Err(FilmError::Variance);
        }
        let Some(i) = self.index(x, y) else { return Ok(()) };
        self.sums[i].merge(&Sums { rgb: raw.rgb, weight: raw.weight, n: raw.n });
        if let (Some(own), Some(other)) = (self.squares.get_mut(i), &raw.squares) {
            own.merge(other);
        }
        Ok(())
    }

    /// Counts samples that another part of the render refused.
    pub fn add_rejected(&mut self, n: u64) {
        self.rejected = self.rejected.saturating_add(n);
    }

    /// Adds the samples of another film of the same window; exact.
    ///
    /// # Errors
    /// Where size or variances differ; the film is then unchanged.
    pub fn merge(&mut self, other: &Film) -> Result<(), FilmError> {
        let (film, size) = ([self.width, self.height], [other.width, other.height]);
        if film != size {
            return Err(FilmError::Size { film, other: size });
        }
        self.merge_at([0, 0], other)
    }

    /// Adds the samples of a smaller film whose first pixel is `origin`; exact.
    ///
    /// # Errors
    /// Where the other reaches beyond this one or variances differ; the film is then unchanged.
    pub(super) fn merge_at(&mut self, origin: [u32; 2], other: &Film) -> Result<(), FilmError> {
        let size = [other.width, other.height];
        self.check_fits(origin, size, other.has_variance())?;
        each_in(&mut self.sums, self.width, origin, size, &other.sums, Sums::merge);
        if self.has_variance() {
            each_in(&mut self.squares, self.width, origin, size, &other.squares, RawSquares::merge);
        }
        self.rejected = self.rejected.saturating_add(other.rejected);
        Ok(())
    }

    /// Adds sums of the pixels of a rectangle, row by row.
    pub(super) fn merge_near(&mut self, origin: [u32; 2], size: [u32; 2], near: &[Near]) {
        each_in(&mut self.sums, self.width, origin, size, near, |own, near| own.merge(&near.sums()));
    }

    /// Says what stands against adding the sums of a rectangle.
    pub(super) fn check_fits(
        &self,
        origin: [u32; 2],
        size: [u32; 2],
        with_variance: bool,
    ) -> Result<(), FilmError> {
        let film = [self.width, self.height];
        let fits = |c: usize| u64::from(origin[c]) + u64::from(size[c]) <= u64::from(film[c]);
        if !(fits(0) && fits(1)) {
            return Err(FilmError::Outside { film, origin, size });
        }
        if self.has_variance() != with_variance && size[0] > 0 && size[1] > 0 {
            return Err(FilmError::Variance);
        }
        Ok(())
    }

    /// Empties the film, keeping its memory.
    pub fn clear(&mut self) {
        self.sums.fill(Sums::default());
        self.squares.fill(RawSquares::default());
        self.rejected = 0;
    }
}

/// Visits the pixels of a rectangle of a film of that width, with what belongs to each.
fn each_in<A, B>(
    all: &mut [A],
    width: u32,
    origin: [u32; 2],
    size: [u32; 2],
    of_rectangle: &[B],
    visit: impl Fn(&mut A, &B),
) {
    let rows = of_rectangle.chunks_exact((size[0] as usize).max(1));
    for (y, row) in (origin[1] as usize..).zip(rows) {
        let first = y * width as usize + origin[0] as usize;
        all[first..][..row.len()].iter_mut().zip(row).for_each(|(own, other)| visit(own, other));
    }
}

/// Variance of the ratio `sum(w x) / sum(w)`: `n / (n - 1) * sum(w^2 (x - mean)^2) / sum(w)^2`. [Cochran1977, ch. 6]
fn variance(squares: &RawSquares, c: usize, mean: f64, weight: f64, n: u32) -> f64 {
    if n < 2 || weight.abs() < WEIGHT_STEP || squares.rgb_sqr[c] == u128::MAX {
        return f64::INFINITY;
    }
    let n = f64::from(n);
    let sqr = squares.rgb_sqr[c] as f64 * VALUE_STEP;
    let cross = squares.rgb[c] as f64 * VALUE_STEP;
    let scatter = sqr - 2.0 * mean * cross + mean * mean * squares.weight as f64 * VALUE_STEP;
    // Only rounding takes the scatter below zero.
    (scatter.max(0.0) * n / (n - 1.0)) / (weight * weight)
}
