//! Several rendered pictures as one: [`Sheet`].

use crate::error::LectureError;
use crate::photo::Photo;

/// Pixels between pictures.
pub(crate) const GAP: usize = 4;
/// What is seen there.
const GROUND: [f32; 3] = [1.0; 3];

/// Pictures of one size in rows and columns.
pub(crate) struct Sheet {
    /// Width and height of the whole, in pixels.
    pub(crate) size: [usize; 2],
    rgb: Vec<[f32; 3]>,
    cell: [usize; 2],
    n_columns: usize,
}

impl Sheet {
    /// An empty sheet for `n` pictures of `cell` pixels, `n_columns` in each row; above each row `head` pixels are left free.
    pub(crate) fn new(cell: [usize; 2], n: usize, n_columns: usize, head: usize) -> Sheet {
        let cell = [cell[0], cell[1] + head];
        let n_columns = n_columns.max(1);
        let rows = n.div_ceil(n_columns);
        let size = [n_columns * (cell[0] + GAP) - GAP, rows * (cell[1] + GAP) - GAP];
        Sheet { size, rgb: vec![GROUND; size[0] * size[1]], cell, n_columns }
    }
    /// The upper left corner of the place of picture `i`, its free head included.
    pub(crate) fn corner(&self, i: usize) -> [usize; 2] {
        let place = [i % self.n_columns, i / self.n_columns];
        [0, 1].map(|k| place[k] * (self.cell[k] + GAP))
    }
    /// Puts picture `i` at its place, all values multiplied by `exposure`.
    pub(crate) fn put(&mut self, i: usize, photo: &Photo, exposure: f32) {
        let [x0, y0] = self.corner(i);
        let head = self.cell[1] - photo.size[1];
        for (k, rgb) in photo.rgb.iter().enumerate() {
            let (x, y) = (x0 + k % photo.size[0], y0 + head + k / photo.size[0]);
            if let Some(pixel) = self.rgb.get_mut(y * self.size[0] + x) {
                *pixel = rgb.map(|v| v * exposure);
            }
        }
    }
    /// A PNG file.
    ///
    /// # Errors
    /// Where the sheet is empty.
    pub(crate) fn png(&self) -> Result<Vec<u8>, LectureError> {
        sparrow_image::encode_png(self.size[0], self.size[1], &self.rgb).map_err(LectureError::Figure)
    }
}

/// Pictures of one size side by side, each with its exposure, as a PNG file.
///
/// # Errors
/// Where there is none.
pub(crate) fn side_by_side(photos: &[(&Photo, f32)]) -> Result<Vec<u8>, LectureError> {
    let cell = photos.first().map_or([0, 0], |(p, _)| p.size);
    let mut sheet = Sheet::new(cell, photos.len(), photos.len(), 0);
    for (i, (photo, exposure)) in photos.iter().enumerate() {
        sheet.put(i, photo, *exposure);
    }
    sheet.png()
}
