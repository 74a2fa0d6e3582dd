//! A cloth that lies in folds: a height over the plane y = 0.

use sparrow_math::{Real, Vec3, vec3};

use super::grid;

const SIDE: u32 = 32;
const WIDTH: f64 = 2.4;

/// Place of the cloth above (x, z): folds that run from front to back, wander and flatten towards the edges.
fn place(x: f64, z: f64) -> Vec3<f64> {
    let wander = 0.7 * Real::sin(1.3 * z + 0.4);
    let folds = 0.11 * Real::sin(5.0 * x + wander) + 0.045 * Real::sin(11.0 * x - 2.0 * z);
    let flat = (1.0 - (x / WIDTH).powi(4)) * (1.0 - (z / WIDTH).powi(4));
    vec3(x, 0.16 + folds * flat, z)
}

/// The mesh; u runs along x, v towards the front, so that u, v and the upper normal are right-handed.
pub(super) fn ply() -> String {
    grid::ply(SIDE, SIDE, |i, j| {
        let [u, v] = [i, j].map(|k| f64::from(k) / f64::from(SIDE));
        let [x, z] = [WIDTH * (u - 0.5), WIDTH * (0.5 - v)];
        let h = 1e-4;
        let along = place(x + h, z) - place(x - h, z);
        let back = place(x, z - h) - place(x, z + h);
        let n = along.cross(back).normalized();
        let p = place(x, z);
        [p.x, p.y, p.z, n.x, n.y, n.z, u, v]
    })
}
