//! Building the tree over what moves: that of things which stand where they are half-way, with the boxes of both ends.

use sparrow_math::{Aabb, Vec3};

use super::super::Bvh;
use super::super::motion::{MotionBlock, MotionBvh, MotionNode};
use super::super::node::{Child, Kind, Node, WIDTH};
use super::super::pages::Pages;
use super::prim::widened;
use super::{PrimRef, Tree};
use crate::lerp::Lerp;
use crate::progress::Progress;
use crate::simd::Unit;

/// Half-way between two boxes.
fn half_way([a, b]: &[Aabb; 2]) -> Aabb {
    let mix = |a: Vec3<f32>, b: Vec3<f32>| Lerp::at(0.5).array(a.to_array(), b.to_array()).into();
    Aabb { lo: mix(a.lo, b.lo), hi: mix(a.hi, b.hi) }
}

fn union(a: [Aabb; 2], b: [Aabb; 2]) -> [Aabb; 2] {
    [a[0].union(b[0]), a[1].union(b[1])]
}

/// Nodes with the boxes of both ends, from those of the leaves.
fn nodes(wide: &[Node], leaf: impl Fn(Child) -> [Aabb; 2]) -> Pages<MotionNode> {
    let mut nodes = Pages::from(wide.iter().map(MotionNode::like).collect::<Vec<_>>());
    // Children come after their parents.
    for i in (0..nodes.len()).rev() {
        for slot in 0..WIDTH {
            let child = nodes[i].child[slot];
            if child == Child::NONE {
                break;
            }
            let boxes = if child.is_leaf() { leaf(child) } else { nodes[child.index()].around() };
            nodes[i].set(slot, &boxes);
        }
    }
    nodes
}

impl MotionBvh {
    /// Builds the tree over primitives with these numbers and boxes at both ends of the motion; `corners` gives those of
    /// triangles, which all of them are or none is.
    pub(crate) fn build_motion(
        kind: Kind,
        ids: &[u32],
        boxes: impl Fn(u32) -> [Aabb; 2] + Sync,
        corners: impl Fn(u32) -> [[[f32; 3]; 3]; 2] + Sync,
        progress: &Progress,
    ) -> MotionBvh {
        let unit = Unit::choose();
        let prims: Vec<PrimRef> = ids.iter().map(|&i| PrimRef::new(i, half_way(&boxes(i)), kind)).collect();
        let Some(tree) = Tree::of(prims, None::<&fn(u32) -> [[f32; 3]; 3]>, progress) else {
            let (nodes, triangles) = (Pages::zeroed(0), Pages::zeroed(0));
            return Bvh { nodes, triangles, root: Child::NONE, bounds: Aabb::EMPTY, unit };
        };
        let around = |ids: &[u32]| ids.iter().map(|&i| boxes(i).map(widened)).fold([Aabb::EMPTY; 2], union);
        let leaf = |child: Child| {
            if child.is_others() {
                around(&[child.index() as u32])
            } else {
                around(tree.ids_of(child.index()))
            }
        };
        let mut triangles = Pages::zeroed(tree.n_blocks());
        tree.gather(&mut triangles, MotionBlock::empty, |block, i, id| block.set(i, id, &corners(id)));
        let nodes = nodes(&tree.wide.nodes, leaf);
        let root = tree.wide.root;
        let [start, end] = if root.is_leaf() { leaf(root) } else { nodes[root.index()].around() };
        Bvh { nodes, triangles, root, bounds: start.union(end), unit }
    }
}
