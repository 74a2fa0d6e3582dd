//! The bounding volume hierarchy: [`Bvh`].
//!
//! A tree with eight children a node. Leaves hold up to eight triangles, gathered side by side, or the number of one
//! other primitive, which the owner of the tree tests itself. [`MotionBvh`] is the same over what moves in lines.

mod block;
mod build;
mod face;
mod few;
mod motion;
mod node;
mod packet;
mod pages;
mod ray_data;
mod settle;
mod stack;
#[cfg(test)]
mod tests;
mod traverse;

pub(crate) use block::{RawHit, TriBlock, gamma};
pub(crate) use build::{Box4, PrimRef};
pub(crate) use few::{Ball, Few, Owner};
pub(crate) use motion::MotionBvh;
pub(crate) use node::Kind;
use node::{Child, Node};
pub(crate) use packet::{Eight, RAYS};
pub(crate) use pages::Pages;
pub(crate) use traverse::{Answers, Others};
use traverse::{Block, Boxes};

use sparrow_math::Aabb;

use crate::simd::Unit;

/// Primitives a tree can number.
pub(crate) const MAX_PRIMS: usize = 1 << 28;

/// The hierarchy over primitives that are known by number; of things that stand still unless its parts say otherwise.
#[derive(Clone, Debug)]
pub(crate) struct Bvh<N: Boxes = Node, B: Block = TriBlock> {
    nodes: Pages<N>,
    triangles: Pages<B>,
    root: Child,
    bounds: Aabb,
    /// What queries run on.
    unit: Unit,
}

impl<N: Boxes, B: Block> Bvh<N, B> {
    pub(crate) fn bounds(&self) -> Aabb {
        self.bounds
    }
    pub(crate) fn n_nodes(&self) -> usize {
        self.nodes.len()
    }
    pub(crate) fn bytes(&self) -> usize {
        self.nodes.len() * size_of::<N>() + self.triangles.len() * size_of::<B>()
    }
}
