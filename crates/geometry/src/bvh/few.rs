//! A tree of one node, laid out for many rays at once: [`Few`].

use core::ops::Range;

use sparrow_math::Aabb;

use super::Bvh;
use super::block::TriBlock;

/// Most corners, doubles not counted.
pub(crate) const MAX_VERTICES: usize = 64;
/// Most triangles.
const MAX_TRIANGLES: usize = 40;

/// A triangle by the numbers of its corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FewTriangle {
    pub(crate) corners: [u8; 3],
    pub(crate) id: u32,
}

/// The leaves of a tree of one node; corners that triangles share are there once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Few {
    /// `x y z 0`
    pub(crate) vertices: Vec<[f32; 4]>,
    pub(crate) triangles: Vec<FewTriangle>,
    /// Boxes of the leaves that hold triangles, and which.
    pub(crate) leaves: Vec<(Aabb, Range<usize>)>,
    pub(crate) others: Vec<Other>,
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
                let first = few.triangles.len();
                few.add(bvh.triangles.get(child.index())?)?;
                few.leaves.push((bounds, first..few.triangles.len()));
            }
        }
        let mut ids: Vec<u32> = few.triangles.iter().map(|t| t.id).collect();
        ids.sort_unstable();
        let twice = ids.windows(2).any(|two| two[0] == two[1]);
        (!twice).then_some(few)
    }

    /// Adds the triangles of a block; `None` where they are too many.
    fn add(&mut self, block: &TriBlock) -> Option<()> {
        for (id, corners) in block.triangles() {
            let mut triangle = FewTriangle { corners: [0; 3], id };
            for (to, [x, y, z]) in triangle.corners.iter_mut().zip(corners) {
                let v = [x, y, z, 0.0];
                let same = |w: &[f32; 4]| w.map(f32::to_bits) == v.map(f32::to_bits);
                let at = self.vertices.iter().position(same).unwrap_or(self.vertices.len());
                if at == self.vertices.len() {
                    self.vertices.push(v);
                }
                *to = u8::try_from(at).ok().filter(|&at| usize::from(at) < MAX_VERTICES)?;
            }
            self.triangles.push(triangle);
        }
        (self.triangles.len() <= MAX_TRIANGLES).then_some(())
    }
}
