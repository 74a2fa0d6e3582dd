//! A quarter horse: bent tubes of oval section for trunk, neck, head, legs, ears and tail, which fur joins.

use std::f64::consts::TAU;

use sparrow_math::{Real, Vec3, vec3};

use super::grid::{self, Grid};

/// A section of a tube: its middle, x forwards and y upwards; half its height in the plane of the tube, and half its width across.
type Section = [f64; 4];

/// A tube in a plane of constant z; hair flows from its first section to its last.
struct Tube {
    z: f64,
    /// Cells around and along.
    cells: [u32; 2],
    sections: &'static [Section],
}

const TRUNK: [Section; 9] = [
    [0.53, 0.78, 0.01, 0.01],
    [0.5, 0.78, 0.16, 0.13],
    [0.38, 0.77, 0.235, 0.19],
    [0.15, 0.75, 0.24, 0.22],
    [-0.1, 0.75, 0.24, 0.23],
    [-0.32, 0.78, 0.235, 0.22],
    [-0.48, 0.8, 0.2, 0.19],
    [-0.58, 0.82, 0.11, 0.1],
    [-0.61, 0.82, 0.01, 0.01],
];
const NECK: [Section; 6] = [
    [0.85, 1.34, 0.01, 0.01],
    [0.8, 1.28, 0.085, 0.06],
    [0.7, 1.18, 0.115, 0.075],
    [0.57, 1.04, 0.155, 0.1],
    [0.42, 0.88, 0.2, 0.14],
    [0.32, 0.78, 0.1, 0.08],
];
const HEAD: [Section; 7] = [
    [1.145, 1.015, 0.01, 0.01],
    [1.12, 1.04, 0.055, 0.048],
    [1.05, 1.1, 0.06, 0.052],
    [0.96, 1.18, 0.085, 0.066],
    [0.88, 1.25, 0.11, 0.075],
    [0.81, 1.31, 0.085, 0.06],
    [0.77, 1.34, 0.01, 0.01],
];
const FRONT_LEG: [Section; 10] = [
    [0.4, 0.84, 0.01, 0.01],
    [0.4, 0.76, 0.12, 0.09],
    [0.385, 0.6, 0.085, 0.065],
    [0.385, 0.45, 0.052, 0.045],
    [0.385, 0.38, 0.052, 0.045],
    [0.38, 0.25, 0.036, 0.034],
    [0.38, 0.13, 0.04, 0.036],
    [0.4, 0.07, 0.034, 0.033],
    [0.415, 0.01, 0.055, 0.05],
    [0.42, 0.0, 0.005, 0.005],
];
const HIND_LEG: [Section; 10] = [
    [-0.42, 0.9, 0.01, 0.01],
    [-0.43, 0.78, 0.17, 0.1],
    [-0.4, 0.6, 0.125, 0.08],
    [-0.45, 0.5, 0.08, 0.058],
    [-0.52, 0.41, 0.055, 0.045],
    [-0.5, 0.27, 0.04, 0.036],
    [-0.485, 0.14, 0.042, 0.038],
    [-0.46, 0.07, 0.035, 0.034],
    [-0.44, 0.01, 0.055, 0.05],
    [-0.435, 0.0, 0.005, 0.005],
];
const EAR: [Section; 4] = [
    [0.79, 1.32, 0.01, 0.01],
    [0.795, 1.36, 0.03, 0.018],
    [0.805, 1.41, 0.024, 0.013],
    [0.81, 1.46, 0.003, 0.003],
];
const TAIL: [Section; 6] = [
    [-0.56, 0.9, 0.01, 0.01],
    [-0.62, 0.87, 0.03, 0.03],
    [-0.68, 0.76, 0.045, 0.04],
    [-0.71, 0.58, 0.05, 0.045],
    [-0.71, 0.42, 0.035, 0.03],
    [-0.7, 0.32, 0.003, 0.003],
];

const TUBES: [Tube; 10] = [
    Tube { z: 0.0, cells: [18, 12], sections: &TRUNK },
    Tube { z: 0.0, cells: [14, 8], sections: &NECK },
    Tube { z: 0.0, cells: [12, 8], sections: &HEAD },
    Tube { z: 0.12, cells: [8, 10], sections: &FRONT_LEG },
    Tube { z: -0.12, cells: [8, 10], sections: &FRONT_LEG },
    Tube { z: 0.12, cells: [8, 10], sections: &HIND_LEG },
    Tube { z: -0.12, cells: [8, 10], sections: &HIND_LEG },
    Tube { z: 0.045, cells: [6, 4], sections: &EAR },
    Tube { z: -0.045, cells: [6, 4], sections: &EAR },
    Tube { z: 0.0, cells: [6, 6], sections: &TAIL },
];

impl Tube {
    /// The section at `v` in [0, 1]: a Catmull-Rom curve through all.
    fn section(&self, v: f64) -> Section {
        let last = self.sections.len() - 1;
        let x = v.clamp(0.0, 1.0) * last as f64;
        let i = (x as usize).min(last - 1);
        let t = x - i as f64;
        let knots = [i.saturating_sub(1), i, i + 1, (i + 2).min(last)].map(|k| self.sections[k]);
        std::array::from_fn(|k| {
            let [a, b, c, d] = knots.map(|s| s[k]);
            b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
        })
    }

    /// Place of the skin at `u` around and `v` along.
    fn place(&self, u: f64, v: f64) -> Vec3<f64> {
        let h = 1e-3;
        let inside = v.clamp(h, 1.0 - h);
        let [before, behind] = [self.section(inside - h), self.section(inside + h)];
        let along = vec3(behind[0] - before[0], behind[1] - before[1], 0.0).normalized();
        let up = vec3(-along.y, along.x, 0.0);
        let [x, y, height, width] = self.section(v);
        let (s, c) = Real::sin_cos(TAU * u);
        vec3(x, y, self.z) + up * (height * c) + vec3(0.0, 0.0, width * s)
    }

    /// Position, normal, u and v at a corner of the grid. The column at u = 1 stands where that at u = 0 stands.
    fn vertex(&self, i: u32, j: u32) -> [f64; 8] {
        let [u, v] = [(i, 0), (j, 1)].map(|(k, axis)| f64::from(k) / f64::from(self.cells[axis]));
        let at = f64::from(i % self.cells[0]) / f64::from(self.cells[0]);
        let h = 1e-3;
        let around = self.place(at + h, v) - self.place(at - h, v);
        let along = self.place(at, v + h) - self.place(at, v - h);
        let n = around.cross(along).normalized();
        let p = self.place(at, v);
        [p.x, p.y, p.z, n.x, n.y, n.z, u, v]
    }
}

/// The mesh; v runs the way that the coat lies, from nose to tail and down the legs.
pub(super) fn ply() -> String {
    let grids =
        TUBES.each_ref().map(|tube| Grid { cells: tube.cells, vertex: Box::new(|i, j| tube.vertex(i, j)) });
    grid::ply_of(&grids)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_point_away_from_the_middle_of_each_tube() {
        for tube in &TUBES {
            let [around, along] = tube.cells;
            for (i, j) in (0..around).flat_map(|i| (0..=along).map(move |j| (i, j))) {
                let [x, y, z, nx, ny, nz, _, v] = tube.vertex(i, j);
                let [cx, cy, ..] = tube.section(v);
                assert!((nx * nx + ny * ny + nz * nz - 1.0).abs() < 1e-9);
                let out = vec3(x - cx, y - cy, z - tube.z).normalized().dot(vec3(nx, ny, nz));
                // On the caps of the ends normals point along the tube.
                let least = if j <= 1 || j + 1 >= along { -0.5 } else { 0.0 };
                assert!(out > least, "the skin at {i}, {j} of {:?} faces inwards: {out}", tube.sections[0]);
            }
        }
    }
}
