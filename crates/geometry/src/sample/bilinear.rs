//! A density on the unit square that is bilinear between its corners.

use sparrow_math::{Real, Vec3};

/// The least weight of a corner that lies in the plane of the viewpoint's surface, or behind it; pbrt-v4's value.
const LEAST_COSINE: f64 = 0.01;

/// Values at the corners (0, 0), (1, 0), (0, 1) and (1, 1).
pub(crate) struct Bilinear([f64; 4]);

/// Draws from the density on [0, 1] that runs from `a` to `b`.
fn sample_linear(u: f64, a: f64, b: f64) -> f64 {
    let x = u * (a + b) / (a + (a * a + u * (b * b - a * a)).sqrt());
    if x.is_finite() { x.min(1.0) } else { u }
}

impl Bilinear {
    /// Proportional to what stands at the corners; uniform where that is nothing.
    pub(crate) fn new(w: [f64; 4]) -> Bilinear {
        Bilinear(if w.iter().sum::<f64>() > 0.0 { w } else { [1.0; 4] })
    }
    /// The cosines between a normal and the directions to the corners, on either side. [PharrJakobHumphreys2023, section 6.5.4]
    pub(crate) fn of_cosines(n: Vec3<f32>, corners: [Vec3<f64>; 4]) -> Bilinear {
        let n = n.to_f64();
        Bilinear(corners.map(|d| (n.dot(d).abs() / d.length()).max(LEAST_COSINE)))
    }
    #[inline]
    pub(crate) fn sample(&self, u: [f32; 2]) -> [f64; 2] {
        let [w00, w10, w01, w11] = self.0;
        let y = sample_linear(u[1].into(), w00 + w10, w01 + w11);
        let x = sample_linear(u[0].into(), w00 + y * (w01 - w00), w10 + y * (w11 - w10));
        [x, y]
    }
    #[inline]
    pub(crate) fn pdf(&self, [u, v]: [f64; 2]) -> f64 {
        let (u, v) = (Real::clamp(u, 0.0, 1.0), Real::clamp(v, 0.0, 1.0));
        let [w00, w10, w01, w11] = self.0;
        let at = (w00 * (1.0 - v) + w01 * v) * (1.0 - u) + (w10 * (1.0 - v) + w11 * v) * u;
        4.0 * at / (w00 + w10 + w01 + w11)
    }
}
