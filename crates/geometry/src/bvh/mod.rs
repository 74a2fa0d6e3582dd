//! The bounding volume hierarchy: [`Bvh`].
//!
//! A tree with eight children a node. Leaves hold up to eight triangles, gathered side by side, or the number of one
//! other primitive, which the owner of the tree tests itself.

mod block;
mod build;
mod few;
mod node;
mod packet;
mod pages;
mod ray_data;
mod stack;
#[cfg(test)]
mod tests;
mod traverse;

pub(crate) use block::{RawHit, TriBlock, gamma};
pub(crate) use build::PrimRef;
pub(crate) use few::Few;
pub(crate) use node::Kind;
use node::{Child, Node};
pub(crate) use pages::Pages;
pub(crate) use traverse::Others;

use sparrow_math::Aabb;

use crate::simd::Unit;

/// Primitives a tree can number.
pub(crate) const MAX_PRIMS: usize = 1 << 28;

/// The hierarchy over primitives that are known by number.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    nodes: Pages<Node>,
    triangles: Pages<TriBlock>,
    root: Child,
    bounds: Aabb,
    /// What queries run on.
    unit: Unit,
}

impl Bvh {
    pub(crate) fn bounds(&self) -> Aabb {
        self.bounds
    }
    pub(crate) fn n_nodes(&self) -> usize {
        self.nodes.len()
    }
    pub(crate) fn bytes(&self) -> usize {
        self.nodes.len() * size_of::<Node>() + self.triangles.len() * size_of::<TriBlock>()
    }
}
