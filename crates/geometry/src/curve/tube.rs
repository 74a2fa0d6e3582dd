//! Rays and tubes: the circle of radius `r(u)` at right angles to the curve, swept along it.
//!
//! At the right `u` the tube is touched from inside or outside by the cone around the tangent with the same slope; so
//! the ray is cut with that cone, and the point is projected on the curve for the next `u`. The cone errs by the square
//! of the distance along the curve, which makes the iteration quadratic, also where the ray grazes the tube.
//! [ReshetovLuebke2018] cuts cones in this way too, and steps along the curve by what it gets.
//!
//! Only where the ray enters the tube does it meet it: who starts inside leaves unhindered.

use sparrow_math::{Mask, Real};

use super::frame::{LaneJet, RayCubic};
use super::pieces::{CurveHit, Found, Lane, Pieces, Reach, until_rest};

/// The ray, cut with the cone that touches the tube along one of its circles.
struct Cut<R: Real> {
    /// From the circle's centre to the point, along the ray.
    s: R,
    /// The discriminant; below zero the ray misses, and the point is where it comes nearest.
    discriminant: R,
}

impl<R: Real> Cut<R> {
    /// With the axis `c + a T` and the radius `r + k a`, the points `(0, 0, c_z + s)` of the ray lie on the cone where
    /// `A s^2 + 2 B s + C = 0`; the ray enters at the smaller root.
    #[inline(always)]
    fn new(j: &LaneJet<R>) -> Cut<R> {
        let (c, d) = (&j.p, &j.d);
        let inv_speed = R::ONE / (d.x.sqr() + d.y.sqr() + d.z.sqr()).max(R::of(1e-30)).sqrt();
        let (tx, ty, tz) = (d.x * inv_speed, d.y * inv_speed, d.z * inv_speed);
        let (r, k) = (c.r, d.r * inv_speed);
        // `a = s T_z - m`
        let m = c.x * tx + c.y * ty;
        let k1 = R::ONE + k * k;
        let a = R::ONE - k1 * tz * tz;
        let b = tz * (k1 * m - r * k);
        let c = c.x.sqr() + c.y.sqr() - k1 * m * m + R::of(2.0) * r * k * m - r * r;
        let discriminant = b * b - a * c;
        let root = discriminant.safe_sqrt();
        let sum = b.abs() + root;
        // The smaller root, without cancellation: their product is C / A.
        let s = R::select(b.lt(R::ZERO), c / sum.max(R::of(1e-30)), -(sum / a.max(R::of(1e-12))));
        Cut { s, discriminant }
    }

    /// From the point's foot on the tangent to its foot on the curve, to first order: the step in `u`.
    #[inline(always)]
    fn step(&self, j: &LaneJet<R>) -> R {
        let (d, dd) = (&j.d, &j.dd);
        let (x, y, s) = (-j.p.x, -j.p.y, self.s);
        let along = x * d.x + y * d.y + s * d.z;
        let speed2 = d.x.sqr() + d.y.sqr() + d.z.sqr();
        let slope = speed2 - (x * dd.x + y * dd.y + s * dd.z);
        let slope = R::select(slope.gt(R::of(0.1) * speed2), slope, speed2);
        along / slope.max(R::of(1e-30))
    }
}

/// A point of the curve with the cut there, after the step that it suggests.
#[inline(always)]
fn stepped<R: Real>(j: LaneJet<R>) -> (R, (LaneJet<R>, Cut<R>)) {
    let cut = Cut::new(&j);
    (cut.step(&j), (j, cut))
}

/// The nearest point between 0 and `t_max` where the ray enters the tube.
#[inline(always)]
pub(super) fn hit<R: Real>(c: &RayCubic, pieces: &Pieces, inv_length: f32, t_max: f32) -> Option<CurveHit> {
    let (t0, inv_length, limit) =
        (R::of(f64::from(c.t)), R::of(f64::from(inv_length)), R::of(f64::from(t_max)));
    pieces.nearest(
        t_max,
        #[inline(always)]
        |pieces: &Pieces, lane: Lane<R>| {
            let middle = c.jet(lane.u);
            let Reach { alive, turning } = pieces.reach::<R>(&middle);
            if !alive.any() {
                return None;
            }
            let (u, (_, (j, cut)), at_rest) = until_rest(
                &lane,
                alive,
                stepped(middle),
                #[inline(always)]
                |u| stepped(c.jet(u)),
            );
            let t = t0 + (j.p.z + cut.s) * inv_length;
            let met = alive & at_rest & pieces.holds(&lane, u) & j.p.r.gt(R::ZERO);
            let met = met & cut.discriminant.ge(R::ZERO) & t.gt(R::ZERO) & t.lt(limit);
            let across2 = j.d.x.sqr() + j.d.y.sqr();
            let h = (j.p.x * j.d.y - j.p.y * j.d.x) / (j.p.r * across2.sqrt());
            let h = R::select(across2.gt(R::ZERO) & j.p.r.gt(R::ZERO), h, R::ZERO);
            Some((Found { t: R::select(met, t, limit), u, h }, turning))
        },
    )
}
