//! Many points of a whole ball at once, in a loop that the compiler fills lanes with.

use sparrow_math::{InLanes, MAX_WIDTH, Real, Vec3, in_lanes};

use super::ball::Ball;
use super::form::around_sphere;
use super::{Quadric, p_error};
use crate::columns::{PointBlock, Vectors, get, set};
use crate::ray::Ray;

/// Where rays meet something.
#[derive(Default)]
pub(crate) struct Met {
    o: Vectors,
    d: Vectors,
    t: [f32; MAX_WIDTH],
}

impl Met {
    /// Writes where a ray meets something to place `k`.
    #[inline(always)]
    pub(crate) fn set(&mut self, k: usize, ray: &Ray, t: f32) {
        set(&mut self.o, k, ray.o);
        set(&mut self.d, k, ray.d);
        self.t[k] = t;
    }
}

struct Work<'a> {
    quadric: &'a Quadric,
    ball: &'a Ball,
    met: &'a Met,
    block: &'a mut PointBlock,
}

impl InLanes for Work<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Work { quadric, ball, met, block } = self;
        for k in 0..MAX_WIDTH {
            let out = ball.outward(&Ray::new(get(&met.o, k), get(&met.d, k)), met.t[k]);
            let (p, n) = quadric.on_ball(ball, out);
            set(&mut block.p, k, p.to_f32());
            set(&mut block.p_error, k, p_error(p));
            set(&mut block.ng, k, n.to_f32());
            set(&mut block.tangent, k, quadric.around_ball(ball, out).to_f32());
        }
    }
}

impl Quadric {
    pub(crate) fn is_ball(&self) -> bool {
        self.ball.is_some()
    }
    /// Derivative of the point by the first texture coordinate, on a ball.
    #[inline(always)]
    fn around_ball(&self, ball: &Ball, out: Vec3<f64>) -> Vec3<f64> {
        let n = self.to_object.vector(out) * ball.scale;
        self.to_world.vector(around_sphere(n * ball.object_radius, ball.object_radius))
    }
    /// [`surface`](Self::surface) without texture coordinates and derivatives, where rays meet a whole ball; nothing on others.
    pub(crate) fn surface_many(&self, met: &Met, block: &mut PointBlock) {
        if let Some(ball) = &self.ball {
            in_lanes(Work { quadric: self, ball, met, block });
            block.ns = block.ng;
        }
    }
}
