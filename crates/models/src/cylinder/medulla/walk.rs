//! Random walks through the core, which the table's moments are taken of.

use core::f64::consts::TAU;

use sparrow_math::{Frame, LocalDir, Real, Vec3, vec3};

use super::{MOST_FORWARD, Moments, NODES, OPTICAL};
use crate::generator::generator;

/// Inclination at which walks begin, in degrees.
const INCLINATION: f64 = 25.0;

/// A direction scattered from `w`. [HenyeyGreenstein1941]
fn scattered(w: Vec3<f64>, g: f64, u: [f64; 2]) -> Vec3<f64> {
    let cos = if g < 1e-3 {
        1.0 - 2.0 * u[0]
    } else {
        let s = (1.0 - g * g) / (1.0 + g - 2.0 * g * u[0]);
        ((1.0 + g * g - s * s) / (2.0 * g)).clamp(-1.0, 1.0)
    };
    let (sin, (s, c)) = ((1.0 - cos * cos).max(0.0).sqrt(), Real::sin_cos(TAU * u[1]));
    Frame::from_z(w).to_world(LocalDir::new(vec3(sin * c, sin * s, cos))).normalized()
}

/// Way from the point `p` of the unit cylinder's inside to its surface along `w`.
fn to_surface(p: [f64; 2], w: Vec3<f64>) -> f64 {
    let a = (w.y * w.y + w.z * w.z).max(1e-12);
    let h = p[0] * w.y + p[1] * w.z;
    (-h + (h * h + a * (1.0 - p[0] * p[0] - p[1] * p[1]).max(0.0)).sqrt()) / a
}

/// Means of `n` walks, which are scattered at least once.
fn walks(tau: f64, g: f64, n: u32, seed: u64) -> Moments {
    let mut u = generator(seed);
    let (sin, cos) = Real::sin_cos(f64::to_radians(INCLINATION));
    let (mut sum, mut whole) = ([0.0; 4], 0.0);
    for k in 0..n {
        let h = 2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0;
        let (mut p, mut w) = ([-(1.0 - h * h).sqrt(), h], vec3(sin, cos, 0.0));
        let mut end = to_surface(p, w);
        let weight = 1.0 - Real::exp(-tau * end);
        let mut free = -Real::ln(1.0 - u() * weight) / tau;
        let mut way = 0.0;
        while free < end {
            way += free;
            p = [p[0] + free * w.y, p[1] + free * w.z];
            w = scattered(w, g, [u(), u()]);
            end = to_surface(p, w);
            free = -Real::ln((1.0 - u()).max(1e-300)) / tau;
        }
        way += end;
        let across = (w.y * w.y + w.z * w.z).sqrt().max(1e-12);
        for (sum, x) in sum.iter_mut().zip([w.x / sin, w.y / across, way, way * way]) {
            *sum += weight * x;
        }
        whole += weight;
    }
    let [along, around, mean, square] = sum.map(|s| s / whole);
    Moments { along, around, way: [mean, mean * mean / (square - mean * mean)] }
}

/// Writes `table.txt`, in a minute.
///
/// `cargo test --release -p sparrow-models --lib write_the_medulla -- --ignored`
#[test]
#[ignore = "a generator, run by hand when the walks change"]
fn write_the_medulla() {
    let mut text = String::from(
        "# Moments of light that a core scattered: along, around, length of the way, its shape; 13 rows of optical radii 0.1 to 30, even in the\n\
         # logarithm, each of 7 mean cosines 0 to 0.9. Written by the test `write_the_medulla` in walk.rs.\n",
    );
    for row in 0..NODES[0] {
        for column in 0..NODES[1] {
            let tau = OPTICAL[0] * Real::pow(OPTICAL[1] / OPTICAL[0], row as f64 / (NODES[0] - 1) as f64);
            let g = MOST_FORWARD * column as f64 / (NODES[1] - 1) as f64;
            let m = walks(tau, g, 1 << 17, (row * NODES[1] + column) as u64);
            text += &format!("{:.5} {:.5} {:.5} {:.5}\n", m.along, m.around, m.way[0], m.way[1]);
        }
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/cylinder/medulla/table.txt");
    std::fs::write(path, text).expect("the table is written");
}

#[test]
fn the_table_stands_for_walks_between_its_nodes() {
    for (tau, g) in [(0.2, 0.1), (0.7, 0.5), (2.0, 0.8), (5.0, 0.35), (20.0, 0.7)] {
        let (want, got) = (walks(tau, g, 20_000, 77), Moments::of(tau, g));
        // Cosines: four standard errors of 20 000 walks, and what is linear between nodes.
        let near = |a: f64, b: f64| (a - b).abs() < 0.03 + 0.03 * b.abs();
        assert!(
            near(got.along, want.along) && near(got.around, want.around),
            "{tau} {g}: {got:?}, walks {want:?}"
        );
        assert!((got.way[0] / want.way[0] - 1.0).abs() < 0.05, "{tau} {g}: {got:?}, walks {want:?}");
        assert!((got.way[1] / want.way[1] - 1.0).abs() < 0.15, "{tau} {g}: {got:?}, walks {want:?}");
    }
}

#[test]
fn a_mean_along_the_fibre_is_that_of_its_lobe() {
    for v in [0.02, 0.1, 0.5, 3.0] {
        let e = Real::exp(-2.0 / v);
        let along = (1.0 + e) / (1.0 - e) - v;
        let moments = Moments { along, around: 0.0, way: [1.0; 2] };
        assert!((moments.variance() / v - 1.0).abs() < 0.05, "{v}: {}", moments.variance());
    }
}
