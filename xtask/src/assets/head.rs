//! A head with closed eyes, a bust, and the scalp for long hair: solids joined smoothly into distances that vanish on the skin, and
//! meshes of the places where rays from a point inside leave it. x points to the head's left, y upwards, z forwards.

use std::f64::consts::{PI, TAU};

use sparrow_math::{Real, Vec3, vec3};

use super::grid;

/// A body by its distance, exact for capsules and of first order for ellipsoids.
enum Solid {
    /// Middle and half axes.
    Ellipsoid([f64; 3], [f64; 3]),
    /// Two balls, each with its radius, and what lies between them.
    Capsule([f64; 3], f64, [f64; 3], f64),
}
use Solid::{Capsule, Ellipsoid};

/// What a solid does to those before it.
enum Part {
    /// Joined, over a width that grows with the number.
    Add(Solid, f64),
    /// Taken away, in the same way.
    Cut(Solid, f64),
}
use Part::{Add, Cut};

/// The left half; the right one is its image.
const HEAD: [Part; 14] = [
    // Skull, face, jaw, chin.
    Add(Ellipsoid([0.0, 0.28, -0.14], [0.75, 0.83, 0.96]), 0.1),
    Add(Ellipsoid([0.0, -0.3, 0.24], [0.58, 0.82, 0.64]), 0.25),
    Add(Capsule([0.5, -0.55, 0.0], 0.12, [0.14, -0.98, 0.58], 0.15), 0.25),
    Add(Ellipsoid([0.0, -0.99, 0.7], [0.2, 0.15, 0.17]), 0.22),
    // Brow, cheek bone.
    Add(Capsule([0.0, 0.16, 0.8], 0.07, [0.4, 0.15, 0.64], 0.05), 0.14),
    Add(Ellipsoid([0.34, -0.3, 0.56], [0.22, 0.2, 0.2]), 0.3),
    // Socket, lid and lashes of the eye.
    Cut(Ellipsoid([0.29, -0.02, 0.98], [0.2, 0.12, 0.22]), 0.12),
    Add(Ellipsoid([0.29, -0.03, 0.705], [0.15, 0.105, 0.12]), 0.03),
    Add(Capsule([0.2, -0.075, 0.795], 0.022, [0.38, -0.075, 0.745], 0.018), 0.02),
    // Ridge and wing of the nose.
    Add(Capsule([0.0, 0.06, 0.83], 0.06, [0.0, -0.27, 1.02], 0.075), 0.13),
    Add(Ellipsoid([0.08, -0.315, 0.92], [0.07, 0.065, 0.1]), 0.09),
    // Mouth, upper and lower lip.
    Add(Ellipsoid([0.0, -0.64, 0.7], [0.36, 0.26, 0.18]), 0.25),
    Add(Capsule([0.0, -0.605, 0.915], 0.032, [0.21, -0.635, 0.875], 0.012), 0.03),
    Add(Capsule([0.0, -0.69, 0.905], 0.042, [0.18, -0.66, 0.875], 0.015), 0.03),
];
/// Neck, shoulder, chest; the left half.
const BUST: [Part; 3] = [
    Add(Capsule([0.0, -0.5, -0.22], 0.37, [0.0, -1.5, -0.28], 0.4), 0.1),
    Add(Capsule([0.0, -1.66, -0.32], 0.34, [1.15, -1.98, -0.36], 0.36), 0.45),
    Add(Ellipsoid([0.0, -2.4, -0.25], [1.25, 0.95, 0.55]), 0.4),
];
/// Where rays start.
const IN_HEAD: Vec3<f64> = Vec3 { x: 0.0, y: -0.42, z: 0.0 };
const IN_BUST: Vec3<f64> = Vec3 { x: 0.0, y: -2.05, z: -0.34 };
const IN_SCALP: Vec3<f64> = Vec3 { x: 0.0, y: 0.15, z: 0.0 };
/// Angle from the crown to the hairline, by the share of the way around from the forehead to the nape.
const HAIRLINE: [[f64; 2]; 7] =
    [[0.0, 0.98], [0.18, 1.02], [0.32, 1.18], [0.45, 1.72], [0.6, 1.95], [0.8, 2.12], [1.0, 2.16]];
/// Rays start within this distance of the skin.
const REACH: f64 = 4.0;

impl Solid {
    fn distance(&self, p: Vec3<f64>) -> f64 {
        match *self {
            Ellipsoid(middle, half) => {
                let q = [p.x - middle[0], p.y - middle[1], p.z - middle[2]];
                let norm =
                    |power: i32| (0..3).map(|i| (q[i] / half[i].powi(power)).sqr()).sum::<f64>().sqrt();
                norm(1) * (norm(1) - 1.0) / norm(2).max(1e-9)
            }
            Capsule([ax, ay, az], radius_a, [bx, by, bz], radius_b) => {
                let (a, b) = (vec3(ax, ay, az), vec3(bx, by, bz));
                let t = ((p - a).dot(b - a) / (b - a).length2()).clamp(0.0, 1.0);
                (p - (a + (b - a) * t)).length() - (radius_a + (radius_b - radius_a) * t)
            }
        }
    }
}

/// The lesser of two distances, rounded where they differ by less than `width`.
fn smooth_min(a: f64, b: f64, width: f64) -> f64 {
    a.min(b) - (width - (a - b).abs()).max(0.0).sqr() / (4.0 * width)
}

fn distance(parts: &[Part], p: Vec3<f64>) -> f64 {
    let p = vec3(p.x.abs(), p.y, p.z);
    parts.iter().fold(f64::INFINITY, |so_far, part| match part {
        Add(solid, _) if so_far == f64::INFINITY => solid.distance(p),
        Add(solid, width) => smooth_min(so_far, solid.distance(p), *width),
        Cut(solid, width) => -smooth_min(-so_far, solid.distance(p), *width),
    })
}

/// The outermost place of the skin on the ray from `from` at `azimuth` from z towards x and `polar` from y, and the normal there.
fn skin(parts: &[Part], from: Vec3<f64>, azimuth: f64, polar: f64) -> [f64; 6] {
    let ((sin_a, cos_a), (sin_p, cos_p)) = (Real::sin_cos(azimuth), Real::sin_cos(polar));
    let d = vec3(sin_p * sin_a, cos_p, sin_p * cos_a);
    let mut t = REACH;
    // Distances are of first order only: steps are shorter.
    for _ in 0..400 {
        t -= 0.6 * distance(parts, from + d * t);
    }
    let p = from + d * t;
    let slope = |e: Vec3<f64>| distance(parts, p + e * 1e-4) - distance(parts, p - e * 1e-4);
    let n =
        vec3(slope(vec3(1.0, 0.0, 0.0)), slope(vec3(0.0, 1.0, 0.0)), slope(vec3(0.0, 0.0, 1.0))).normalized();
    [p.x, p.y, p.z, n.x, n.y, n.z]
}

/// One half of the head; cells are small in the face.
fn half(left: bool) -> String {
    let cells = [32, 40];
    grid::ply_without_uv(cells, |i, j| {
        let [u, v] = [(i, 0), (j, 1)].map(|(k, axis)| f64::from(k) / f64::from(cells[axis]));
        let from_front = |u: f64| PI * u * (0.4 + 0.6 * u);
        let azimuth = if left { from_front(u) } else { -from_front(1.0 - u) };
        let polar = PI * (1.0 - v) + 0.17 * Real::sin(TAU * (0.98 - v));
        skin(&HEAD, IN_HEAD, azimuth, polar.clamp(0.0, PI))
    })
}

fn bust() -> String {
    let cells = [40, 30];
    grid::ply_without_uv(cells, |i, j| {
        let [u, v] = [f64::from(i) / f64::from(cells[0]), 1.0 - f64::from(j) / f64::from(cells[1])];
        skin(&BUST, IN_BUST, TAU * u, PI * v * (0.3 + 0.7 * v))
    })
}

fn scalp() -> String {
    let cells = [32, 14];
    grid::ply_without_uv(cells, |i, j| {
        let [u, v] = [f64::from(i) / f64::from(cells[0]), f64::from(j) / f64::from(cells[1])];
        skin(&HEAD, IN_SCALP, TAU * u, hairline(2.0 * u.min(1.0 - u)) * (1.0 - v))
    })
}

fn hairline(around: f64) -> f64 {
    let after = HAIRLINE.iter().position(|h| h[0] >= around).unwrap_or(HAIRLINE.len() - 1).max(1);
    let [[a, low], [b, high]] = [HAIRLINE[after - 1], HAIRLINE[after]];
    low.lerp(high, (around - a) / (b - a))
}

/// The meshes by name. The halves of the head share the vertices in the middle.
pub(super) fn all() -> [(&'static str, String); 4] {
    [("head-left", half(true)), ("head-right", half(false)), ("bust", bust()), ("scalp", scalp())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_vertex_lies_on_the_skin_and_faces_outwards() {
        for (name, text) in all() {
            let (parts, from) = match name {
                "bust" => (&BUST[..], IN_BUST),
                "scalp" => (&HEAD[..], IN_SCALP),
                _ => (&HEAD[..], IN_HEAD),
            };
            let (_, body) = text.split_once("end_header\n").expect("a header");
            for line in body.lines().filter(|l| l.split(' ').count() == 6) {
                let x: Vec<f64> = line.split(' ').map(|w| w.parse().expect("a number")).collect();
                let (p, n) = (vec3(x[0], x[1], x[2]), vec3(x[3], x[4], x[5]));
                assert!(distance(parts, p).abs() < 2e-4, "{name}: {line} lies off the skin");
                assert!(
                    (n.length() - 1.0).abs() < 2e-4 && n.dot(p - from) > -0.1,
                    "{name}: {line} faces inwards"
                );
            }
        }
    }
}
