//! Every order of scattering on a Smith surface of GGX mirrors, by a random walk. [Heitz2016]
//!
//! The walk is the truth that energy compensation is held against. It is no registered model: its value is known only
//! as the mean of random numbers, while the contract [`Bsdf`](crate::Bsdf) asks for the same number at every call.
//!
//! Heights are uniform on [-1, 1], `c = (h + 1) / 2`; with `Lambda` of the direction of travel, which is
//! `-1 - Lambda(-w)` downwards, a ray at `c` leaves with probability `c^Lambda` and else meets the next facet at
//! `c / U^(1 / Lambda)`. [Heitz2016, eq. 10, alg. 3]

use sparrow_math::{LocalDir, Real};

use crate::ggx::Ggx;

/// Where a walk left the surface.
#[derive(Clone, Copy, Debug)]
pub struct WalkEnd {
    /// The direction in which it left, above.
    pub wi: LocalDir<f64>,
    /// Product of the reflectances met.
    pub weight: f64,
    /// Facets met.
    pub bounces: u32,
}

/// Bounces after which a walk is given up; a surface of width one keeps 1e-9 of the light that long.
const MAX_BOUNCES: u32 = 2000;

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

impl Ray<'_> {
    /// Moves to the next facet, or says that the ray has left.
    fn leaves(&mut self, u: f64) -> bool {
        let l = lambda(self.ggx, self.w);
        if self.w.z() > 0.0 && u < Real::pow(self.c, l) {
            return true;
        }
        // For u = 0 downwards the height is 0; upwards that has left above.
        self.c = (self.c / Real::pow(u.max(1e-300), 1.0 / l)).clamp(1e-300, 1.0);
        false
    }
    /// Is mirrored at a visible facet; returns the cosine to its normal.
    fn bounces(&mut self, u: [f64; 2]) -> f64 {
        let v = -self.w;
        let m = self.ggx.sample_visible(v, u);
        self.w = v.reflect(m);
        v.dot(m).clamp(0.0, 1.0)
    }
}

/// Sends light, or equally a view, from `wo` on a walk until it leaves. `fresnel` takes the cosine to a facet's normal,
/// `uniform` gives numbers in [0, 1).
pub fn walk(
    ggx: &Ggx<f64>,
    wo: LocalDir<f64>,
    fresnel: impl Fn(f64) -> f64,
    mut uniform: impl FnMut() -> f64,
) -> WalkEnd {
    let mut ray = Ray { ggx, w: -wo, c: 1.0 };
    let mut weight = 1.0;
    for bounces in 0..MAX_BOUNCES {
        if ray.leaves(uniform()) {
            return WalkEnd { wi: ray.w, weight, bounces };
        }
        weight *= fresnel(ray.bounces([uniform(), uniform()]));
    }
    WalkEnd { wi: wo, weight: 0.0, bounces: MAX_BOUNCES }
}

/// One random number whose mean is the value of the surface for `wo` and `wi`, both above, in 1/sr.
///
/// At every facet met the walk adds what reaches `wi` from there. [Heitz2016, alg. 5]
pub fn walk_value(
    ggx: &Ggx<f64>,
    wo: LocalDir<f64>,
    wi: LocalDir<f64>,
    fresnel: impl Fn(f64) -> f64,
    mut uniform: impl FnMut() -> f64,
) -> f64 {
    let mut ray = Ray { ggx, w: -wo, c: 1.0 };
    let (mut weight, mut sum) = (1.0, 0.0);
    let lambda_i = lambda(ggx, wi);
    for _ in 0..MAX_BOUNCES {
        if ray.leaves(uniform()) {
            break;
        }
        let v = -ray.w;
        let m = v.half(wi);
        let cos = v.dot(m);
        // Visible normals of either side: the projected area is cos theta (1 + Lambda(v)).
        let area = 0.5 * (ggx.stretched(v) + v.z());
        if m.z() > 0.0 && cos > 0.0 && area > 1e-12 {
            let phase = fresnel(cos.min(1.0)) * ggx.d(m) / (4.0 * area);
            sum += weight * phase * Real::pow(ray.c, lambda_i);
        }
        weight *= fresnel(ray.bounces([uniform(), uniform()]));
    }
    sum / wi.z()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::vec3;

    /// A small generator with a fixed seed. [Steele2014]
    fn generator(mut state: u64) -> impl FnMut() -> f64 {
        move || {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = state;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
        }
    }

    #[test]
    fn values_of_one_bounce_are_those_of_the_formula() {
        let ggx = Ggx::new(0.4, 0.7);
        let wo = LocalDir::from_angles(0.9, 0.3);
        let wi = LocalDir::from_angles(0.6, 2.9);
        let m = wo.half(wi);
        let want = ggx.d(m) * ggx.g2_over_4cos(wo, wi);
        let mut u = generator(3);
        let n = 40_000;
        // A reflectance of 1e-6 makes the second bounce a millionth of the first.
        let sum: f64 = (0..n).map(|_| 1e6 * walk_value(&ggx, wo, wi, |_| 1e-6, &mut u)).sum();
        let got = sum / f64::from(n);
        assert!((got - want).abs() < 0.01 * want, "{got} {want}");
    }

    #[test]
    fn values_integrate_to_all_the_light() {
        let ggx = Ggx::new(0.8, 0.8);
        let wo = LocalDir::from_angles(1.1, 0.0);
        let mut u = generator(11);
        let n = 60_000;
        let mut sum = 0.0;
        for _ in 0..n {
            let z = u();
            let (s, c) = Real::sin_cos(core::f64::consts::TAU * u());
            let r = Real::safe_sqrt(1.0 - z * z);
            let wi = LocalDir::new(vec3(r * c, r * s, z));
            sum += walk_value(&ggx, wo, wi, |_| 1.0, &mut u) * z * core::f64::consts::TAU;
        }
        let got = sum / f64::from(n);
        assert!((got - 1.0).abs() < 0.03, "{got}");
    }
}
