//! The eight pieces that a segment is searched in, one a lane: [`Pieces`].

use sparrow_math::{Mask, Real};

use super::frame::{LaneJet, RayCubic};

/// Pieces of a segment.
const N: usize = 8;
/// Middles of the pieces, in half pieces.
const MIDDLES: [f32; N] = [1.0, 3.0, 5.0, 7.0, 9.0, 11.0, 13.0, 15.0];
/// Steps at most; two or three do for nearly all.
const MOST: usize = 8;
/// A step at rest, in half pieces: its square, times the bend, is far below a thousandth of a radius.
const REST: f64 = 0.01;
/// How far beyond its ends a piece may find a point, in the parameter; less than one point in a hundred thousand of
/// a segment is found twice.
const OVERLAP: f32 = 2e-6;

/// A point of a ray on a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CurveHit {
    pub(super) t: f32,
    /// Parameter of the segment.
    pub(super) u: f32,
    /// Offset across the fibre, in [-1, 1]: the sine of the angle from the ray's origin to the outward normal, around
    /// the tangent.
    pub(super) h: f32,
}

/// Part of a segment, cut into equal pieces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pieces {
    u: [f32; 2],
    /// Half of a piece.
    half: f32,
    /// Bound of the radius.
    radius: f32,
    /// Bound of the distance between a piece and the tangent in its middle.
    sag: f32,
}

/// Some pieces, one a lane.
#[derive(Clone, Copy)]
pub(super) struct Lane<R> {
    /// Middles.
    pub(super) u: R,
    /// Half of a piece.
    pub(super) half: R,
}

/// What was found in the pieces of all lanes.
pub(super) struct Found<R> {
    /// The ray's parameter; not below the limit where nothing was found.
    pub(super) t: R,
    /// Parameter of the segment.
    pub(super) u: R,
    /// Offset.
    pub(super) h: R,
}

/// Which pieces are worth a search.
pub(super) struct Reach<R: Real> {
    /// The piece comes as near to the ray as its radius.
    pub(super) alive: R::Mask,
    /// Seen along the ray it may turn back, so that it has to be cut further.
    pub(super) turning: R::Mask,
}

impl Pieces {
    #[inline(always)]
    pub(super) fn new(c: &RayCubic, u: [f32; 2], radius: f32) -> Pieces {
        let half = (u[1] - u[0]) * (0.5 / N as f32);
        Pieces { u, half, radius, sag: 0.5 * c.bend2().sqrt() * half * half }
    }

    /// One of these, cut into eight again.
    fn inner(&self, i: usize) -> Pieces {
        let middle = self.u[0] + self.half * MIDDLES[i];
        let u = [middle - self.half, middle + self.half];
        Pieces { u, half: self.half / N as f32, radius: self.radius, sag: self.sag / (N * N) as f32 }
    }

    /// Runs `find` for all pieces, as many at once as there are lanes, and again for the eight parts of those that
    /// turn. Returns the nearest point.
    #[inline(always)]
    pub(super) fn nearest<R: Real>(
        &self,
        t_max: f32,
        find: impl Fn(&Pieces, Lane<R>) -> Option<(Found<R>, R::Mask)>,
    ) -> Option<CurveHit> {
        let mut best = None;
        let mut turning = [0.0; N];
        let mut turns = false;
        let mut first = 0;
        while first < N {
            if let Some((found, turn)) = find(self, self.lane(first)) {
                best = nearer(best, t_max, &found);
                if turn.any() {
                    R::ONE.only_where(turn).store(&mut turning, first);
                    turns = true;
                }
            }
            first += R::WIDTH;
        }
        if turns {
            for (i, _) in turning.iter().enumerate().filter(|(_, t)| **t > 0.0) {
                let inner = self.inner(i);
                let mut first = 0;
                while first < N {
                    if let Some((found, _)) = find(&inner, inner.lane(first)) {
                        best = nearer(best, t_max, &found);
                    }
                    first += R::WIDTH;
                }
            }
        }
        best
    }

    #[inline(always)]
    fn lane<R: Real>(&self, first: usize) -> Lane<R> {
        let half = R::of(f64::from(self.half));
        Lane { u: R::of(f64::from(self.u[0])) + half * R::load(&MIDDLES, first), half }
    }

    /// What to think of pieces, given their middles.
    #[inline(always)]
    pub(super) fn reach<R: Real>(&self, middle: &LaneJet<R>) -> Reach<R> {
        let (p, d) = (&middle.p, &middle.d);
        let (half, sag) = (R::of(f64::from(self.half)), R::of(f64::from(self.sag)));
        let width = R::of(f64::from(self.radius)) + sag;
        let speed = (d.x.sqr() + d.y.sqr()).sqrt();
        let reach = speed * half + width;
        let alive = (p.x * d.y - p.y * d.x).abs().le(width * speed) & (p.x.sqr() + p.y.sqr()).le(reach.sqr());
        // The direction turns by less than a right angle where the speed cannot change by more than its half.
        Reach { alive, turning: alive & (speed * half).lt(R::of(4.0) * sag) }
    }

    /// The parameter lies in the lane's piece, or so little beyond that rounding may have put it there.
    #[inline(always)]
    pub(super) fn holds<R: Real>(&self, lane: &Lane<R>, u: R) -> R::Mask {
        (u - lane.u).abs().le(lane.half + R::of(f64::from(OVERLAP)))
    }
}

/// The nearest of the best so far and what the lanes found.
#[inline(always)]
fn nearer<R: Real>(best: Option<CurveHit>, t_max: f32, found: &Found<R>) -> Option<CurveHit> {
    let mut limit = best.map_or(t_max, |b| b.t);
    if !found.t.lt(R::of(f64::from(limit))).any() {
        return best;
    }
    let mut best = best;
    let [mut t, mut u, mut h] = [[0.0; N]; 3];
    found.t.store(&mut t, 0);
    found.u.store(&mut u, 0);
    found.h.store(&mut h, 0);
    for i in 0..R::WIDTH.min(N) {
        if t[i] < limit {
            limit = t[i];
            best = Some(CurveHit { t: t[i], u: u[i].clamp(0.0, 1.0), h: h[i].clamp(-1.0, 1.0) });
        }
    }
    best
}

/// Runs `step`, which gives the step to the next parameter and what it worked out, from the middles on until the steps
/// are so small that their squares change nothing; at most `MOST` times. Gives the last parameter, the last step with
/// what was worked out before it, and where it came to rest.
#[inline(always)]
pub(super) fn until_rest<R: Real, T>(
    lane: &Lane<R>,
    alive: R::Mask,
    first: (R, T),
    mut step: impl FnMut(R) -> (R, T),
) -> (R, (R, T), R::Mask) {
    let rest = lane.half * R::of(REST);
    let (lo, hi) = (lane.u - lane.half - lane.half, lane.u + lane.half + lane.half);
    let (mut u, mut last) = (lane.u, first);
    let mut n = 1;
    loop {
        let next = (u + last.0).clamp(lo, hi);
        let at_rest = (next - u).abs().le(rest);
        u = next;
        if n == MOST || (at_rest | !alive).all() {
            return (u, last, at_rest);
        }
        last = step(u);
        n += 1;
    }
}
