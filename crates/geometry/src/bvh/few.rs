//! A tree of one node, laid out for many rays at once: [`Few`].

use core::ops::Range;

use sparrow_math::{Aabb, vec3};

use super::Bvh;
use super::block::TriBlock;

/// Most corners, doubles not counted.
pub(crate) const MAX_VERTICES: usize = 64;
/// Most triangles.
const MAX_TRIANGLES: usize = 40;

/// Numbers of a triangle's corners.
pub(crate) type Corners = [u8; 3];

/// A triangle, or two that share a side and lie in a plane: rays of both go through that side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub(crate) first: Corners,
    pub(crate) second: Option<Corners>,
    ids: [u32; 2],
}

impl Pair {
    fn alone(corners: Corners, id: u32) -> Pair {
        Pair { first: corners, second: None, ids: [id; 2] }
    }
    /// A triangle alone with another one.
    fn with(&self, other: &Pair, vertices: &[[f32; 4]]) -> Option<Pair> {
        let (p, q) = (self.first, other.first);
        // Seen from the same side, triangles go opposite ways along the side that they share.
        let sides = |[a, b, c]: Corners| [[a, b], [b, c], [c, a]];
        let share = sides(p).iter().any(|&[a, b]| sides(q).contains(&[b, a]));
        let normal = |corners: Corners| {
            let [a, b, c] = corners.map(|i| {
                let [x, y, z, _] = vertices[usize::from(i)];
                vec3(x, y, z).to_f64()
            });
            (b - a).cross(c - a)
        };
        // Less than three degrees apart. Of planes that are not the same some rays are asked anew, no more.
        let (n, m) = (normal(p), normal(q));
        let flat = n.dot(m) > 0.999 * n.length() * m.length();
        (share && flat).then_some(Pair { second: Some(q), ids: [self.ids[0], other.ids[0]], ..*self })
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
            alone.push(Pair::alone(numbers, id));
        }
        while let Some(one) = alone.pop() {
            let with = |(i, other)| Some((i, one.with(other, &self.vertices)?));
            let found = alone.iter().enumerate().find_map(with);
            if let Some((i, _)) = found {
                alone.remove(i);
            }
            self.pairs.push(found.map_or(one, |(_, pair)| pair));
        }
        Some(())
    }
}
