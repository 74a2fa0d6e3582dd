//! Rays through the tree.

use core::fmt::Debug;

use bytemuck::Pod;

use super::Bvh;
use super::block::RawHit;
use super::few::Few;
use super::node::{Child, WIDTH};
use super::packet::{self, Eight, RAYS};
use super::ray_data::RayData;
use super::stack::{Entry, Stack};
use crate::ray::Ray;
use crate::simd::{Floats, Kernel, Simd, prefetch};

/// Whoever knows the primitives that are not triangles.
pub(crate) trait Others {
    /// Offers every point of the ray before `t_max` on primitive `id` to `found`, which answers with the new
    /// `t_max`; returns the last of them.
    fn hit(&self, id: u32, ray: &Ray, t_max: f32, found: &mut impl FnMut(RawHit) -> f32) -> f32;
    /// Where the lines of eight rays, whose directions are not zero, meet primitive `id`, in order and rounded, if that is a whole ball; not
    /// numbers where they do not, and nothing positive behind their origins. Takes origins and directions axis by axis.
    #[inline(always)]
    fn roots(&self, _id: u32, _o: &[[f32; RAYS]; 3], _d: &[[f32; RAYS]; 3]) -> Option<[[f32; RAYS]; 2]> {
        None
    }
    /// Asks for what the test of primitive `id` will read.
    #[inline(always)]
    fn ahead(&self, _id: u32) {}
}

/// Whoever waits for what the rays of a list meet.
pub(crate) trait Answers {
    /// Takes what ray `i` meets.
    fn one(&mut self, i: usize, hit: Option<RawHit>);
    /// Takes what eight rays meet, from ray `first` on. Some of them may be answered once more.
    fn eight(&mut self, first: usize, hits: &Eight);
}

/// Children of a node, with their boxes.
pub(crate) trait Boxes: Pod + Debug {
    /// The boxes met between 0 and `t_max` at the ray's time, one bit each, and where the ray enters them.
    fn hit<S: Simd>(&self, ray: &Ray, r: &RayData<S>, t_max: S::F8) -> (u32, S::F8);
    fn children(&self) -> &[Child; WIDTH];
}

/// Triangles of a leaf.
pub(crate) trait Block: Pod + Debug {
    /// Offers every point of the ray before `t_max`, at the ray's time, to `found`, which answers with the new `t_max`;
    /// returns the last of them.
    fn hit<S: Simd>(
        &self,
        ray: &Ray,
        r: &RayData<S>,
        t_max: f32,
        found: &mut impl FnMut(RawHit) -> f32,
    ) -> f32;
}

/// The lists that a ray reads.
struct Blocks<'a, N, B, O> {
    others: &'a O,
    nodes: &'a [N],
    triangles: &'a [B],
}

/// Asks for the data of a child ahead of its use.
#[inline(always)]
fn ahead<N, B>(blocks: &Blocks<N, B, impl Others>, child: Child) {
    let i = child.index();
    if !child.is_leaf() {
        prefetch(blocks.nodes, i);
    } else if child.is_others() {
        blocks.others.ahead(i as u32);
    } else {
        prefetch(blocks.triangles, i);
    }
}

/// Goes on to the nearest child met, one of `mask`, and puts the others on the stack.
#[inline(always)]
fn descend<const ANY: bool, N, B>(
    blocks: &Blocks<N, B, impl Others>,
    stack: &mut Stack,
    children: &[Child; WIDTH],
    mut mask: u32,
    t: &[f32; WIDTH],
) -> Child {
    let mut next = || {
        let i = mask.trailing_zeros() as usize & (WIDTH - 1);
        mask &= mask - 1;
        (Entry::new(t[i], children[i]), mask != 0)
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

/// Offers points of the ray before `t_max` to `found`, the nearest boxes first, or with `ANY` in whatever order is quick;
/// `found` answers with the new `t_max`, which may be negative to end the search.
#[inline(always)]
fn walk<S: Simd, const ANY: bool, N: Boxes, B: Block>(
    bvh: &Bvh<N, B>,
    ray: &Ray,
    others: &impl Others,
    mut found: impl FnMut(RawHit) -> f32,
) {
    let Some(r) = RayData::<S>::new(ray) else { return };
    let (nodes, triangles): (&[N], &[B]) = (&bvh.nodes, &bvh.triangles);
    let blocks = Blocks { others, nodes, triangles };
    let mut stack = Stack::new();
    let (mut t_max, mut child) = (ray.t_max, bvh.root);
    if child == Child::NONE {
        return;
    }
    loop {
        let t_limit = S::F8::splat(t_max);
        while !child.is_leaf() {
            let node = &blocks.nodes[child.index()];
            let (mask, t) = node.hit(ray, &r, t_limit);
            if mask == 0 {
                let Some(c) = stack.pop(t_max) else { return };
                child = c;
            } else {
                child = descend::<ANY, _, _>(&blocks, &mut stack, node.children(), mask, &t.to_array());
            }
        }
        t_max = if child.is_others() {
            others.hit(child.index() as u32, ray, t_max, &mut found)
        } else {
            blocks.triangles[child.index()].hit(ray, &r, t_max, &mut found)
        };
        if ANY && t_max < 0.0 {
            return;
        }
        let Some(c) = stack.pop(t_max) else { return };
        child = c;
    }
}

/// One ray through a tree.
struct Walk<'a, const ANY: bool, N: Boxes, B: Block, O, F> {
    bvh: &'a Bvh<N, B>,
    ray: &'a Ray,
    others: &'a O,
    found: F,
}

impl<const ANY: bool, N, B, O, F> Kernel for Walk<'_, ANY, N, B, O, F>
where
    N: Boxes,
    B: Block,
    O: Others,
    F: FnMut(RawHit) -> f32,
{
    type Output = ();
    #[inline(always)]
    fn run<S: Simd>(self) {
        walk::<S, ANY, _, _>(self.bvh, self.ray, self.others, self.found);
    }
}

/// The first point that `accept` takes, of those that a search offers; the nearest of all unless `ANY`.
struct Best<A> {
    accept: A,
    hit: Option<RawHit>,
    t_max: f32,
}

impl<A: Fn(&RawHit) -> bool> Best<A> {
    #[inline(always)]
    fn offer<const ANY: bool>(&mut self, h: RawHit) -> f32 {
        if (self.accept)(&h) {
            self.t_max = if ANY { f32::NEG_INFINITY } else { h.t };
            self.hit = Some(h);
        }
        self.t_max
    }
}

/// Many rays through a tree, or all of it that there is if these are few: the vector unit is chosen once for all.
struct Walks<'a, const ANY: bool, O, A> {
    bvh: &'a Bvh,
    few: Option<&'a Few>,
    rays: &'a [Ray],
    others: &'a O,
    answers: &'a mut A,
}

impl<const ANY: bool, O: Others, A: Answers> Kernel for Walks<'_, ANY, O, A> {
    type Output = ();
    #[inline(always)]
    fn run<S: Simd>(self) {
        for (n, rays) in self.rays.chunks(RAYS).enumerate() {
            let (first, mut alone) = (n * RAYS, (1 << rays.len()) - 1_u32);
            // In halves of four, rays that go different ways take longer together than one by one.
            if S::EIGHT_IN_ONE
                && let (Some(few), Ok(rays)) = (self.few, rays.try_into())
            {
                let hits = packet::hit::<S, ANY>(few, rays, self.others);
                self.answers.eight(first, &hits);
                alone = hits.anew;
            }
            while alone != 0 {
                let i = alone.trailing_zeros() as usize & (RAYS - 1);
                alone &= alone - 1;
                let mut best = Best { accept: |_: &RawHit| true, hit: None, t_max: rays[i].t_max };
                walk::<S, ANY, _, _>(self.bvh, &rays[i], self.others, |h| best.offer::<ANY>(h));
                self.answers.one(first + i, best.hit);
            }
        }
    }
}

impl<N: Boxes, B: Block> Bvh<N, B> {
    /// Offers points of the ray before its end to `found`, which answers with the new end.
    #[inline]
    pub(crate) fn visit(&self, ray: &Ray, others: &impl Others, found: impl FnMut(RawHit) -> f32) {
        self.unit.run(Walk::<false, _, _, _, _> { bvh: self, ray, others, found });
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
        let mut best = Best { accept, hit: None, t_max: ray.t_max };
        self.unit.run(Walk::<ANY, _, _, _, _> { bvh: self, ray, others, found: |h| best.offer::<ANY>(h) });
        best.hit
    }
    /// The same for each ray of a list, without a choice. `few` may be what [`Few::new`] made of this tree.
    pub(crate) fn hits<const ANY: bool>(
        &self,
        few: Option<&Few>,
        rays: &[Ray],
        others: &impl Others,
        answers: &mut impl Answers,
    ) {
        self.unit.run(Walks::<ANY, _, _> { bvh: self, few, rays, others, answers });
    }
}
