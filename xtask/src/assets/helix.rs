//! A cylinder around the y axis whose texture coordinate u climbs at 45 degrees: the way its fibres lie.

use std::f64::consts::TAU;

use sparrow_math::Real;

use super::grid;

const RADIUS: f64 = 0.7;
const HEIGHT: f64 = 2.0;
const AROUND: u32 = 72;

/// The mesh. With `s` the way around and `y` the way up, `u = s + y` and `v = y - s`, so that v stands still along the fibres.
pub(super) fn ply() -> String {
    grid::ply(AROUND, 1, |i, j| {
        let angle = TAU * f64::from(i) / f64::from(AROUND);
        let (s, c) = Real::sin_cos(angle);
        let (way, y) = (RADIUS * angle, HEIGHT * (f64::from(j) - 0.5));
        // Clockwise seen from below, so that u, v and the outer normal are right-handed.
        [RADIUS * s, y, RADIUS * c, s, 0.0, c, way + y, y - way]
    })
}
