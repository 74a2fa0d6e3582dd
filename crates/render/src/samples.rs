//! The camera samples of a tile: [`Samples`].

use core::ops::Range;

/// Samples of one pixel that follow each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct OfPixel {
    /// Column and row in the film's window.
    pub(crate) pixel: [u32; 2],
    pub(crate) samples: Range<u32>,
}

/// Some samples of every pixel of a rectangle, pixel by pixel.
pub(crate) struct Samples {
    first: [u32; 2],
    size: [u32; 2],
    samples: Range<u32>,
    /// Column, row and sample of what comes next; column and row from the first.
    next: ([u32; 2], u32),
}

impl Samples {
    /// Those numbers of each pixel.
    pub(crate) fn new(first: [u32; 2], size: [u32; 2], samples: Range<u32>) -> Samples {
        Samples { first, size, next: ([0, 0], samples.start), samples }
    }

    /// Takes the next samples of one pixel, so many at most; none where all were taken.
    pub(crate) fn of_pixel(&mut self, most: u32) -> Option<OfPixel> {
        let ([x, y], sample) = &mut self.next;
        if *y == self.size[1] || *x == self.size[0] || *sample == self.samples.end {
            return None;
        }
        let pixel = [self.first[0] + *x, self.first[1] + *y];
        let samples = *sample..self.samples.end.min(sample.saturating_add(most));
        *sample = samples.end;
        if *sample == self.samples.end {
            (*sample, *x) = (self.samples.start, *x + 1);
        }
        if *x == self.size[0] {
            (*x, *y) = (0, *y + 1);
        }
        Some(OfPixel { pixel, samples })
    }
}

/// Samples one by one, as pixel and number.
impl Iterator for Samples {
    type Item = ([u32; 2], u32);
    fn next(&mut self) -> Option<([u32; 2], u32)> {
        self.of_pixel(1).map(|of| (of.pixel, of.samples.start))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_the_samples_one_by_one() {
        let all: Vec<_> = Samples::new([4, 7], [3, 2], 10..15).collect();
        assert_eq!((all.len(), all[0], all[29]), (30, ([4, 7], 10), ([6, 8], 14)));
        for most in [1, 2, 5, 9] {
            let mut samples = Samples::new([4, 7], [3, 2], 10..15);
            let runs = core::iter::from_fn(|| samples.of_pixel(most));
            let each = runs.flat_map(|OfPixel { pixel, samples }| samples.map(move |s| (pixel, s)));
            assert_eq!(each.collect::<Vec<_>>(), all, "{most}");
        }
    }

    #[test]
    fn nothing_comes_of_nothing() {
        for (size, samples) in [([0, 3], 0..4), ([3, 0], 0..4), ([3, 3], 4..4)] {
            assert_eq!(Samples::new([1, 1], size, samples).of_pixel(8), None);
        }
    }
}
