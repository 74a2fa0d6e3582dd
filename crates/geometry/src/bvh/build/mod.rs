//! Building the tree: a binary tree by the surface area heuristic, then the best wide tree that its cuts allow.
//!
//! The order of everything follows from the primitives alone, so the tree is the same for any number of threads.

mod binary;
mod bins;
mod collapse;
mod motion;
mod prim;
mod spatial;

use rayon::prelude::*;
use sparrow_math::Aabb;

use self::binary::Binary;
use self::bins::{Extent, Range};
use self::collapse::{Plan, Wide};
pub(crate) use self::prim::{Box4, PrimRef};
use self::spatial::{References, Spatial};
use super::Bvh;
use super::block::TriBlock;
use super::node::{Child, Kind};
use super::pages::Pages;
use super::stack::STACK_SIZE;
use crate::progress::Progress;
use crate::simd::Unit;

/// Where the surface of all primitives' boxes is more than this many times that of the box around them, primitives may be cut.
const MAX_OVERLAP: f32 = 10.0;
/// How many more references than primitives cutting may make, as a part of their number.
const MAX_COPIES: f64 = 1.0;

/// The surface of the boxes of triangles, in units of `area`; summed in an order of its own, whatever the number of threads.
fn overlap(prims: &[PrimRef], area: f32) -> f32 {
    let triangles = |p: &&PrimRef| p.kind() == Kind::Triangles;
    let sum = |chunk: &[PrimRef]| chunk.iter().filter(triangles).map(|p| p.bounds().half_area()).sum::<f32>();
    let parts: Vec<f32> = prims.par_chunks(1 << 12).map(sum).collect();
    parts.iter().sum::<f32>() / area
}

/// A wide tree, and the numbers of the primitives in the order of its leaves.
struct Tree {
    ids: Vec<u32>,
    wide: Wide,
    bounds: Aabb,
}

impl Tree {
    /// `None` where there is nothing to build it over. Triangles may be cut where their `corners` are given.
    fn of<C>(mut prims: Vec<PrimRef>, corners: Option<&C>, progress: &Progress) -> Option<Tree>
    where
        C: Fn(u32) -> [[f32; 3]; 3] + Sync,
    {
        if prims.is_empty() {
            return None;
        }
        let extent = Extent::of(&prims);
        let mut tree = Binary::new(progress);
        let area = extent.bounds.half_area();
        match corners {
            Some(corners) if overlap(&prims, area) > MAX_OVERLAP => {
                let spare = (prims.len() as f64 * MAX_COPIES) as usize;
                let spatial = Spatial { corners, area };
                spatial.add(&mut tree, References { prims, spare }, extent, 0);
            }
            _ => {
                tree.add(Range { prims: &mut prims, extent }, 0);
                drop(prims);
            }
        }
        tree.tell();
        let wide = Wide::new(&Plan::new(&tree));
        debug_assert!(wide.stack <= STACK_SIZE, "depth is limited");
        Some(Tree { ids: tree.ids, wide, bounds: extent.bounds.to_aabb() })
    }
    /// Leaves that hold triangles.
    fn n_blocks(&self) -> usize {
        self.wide.triangles.len()
    }
    /// The triangles of such a leaf.
    fn ids_of(&self, block: usize) -> &[u32] {
        let (first, len) = self.wide.triangles[block];
        &self.ids[first as usize..first as usize + usize::from(len)]
    }
    /// Fills blocks, each with the triangles of its leaf by `set`.
    fn gather<B: Send>(
        &self,
        blocks: &mut [B],
        empty: impl Fn() -> B + Sync,
        set: impl Fn(&mut B, usize, u32) + Sync,
    ) {
        blocks.par_iter_mut().enumerate().for_each(|(n, block)| {
            *block = empty();
            self.ids_of(n).iter().enumerate().for_each(|(i, &id)| set(block, i, id));
        });
    }
}

impl Bvh {
    /// Builds the tree over `prims`; `corners` gives the corners of the triangles among them.
    pub(crate) fn build(
        prims: Vec<PrimRef>,
        corners: impl Fn(u32) -> [[f32; 3]; 3] + Sync,
        progress: &Progress,
    ) -> Bvh {
        let unit = Unit::choose();
        let Some(tree) = Tree::of(prims, Some(&corners), progress) else {
            let (nodes, triangles) = (Pages::zeroed(0), Pages::zeroed(0));
            return Bvh { nodes, triangles, root: Child::NONE, bounds: Aabb::EMPTY, unit };
        };
        let mut triangles = Pages::zeroed(tree.n_blocks());
        tree.gather(&mut triangles, TriBlock::empty, |block, i, id| block.set(i, id, &corners(id)));
        let Wide { nodes, root, .. } = tree.wide;
        Bvh { nodes, triangles, root, bounds: tree.bounds, unit }
    }
}
