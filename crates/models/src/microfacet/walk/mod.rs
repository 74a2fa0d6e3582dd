//! Every order of scattering on a Smith surface of GGX facets, by a random walk. [Heitz2016]
//!
//! Heights are uniform on [-1, 1], `c = (h + 1) / 2`; with `Lambda` of the direction of travel, which is
//! `-1 - Lambda(-w)` downwards, a ray at `c` leaves upwards with probability `c^Lambda` and else meets the next facet at
//! `c / U^(1 / Lambda)`, U uniform on what is left. [Heitz2016, eq. 10, alg. 3]
//!
//! A model needs the same number at every call, but the walk only knows its value as the mean of random ones.
//! [`mirrors::further`] and [`boundary::further`] therefore draw their numbers from the two directions
//! ([`numbers::Numbers`]): one pair has one value, either way round, and the mean over any range of directions is right.
//! What one facet sends is known in closed form and not left to chance.

pub(crate) mod boundary;
pub(crate) mod mirrors;
mod numbers;

pub use mirrors::{WalkEnd, walk};

use sparrow_math::{LocalDir, Real};

use crate::ggx::Ggx;

/// Facets after which a walk is given up; a surface of width one keeps 1e-9 of the light that long.
const MAX_BOUNCES: u32 = 2000;
/// Least height: what lies at zero cannot be told apart, and its powers are no numbers.
const BOTTOM: f64 = 1e-300;

/// `Lambda` of a direction of travel.
fn lambda(ggx: &Ggx<f64>, w: LocalDir<f64>) -> f64 {
    let up = 0.5 * (ggx.stretched(w) / w.abs_cos_theta().max(1e-300) - 1.0);
    if w.z() > 0.0 { up } else { -1.0 - up }
}

/// The walk's state: direction of travel and height.
struct Ray<'a> {
    ggx: &'a Ggx<f64>,
    w: LocalDir<f64>,
    c: f64,
}

impl<'a> Ray<'a> {
    /// Comes down along `-from`.
    fn entering(ggx: &'a Ggx<f64>, from: LocalDir<f64>) -> Self {
        Ray { ggx, w: -from, c: 1.0 }
    }
    /// Moves to the facet that the ray would meet next; returns the chance that it meets one before it leaves.
    ///
    /// Few rays that go steeply up meet another facet, which then reflects them much: values take the chance as a factor,
    /// and only then let it decide.
    fn advance(&mut self, u: f64) -> f64 {
        let l = lambda(self.ggx, self.w);
        let leaves = if self.w.z() > 0.0 { Real::pow(self.c, l) } else { 0.0 };
        let u = (leaves + (1.0 - leaves) * u).max(BOTTOM);
        self.c = (self.c / Real::pow(u, 1.0 / l)).clamp(BOTTOM, 1.0);
        1.0 - leaves
    }
    /// The facet that is met: its normal, and its cosine with the ray.
    fn facet(&self, u: [f64; 2]) -> (LocalDir<f64>, f64) {
        let v = -self.w;
        let m = self.ggx.sample_visible(v, u);
        (m, v.dot(m).clamp(0.0, 1.0))
    }
    /// `D(m) / (cos theta (1 + Lambda(v)))`: with `v.m` the density of the visible normals, seen from either side.
    fn visible_over_cos(&self, m: LocalDir<f64>) -> f64 {
        let v = -self.w;
        let area = 0.5 * (self.ggx.stretched(v) + v.z());
        if m.z() > 0.0 && v.dot(m) > 0.0 && area > 1e-12 { self.ggx.d(m) / area } else { 0.0 }
    }
}

/// The more grazing of two directions above first: from there the walk's end is seen with the least chance. Either order
/// gives the same.
fn ordered(a: LocalDir<f64>, b: LocalDir<f64>) -> (LocalDir<f64>, LocalDir<f64>) {
    let key = |w: LocalDir<f64>| [w.z(), w.x(), w.y()];
    if key(b) < key(a) { (b, a) } else { (a, b) }
}
