//! A vase: a curve turned around the y axis, with normals and texture coordinates.

use std::f64::consts::TAU;

use sparrow_math::Real;

use super::grid;

const HEIGHT: f64 = 1.7;
const AROUND: u32 = 32;
const UP: u32 = 24;
/// Radius at equal steps of height, foot to lip.
const RADII: [f64; 8] = [0.3, 0.36, 0.52, 0.58, 0.46, 0.25, 0.19, 0.3];

/// The mesh. The column at u = 1 stands where that at u = 0 stands.
pub(super) fn ply() -> String {
    grid::ply(AROUND, UP, |i, j| {
        let [u, v] = [f64::from(i) / f64::from(AROUND), f64::from(j) / f64::from(UP)];
        let (r, slope) = radius(v);
        // Clockwise seen from above, so that u, v and the outer normal are right-handed.
        let (s, c) = Real::sin_cos(-TAU * f64::from(i % AROUND) / f64::from(AROUND));
        let n = 1.0 / (1.0 + slope * slope).sqrt();
        [r * c, HEIGHT * v, r * s, n * c, -n * slope, n * s, u, v]
    })
}

/// Radius at `v` of the height and its slope against the height: a Catmull-Rom curve through [`RADII`].
fn radius(v: f64) -> (f64, f64) {
    let last = RADII.len() - 1;
    let x = v * last as f64;
    let i = (x as usize).min(last - 1);
    let t = x - i as f64;
    let [p0, p1, p2, p3] = [i.saturating_sub(1), i, i + 1, (i + 2).min(last)].map(|k| RADII[k]);
    let (a, b) = (0.5 * (p2 - p0), 2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3);
    let c = 3.0 * (p1 - p2) + p3 - p0;
    let r = p1 + t * (a + t * (0.5 * b + t * 0.5 * c));
    let slope = a + t * (b + t * 1.5 * c);
    (r, slope * last as f64 / HEIGHT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_profile_passes_its_knots_and_has_its_slope() {
        for (i, want) in RADII.iter().enumerate() {
            let (r, _) = radius(i as f64 / (RADII.len() - 1) as f64);
            assert!((r - want).abs() < 1e-12, "knot {i}: {r}");
        }
        for v in [0.05, 0.3, 0.61, 0.97] {
            let h = 1e-6;
            let slope = (radius(v + h).0 - radius(v - h).0) / (2.0 * h * HEIGHT);
            assert!((radius(v).1 - slope).abs() < 1e-6, "at {v}: {} against {slope}", radius(v).1);
        }
    }

    #[test]
    fn the_header_counts_what_follows() {
        let text = ply();
        let (head, body) = text.split_once("end_header\n").expect("a header");
        assert!(head.contains("element vertex 825\n") && head.contains("element face 1536\n"));
        assert_eq!(body.lines().count(), 825 + 1536);
        assert_eq!(body.lines().filter(|l| l.starts_with("3 ")).count(), 1536);
    }
}
