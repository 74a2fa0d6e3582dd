//! Herbert, a round animal with a head, ears, a tail and four stubby feet: a radius over the sphere of directions.

use std::f64::consts::{PI, TAU};

use sparrow_math::{Real, Vec3, vec3};

use super::grid;

/// Cells around the axis from nose to tail, and along it.
const AROUND: u32 = 40;
const ALONG: u32 = 24;
/// Half axes of the body: along x, from tail to nose; upwards; sideways.
const BODY: [f64; 3] = [0.95, 0.68, 0.62];
/// What is added to the radius: direction, height, sharpness.
const BUMPS: [([f64; 3], f64, f64); 8] = [
    ([1.0, 0.5, 0.0], 0.6, 14.0),
    ([0.78, 0.85, 0.4], 0.3, 45.0),
    ([0.78, 0.85, -0.4], 0.3, 45.0),
    ([-1.0, 0.35, 0.0], 0.35, 40.0),
    ([0.55, -0.9, 0.45], 0.3, 25.0),
    ([0.55, -0.9, -0.45], 0.3, 25.0),
    ([-0.6, -0.9, 0.45], 0.3, 25.0),
    ([-0.6, -0.9, -0.45], 0.3, 25.0),
];

/// Place of the skin at angle `u` around the axis and `v` from nose to tail, both in [0, 1].
fn place(u: f64, v: f64) -> Vec3<f64> {
    let (sv, cv) = Real::sin_cos(PI * v);
    let (su, cu) = Real::sin_cos(TAU * u);
    // Clockwise seen from the nose.
    let d = vec3(cv, sv * cu, -sv * su);
    let body = 1.0 / ((d.x / BODY[0]).sqr() + (d.y / BODY[1]).sqr() + (d.z / BODY[2]).sqr()).sqrt();
    let bumps = BUMPS.iter().map(|&([x, y, z], height, sharpness)| {
        height * Real::exp(sharpness * (d.dot(vec3(x, y, z).normalized()) - 1.0))
    });
    d * (body + bumps.sum::<f64>())
}

/// The mesh; u runs around, v from nose to tail, so that u, v and the outer normal are right-handed. The column at u = 1 stands
/// where that at u = 0 stands.
pub(super) fn ply() -> String {
    grid::ply(AROUND, ALONG, |i, j| {
        let [u, v] = [f64::from(i) / f64::from(AROUND), f64::from(j) / f64::from(ALONG)];
        let h = 1e-4;
        let at = f64::from(i % AROUND) / f64::from(AROUND);
        // At the poles the way around has no length; just beside them it has.
        let beside = v.clamp(2.0 * h, 1.0 - 2.0 * h);
        let around = place(at + h, beside) - place(at - h, beside);
        let along = place(at, beside + h) - place(at, beside - h);
        let n = around.cross(along).normalized();
        let p = place(at, v);
        [p.x, p.y, p.z, n.x, n.y, n.z, u, v]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_point_outwards() {
        let text = ply();
        let (_, body) = text.split_once("end_header\n").expect("a header");
        for line in body.lines().filter(|l| l.split(' ').count() == 8) {
            let x: Vec<f64> = line.split(' ').map(|w| w.parse().expect("a number")).collect();
            let out = x[0] * x[3] + x[1] * x[4] + x[2] * x[5];
            assert!(out > 0.0, "the skin is seen from the middle everywhere: {line}");
        }
    }
}
