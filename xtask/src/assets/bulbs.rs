//! Thousands of small lamps in a hall: chandeliers, strings between its columns, brackets on its walls. Each bulb is a tetrahedron.

use std::f64::consts::TAU;

use sparrow_math::Real;

use super::grid::short;

/// Columns stand at `x = +-4`, `y = 2, 6, .. 38`.
const BAYS: u32 = 9;
const COLUMN: f64 = 4.0;
/// Bulbs on a string.
const STRING: u32 = 36;

type Point = [f64; 3];

/// A bulb: its middle and its size.
struct Bulb(Point, f64);

/// The meshes by name; together 10 304 triangles.
pub(super) fn all() -> Vec<(String, String)> {
    let strings = strings();
    let mut groups = vec![("chandeliers".to_owned(), chandeliers()), ("brackets".to_owned(), brackets())];
    for colour in 0..4 {
        let own = strings.iter().skip(colour).step_by(4).flat_map(|&(a, b, sag)| string(a, b, sag));
        groups.push((format!("string-{colour}"), own.collect()));
    }
    groups.into_iter().map(|(name, bulbs)| (name, ply(&bulbs))).collect()
}

/// Eight crowns of three rings, below the vault.
fn chandeliers() -> Vec<Bulb> {
    let bulb = |i: u32| {
        let (crown, ring, k) = (i / 54, i / 18 % 3, i % 18);
        let (sin, cos) = Real::sin_cos(TAU * f64::from(k) / 18.0);
        let r = 0.9 - 0.25 * f64::from(ring);
        Bulb([r * cos, 4.0 + 4.5 * f64::from(crown) + r * sin, 5.6 + 0.35 * f64::from(ring)], 0.04)
    };
    (0..8 * 54).map(bulb).collect()
}

/// Twenty plates of ten, on the walls below the galleries.
fn brackets() -> Vec<Bulb> {
    let bulb = |i: u32| {
        let (plate, k) = (i / 10, i % 10);
        let side = if plate % 2 == 0 { -1.0 } else { 1.0 };
        let along = 2.0 + 4.0 * f64::from(plate / 2) + 0.12 * (f64::from(k % 5) - 2.0);
        Bulb([side * 5.85, along, 2.0 + 0.12 * f64::from(k / 5)], 0.015)
    };
    (0..200).map(bulb).collect()
}

/// Ends and sag of every string: across the nave, along both galleries, along both walls below.
fn strings() -> Vec<(Point, Point, f64)> {
    let mut all = Vec::new();
    for bay in 0..BAYS {
        let [y0, y1] = [bay, bay + 1].map(|k| 2.0 + 4.0 * f64::from(k));
        for x in [-COLUMN, COLUMN] {
            all.push(([x, y0, 5.8], [-x, y1, 5.8], 1.1));
            all.push(([0.9 * x, y0, 3.5], [0.9 * x, y1, 3.5], 0.35));
            all.push(([1.4 * x, y0, 3.3], [1.4 * x, y1, 3.3], 0.5));
        }
    }
    all
}

/// Bulbs on a parabola, of sizes that vary.
fn string(a: Point, b: Point, sag: f64) -> impl Iterator<Item = Bulb> {
    (0..STRING).map(move |i| {
        let t = (f64::from(i) + 0.5) / f64::from(STRING);
        let at = |k: usize| a[k] + t * (b[k] - a[k]);
        let size = 0.01 + 0.02 * (f64::from(i) * 0.618_034).fract();
        Bulb([at(0), at(1), at(2) - 4.0 * sag * t * (1.0 - t)], size)
    })
}

/// Tetrahedra around the bulbs' middles, each turned by its number, normals outwards.
fn ply(bulbs: &[Bulb]) -> String {
    let n = bulbs.len();
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment written by cargo run -p xtask -- assets\nelement vertex {}\n",
        4 * n
    );
    for name in ["x", "y", "z"] {
        text += &format!("property float {name}\n");
    }
    text += &format!("element face {}\nproperty list uchar int vertex_indices\nend_header\n", 4 * n);
    for (i, Bulb(p, size)) in bulbs.iter().enumerate() {
        let (s, c) = Real::sin_cos(i as f64);
        for [x, y, z] in [[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]] {
            let corner = [p[0] + size * (c * x - s * y), p[1] + size * (s * x + c * y), p[2] + size * z];
            text += &corner.map(short).join(" ");
            text.push('\n');
        }
    }
    for i in 0..n {
        for [a, b, c] in [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] {
            text += &format!("3 {} {} {}\n", 4 * i + a, 4 * i + b, 4 * i + c);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_ten_thousand_triangles() {
        let faces: usize =
            all().iter().map(|(_, text)| text.lines().filter(|l| l.starts_with("3 ")).count()).sum();
        assert!(faces > 10_000, "{faces}");
    }

    /// The normals of a bulb's faces point away from its middle.
    #[test]
    fn bulbs_shine_outwards() {
        let text = ply(&[Bulb([0.0; 3], 1.0)]);
        let rows: Vec<Vec<f64>> = text
            .lines()
            .skip_while(|l| *l != "end_header")
            .skip(1)
            .map(|l| l.split(' ').map(|w| w.parse().expect("a number")).collect())
            .collect();
        for face in &rows[4..] {
            let [a, b, c] = [1, 2, 3].map(|k| {
                let p = &rows[face[k] as usize];
                sparrow_math::vec3(p[0], p[1], p[2])
            });
            assert!((b - a).cross(c - a).dot(a + b + c) > 0.0, "{face:?}");
        }
    }
}
