//! Building the tree: a binary tree by the surface area heuristic, then the best wide tree that its cuts allow.
//!
//! The order of everything follows from the primitives alone, so the tree is the same for any number of threads.

mod binary;
mod bins;
mod collapse;
mod prim;
mod spatial;

use rayon::prelude::*;
use sparrow_math::Aabb;

use self::binary::Binary;
use self::bins::{Extent, Range};
use self::collapse::{Plan, Wide};
pub(crate) use self::prim::PrimRef;
use self::spatial::{References, Spatial};
use super::Bvh;
use super::block::TriBlock;
use super::node::{Child, Kind};
use super::pages::Pages;
use super::stack::STACK_SIZE;
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

impl Bvh {
    /// Builds the tree over `prims`; `corners` gives the corners of the triangles among them.
    pub(crate) fn build(mut prims: Vec<PrimRef>, corners: impl Fn(u32) -> [[f32; 3]; 3] + Sync) -> Bvh {
        let unit = Unit::choose();
        if prims.is_empty() {
            let (nodes, triangles) = (Pages::zeroed(0), Pages::zeroed(0));
            return Bvh { nodes, triangles, root: Child::NONE, bounds: Aabb::EMPTY, unit };
        }
        let extent = Extent::of(&prims);
        let mut tree = Binary::default();
        let area = extent.bounds.half_area();
        if overlap(&prims, area) > MAX_OVERLAP {
            let spare = (prims.len() as f64 * MAX_COPIES) as usize;
            let spatial = Spatial { corners: &corners, area };
            spatial.add(&mut tree, References { prims, spare }, extent, 0);
        } else {
            tree.add(Range { prims: &mut prims, extent }, 0);
            drop(prims);
        }
        let mut wide = Wide::default();
        let root = wide.add(&Plan::new(&tree), 0, 0, 0);
        debug_assert!(wide.stack <= STACK_SIZE, "depth is limited");

        let mut triangles = Pages::zeroed(wide.triangles.len());
        triangles.par_iter_mut().zip(&wide.triangles).for_each(|(block, place)| {
            *block = TriBlock::empty();
            let &(first, len) = place;
            let ids = &tree.ids[first as usize..first as usize + usize::from(len)];
            for (i, &id) in ids.iter().enumerate() {
                block.set(i, id, &corners(id));
            }
        });
        let mut nodes = Pages::zeroed(wide.nodes.len());
        nodes.copy_from_slice(&wide.nodes);
        Bvh { nodes, triangles, root, bounds: extent.bounds.to_aabb(), unit }
    }
}
