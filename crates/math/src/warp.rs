//! Maps of the unit square that carry uniform numbers to directions and points.

use core::f64::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI};

use crate::real::Real;
use crate::vec3::{Vec3, vec3};

/// Unit square to unit disk, area- and neighbour-preserving. [ShirleyChiu1997]
#[inline(always)]
pub fn concentric_disk<R: Real>(u: [R; 2]) -> [R; 2] {
    let a = u[0] + u[0] - R::ONE;
    let b = u[1] + u[1] - R::ONE;
    let wide = a.abs().gt(b.abs());
    let r = R::select(wide, a, b);
    let safe = R::select(r.abs().gt(R::ZERO), r, R::ONE);
    let q = R::of(FRAC_PI_4) * R::select(wide, b, a) / safe;
    let phi = R::select(wide, q, R::of(FRAC_PI_2) - q);
    let (s, c) = phi.sin_cos();
    [r * c, r * s]
}

/// Direction about z with density `cos theta / pi`.
#[inline(always)]
pub fn cosine_hemisphere<R: Real>(u: [R; 2]) -> Vec3<R> {
    let [x, y] = concentric_disk(u);
    vec3(x, y, (R::ONE - x * x - y * y).safe_sqrt())
}

/// Density of [`cosine_hemisphere`], per steradian.
#[inline(always)]
pub fn cosine_hemisphere_pdf<R: Real>(cos_theta: R) -> R {
    cos_theta * R::of(FRAC_1_PI)
}

/// Direction uniform over the sphere, density `1 / (4 pi)`.
#[inline(always)]
pub fn uniform_sphere<R: Real>(u: [R; 2]) -> Vec3<R> {
    let z = R::ONE - (u[0] + u[0]);
    let r = (R::ONE - z * z).safe_sqrt();
    let (s, c) = (R::of(2.0 * PI) * u[1]).sin_cos();
    vec3(r * c, r * s, z)
}

/// Direction uniform in the cone about z given by `1 - cos theta_max`; density `1 / (2 pi (1 - cos theta_max))`.
///
/// Takes `1 - cos` because that keeps its digits in narrow cones.
#[inline(always)]
pub fn uniform_cone<R: Real>(u: [R; 2], one_minus_cos_max: R) -> Vec3<R> {
    let omc = u[0] * one_minus_cos_max;
    let r = (omc * (R::of(2.0) - omc)).safe_sqrt();
    let (s, c) = (R::of(2.0 * PI) * u[1]).sin_cos();
    vec3(r * c, r * s, R::ONE - omc)
}

/// Barycentric weights of the first two corners, uniform over a triangle. [Heitz2019]
#[inline(always)]
pub fn uniform_triangle<R: Real>(u: [R; 2]) -> [R; 2] {
    let low = u[0].lt(u[1]);
    let half = R::of(0.5);
    let b0 = R::select(low, u[0] * half, u[0] - u[1] * half);
    let b1 = R::select(low, u[1] - u[0] * half, u[1] * half);
    [b0, b1]
}
