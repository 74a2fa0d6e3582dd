//! A rendered picture: [`Photo`].

use sparrow_render::camera::Camera;

use crate::error::LectureError;

/// A rendered picture with the camera that took it.
#[derive(Clone, Debug)]
pub struct Photo {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Linear RGB, row by row from the top, `[height * width]`.
    pub rgb: Vec<[f32; 3]>,
    /// Variance of `rgb`, as the film estimates it.
    pub variance: Vec<[f32; 3]>,
    /// The camera.
    pub camera: Camera,
}

impl Photo {
    /// Linear RGB of a pixel; black outside of the picture.
    pub fn at(&self, x: usize, y: usize) -> [f32; 3] {
        let inside = x < self.size[0] && y < self.size[1];
        if inside { self.rgb[y * self.size[0] + x] } else { [0.0; 3] }
    }
    /// The mean of red, green and blue of a pixel.
    pub fn grey(&self, x: usize, y: usize) -> f64 {
        self.at(x, y).iter().map(|v| f64::from(*v)).sum::<f64>() / 3.0
    }
    /// The mean of [`grey`](Self::grey) over columns and rows from the first to before the last of each.
    pub fn mean(&self, columns: std::ops::Range<usize>, rows: std::ops::Range<usize>) -> f64 {
        let n = (columns.len() * rows.len()) as f64;
        rows.map(|y| columns.clone().map(|x| self.grey(x, y)).sum::<f64>()).sum::<f64>() / n
    }
    /// The mean of [`grey`](Self::grey) over all pixels.
    pub fn brightness(&self) -> f64 {
        self.mean(0..self.size[0], 0..self.size[1])
    }
    /// Where on the picture a point of the world is seen, in pixels from the top left corner; none behind the camera.
    pub fn place(&self, point: [f64; 3]) -> Option<[f64; 2]> {
        let camera = self.camera.to_world().inverse();
        let p = camera.point(sparrow_math::vec3(point[0], point[1], point[2]));
        let [x, y, w] = [0, 1, 3].map(|row| {
            let m = self.camera.film_from_camera()[row];
            m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3]
        });
        (p.z > 0.0 && w > 0.0).then(|| [x / w, y / w])
    }
    /// The picture as a PNG, all values multiplied by `exposure`.
    ///
    /// # Errors
    /// Where the picture is empty.
    pub fn png(&self, exposure: f32) -> Result<Vec<u8>, LectureError> {
        let rgb: Vec<[f32; 3]> = self.rgb.iter().map(|p| p.map(|v| v * exposure)).collect();
        sparrow_image::encode_png(self.size[0], self.size[1], &rgb).map_err(LectureError::Figure)
    }
}
