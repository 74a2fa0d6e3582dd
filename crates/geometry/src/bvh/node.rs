//! The tree's parts: [`Node`] and its [`Child`]ren.

#![allow(
    unsafe_code,
    reason = "says that the bytes of a type are numbers, so that it can lie in mapped pages"
)]

use bytemuck::{Pod, Zeroable};
use sparrow_math::Aabb;

use super::ray_data::RayData;
use super::traverse::Boxes;
use crate::ray::Ray;
use crate::simd::{Floats, Mask, Simd};

/// Children of a node.
pub(crate) const WIDTH: usize = 8;

/// What a child is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Node,
    /// A leaf: a block of triangles.
    Triangles,
    /// A leaf: one other primitive, whose place is its number.
    Others,
}

/// Where a child lies: what it is in the upper three bits, and its place among its kind.
///
/// Leaves have the highest bit; two bits tell their kind, of which two values are free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub(crate) struct Child(pub(crate) u32);

const LEAF: u32 = 1 << 31;
const OTHERS: u32 = 1 << 29;
const KIND: u32 = 3 << 29;
const INDEX: u32 = (1 << 29) - 1;

impl Child {
    /// No child. Its box is never hit.
    pub(crate) const NONE: Child = Child(u32::MAX);

    pub(crate) fn new(kind: Kind, i: usize) -> Child {
        let bits = match kind {
            Kind::Node => 0,
            Kind::Triangles => LEAF,
            Kind::Others => LEAF | OTHERS,
        };
        Child(bits | i as u32)
    }
    #[inline(always)]
    pub(crate) fn is_leaf(self) -> bool {
        self.0 & LEAF != 0
    }
    /// It is another primitive; asked of leaves alone.
    #[inline(always)]
    pub(crate) fn is_others(self) -> bool {
        self.0 & KIND == OTHERS
    }
    /// The same child in a tree that has so many nodes and blocks of triangles before those that it was counted among.
    pub(crate) fn moved(self, [nodes, blocks]: [usize; 2]) -> Child {
        match (self, self.is_leaf()) {
            (Child::NONE, _) => self,
            (_, false) => Child::new(Kind::Node, self.index() + nodes),
            (_, true) if self.is_others() => self,
            (_, true) => Child::new(Kind::Triangles, self.index() + blocks),
        }
    }
    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        (self.0 & INDEX) as usize
    }
}

// SAFETY: a number; all of its bits mean something.
unsafe impl Pod for Child {}
// SAFETY: as above.
unsafe impl Zeroable for Child {}

/// Children with their boxes, side by side; four cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// `bounds[axis][0]` the lower, `[1]` the upper faces of the boxes.
    pub(crate) bounds: [[[f32; WIDTH]; 2]; 3],
    /// The children; unused ones come last.
    pub(crate) child: [Child; WIDTH],
    spare: [u32; 8],
}

// SAFETY: numbers without gaps between them.
unsafe impl Pod for Node {}
// SAFETY: as above.
unsafe impl Zeroable for Node {}

impl Node {
    /// A node whose boxes are never hit: they end before they begin, which no arithmetic of the test turns into NaN.
    pub(crate) fn empty() -> Node {
        let none = [[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]];
        Node { bounds: [none; 3], child: [Child::NONE; WIDTH], spare: [0; 8] }
    }

    /// Fills a slot.
    pub(crate) fn set(&mut self, i: usize, b: Aabb, child: Child) {
        for (axis, [lo, hi]) in self.bounds.iter_mut().enumerate() {
            (lo[i], hi[i]) = (b.lo[axis], b.hi[axis]);
        }
        self.child[i] = child;
    }

    /// The box of a child; `None` where there is none.
    pub(crate) fn bounds_of(&self, i: usize) -> Option<Aabb> {
        let face = |side: usize| [0, 1, 2].map(|a: usize| self.bounds[a][side][i]).into();
        (self.child[i] != Child::NONE).then(|| Aabb { lo: face(0), hi: face(1) })
    }
}

impl Boxes for Node {
    #[inline(always)]
    fn hit<S: Simd>(&self, _: &Ray, r: &RayData<S>, t_max: S::F8) -> (u32, S::F8) {
        let near = |a: usize| S::F8::load(&self.bounds[a][r.neg[a] & 1]);
        let far = |a: usize| S::F8::load(&self.bounds[a][1 - (r.neg[a] & 1)]);
        meet(r, near, far, t_max)
    }
    #[inline(always)]
    fn children(&self) -> &[Child; WIDTH] {
        &self.child
    }
}

/// The boxes met between 0 and `t_max`, and where the ray enters them; `near` and `far` give the faces across an axis.
#[inline(always)]
pub(super) fn meet<S: Simd>(
    r: &RayData<S>,
    near: impl Fn(usize) -> S::F8,
    far: impl Fn(usize) -> S::F8,
    t_max: S::F8,
) -> (u32, S::F8) {
    let near = |a: usize| (r.o[a] - near(a)) * r.minus_inv_near[a];
    let far = |a: usize| (r.o[a] - far(a)) * r.minus_inv_far[a];
    let t0 = near(0).max_nonneg(near(1)).max_nonneg(near(2).max_nonneg(S::F8::splat(0.0)));
    let t1 = far(0).min_nonneg(far(1)).min_nonneg(far(2).min_nonneg(t_max));
    (t0.le(t1).bits(), t0)
}
