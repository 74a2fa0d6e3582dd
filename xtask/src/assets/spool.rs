//! A ball wound with thread from pole to pole: fibres along its parallels, as control points of a uniform cubic B-spline.

use std::f64::consts::{PI, TAU};

use sparrow_math::Real;

const TURNS: u32 = 80;
/// Control points of a turn.
const POINTS: u32 = 16;
const WIDTH: f64 = 0.044;

/// A curve of a scene, about the z axis.
pub(super) fn curve() -> String {
    // A B-spline through points on a circle runs inside it: a weighted mean of three neighbours, 1/6, 2/3 and 1/6.
    let shrunk = (2.0 + Real::cos(TAU / f64::from(POINTS))) / 3.0;
    let n = TURNS * POINTS;
    let mut text = format!(
        "# A ball of radius 1, wound with {TURNS} turns of thread; written by cargo run -p xtask -- assets\n\
         Shape \"curve\" \"string type\" \"cylinder\" \"string basis\" \"bspline\" \"float width\" {WIDTH} \"point3 P\" [\n"
    );
    for k in 0..=n {
        let (sin_theta, cos_theta) = Real::sin_cos(PI * f64::from(k) / f64::from(n));
        let (s, c) = Real::sin_cos(TAU * f64::from(k) / f64::from(POINTS));
        let r = sin_theta / shrunk;
        text += &format!("{:.4} {:.4} {:.4}\n", r * c, r * s, cos_theta);
    }
    text + "]\n"
}
