//! Rays through the tree.

use super::block::RawHit;
use super::node::{Child, Node, RayData};
use super::{Bvh, UNUSED};
use crate::ray::Ray;

/// Whoever knows the primitives that are not triangles.
pub(crate) trait Others {
    /// Offers every point of the ray before `t_max` on primitive `id` to `found`, which answers with the new
    /// `t_max`; returns the last of them.
    fn hit(&self, id: u32, ray: &Ray, t_max: f32, found: &mut impl FnMut(RawHit) -> f32) -> f32;
}

/// A child and where the ray enters its box, as one number that sorts by that distance.
///
/// Distances are not negative, so their bits sort as they do. No entry of a child is 0: the root is nobody's child.
#[inline(always)]
fn entry(t: f32, child: Child) -> u64 {
    u64::from(t.to_bits()) << 32 | u64::from(child.0)
}

/// What is left to visit, nearest on top.
struct Stack<const N: usize> {
    entries: [u64; N],
    len: usize,
}

impl<const N: usize> Stack<N> {
    /// The next child whose box begins before `t_max`.
    #[inline(always)]
    fn pop(&mut self, t_max: f32) -> Option<Child> {
        while self.len > 0 {
            self.len -= 1;
            let e = *self.entries.get(self.len)?;
            if f32::from_bits((e >> 32) as u32) < t_max {
                return Some(Child(e as u32));
            }
        }
        None
    }
    /// Goes on to the nearest child met and puts the others on top. From two on there are no branches: how many
    /// there are, and in what order, cannot be foretold.
    #[inline(always)]
    fn descend(&mut self, node: &Node, mask: u32, t: [f32; 4]) -> Child {
        if mask & (mask - 1) == 0 {
            return node.child[mask.trailing_zeros() as usize & 3];
        }
        let key = |i: usize| entry(t[i], node.child[i]) * u64::from(mask >> i & 1);
        // A sorting network, farthest first; the children missed are 0 and end up beyond the top.
        let order = |a: u64, b: u64| (a.max(b), a.min(b));
        let ((a, b), (c, d)) = (order(key(0), key(1)), order(key(2), key(3)));
        let ((a, c), (b, d)) = (order(a, c), order(b, d));
        let (b, c) = order(b, c);
        let keys = [a, b, c, d];
        let rest = mask.count_ones() as usize - 1;
        debug_assert!(self.len + 4 <= N, "the stack was sized by the tree");
        if let Some(top) = self.entries.get_mut(self.len..self.len + 4) {
            top.copy_from_slice(&keys);
            self.len += rest;
        }
        Child(keys[rest & 3] as u32)
    }
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
        // A stack is cleared before use, which a small tree should not pay a large one for.
        match self.stack {
            0..=20 => self.walk::<ANY, 24>(ray, others, accept),
            21..=60 => self.walk::<ANY, 64>(ray, others, accept),
            _ => self.walk::<ANY, 512>(ray, others, accept),
        }
    }

    fn walk<const ANY: bool, const N: usize>(
        &self,
        ray: &Ray,
        others: &impl Others,
        accept: impl Fn(&RawHit) -> bool,
    ) -> Option<RawHit> {
        let r = RayData::new(ray);
        let mut stack = Stack::<N> { entries: [0; N], len: 0 };
        let (mut best, mut t_max) = (None, ray.t_max);
        let mut child = self.root;
        if child == Child::NONE {
            return None;
        }
        loop {
            if !child.is_leaf() {
                let node = &self.nodes[child.index()];
                let (mask, t) = node.hit(&r, t_max);
                if mask != 0 {
                    child = stack.descend(node, mask, t.to_array());
                    continue;
                }
            } else {
                let mut limit = t_max;
                let mut found = |h: RawHit| {
                    if accept(&h) {
                        t_max = if ANY { f32::NEG_INFINITY } else { h.t };
                        best = Some(h);
                    }
                    t_max
                };
                if child.is_other() {
                    for &id in self.others[child.index()].iter().filter(|&&id| id != UNUSED) {
                        limit = others.hit(id, ray, limit, &mut found);
                    }
                } else {
                    self.triangles[child.index()].hit(ray, &r, limit, found);
                }
                if ANY && best.is_some() {
                    return best;
                }
            }
            match stack.pop(t_max) {
                Some(c) => child = c,
                None => return best,
            }
        }
    }
}
