//! A market at night: rows of stalls, each a table and an awning with a bulb of four triangles below it.

use sparrow_math::Real;

use super::grid::short;

/// Stalls of a row, and rows.
const STALLS: u32 = 51;
const ROWS: u32 = 50;
/// Metres from one to the next.
const SPACING: f64 = 2.5;
/// Groups of bulbs, each with a colour of its own.
const COLOURS: u32 = 5;

type Point = [f64; 3];
type Mesh = (Vec<Point>, Vec<[usize; 3]>);

/// The meshes by name: one row of stalls at y = 0, and the bulbs of all rows, 10 200 triangles.
pub(super) fn all() -> Vec<(String, String)> {
    let bulbs = (0..COLOURS).map(|c| (format!("bulbs-{c}"), ply(&bulbs(c))));
    core::iter::once(("stalls".to_owned(), ply(&stalls()))).chain(bulbs).collect()
}

/// The middle of a stall in its row.
fn across(stall: u32) -> f64 {
    SPACING * (f64::from(stall) - 25.0)
}

/// How far a row is moved sideways: as in `market.inc`.
fn shift(row: u32) -> f64 {
    0.4 * f64::from(row % 4)
}

/// Tables with their sides, and awnings that lean.
fn stalls() -> Mesh {
    let (mut p, mut faces): Mesh = Default::default();
    for stall in 0..STALLS {
        let (x, first) = (across(stall), p.len());
        for z in [0.0, 0.85] {
            p.extend([[-0.7, -0.35], [0.7, -0.35], [0.7, 0.35], [-0.7, 0.35]].map(|[a, b]| [x + a, b, z]));
        }
        p.extend(
            [[-0.9, -0.8, 2.0], [0.9, -0.8, 2.0], [0.9, 0.7, 2.4], [-0.9, 0.7, 2.4]]
                .map(|[a, b, c]| [x + a, b, c]),
        );
        let quads = [[4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [8, 9, 10, 11]];
        let halves = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        faces.extend(halves.map(|f| f.map(|k: usize| first + k)));
    }
    (p, faces)
}

/// Every fifth bulb, each turned by its number and of a size of its own; normals point outwards.
fn bulbs(colour: u32) -> Mesh {
    let (mut p, mut faces): Mesh = Default::default();
    for i in (colour..STALLS * ROWS).step_by(COLOURS as usize) {
        let (row, stall, t) = (i / STALLS, i % STALLS, f64::from(i));
        let center = [across(stall) + shift(row), SPACING * f64::from(row), 1.7 + 0.2 * (0.382 * t).fract()];
        let size = 0.02 + 0.04 * (0.618_034 * t).fract();
        let (s, c) = Real::sin_cos(t);
        let first = p.len();
        for [x, y, z] in [[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]] {
            let turned = [c * x - s * y, s * x + c * y, z];
            p.push([0, 1, 2].map(|k| center[k] + size * turned[k]));
        }
        faces.extend([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|f| f.map(|k| first + k)));
    }
    (p, faces)
}

fn ply((points, faces): &Mesh) -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment written by cargo run -p xtask -- assets\nelement vertex {}\n",
        points.len()
    );
    for name in ["x", "y", "z"] {
        text += &format!("property float {name}\n");
    }
    text += &format!("element face {}\nproperty list uchar int vertex_indices\nend_header\n", faces.len());
    for p in points {
        text += &p.map(short).join(" ");
        text.push('\n');
    }
    for [a, b, c] in faces {
        text += &format!("3 {a} {b} {c}\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_ten_thousand_emitters() {
        assert_eq!((0..COLOURS).map(|c| bulbs(c).1.len()).sum::<usize>(), 10_200);
    }

    #[test]
    fn bulbs_shine_outwards() {
        let (points, faces) = bulbs(3);
        for (i, face) in faces.iter().enumerate().take(40) {
            let at = |k: usize| sparrow_math::Vec3::from(points[k].map(|x| x as f32)).to_f64();
            let [a, b, c] = face.map(at);
            let first = i / 4 * 4;
            let middle = (at(first) + at(first + 1) + at(first + 2) + at(first + 3)) * 0.25;
            assert!((b - a).cross(c - a).dot(a - middle) > 0.0, "{face:?}");
        }
    }
}
