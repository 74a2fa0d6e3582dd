//! Steps of a batch that run in lanes.

use sparrow_math::{Frame, InLanes, LocalDir, Real};

use super::column::{Column, store_vector, vector};
use crate::scatter::frame_of_fibre;

/// Makes the local frames of `n` vertices, and turns directions to them.
pub(super) struct ToLocal<'a> {
    pub(super) n: usize,
    /// The vertices lie on fibres.
    pub(super) fibre: bool,
    pub(super) ns: &'a [Column; 3],
    pub(super) tangent: &'a [Column; 3],
    pub(super) world: [&'a [Column; 3]; 2],
    pub(super) frame: &'a mut [[Column; 3]; 3],
    pub(super) local: [&'a mut [Column; 3]; 2],
}

impl InLanes for ToLocal<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let [x, y, z] = self.frame;
        let [first, second] = self.local;
        for k in (0..self.n).step_by(R::WIDTH) {
            let (ns, tangent) = (vector::<R>(self.ns, k), vector::<R>(self.tangent, k));
            let frame = if self.fibre { frame_of_fibre(tangent, ns) } else { Frame::from_zx(ns, tangent) };
            store_vector(frame.x, x, k);
            store_vector(frame.y, y, k);
            store_vector(frame.z, z, k);
            store_vector(frame.to_local(vector(self.world[0], k)).v(), first, k);
            store_vector(frame.to_local(vector(self.world[1], k)).v(), second, k);
        }
    }
}

/// Turns directions of `n` vertices to the world.
pub(super) struct ToWorld<'a> {
    pub(super) n: usize,
    pub(super) frame: &'a [[Column; 3]; 3],
    pub(super) local: &'a [Column; 3],
    pub(super) world: &'a mut [Column; 3],
}

impl InLanes for ToWorld<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let [x, y, z] = self.frame;
        for k in (0..self.n).step_by(R::WIDTH) {
            let frame = Frame { x: vector::<R>(x, k), y: vector(y, k), z: vector(z, k) };
            let wi = frame.to_world(LocalDir::new(vector(self.local, k)));
            store_vector(wi.normalized(), self.world, k);
        }
    }
}
