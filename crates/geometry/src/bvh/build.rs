//! Building the tree: the surface area heuristic over sixteen bins an axis, top down, four children a node.
//!
//! The order of everything follows from the primitives alone, so the tree is the same for any number of threads.

use rayon::prelude::*;
use sparrow_math::{Aabb, Vec3, vec3};

use super::block::{LEAF_SIZE, TriBlock};
use super::node::{Child, Kind, Node, WIDTH};
use super::pages::Pages;
use super::split::{Range, best_split};
use super::{Bvh, OtherBlock, UNUSED};
use crate::simd::Unit;

/// Below this size a subtree is built by one thread.
const PARALLEL: usize = 4096;

/// A primitive on its way into the tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PrimRef {
    pub(crate) lo: [f32; 3],
    pub(crate) hi: [f32; 3],
    pub(crate) id: u32,
    /// It is not a triangle.
    pub(crate) other: bool,
}

impl PrimRef {
    /// A primitive with its box, widened by what a triangle test may err that starts from far corners.
    pub(crate) fn new(id: u32, b: Aabb, other: bool) -> PrimRef {
        let pad = Vec3::splat(4.0 * f32::EPSILON * b.extent().max_component());
        PrimRef { lo: (b.lo - pad).to_array(), hi: (b.hi + pad).to_array(), id, other }
    }
    pub(crate) fn bounds(&self) -> Aabb {
        Aabb { lo: self.lo.into(), hi: self.hi.into() }
    }
    /// Twice the centre of the box.
    pub(crate) fn center2(&self) -> Vec3<f32> {
        vec3(self.lo[0] + self.hi[0], self.lo[1] + self.hi[1], self.lo[2] + self.hi[2])
    }
}

/// A leaf before its block exists: first place and length, in the list of primitives.
fn pending_leaf(r: &Range) -> Child {
    Child::new(
        if r.prims[0].other { Kind::Others } else { Kind::Triangles },
        r.first << 3 | (r.prims.len() - 1),
    )
}

/// The same child, once `by` nodes were put before the nodes it counts among.
fn moved(c: Child, by: usize) -> Child {
    if c.is_leaf() { c } else { Child::new(Kind::Node, c.index() + by) }
}

/// A subtree; its nodes are numbered from 0.
struct Subtree {
    root: Child,
    nodes: Vec<Node>,
    /// Stack entries a traversal of it may need.
    stack: usize,
}

fn build_subtree(range: Range, depth: u32) -> Subtree {
    if range.is_leaf() {
        return Subtree { root: pending_leaf(&range), nodes: Vec::new(), stack: 0 };
    }
    let size = range.prims.len();
    let parts = parts_of(range, depth);
    let boxes: Vec<Aabb> = parts.iter().map(|p| p.bounds).collect();
    let subtrees: Vec<Subtree> = if size > PARALLEL {
        parts.into_par_iter().map(|p| build_subtree(p, depth + 1)).collect()
    } else {
        parts.into_iter().map(|p| build_subtree(p, depth + 1)).collect()
    };
    join(&boxes, subtrees)
}

/// Splits a range until there are four, each time the one with the largest surface.
fn parts_of(range: Range, depth: u32) -> Vec<Range> {
    let mut parts = Vec::with_capacity(WIDTH);
    parts.push(range);
    while parts.len() < WIDTH {
        let area = |r: &Range| r.bounds.half_area();
        let open = (0..parts.len()).filter(|&i| !parts[i].is_leaf());
        let Some(i) = open.max_by(|&i, &j| area(&parts[i]).total_cmp(&area(&parts[j]))) else { break };
        let (a, b) = best_split(parts.remove(i), depth);
        parts.insert(i, b);
        parts.insert(i, a);
    }
    parts
}

/// Puts a node over subtrees, in one list: the node, then the subtrees one after the other.
fn join(boxes: &[Aabb], subtrees: Vec<Subtree>) -> Subtree {
    let mut nodes = Vec::with_capacity(1 + subtrees.iter().map(|s| s.nodes.len()).sum::<usize>());
    let mut root = Node::empty();
    let mut deepest = 0;
    let siblings = subtrees.len() - 1;
    nodes.push(root);
    for (i, (b, s)) in boxes.iter().zip(subtrees).enumerate() {
        let offset = nodes.len();
        root.child[i] = moved(s.root, offset);
        for axis in 0..3 {
            root.bounds[axis][0][i] = b.lo[axis];
            root.bounds[axis][1][i] = b.hi[axis];
        }
        deepest = deepest.max(s.stack);
        nodes.extend(s.nodes.iter().map(|n| Node { child: n.child.map(|c| moved(c, offset)), ..*n }));
    }
    nodes[0] = root;
    Subtree { root: Child::new(Kind::Node, 0), nodes, stack: deepest + siblings }
}

/// The primitives that fill the leaves, and in what order.
struct Leaves {
    ids: Vec<u32>,
    /// First place and length in `ids`, for each block.
    triangles: Vec<(u32, u8)>,
    others: Vec<OtherBlock>,
}

impl Leaves {
    /// Turns a pending leaf into one that names its block.
    fn settle(&mut self, c: Child) -> Child {
        if !c.is_leaf() || c == Child::NONE {
            return c;
        }
        let (first, len) = (c.index() >> 3, (c.index() & 7) + 1);
        if c.is_others() {
            let mut block = [UNUSED; LEAF_SIZE];
            block[..len].copy_from_slice(&self.ids[first..first + len]);
            self.others.push(block);
            Child::new(Kind::Others, self.others.len() - 1)
        } else {
            self.triangles.push((first as u32, len as u8));
            Child::new(Kind::Triangles, self.triangles.len() - 1)
        }
    }
}

impl Bvh {
    /// Builds the tree over `prims`; `corners` gives the corners of the triangles among them.
    pub(crate) fn build(mut prims: Vec<PrimRef>, corners: impl Fn(u32) -> [[f32; 3]; 3] + Sync) -> Bvh {
        let unit = Unit::choose();
        let Some(range) = Range::whole(&mut prims) else {
            let (nodes, triangles, others) = (Pages::zeroed(0), Pages::zeroed(0), Vec::new());
            return Bvh { nodes, triangles, others, root: Child::NONE, stack: 0, bounds: Aabb::EMPTY, unit };
        };
        let bounds = range.bounds;
        let Subtree { root, mut nodes, stack } = build_subtree(range, 0);
        let ids: Vec<u32> = prims.iter().map(|p| p.id).collect();
        drop(prims);

        let mut leaves = Leaves { ids, triangles: Vec::new(), others: Vec::new() };
        let root = leaves.settle(root);
        for node in &mut nodes {
            node.child = node.child.map(|c| leaves.settle(c));
        }
        let Leaves { ids, triangles, others } = leaves;
        let gather = |&(first, len): &(u32, u8)| {
            let mut block = TriBlock::empty();
            let first = first as usize;
            for (i, &id) in ids[first..first + usize::from(len)].iter().enumerate() {
                block.set(i, id, &corners(id));
            }
            block
        };
        let mut blocks = Pages::zeroed(triangles.len());
        blocks.par_iter_mut().zip(&triangles).for_each(|(b, t)| *b = gather(t));
        let triangles = blocks;
        let mut pages = Pages::zeroed(nodes.len());
        pages.copy_from_slice(&nodes);
        let nodes = pages;
        Bvh { nodes, triangles, others, root, stack, bounds, unit }
    }
}
