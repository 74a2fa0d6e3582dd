//! The tree's parts: [`Node`], its [`Child`]ren, and the ray as the tests want it.

use sparrow_math::Vec3;

use super::lanes::F4;
use crate::ray::Ray;

/// Where a child lies: an inner node, four triangles, or up to four other primitives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(pub(crate) u32);

/// Bit that tells leaves from nodes.
const LEAF: u32 = 1 << 31;
/// Bit that tells leaves of other primitives from leaves of triangles.
const OTHER: u32 = 1 << 30;
/// The rest: a number of a node or block.
const INDEX: u32 = OTHER - 1;

impl Child {
    /// No child. Its box is never hit.
    pub(crate) const NONE: Child = Child(u32::MAX);

    pub(crate) fn node(i: usize) -> Child {
        Child(i as u32)
    }
    pub(crate) fn leaf(i: usize, other: bool) -> Child {
        Child(LEAF | if other { OTHER } else { 0 } | i as u32)
    }
    /// The same child, once `by` nodes were put before the nodes it counts among.
    pub(crate) fn moved(self, by: usize) -> Child {
        if self.is_leaf() { self } else { Child::node(self.index() + by) }
    }
    #[inline(always)]
    pub(crate) fn is_leaf(self) -> bool {
        self.0 & LEAF != 0
    }
    #[inline(always)]
    pub(crate) fn is_other(self) -> bool {
        self.0 & OTHER != 0
    }
    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        (self.0 & INDEX) as usize
    }
}

/// Four children with their boxes, side by side.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// `bounds[axis][0]` the lower, `[1]` the upper faces of the four boxes.
    pub(crate) bounds: [[F4; 2]; 3],
    /// The children; unused ones come last.
    pub(crate) child: [Child; 4],
}

impl Node {
    /// A node whose four boxes are never hit.
    pub(crate) fn empty() -> Node {
        let none = [F4::splat(f32::INFINITY), F4::splat(f32::NEG_INFINITY)];
        Node { bounds: [none; 3], child: [Child::NONE; 4] }
    }

    /// The boxes met between 0 and `t_max`, one bit each, and where the ray enters them.
    #[inline(always)]
    pub(crate) fn hit(&self, r: &RayData, t_max: f32) -> (u32, F4) {
        let [x, y, z] = &self.bounds;
        let [i, j, k] = r.neg;
        let near = |b: &[F4; 2], a: usize, i: usize| (b[i & 1] - r.o[a]) * r.inv_near[a];
        let far = |b: &[F4; 2], a: usize, i: usize| (b[1 - (i & 1)] - r.o[a]) * r.inv_far[a];
        let t0 = near(x, 0, i).max(near(y, 1, j)).max(near(z, 2, k)).max(F4::splat(0.0));
        let t1 = far(x, 0, i).min(far(y, 1, j)).min(far(z, 2, k)).min(F4::splat(t_max));
        (t0.le(t1), t0)
    }
}

/// A ray with what the tests need of it, worked out once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayData {
    /// Origin; like the next two in every lane, so that no test has to spread them.
    o: [F4; 3],
    /// 1 where the direction is negative: the upper face is the near one.
    neg: [usize; 3],
    /// Reciprocal direction, drawn in for entries and stretched for exits.
    ///
    /// By eight units in the last place: more than the box test and the shear of the triangle test can err
    /// together, so that no ray slips between two boxes that touch. [Ize2013; Woop2013, section 4]
    inv_near: [F4; 3],
    inv_far: [F4; 3],
    /// The axes, permuted: the last is the one along which the direction is longest.
    pub(crate) k: [usize; 3],
    /// The origin, its axes permuted likewise.
    pub(crate) o_k: [F4; 3],
    /// Shear and scale that bring the direction to (0, 0, 1). [Woop2013, section 3.2]
    pub(crate) s: [F4; 3],
    pub(crate) sz: f32,
}

impl RayData {
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> RayData {
        let d: Vec3<f32> = ray.d;
        let a = d.abs();
        let kz = if a.x > a.y {
            if a.x > a.z { 0 } else { 2 }
        } else if a.y > a.z {
            1
        } else {
            2
        };
        let (mut kx, mut ky) = ([1, 2, 0][kz], [2, 0, 1][kz]);
        if d[kz] < 0.0 {
            core::mem::swap(&mut kx, &mut ky);
        }
        let sz = 1.0 / d[kz];
        // A finite stand-in for 1/0: infinity times a distance of zero is not a number.
        let inv = |d: f32| if d.abs() < 1e-30 { 1e30_f32.copysign(d) } else { 1.0 / d };
        let [x, y, z] = [inv(d.x), inv(d.y), inv(d.z)];
        const PAD: f32 = 8.0 * f32::EPSILON;
        let scaled = |s: f32| [F4::splat(x * s), F4::splat(y * s), F4::splat(z * s)];
        let (near, far) = (scaled(1.0 - PAD), scaled(1.0 + PAD));
        RayData {
            o: [F4::splat(ray.o.x), F4::splat(ray.o.y), F4::splat(ray.o.z)],
            neg: [usize::from(x < 0.0), usize::from(y < 0.0), usize::from(z < 0.0)],
            inv_near: near,
            inv_far: far,
            k: [kx, ky, kz],
            o_k: [F4::splat(ray.o[kx]), F4::splat(ray.o[ky]), F4::splat(ray.o[kz])],
            s: [F4::splat(d[kx] * sz), F4::splat(d[ky] * sz), F4::splat(sz)],
            sz,
        }
    }
}
