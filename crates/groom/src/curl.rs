//! Axes wound into curls: [`curled`].

use core::f64::consts::TAU;

use sparrow_math::{Frame, Real, Vec3};

use crate::axis::Axis;
use crate::{Style, unit_or_up};

/// The points of `axis` on a helix around it, which begins at `phase`. Its radius grows from zero at the root to the style's over
/// the first winding, or over the whole strand where that is shorter.
pub(crate) fn curled(axis: &Axis, style: &Style, phase: f64) -> Vec<Vec3<f64>> {
    let p = axis.points();
    if !(style.curl > 0.0) {
        return p.to_vec();
    }
    let last = p.len() - 1;
    let mut before: Option<Frame<f64>> = None;
    let mut out = Vec::with_capacity(p.len());
    for (k, &at) in p.iter().enumerate() {
        let tangent = unit_or_up(p[(k + 1).min(last)] - p[k.max(1) - 1]);
        let frame = before.map_or(Frame::from_z(tangent), |f| carried(f, tangent));
        let t = k as f64 / last as f64;
        let radius = style.curl * (t * style.curl_turns.max(1.0)).min(1.0);
        let (s, c) = Real::sin_cos(phase + TAU * style.curl_turns * t);
        out.push(at + frame.x * (radius * c) + frame.y * (radius * s));
        before = Some(frame);
    }
    out
}

/// A frame around `z` that is turned around it as little as can be against the frame before.
fn carried(before: Frame<f64>, z: Vec3<f64>) -> Frame<f64> {
    let x = before.x - z * z.dot(before.x);
    let length = x.length();
    // Two tangents at right angles, one of them the old x, leave no direction.
    if length < 1e-6 {
        return Frame::from_z(z);
    }
    let x = x / length;
    Frame { x, y: z.cross(x), z }
}
