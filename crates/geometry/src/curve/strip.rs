//! Rays and strips that face them.
//!
//! Seen along the ray the strip is drawn by a pen as wide as the curve. A ray meets it at `u` where the projected curve
//! comes nearest, `c . c' = 0`, and is no farther than the radius; the ray's parameter is that of the curve's depth.

use sparrow_math::{Mask, Real};

use super::frame::{LaneJet, RayCubic};
use super::pieces::{CurveHit, Found, Lane, Pieces, Reach, until_rest};

/// How much of a strip's width a ray sees: all, or that of a ribbon with these normals at the ends of the segment,
/// given by their angle and their components along the ray.
#[derive(Clone, Copy, Debug)]
pub(super) enum Width {
    Full,
    Ribbon { angle: f32, along: [f32; 2] },
}

impl Width {
    /// The part of the width that is seen at `u`.
    #[inline(always)]
    fn seen<R: Real>(self, u: R) -> R {
        match self {
            Width::Full => R::ONE,
            Width::Ribbon { angle, along } => {
                let [a, b] = slerp_weights(angle, u);
                let along = [R::of(f64::from(along[0])), R::of(f64::from(along[1]))];
                (a * along[0] + b * along[1]).abs().min(R::ONE)
            }
        }
    }
}

/// Weights of two unit vectors at `angle` for the one between them at `u`.
#[inline(always)]
pub(super) fn slerp_weights<R: Real>(angle: f32, u: R) -> [R; 2] {
    if angle < 1e-3 {
        return [R::ONE - u, u];
    }
    let angle = R::of(f64::from(angle));
    let inv = R::ONE / angle.sin();
    [(angle * (R::ONE - u)).sin() * inv, (angle * u).sin() * inv]
}

/// The nearest point of the ray on a strip between 0 and `t_max`.
#[inline(always)]
pub(super) fn hit<R: Real>(
    c: &RayCubic,
    pieces: &Pieces,
    width: Width,
    inv_length: f32,
    t_max: f32,
) -> Option<CurveHit> {
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
            let (u, (du, j), at_rest) = until_rest(
                &lane,
                alive,
                (newton(&middle), middle),
                #[inline(always)]
                |u| {
                    let j = c.jet(u);
                    (newton(&j), j)
                },
            );
            // The distance is stationary; radius and depth are not.
            let r = (j.p.r + j.d.r * du) * width.seen(u);
            let speed = (j.d.x.sqr() + j.d.y.sqr()).sqrt();
            let across = (j.p.x * j.d.y - j.p.y * j.d.x) / speed;
            let t = t0 + (j.p.z + j.d.z * du) * inv_length;
            let met = alive & at_rest & pieces.holds(&lane, u) & r.gt(R::ZERO) & across.abs().le(r);
            let met = met & t.gt(R::ZERO) & t.lt(limit);
            Some((Found { t: R::select(met, t, limit), u, h: across / r }, turning))
        },
    )
}

/// Newton's step to where the curve comes nearest to the ray.
#[inline(always)]
fn newton<R: Real>(j: &LaneJet<R>) -> R {
    let speed2 = j.d.x.sqr() + j.d.y.sqr();
    let slope = speed2 + j.p.x * j.dd.x + j.p.y * j.dd.y;
    // Where the distance has no minimum nearby, the step for a straight line.
    let slope = R::select(slope.gt(R::of(0.03) * speed2), slope, speed2);
    let g = j.p.x * j.d.x + j.p.y * j.d.y;
    -(g / slope.max(R::of(1e-30)))
}
