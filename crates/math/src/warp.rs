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

/// Unit square to unit sphere, area-preserving, by a folded octahedron. [Clarberg2008]
///
/// pbrt-v4's layout of environment maps: the centre of the square is +z, its corners are -z.
#[inline(always)]
pub fn equal_area_square_to_sphere<R: Real>(p: [R; 2]) -> Vec3<R> {
    let (one, two) = (R::ONE, R::of(2.0));
    let (u, v) = (two * p[0] - one, two * p[1] - one);
    let (up, vp) = (u.abs(), v.abs());
    let signed = one - (up + vp);
    let r = one - signed.abs();
    let turn = R::select(r.gt(R::ZERO), (vp - up) / r + one, one);
    let (s, c) = (turn * R::of(core::f64::consts::FRAC_PI_4)).sin_cos();
    let h = r * (two - r * r).safe_sqrt();
    vec3((c * h).copysign(u), (s * h).copysign(v), (one - r * r).copysign(signed))
}

/// The way back from [`equal_area_square_to_sphere`].
#[inline(always)]
pub fn equal_area_sphere_to_square<R: Real>(d: Vec3<R>) -> [R; 2] {
    let (one, half) = (R::ONE, R::of(0.5));
    let r = (one - d.z.abs()).safe_sqrt();
    let phi = d.y.abs().atan2(d.x.abs()) * R::of(core::f64::consts::FRAC_2_PI);
    let (v, u) = (phi * r, r - phi * r);
    let below = d.z.lt(R::ZERO);
    let (u, v) = (R::select(below, one - v, u), R::select(below, one - u, v));
    [(u.copysign(d.x) + one) * half, (v.copysign(d.y) + one) * half]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn octahedral_map_and_its_inverse_agree() {
        for i in 0..64 {
            for j in 0..64 {
                let p = [(i as f32 + 0.37) / 64.0, (j as f32 + 0.61) / 64.0];
                let d = equal_area_square_to_sphere(p);
                assert!((d.length() - 1.0).abs() < 1e-6);
                let q = equal_area_sphere_to_square(d);
                assert!((p[0] - q[0]).abs() < 2e-4 && (p[1] - q[1]).abs() < 2e-4, "{p:?} {d:?} {q:?}");
            }
        }
        assert!(equal_area_square_to_sphere([0.5, 0.5]).z > 0.9999);
    }

    #[test]
    fn octahedral_map_preserves_area() {
        // Each octant holds an eighth of the square.
        let n = 256;
        let mut octants = [0u32; 8];
        for i in 0..n * n {
            let d = equal_area_square_to_sphere([
                ((i % n) as f32 + 0.5) / n as f32,
                ((i / n) as f32 + 0.5) / n as f32,
            ]);
            octants[usize::from(d.x > 0.0) + 2 * usize::from(d.y > 0.0) + 4 * usize::from(d.z > 0.0)] += 1;
        }
        let eighth = (n * n / 8) as f32;
        assert!(octants.iter().all(|&o| (o as f32 / eighth - 1.0).abs() < 0.02), "{octants:?}");
    }

    #[test]
    fn cosine_hemisphere_has_the_right_mean_height() {
        let n = 128;
        let mean: f64 = (0..n * n)
            .map(|i| {
                let u = [(f64::from(i % n) + 0.5) / f64::from(n), (f64::from(i / n) + 0.5) / f64::from(n)];
                cosine_hemisphere(u).z / f64::from(n * n)
            })
            .sum();
        // The midpoint rule loses half a power at the rim, where the height has a root.
        assert!((mean - 2.0 / 3.0).abs() < 1e-3, "{mean}");
    }
}
