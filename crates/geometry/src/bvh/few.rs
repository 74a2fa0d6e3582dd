//! A tree of one node, laid out for many rays at once: [`Few`].

use core::ops::Range;

use sparrow_math::Aabb;

use super::Bvh;
use super::block::TriBlock;

/// Most corners, doubles not counted.
pub(crate) const MAX_VERTICES: usize = 64;
/// Most triangles.
const MAX_TRIANGLES: usize = 40;

/// Two triangles that share a side, (a, b, c) and (a, c, d), by the numbers of their corners. For a triangle alone, d is a: the second
/// then has no area.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub(crate) corners: [u8; 4],
    ids: [u32; 2],
}

impl Pair {
    /// With another triangle, which must not be part of a pair.
    fn with(&self, other: &Pair) -> Option<Pair> {
        let ([a, b, c, none], [a2, c2, d, none2]) = (self.corners, other.corners);
        let share = a == a2 && c == c2 && none == a && none2 == a2;
        share.then_some(Pair { corners: [a, b, c, d], ids: [self.ids[0], other.ids[0]] })
    }
}

/// The leaves of a tree of one node; corners that triangles share are there once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Few {
    /// `x y z 0`
    pub(crate) vertices: Vec<[f32; 4]>,
    pub(crate) pairs: Vec<Pair>,
    /// Boxes of the leaves that hold triangles, and which.
    pub(crate) leaves: Vec<(Aabb, Range<usize>)>,
    pub(crate) others: Vec<Other>,
    /// Numbers among the primitives of the tree: two for each pair, one for each other.
    pub(crate) ids: Vec<u32>,
}

/// A primitive that is not a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Other {
    pub(crate) bounds: Aabb,
    pub(crate) id: u32,
    /// Centre and radius of a ball that holds it; rounded to the nearest.
    pub(crate) ball: ([f32; 3], f32),
}

impl Few {
    /// Takes the leaves of `bvh`. `None` where it has more than a node, or more of anything than pays; where a triangle
    /// lies in two leaves; or where `ball` has none to hold another primitive. Of those that have one, the points that a ray is
    /// offered must not depend on where the ray ends.
    pub(crate) fn new(bvh: &Bvh, ball: impl Fn(u32) -> Option<([f32; 3], f32)>) -> Option<Few> {
        let [node] = &*bvh.nodes else { return None };
        let mut few = Few::default();
        for (i, child) in node.child.iter().enumerate().filter(|(_, c)| c.is_leaf()) {
            let Some(bounds) = node.bounds_of(i) else { continue };
            if child.is_others() {
                let id = child.index() as u32;
                few.others.push(Other { bounds, id, ball: ball(id)? });
            } else {
                let first = few.pairs.len();
                few.add(bvh.triangles.get(child.index())?)?;
                few.leaves.push((bounds, first..few.pairs.len()));
            }
        }
        let mut ids: Vec<u32> = bvh.triangles.iter().flat_map(TriBlock::triangles).map(|t| t.0).collect();
        ids.sort_unstable();
        let twice = ids.windows(2).any(|two| two[0] == two[1]);
        few.ids = few.pairs.iter().flat_map(|p| p.ids).chain(few.others.iter().map(|o| o.id)).collect();
        (!twice && ids.len() <= MAX_TRIANGLES && !few.ids.is_empty()).then_some(few)
    }

    /// Adds the triangles of a block, in pairs where they share a side; `None` where their corners are too many.
    fn add(&mut self, block: &TriBlock) -> Option<()> {
        let mut alone = Vec::new();
        for (id, corners) in block.triangles() {
            let mut numbers = [0; 3];
            for (to, [x, y, z]) in numbers.iter_mut().zip(corners) {
                let v = [x, y, z, 0.0];
                let same = |w: &[f32; 4]| w.map(f32::to_bits) == v.map(f32::to_bits);
                let at = self.vertices.iter().position(same).unwrap_or(self.vertices.len());
                if at == self.vertices.len() {
                    self.vertices.push(v);
                }
                *to = u8::try_from(at).ok().filter(|&at| usize::from(at) < MAX_VERTICES)?;
            }
            let [a, b, c] = numbers;
            alone.push(Pair { corners: [a, b, c, a], ids: [id; 2] });
        }
        while let Some(one) = alone.pop() {
            let two = |other: &Pair| one.with(other).or_else(|| other.with(&one));
            let found = alone.iter().enumerate().find_map(|(i, other)| Some((i, two(other)?)));
            if let Some((i, _)) = found {
                alone.remove(i);
            }
            self.pairs.push(found.map_or(one, |(_, pair)| pair));
        }
        Some(())
    }
}
