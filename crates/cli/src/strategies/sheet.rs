//! A contact sheet: pictures of one size in rows of four, each with a line of text above it.

use super::{Pixels, letters};

/// Pictures in a row.
const COLUMNS: usize = 4;
/// Widest picture, in pixels; what is wider is shrunk by a whole number.
const WIDEST: usize = 512;
/// Blank pixels around pictures and text.
const GAP: usize = 6;

const PAPER: [f32; 3] = [1.0; 3];
const INK: [f32; 3] = [0.0; 3];

/// Pictures that are put side by side.
pub(super) struct Sheet {
    width: usize,
    tiles: Vec<(String, Pixels)>,
}

impl Sheet {
    /// For pictures of that width.
    pub(super) fn new(width: usize) -> Sheet {
        Sheet { width, tiles: Vec::new() }
    }

    /// Adds a picture.
    pub(super) fn add(&mut self, title: &str, pixels: &[[f32; 3]]) {
        self.tiles.push((title.to_owned(), shrunk(pixels, self.width, self.shrink())));
    }

    fn shrink(&self) -> usize {
        self.width.div_ceil(WIDEST)
    }

    /// Width and pixels of the whole.
    pub(super) fn finish(self) -> (usize, Pixels) {
        let width = self.width.div_ceil(self.shrink());
        let height = self.tiles.first().map_or(0, |t| t.1.len() / width);
        let cell = [width + GAP, letters::HEIGHT + height + 3 * GAP];
        let size = [COLUMNS * cell[0] + GAP, self.tiles.len().div_ceil(COLUMNS) * cell[1]];
        let mut sheet = vec![PAPER; size[0] * size[1]];
        for (i, (title, pixels)) in self.tiles.iter().enumerate() {
            let [left, top] = [GAP + i % COLUMNS * cell[0], GAP + i / COLUMNS * cell[1]];
            for [x, y] in letters::pixels(title).filter(|[x, _]| *x < width) {
                sheet[(top + y) * size[0] + left + x] = INK;
            }
            for (y, row) in pixels.chunks_exact(width).enumerate() {
                let start = (top + letters::HEIGHT + GAP + y) * size[0] + left;
                sheet[start..start + width].copy_from_slice(row);
            }
        }
        (size[0], sheet)
    }
}

/// Means over squares of `by` pixels; those at the right and lower edge may be smaller.
fn shrunk(pixels: &[[f32; 3]], width: usize, by: usize) -> Pixels {
    let height = pixels.len() / width;
    let mut small = Vec::with_capacity(width.div_ceil(by) * height.div_ceil(by));
    for top in (0..height).step_by(by) {
        for left in (0..width).step_by(by) {
            let (mut sum, mut n) = ([0.0; 3], 0.0);
            for y in top..(top + by).min(height) {
                for p in &pixels[y * width + left..y * width + (left + by).min(width)] {
                    // As it is shown: what is brighter than white does not outshine its neighbours.
                    (0..3).for_each(|c| sum[c] += p[c].clamp(0.0, 1.0));
                    n += 1.0;
                }
            }
            small.push(sum.map(|s| s / n));
        }
    }
    small
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn pictures_stand_where_they_belong() {
        let (width, height) = (2 * WIDEST + 1, 5);
        let mut sheet = Sheet::new(width);
        for i in 0..5 {
            sheet.add("I", &vec![[0.125 * i as f32; 3]; width * height]);
        }
        let (w, pixels) = sheet.finish();
        let small = width.div_ceil(3);
        assert_eq!(w, COLUMNS * (small + GAP) + GAP);
        let below = |tile: usize| {
            let [x, y] = [
                GAP + tile % COLUMNS * (small + GAP),
                GAP + tile / COLUMNS * (letters::HEIGHT + 2 + 3 * GAP),
            ];
            pixels[(y + letters::HEIGHT + GAP) * w + x + small - 1]
        };
        for tile in 0..5 {
            assert_eq!(below(tile), [0.125 * tile as f32; 3], "tile {tile}");
        }
        assert_eq!(pixels[GAP * w + GAP + 2], INK, "the text");
        assert_eq!(pixels[pixels.len() - 1], PAPER);
    }
}
