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

/// A child and where the ray enters its box; as one number it sorts by that distance.
#[derive(Clone, Copy)]
struct Entry(u64);

impl Entry {
    #[inline(always)]
    fn new(t: f32, child: Child) -> Entry {
        // Distances are not negative, so their bits sort as they do.
        Entry(u64::from(t.to_bits()) << 32 | u64::from(child.0))
    }
    #[inline(always)]
    fn t(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }
    #[inline(always)]
    fn child(self) -> Child {
        Child(self.0 as u32)
    }
}

/// What is left to visit, nearest on top.
struct Stack<const N: usize> {
    entries: [u64; N],
    len: usize,
}

impl<const N: usize> Stack<N> {
    #[inline(always)]
    fn push(&mut self, e: Entry) {
        debug_assert!(self.len < N, "the stack was sized by the tree");
        if let Some(place) = self.entries.get_mut(self.len) {
            *place = e.0;
            self.len += 1;
        }
    }
    /// The next child whose box begins before `t_max`.
    #[inline(always)]
    fn pop(&mut self, t_max: f32) -> Option<Child> {
        while self.len > 0 {
            self.len -= 1;
            let e = Entry(*self.entries.get(self.len)?);
            if e.t() < t_max {
                return Some(e.child());
            }
        }
        None
    }
    /// Goes on to the nearest child met and keeps the others.
    #[inline(always)]
    fn descend(&mut self, node: &Node, mut mask: u32, t: [f32; 4]) -> Child {
        let entry = |i: usize| Entry::new(t[i & 3], node.child[i & 3]);
        let mut next = entry(mask.trailing_zeros() as usize);
        mask &= mask - 1;
        if mask == 0 {
            return next.child();
        }
        let base = self.len;
        while mask != 0 {
            let e = entry(mask.trailing_zeros() as usize);
            mask &= mask - 1;
            let (near, far) = (Entry(next.0.min(e.0)), Entry(next.0.max(e.0)));
            next = near;
            self.push(far);
        }
        // At most three were pushed; the nearest of them belongs on top.
        let order = |s: &mut [u64; N], i: usize, j: usize| {
            if let (Some(&a), Some(&b)) = (s.get(i), s.get(j)) {
                s[i] = a.max(b);
                s[j] = a.min(b);
            }
        };
        if self.len - base >= 2 {
            order(&mut self.entries, base, base + 1);
            if self.len - base == 3 {
                order(&mut self.entries, base + 1, base + 2);
                order(&mut self.entries, base, base + 1);
            }
        }
        next.child()
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
            0..=24 => self.walk::<ANY, 24>(ray, others, accept),
            25..=64 => self.walk::<ANY, 64>(ray, others, accept),
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
                    child = stack.descend(node, mask, t.0);
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
