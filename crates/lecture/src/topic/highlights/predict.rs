//! Where the highlight of fibres lies on bodies, by `t . h = 0` in closed form. [LuKoenderinkKappers2000]
//!
//! Light and viewer are far away, so that the half vector `h` is the same everywhere; it is of unit length. Bodies are of unit size about
//! the origin, their axis is z. Points come as runs of a curve, to be joined by lines.

use sparrow_math::{Real, Vec3, vec3};

/// A run of points.
pub(crate) type Run = Vec<Vec3<f64>>;

/// Angle around z and size of the part of `h` across it.
fn azimuth(h: Vec3<f64>) -> (f64, f64) {
    (Real::atan2(h.y, h.x), (h.x * h.x + h.y * h.y).sqrt())
}

fn on_sphere(theta: f64, phi: f64) -> Vec3<f64> {
    let ((s, c), (t, d)) = (Real::sin_cos(theta), Real::sin_cos(phi));
    vec3(s * d, s * t, c)
}

fn places(lo: f64, hi: f64, n: usize) -> impl Iterator<Item = f64> {
    (0..=n).map(move |k| lo + (hi - lo) * k as f64 / n.max(1) as f64)
}

/// Tangent of fibres on a sphere that make `turn` radians with its parallels: 0 along parallels, a quarter turn along meridians.
pub(crate) fn sphere_tangent(p: Vec3<f64>, turn: f64) -> Vec3<f64> {
    let (phi, _) = azimuth(p);
    let ((s, c), (st, ct)) = (Real::sin_cos(phi), Real::sin_cos(turn));
    let (east, south) = (vec3(-s, c, 0.0), vec3(p.z * c, p.z * s, -(p.x * p.x + p.y * p.y).sqrt()));
    east * ct + south * st
}

/// Tangent of fibres on a cylinder that make `turn` radians with its circumference.
pub(crate) fn cylinder_tangent(p: Vec3<f64>, turn: f64) -> Vec3<f64> {
    let (phi, _) = azimuth(p);
    let ((s, c), (st, ct)) = (Real::sin_cos(phi), Real::sin_cos(turn));
    vec3(-s * ct, c * ct, st)
}

/// Tangent of grooves on a disc that make `turn` radians with its circles.
pub(crate) fn disc_tangent(p: Vec3<f64>, turn: f64) -> Vec3<f64> {
    let (phi, _) = azimuth(p);
    let ((s, c), (st, ct)) = (Real::sin_cos(phi), Real::sin_cos(turn));
    vec3(-s * ct + c * st, c * ct + s * st, 0.0)
}

/// On a sphere with fibres at `turn` radians from its parallels.
///
/// `-sin(phi - phi_h) |h_xy| cos turn + (cos theta cos(phi - phi_h) |h_xy| - sin theta h_z) sin turn = 0` for each theta: two azimuths where there
/// are any. Along parallels this is the meridian through h and the one opposite, along meridians `tan theta = tan theta_h cos(phi - phi_h)`.
pub(crate) fn sphere(h: Vec3<f64>, turn: f64, n: usize) -> Vec<Run> {
    let (phi_h, across) = azimuth(h);
    let (st, ct) = Real::sin_cos(turn);
    let side = |sign: f64| -> Run {
        let at = |theta: f64| {
            let (s, c) = Real::sin_cos(theta);
            // a sin(delta) + b cos(delta) = d
            let (a, b, d) = (-across * ct, across * c * st, h.z * s * st);
            let size = (a * a + b * b).sqrt();
            if d.abs() > size || !(size > 0.0) {
                return None;
            }
            let delta = Real::atan2(a, b) + sign * Real::acos(d / size);
            Some(on_sphere(theta, phi_h + delta))
        };
        // Dense near the poles, where the curve turns quickly.
        places(0.0, 1.0, n).filter_map(|u| at(core::f64::consts::PI * u)).collect()
    };
    vec![side(1.0), side(-1.0)]
}

/// Azimuths on a cylinder with fibres at `turn` radians from its circumference: the generators along which the highlight lies. None where no
/// fibre reflects, as for axial fibres unless h is across the axis.
///
/// `sin(phi - phi_h) |h_xy| = tan turn h_z`
pub(crate) fn cylinder(h: Vec3<f64>, turn: f64) -> Vec<f64> {
    let (phi_h, across) = azimuth(h);
    let (st, ct) = Real::sin_cos(turn);
    let (up, side) = (st * h.z, ct * across);
    if up.abs() > side.abs() || !(side.abs() > 0.0) {
        return Vec::new();
    }
    let delta = Real::asin(up / side);
    vec![phi_h + delta, phi_h + core::f64::consts::PI - delta]
}

/// Azimuths on a disc with grooves at `turn` radians from its circles: the rays along which the highlight lies. Circles have it along the
/// direction of h, spokes across.
pub(crate) fn disc(h: Vec3<f64>, turn: f64) -> Vec<f64> {
    let (phi_h, _) = azimuth(h);
    vec![phi_h + turn, phi_h + turn + core::f64::consts::PI]
}

/// The point of the tangent plane at the pole on the ray from the centre through `p`; none for points of the lower half.
pub(crate) fn gnomonic(p: Vec3<f64>) -> Option<[f64; 2]> {
    (p.z > 1e-9).then(|| [p.x / p.z, p.y / p.z])
}
