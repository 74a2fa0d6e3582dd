//! Finds the sigmoid whose colour is a given RGB.
//!
//! Damped Gauss-Newton on the three coefficients, for the difference in CIE L*a*b* [Jakob2019, sec. 4],
//! with analytic derivatives. The wavelength is scaled to `t = (λ - 360) / 470` while solving.

use std::sync::OnceLock;

use sparrow_math::Real;

use crate::matrix::{self, Mat3};
use crate::{ColorSpace, N_DENSE, Sigmoid, cie};

/// Largest coefficient in units of `t`. Beyond it spectra only get steeper, and `f32` loses track.
///
/// The authors' optimiser stops at 200, which leaves dark saturated colours up to 2.5e-3 off.
const C_MAX: f64 = 2000.0;

/// The sigmoid whose colour under the illuminant of `space` is `rgb`, solved for this colour alone.
///
/// `rgb` is clamped to [0, 1]; equal components give an exactly constant spectrum. Colours that no
/// sigmoid reaches, saturated and bright at once, get the nearest one in CIE L*a*b*.
/// Takes tens of microseconds, and is within 7e-6 for every sRGB colour; [`rgb_to_sigmoid`](crate::rgb_to_sigmoid) is the fast way.
pub fn fit_sigmoid(rgb: [f32; 3], space: ColorSpace) -> Sigmoid {
    let rgb = clamped(rgb);
    if let Some(v) = grey(rgb) {
        return Sigmoid::constant(v);
    }
    let start = from_nm(super::table::rgb_to_sigmoid(rgb, space));
    let solver = Solver::fine(space);
    let rgb = rgb.map(f64::from);
    to_nm(solver.solve(rgb, [start, [0.0; 3]]))
}

/// The components within [0, 1], NaN as 0.
pub(super) fn clamped(rgb: [f32; 3]) -> [f32; 3] {
    rgb.map(|v| if v > 0.0 { v.min(1.0) } else { 0.0 })
}

/// The value of an RGB with three equal components.
pub(super) fn grey([r, g, b]: [f32; 3]) -> Option<f32> {
    (r.max(g).max(b) <= r.min(g).min(b)).then_some(r)
}

/// Coefficients for `t` turned into those for nanometres.
pub(super) fn to_nm([a, b, c]: [f64; 3]) -> Sigmoid {
    let (w, o) = (1.0 / 470.0, 360.0 / 470.0);
    Sigmoid { c: [a * w * w, (b - 2.0 * a * o) * w, c + (a * o - b) * o].map(|v| v as f32) }
}

/// The way back from [`to_nm`].
fn from_nm(s: Sigmoid) -> [f64; 3] {
    let [a, b, c] = s.c.map(f64::from);
    [a * 470.0 * 470.0, (b + 2.0 * a * 360.0) * 470.0, c + (b + a * 360.0) * 360.0]
}

/// What integrates reflectances to a colour: nodes in `t`, and the XYZ weight of each.
pub(super) struct Solver {
    nodes: Vec<(f64, [f64; 3])>,
    white: [f64; 3],
    to_xyz: Mat3,
}

impl Solver {
    /// Integrates at every nanometre.
    pub(super) fn fine(space: ColorSpace) -> &'static Solver {
        static ALL: [OnceLock<Solver>; 4] = [const { OnceLock::new() }; 4];
        ALL[space as usize].get_or_init(|| Solver::new(space, nanometres(space)))
    }

    /// Integrates at every fifth nanometre, with weights that are exact for cubics between the nodes.
    pub(super) fn coarse(space: ColorSpace) -> Solver {
        let mut nodes: Vec<_> = (0..=94).map(|i| (f64::from(i) / 94.0, [0.0; 3])).collect();
        for (i, (_, w)) in nanometres(space).into_iter().enumerate() {
            let first = (i / 5).clamp(1, 92) - 1;
            let x = i as f64 / 5.0 - first as f64;
            for j in 0..4 {
                let others = (0..4).filter(|&k| k != j).map(|k| (x - k as f64) / (j as f64 - k as f64));
                let l: f64 = others.product();
                for (sum, w) in nodes[first + j].1.iter_mut().zip(w) {
                    *sum += l * w;
                }
            }
        }
        Solver::new(space, nodes)
    }

    fn new(space: ColorSpace, nodes: Vec<(f64, [f64; 3])>) -> Self {
        let c = space.conversions();
        Self { nodes, white: c.white, to_xyz: c.to_xyz }
    }

    /// The best coefficients for `rgb` that the starting points lead to.
    ///
    /// Later starting points are tried only where those before did not reach the colour.
    pub(super) fn solve<const N: usize>(&self, rgb: [f64; 3], starts: [[f64; 3]; N]) -> [f64; 3] {
        let target = self.lab(matrix::apply(&self.to_xyz, rgb)).0;
        let mut best = (f64::INFINITY, [0.0; 3]);
        for start in starts {
            let found = self.descend(target, start);
            if found.0 < best.0 {
                best = found;
            }
            if best.0 < 1e-8 {
                break;
            }
        }
        best.1
    }

    /// Squared L*a*b* difference and coefficients at the end of a damped descent.
    fn descend(&self, target: [f64; 3], start: [f64; 3]) -> (f64, [f64; 3]) {
        let mut c = limited(start);
        let (mut r, mut j) = self.residual(c, target);
        let mut error = dot(r, r);
        let mut damping = 1e-4;
        for _ in 0..60 {
            if error < 1e-16 || damping > 1e8 {
                break;
            }
            let Some(step) = damped_step(&j, r, damping) else { break };
            let next = limited([c[0] - step[0], c[1] - step[1], c[2] - step[2]]);
            let (next_r, next_j) = self.residual(next, target);
            let next_error = dot(next_r, next_r);
            if next_error < error {
                let gain = error - next_error;
                let done = gain < 1e-7 * error;
                (c, r, j, error) = (next, next_r, next_j, next_error);
                damping *= 0.1;
                if done {
                    break;
                }
            } else {
                damping *= 8.0;
            }
        }
        (error, c)
    }

    /// Difference in L*a*b*, and its derivatives by the three coefficients.
    fn residual(&self, c: [f64; 3], target: [f64; 3]) -> ([f64; 3], Mat3) {
        let mut xyz = [0.0; 3];
        let mut d_xyz = [[0.0; 3]; 3];
        for &(t, w) in &self.nodes {
            let x = (c[0] * t + c[1]) * t + c[2];
            let root = (1.0 + x * x).sqrt();
            let s = 0.5 + 0.5 * x / root;
            // s' = 1 / (2 (1 + x²)^(3/2)); x changes by t², t, 1 with the coefficients.
            let ds = 0.5 / (root * root * root);
            let d = [ds * t * t, ds * t, ds];
            for i in 0..3 {
                xyz[i] += s * w[i];
                for k in 0..3 {
                    d_xyz[i][k] += d[k] * w[i];
                }
            }
        }
        let (lab, d_lab) = self.lab(xyz);
        let r = [lab[0] - target[0], lab[1] - target[1], lab[2] - target[2]];
        (r, matrix::product(&d_lab, &d_xyz))
    }

    /// CIE L*a*b* relative to the illuminant, and its derivatives by XYZ [CIE15, sec. 8.2.1].
    fn lab(&self, xyz: [f64; 3]) -> ([f64; 3], Mat3) {
        const KNEE: f64 = 6.0 / 29.0;
        let mut f = [0.0; 3];
        let mut d = [0.0; 3];
        for i in 0..3 {
            let v = xyz[i] / self.white[i];
            if v > KNEE * KNEE * KNEE {
                f[i] = Real::pow(v, 1.0 / 3.0);
                d[i] = f[i] / (3.0 * v * self.white[i]);
            } else {
                let slope = 1.0 / (3.0 * KNEE * KNEE);
                f[i] = v * slope + 4.0 / 29.0;
                d[i] = slope / self.white[i];
            }
        }
        let lab = [116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])];
        let d_lab = [
            [0.0, 116.0 * d[1], 0.0],
            [500.0 * d[0], -500.0 * d[1], 0.0],
            [0.0, 200.0 * d[1], -200.0 * d[2]],
        ];
        (lab, d_lab)
    }
}

/// Weights of XYZ under the illuminant, for each nanometre.
fn nanometres(space: ColorSpace) -> Vec<(f64, [f64; 3])> {
    let bars = [cie::x(), cie::y(), cie::z()];
    let light = space.illuminant().values();
    let weight =
        |i: usize| bars.map(|b| f64::from(b.values()[i]) * f64::from(light[i]) / f64::from(cie::Y_INTEGRAL));
    (0..N_DENSE).map(|i| (i as f64 / 470.0, weight(i))).collect()
}

/// Solves `(JᵀJ + damping diag(JᵀJ)) step = Jᵀ r`.
fn damped_step(j: &Mat3, r: [f64; 3], damping: f64) -> Option<[f64; 3]> {
    let jt = matrix::transpose(j);
    let mut m = matrix::product(&jt, j);
    for (i, row) in m.iter_mut().enumerate() {
        row[i] += damping * row[i] + f64::MIN_POSITIVE;
    }
    Some(matrix::apply(&matrix::inverse(&m)?, matrix::apply(&jt, r)))
}

/// Scales coefficients back to [`C_MAX`].
fn limited(c: [f64; 3]) -> [f64; 3] {
    let m = c.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    if m > C_MAX { c.map(|v| v * (C_MAX / m)) } else { c }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
