//! A density on the unit square that is bilinear between its corners.

use sparrow_math::Real;

/// The least weight of a corner that lies in the plane of the viewpoint's surface, or behind it; pbrt-v4's value.
const LEAST_COSINE: f64 = 0.01;

/// Values at the corners (0, 0), (1, 0), (0, 1) and (1, 1).
#[derive(Clone, Copy)]
pub(crate) struct Bilinear<R>([R; 4]);

/// Draws from the density on [0, 1] that runs from `a` to `b`.
#[inline(always)]
fn sample_linear<R: Real>(u: R, a: R, b: R) -> R {
    let below = a + (a * a + u * (b * b - a * a)).sqrt();
    R::select(below.gt(R::ZERO), (u * (a + b) / below).min(R::ONE), u)
}

impl<R: Real> Bilinear<R> {
    /// Proportional to what stands at the corners; uniform where that is nothing.
    #[inline(always)]
    pub(crate) fn new(w: [R; 4]) -> Bilinear<R> {
        let some = (w[0] + w[1] + w[2] + w[3]).gt(R::ZERO);
        let or_one = R::select(some, R::ZERO, R::ONE);
        Bilinear([w[0] + or_one, w[1] + or_one, w[2] + or_one, w[3] + or_one])
    }
    /// By the cosines between a normal and the directions to the corners, on either side. [PharrJakobHumphreys2023, section 6.5.4]
    #[inline(always)]
    pub(crate) fn of_cosines(c: [R; 4]) -> Bilinear<R> {
        let least = R::of(LEAST_COSINE);
        Bilinear([c[0].abs().max(least), c[1].abs().max(least), c[2].abs().max(least), c[3].abs().max(least)])
    }
    #[inline(always)]
    pub(crate) fn sample(&self, u: [R; 2]) -> [R; 2] {
        let [w00, w10, w01, w11] = self.0;
        let y = sample_linear(u[1], w00 + w10, w01 + w11);
        let x = sample_linear(u[0], w00 + y * (w01 - w00), w10 + y * (w11 - w10));
        [x, y]
    }
    #[inline(always)]
    pub(crate) fn pdf(&self, [u, v]: [R; 2]) -> R {
        let (u, v) = (u.clamp(R::ZERO, R::ONE), v.clamp(R::ZERO, R::ONE));
        let [w00, w10, w01, w11] = self.0;
        let (not_u, not_v) = (R::ONE - u, R::ONE - v);
        let at = (w00 * not_v + w01 * v) * not_u + (w10 * not_v + w11 * v) * u;
        R::of(4.0) * at / (w00 + w10 + w01 + w11)
    }
}
