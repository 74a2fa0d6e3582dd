//! The hierarchy over primitives whose points move in straight lines: [`MotionBvh`].
//!
//! Boxes are kept where motion starts and where it ends; a ray meets those between, which hold what is between.

#![allow(
    unsafe_code,
    reason = "says that the bytes of a type are numbers, so that it can lie in mapped pages"
)]

use bytemuck::{Pod, Zeroable};
use sparrow_math::Aabb;

use super::Bvh;
use super::block::{RawHit, TriBlock};
use super::node::{Child, Node, WIDTH, meet};
use super::ray_data::RayData;
use super::traverse::{Block, Boxes};
use crate::lerp::Lerp;
use crate::ray::Ray;
use crate::simd::{Floats, Simd};

/// The hierarchy over what moves.
pub(crate) type MotionBvh = Bvh<MotionNode, MotionBlock>;

/// Children with their boxes at both ends of the motion; seven cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct MotionNode {
    /// `bounds[axis][0]` the lower, `[1]` the upper faces, each at the start and at the end.
    bounds: [[[[f32; WIDTH]; 2]; 2]; 3],
    pub(super) child: [Child; WIDTH],
    spare: [u32; 8],
}

// SAFETY: numbers without gaps between them: 448 bytes, a multiple of the alignment.
unsafe impl Pod for MotionNode {}
// SAFETY: as above.
unsafe impl Zeroable for MotionNode {}

impl MotionNode {
    /// The children of a node, with boxes that are never hit. Their faces are finite, as infinity times a weight of zero is no
    /// number.
    pub(super) fn like(node: &Node) -> MotionNode {
        let none = [[[f32::MAX; WIDTH]; 2], [[f32::MIN; WIDTH]; 2]];
        MotionNode { bounds: [none; 3], child: node.child, spare: [0; 8] }
    }
    /// Sets the boxes of a child.
    pub(super) fn set(&mut self, i: usize, boxes: &[Aabb; 2]) {
        for (axis, [lo, hi]) in self.bounds.iter_mut().enumerate() {
            for (end, b) in boxes.iter().enumerate() {
                (lo[end][i], hi[end][i]) = (b.lo[axis], b.hi[axis]);
            }
        }
    }
    /// Boxes around all children.
    pub(super) fn around(&self) -> [Aabb; 2] {
        let used = self.child.iter().filter(|&&c| c != Child::NONE).count();
        let fold = |axis: usize, side: usize, end: usize| {
            let faces = &self.bounds[axis][side][end][..used];
            if side == 0 {
                faces.iter().copied().fold(f32::INFINITY, f32::min)
            } else {
                faces.iter().copied().fold(f32::NEG_INFINITY, f32::max)
            }
        };
        [0, 1].map(|end| {
            let face = |side: usize| [fold(0, side, end), fold(1, side, end), fold(2, side, end)].into();
            Aabb { lo: face(0), hi: face(1) }
        })
    }
}

impl Boxes for MotionNode {
    #[inline(always)]
    fn hit<S: Simd>(&self, ray: &Ray, r: &RayData<S>, t_max: S::F8) -> (u32, S::F8) {
        let at = Lerp::at(ray.time);
        let (s, t) = (S::F8::splat(at.start), S::F8::splat(at.end));
        let face = |[start, end]: &[[f32; WIDTH]; 2]| S::F8::load(start) * s + S::F8::load(end) * t;
        let near = |a: usize| face(&self.bounds[a][r.neg[a] & 1]);
        let far = |a: usize| face(&self.bounds[a][1 - (r.neg[a] & 1)]);
        meet(r, near, far, t_max)
    }
    #[inline(always)]
    fn children(&self) -> &[Child; WIDTH] {
        &self.child
    }
}

/// Eight triangles at both ends of the motion.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct MotionBlock {
    start: TriBlock,
    end: TriBlock,
}

// SAFETY: two of a kind that is.
unsafe impl Pod for MotionBlock {}
// SAFETY: as above.
unsafe impl Zeroable for MotionBlock {}

impl MotionBlock {
    pub(super) fn empty() -> MotionBlock {
        MotionBlock { start: TriBlock::empty(), end: TriBlock::empty() }
    }
    pub(super) fn set(&mut self, i: usize, id: u32, [start, end]: &[[[f32; 3]; 3]; 2]) {
        self.start.set(i, id, start);
        self.end.set(i, id, end);
    }
}

impl Block for MotionBlock {
    #[inline(always)]
    fn hit<S: Simd>(
        &self,
        ray: &Ray,
        r: &RayData<S>,
        t_max: f32,
        found: &mut impl FnMut(RawHit) -> f32,
    ) -> f32 {
        self.start.between::<S>(&self.end, Lerp::at(ray.time)).hit(ray, r, t_max, found)
    }
}
