//! Rays through the tree.

use super::block::{RawHit, TriBlock};
use super::node::{Child, Node, WIDTH};
use super::ray_data::RayData;
use super::stack::{Entry, Stack};
use super::{Bvh, UNUSED};
use crate::ray::Ray;
use crate::simd::{Floats, Kernel, Simd, prefetch};

/// Whoever knows the primitives that are not triangles.
pub(crate) trait Others {
    /// Offers every point of the ray before `t_max` on primitive `id` to `found`, which answers with the new
    /// `t_max`; returns the last of them.
    fn hit(&self, id: u32, ray: &Ray, t_max: f32, found: &mut impl FnMut(RawHit) -> f32) -> f32;
}

/// The lists that a ray reads.
struct Blocks<'a> {
    nodes: &'a [Node],
    triangles: &'a [TriBlock],
}

/// Asks for the data of a child ahead of its use.
#[inline(always)]
fn ahead(blocks: &Blocks, child: Child) {
    let i = child.index();
    if !child.is_leaf() {
        prefetch(blocks.nodes, i);
    } else {
        prefetch(blocks.triangles, i);
    }
}

/// Goes on to the nearest child met, one of `mask`, and puts the others on the stack.
#[inline(always)]
fn descend<const ANY: bool>(
    blocks: &Blocks,
    stack: &mut Stack,
    node: &Node,
    mut mask: u32,
    t: &[f32; WIDTH],
) -> Child {
    let mut next = || {
        let i = mask.trailing_zeros() as usize & (WIDTH - 1);
        mask &= mask - 1;
        (Entry::new(t[i], node.child[i]), mask != 0)
    };
    let (mut near, mut more) = next();
    if !more {
        return near.child();
    }
    let bottom = stack.len();
    ahead(blocks, near.child());
    while more {
        let e;
        (e, more) = next();
        ahead(blocks, e.child());
        if ANY {
            stack.push(e);
        } else {
            stack.push(e.max(near));
            near = e.min(near);
        }
    }
    if !ANY {
        stack.sort_from(bottom);
    }
    near.child()
}

/// One query: a ray through a tree.
struct Walk<'a, const ANY: bool, O, A> {
    bvh: &'a Bvh,
    ray: &'a Ray,
    others: &'a O,
    accept: A,
}

impl Bvh {
    /// The nearest point of the ray that `accept` takes; with `ANY`, the first one come across.
    #[inline]
    pub(crate) fn hit<const ANY: bool>(
        &self,
        ray: &Ray,
        others: &impl Others,
        accept: impl Fn(&RawHit) -> bool,
    ) -> Option<RawHit> {
        self.unit.run(Walk::<ANY, _, _> { bvh: self, ray, others, accept })
    }
}

impl<const ANY: bool, O: Others, A: Fn(&RawHit) -> bool> Kernel for Walk<'_, ANY, O, A> {
    type Output = Option<RawHit>;

    #[inline(always)]
    fn run<S: Simd>(self) -> Option<RawHit> {
        let Walk { bvh, ray, others, accept } = self;
        let r = RayData::<S>::new(ray)?;
        let blocks = Blocks { nodes: &bvh.nodes, triangles: &bvh.triangles };
        let mut stack = Stack::new();
        let (mut best, mut t_max) = (None, ray.t_max);
        let mut child = bvh.root;
        if child == Child::NONE {
            return None;
        }
        loop {
            let t_limit = S::F8::splat(t_max);
            while !child.is_leaf() {
                let node = &blocks.nodes[child.index()];
                let (mask, t) = node.hit(&r, t_limit);
                if mask == 0 {
                    let Some(c) = stack.pop(t_max) else { return best };
                    child = c;
                } else {
                    child = descend::<ANY>(&blocks, &mut stack, node, mask, &t.to_array());
                }
            }
            let mut limit = t_max;
            let mut found = |h: RawHit| {
                if accept(&h) {
                    t_max = if ANY { f32::NEG_INFINITY } else { h.t };
                    best = Some(h);
                }
                t_max
            };
            if child.is_others() {
                for &id in bvh.others[child.index()].iter().filter(|&&id| id != UNUSED) {
                    limit = others.hit(id, ray, limit, &mut found);
                }
            } else {
                blocks.triangles[child.index()].hit(ray, &r, limit, found);
            }
            if ANY && best.is_some() {
                return best;
            }
            let Some(c) = stack.pop(t_max) else { return best };
            child = c;
        }
    }
}
