//! Many points of a whole ball at once, in a loop that the compiler fills lanes with.

use sparrow_math::{InLanes, Real, Vec3, in_lanes, vec3};

use super::ball::Ball;
use super::form::around_sphere;
use super::{Quadric, p_error};
use crate::columns::SurfaceColumns;
use crate::ray::{Hit, Ray};

/// Fewer points are worked out one by one.
pub(crate) const MIN_MANY: usize = 4;
/// Points of a batch: what is known of them stays in the first cache.
const BATCH: usize = 64;
/// The loop goes over a multiple of so many points, so that none is left to be done by itself.
const STEP: usize = 16;

/// A vector for each point of a batch, axis by axis.
type Vectors = [[f32; BATCH]; 3];

#[inline(always)]
fn set(to: &mut Vectors, k: usize, v: Vec3<f32>) {
    [to[0][k], to[1][k], to[2][k]] = v.to_array();
}
#[inline(always)]
fn get(from: &Vectors, k: usize) -> Vec3<f32> {
    vec3(from[0][k], from[1][k], from[2][k])
}

/// Where rays met the ball.
struct Met {
    o: Vectors,
    d: Vectors,
    t: [f32; BATCH],
}

/// What is said of the points.
struct Points {
    p: Vectors,
    p_error: Vectors,
    n: Vectors,
    tangent: Vectors,
}

/// Works out the first `n` points of a batch.
struct Work<'a> {
    quadric: &'a Quadric,
    ball: &'a Ball,
    met: &'a Met,
    points: &'a mut Points,
    n: usize,
}

impl InLanes for Work<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Work { quadric, ball, met, points, n } = self;
        for k in 0..(n.next_multiple_of(STEP) & !(STEP - 1)).min(BATCH) {
            let out = ball.outward(&Ray::new(get(&met.o, k), get(&met.d, k)), met.t[k]);
            let (p, n) = quadric.on_ball(ball, out);
            set(&mut points.p, k, p.to_f32());
            set(&mut points.p_error, k, p_error(p));
            set(&mut points.n, k, n.to_f32());
            set(&mut points.tangent, k, quadric.around_ball(ball, out).to_f32());
        }
    }
}

impl Quadric {
    /// Derivative of the point by the first texture coordinate, on a ball.
    #[inline(always)]
    fn around_ball(&self, ball: &Ball, out: Vec3<f64>) -> Vec3<f64> {
        let n = self.to_object.vector(out) * ball.scale;
        self.to_world.vector(around_sphere(n * ball.object_radius, ball.object_radius))
    }

    /// [`surface`](Self::surface) without texture coordinates and derivatives, of the hits numbered `which`, to places from `first` on.
    /// False, and nothing done, where this is no whole ball.
    pub(crate) fn surface_many(
        &self,
        rays: &[Ray],
        hits: &[Option<Hit>],
        which: &[u32],
        first: usize,
        out: &mut SurfaceColumns<'_>,
    ) -> bool {
        let Some(ball) = &self.ball else { return false };
        let zero = [[0.0; BATCH]; 3];
        let mut met = Met { o: zero, d: zero, t: [0.0; BATCH] };
        let mut points = Points { p: zero, p_error: zero, n: zero, tangent: zero };
        for (batch, which) in which.chunks(BATCH).enumerate() {
            for (k, &i) in which.iter().enumerate() {
                let ray = &rays[i as usize];
                set(&mut met.o, k, ray.o);
                set(&mut met.d, k, ray.d);
                met.t[k] = hits[i as usize].map_or(0.0, |hit| hit.t);
            }
            let n = which.len();
            in_lanes(Work { quadric: self, ball, met: &met, points: &mut points, n });
            let (first, Points { p, p_error, n: normal, tangent }) = (first + BATCH * batch, &points);
            for (to, from) in [
                (&mut out.p, p),
                (&mut out.p_error, p_error),
                (&mut out.ng, normal),
                (&mut out.ns, normal),
                (&mut out.tangent, tangent),
            ] {
                for (to, from) in to.iter_mut().zip(from) {
                    to[first..first + n].copy_from_slice(&from[..n]);
                }
            }
        }
        true
    }
}
