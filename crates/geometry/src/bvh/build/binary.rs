//! The binary tree that the wide one is made of: [`Binary`].

use super::super::block::LEAF_SIZE;
use super::super::node::Kind;
use super::bins::Range;
use super::prim::{Box4, PrimRef};
use crate::progress::Progress;

/// Below this size a subtree is built by one thread.
const PARALLEL: usize = 4096;

/// What the primitives of a subtree are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kinds {
    One(Kind),
    Mixed,
}

impl Kinds {
    /// Of as many as fit a leaf; more count as mixed.
    pub(super) fn of_few(prims: &[PrimRef]) -> Kinds {
        let first = prims[0].kind();
        let one = prims.len() <= LEAF_SIZE && prims.iter().all(|p| p.kind() == first);
        if one { Kinds::One(first) } else { Kinds::Mixed }
    }
    /// That many make a leaf.
    pub(super) fn fit(self, n: usize) -> bool {
        match self {
            Kinds::One(Kind::Triangles) => n <= LEAF_SIZE,
            // Nothing tests the boxes of other primitives in a leaf, so each has one of its own.
            Kinds::One(_) => n == 1,
            Kinds::Mixed => false,
        }
    }
    fn and(self, o: Kinds) -> Kinds {
        if self == o { self } else { Kinds::Mixed }
    }
}

/// A node of the binary tree. Its left child follows it in the list.
#[derive(Clone, Copy, Debug)]
pub(super) struct BinaryNode {
    pub(super) bounds: Box4,
    /// Primitives below it; those of the left child come first.
    pub(super) count: u32,
    /// How much farther in the list its right child lies; 0 for a leaf.
    pub(super) right: u32,
    pub(super) kinds: Kinds,
}

/// A binary tree: its nodes, each before its children, and the numbers of the primitives in the order of the leaves.
pub(super) struct Binary<'a> {
    pub(super) nodes: Vec<BinaryNode>,
    pub(super) ids: Vec<u32>,
    progress: &'a Progress<'a>,
    /// Primitives of which `progress` knows.
    told: usize,
}

impl<'a> Binary<'a> {
    pub(super) fn new(progress: &'a Progress<'a>) -> Binary<'a> {
        Binary { nodes: Vec::new(), ids: Vec::new(), progress, told: 0 }
    }
    /// Tells of the primitives that nobody was told of.
    pub(super) fn tell(&mut self) {
        self.progress.add(self.ids.len() - self.told);
        self.told = self.ids.len();
    }
    pub(super) fn leaf(&mut self, prims: &[PrimRef], bounds: Box4, kinds: Kinds) {
        self.nodes.push(BinaryNode { bounds, count: prims.len() as u32, right: 0, kinds });
        self.ids.extend(prims.iter().map(PrimRef::id));
    }
    /// Puts a node over two subtrees that `fill` adds, or that are built side by side.
    pub(super) fn inner<L: Send, R: Send>(
        &mut self,
        bounds: Box4,
        parallel: bool,
        (left, right): (L, R),
        fill: impl Fn(&mut Binary<'a>, Side<L, R>) + Sync,
    ) {
        let at = self.nodes.len();
        self.nodes.push(BinaryNode { bounds, count: 0, right: 0, kinds: Kinds::Mixed });
        if parallel {
            let mut b = Binary::new(self.progress);
            let told = |tree: &mut Binary<'a>, side| {
                fill(tree, side);
                tree.tell();
            };
            rayon::join(|| told(self, Side::Left(left)), || told(&mut b, Side::Right(right)));
            self.nodes[at].right = (self.nodes.len() - at) as u32;
            self.append(b);
        } else {
            fill(self, Side::Left(left));
            self.nodes[at].right = (self.nodes.len() - at) as u32;
            fill(self, Side::Right(right));
        }
        let (l, r) = (self.nodes[at + 1], self.nodes[at + self.nodes[at].right as usize]);
        self.nodes[at].count = l.count + r.count;
        self.nodes[at].kinds = l.kinds.and(r.kinds);
    }
    fn append(&mut self, mut other: Binary) {
        self.told += other.told;
        self.nodes.append(&mut other.nodes);
        self.ids.append(&mut other.ids);
    }

    /// The tree over a range, cut by the surface area heuristic.
    pub(super) fn add(&mut self, range: Range, depth: u32) {
        let (n, bounds) = (range.prims.len(), range.extent.bounds);
        let kinds = Kinds::of_few(range.prims);
        if kinds.fit(n) {
            return self.leaf(range.prims, bounds, kinds);
        }
        let parts = range.split_best(depth);
        self.inner(bounds, n > PARALLEL, parts, |tree, side| match side {
            Side::Left(part) | Side::Right(part) => tree.add(part, depth + 1),
        });
    }
}

/// One of two parts.
pub(super) enum Side<L, R> {
    Left(L),
    Right(R),
}
