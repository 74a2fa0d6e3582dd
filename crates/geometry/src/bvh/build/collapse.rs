//! From the binary tree to the wide one, at the least cost that its cuts allow: [`Plan`]. [Ylitie2017]

use rayon::prelude::*;

use super::super::node::{Child, Kind, Node, WIDTH};
use super::super::pages::Pages;
use super::binary::{Binary, BinaryNode, Kinds};

/// What a subtree costs at best, in the units of the heuristic, as one child of a wide node up to as many as it has.
#[derive(Clone, Copy)]
struct Costs {
    /// `at_most[i]`: as at most `i + 1` children.
    at_most: [f32; WIDTH - 1],
    /// How many of these `i + 1` come from the left child; 0 where the subtree is one child.
    left: [u8; WIDTH - 1],
    /// The same for the wide node that has this subtree to itself.
    left_of_node: u8,
    /// As one child it is best a leaf.
    is_leaf: bool,
}

impl Costs {
    fn of_leaf(cost: f32) -> Costs {
        Costs { at_most: [cost; WIDTH - 1], left: [0; WIDTH - 1], left_of_node: 0, is_leaf: true }
    }

    /// Of a node, from those of its children.
    fn new(node: &BinaryNode, l: &Costs, r: &Costs) -> Costs {
        let area = node.bounds.half_area();
        let as_leaf = area * leaf_cost(node);
        // The cheapest way to share `n` children out between left and right.
        let share = |n: usize| {
            let mut best = (f32::INFINITY, 1);
            for k in 1..n {
                let cost = l.at_most[k - 1] + r.at_most[n - k - 1];
                if cost < best.0 {
                    best = (cost, k as u8);
                }
            }
            best
        };
        let (below, left_of_node) = share(WIDTH);
        let as_node = area + below;
        let mut c =
            Costs { left_of_node, is_leaf: as_leaf <= as_node, ..Costs::of_leaf(as_leaf.min(as_node)) };
        for n in 2..WIDTH {
            let (cost, k) = share(n);
            let fewer = c.at_most[n - 2];
            (c.at_most[n - 1], c.left[n - 1]) = if cost < fewer { (cost, k) } else { (fewer, c.left[n - 2]) };
            // With fewer children the same shares serve; what is left over stays empty.
        }
        c
    }
}

/// Nodes of a subtree below which one thread goes on alone.
const PARALLEL: usize = 1 << 12;

/// Works out the costs of a subtree, given by its nodes.
fn fill(nodes: &[BinaryNode], costs: &mut [Costs]) {
    let (Some(node), Some((own, below))) = (nodes.first(), costs.split_first_mut()) else { return };
    if node.right == 0 {
        *own = Costs::of_leaf(node.bounds.half_area() * leaf_cost(node));
        return;
    }
    let (l, r) = below.split_at_mut(node.right as usize - 1);
    let (of_l, of_r) = nodes[1..].split_at(l.len());
    if nodes.len() > PARALLEL {
        rayon::join(|| fill(of_l, l), || fill(of_r, r));
    } else {
        fill(of_l, l);
        fill(of_r, r);
    }
    *own = Costs::new(node, &l[0], &r[0]);
}

/// Cost of testing the primitives of a leaf; infinite where they do not fit one.
fn leaf_cost(node: &BinaryNode) -> f32 {
    if node.kinds.fit(node.count as usize) { 1.0 } else { f32::INFINITY }
}

/// The best way to make each subtree part of a wide tree.
pub(super) struct Plan<'a> {
    tree: &'a Binary<'a>,
    costs: Vec<Costs>,
}

impl<'a> Plan<'a> {
    pub(super) fn new(tree: &'a Binary<'a>) -> Plan<'a> {
        let mut costs = vec![Costs::of_leaf(0.0); tree.nodes.len()];
        fill(&tree.nodes, &mut costs);
        Plan { tree, costs }
    }

    /// The subtrees that become the children of the wide node at `at`, with their first primitives.
    fn children(&self, at: usize, first: usize, out: &mut Vec<(usize, usize)>) {
        let k = usize::from(self.costs[at].left_of_node);
        self.share(at, first, k, WIDTH - k, out);
    }
    fn share(&self, at: usize, first: usize, left: usize, right: usize, out: &mut Vec<(usize, usize)>) {
        let right_at = at + self.tree.nodes[at].right as usize;
        self.forest(at + 1, first, left, out);
        self.forest(right_at, first + self.tree.nodes[at + 1].count as usize, right, out);
    }
    /// The subtree at `at` as at most `n` children.
    fn forest(&self, at: usize, first: usize, mut n: usize, out: &mut Vec<(usize, usize)>) {
        let c = &self.costs[at];
        // As few as give the best cost.
        while n > 1 && c.at_most[n - 2] <= c.at_most[n - 1] {
            n -= 1;
        }
        if n == 1 || self.tree.nodes[at].right == 0 {
            out.push((at, first));
            return;
        }
        let k = usize::from(c.left[n - 1]);
        self.share(at, first, k, n - k, out);
    }
    fn is_leaf(&self, at: usize) -> bool {
        self.tree.nodes[at].right == 0 || self.costs[at].is_leaf
    }
}

/// A subtree of the binary tree: its node, its first primitive, and the entries that may lie on the stack by then.
#[derive(Clone, Copy)]
struct Subtree {
    at: usize,
    first: usize,
    stack: usize,
}

/// A part of the wide tree, numbered from its own beginning.
#[derive(Default)]
struct Part {
    nodes: Vec<Node>,
    triangles: Vec<(u32, u8)>,
    stack: usize,
}

impl Part {
    /// Adds a subtree, but for those below it that `leave` has a child for.
    fn add(
        &mut self,
        plan: &Plan,
        tree: Subtree,
        leave: &mut impl FnMut(&BinaryNode, Subtree) -> Option<Child>,
    ) -> Child {
        let Subtree { at, first, stack } = tree;
        let node = &plan.tree.nodes[at];
        if let Some(child) = leave(node, tree) {
            return child;
        }
        if plan.is_leaf(at) {
            if node.kinds == Kinds::One(Kind::Others) {
                return Child::new(Kind::Others, plan.tree.ids[first] as usize);
            }
            self.triangles.push((first as u32, node.count as u8));
            return Child::new(Kind::Triangles, self.triangles.len() - 1);
        }
        let i = self.nodes.len();
        self.nodes.push(Node::empty());
        let mut children = Vec::with_capacity(WIDTH);
        plan.children(at, first, &mut children);
        // Large boxes first: that is where a ray that looks for any hit goes first.
        let area = |&(at, _): &(usize, usize)| plan.tree.nodes[at].bounds.half_area();
        children.sort_by(|a, b| area(b).total_cmp(&area(a)));
        let stack = stack + children.len() - 1;
        self.stack = self.stack.max(stack);
        for (slot, (at, first)) in children.into_iter().enumerate() {
            let child = self.add(plan, Subtree { at, first, stack }, leave);
            self.nodes[i].set(slot, plan.tree.nodes[at].bounds.to_aabb(), child);
        }
        Child::new(Kind::Node, i)
    }
}

/// Primitives of the largest part that one thread makes.
const PART: usize = 1 << 12;

/// The wide tree before the blocks of its leaves exist.
pub(super) struct Wide {
    /// Each before its children.
    pub(super) nodes: Pages<Node>,
    /// First place and length among the numbers of primitives, for each block of triangles.
    pub(super) triangles: Vec<(u32, u8)>,
    /// The whole tree, as if it were a child.
    pub(super) root: Child,
    /// Entries the stack of a traversal may need.
    pub(super) stack: usize,
}

impl Wide {
    /// Nodes over large subtrees come first; the others are made in parts, side by side, and put behind them.
    pub(super) fn new(plan: &Plan) -> Wide {
        let mut subtrees = Vec::new();
        let mut top = Part::default();
        // Until it has its place, a part is a leaf with its number: there are no others at the top.
        let root = top.add(plan, Subtree { at: 0, first: 0, stack: 0 }, &mut |node, tree| {
            let small = node.count as usize <= PART;
            small.then(|| subtrees.push(tree)).map(|()| Child::new(Kind::Triangles, subtrees.len() - 1))
        });
        let make = |tree: &Subtree| {
            let mut part = Part::default();
            let root = part.add(plan, *tree, &mut |_, _| None);
            (part, root)
        };
        let parts: Vec<(Part, Child)> = subtrees.par_iter().map(make).collect();

        let (mut n_nodes, mut n_blocks) = (top.nodes.len(), 0);
        let mut moves = Vec::with_capacity(parts.len());
        for (part, _) in &parts {
            moves.push([n_nodes, n_blocks]);
            n_nodes += part.nodes.len();
            n_blocks += part.triangles.len();
        }
        let placed = |child: Child| match child.index() {
            part if child.is_leaf() && child != Child::NONE => parts[part].1.moved(moves[part]),
            _ => child,
        };
        let mut nodes = Pages::zeroed(n_nodes);
        let (to_top, mut rest) = nodes.split_at_mut(top.nodes.len());
        copy(&top.nodes, to_top, placed);
        let places: Vec<&mut [Node]> = parts
            .iter()
            .map(|(part, _)| rest.split_off_mut(..part.nodes.len()).unwrap_or_default())
            .collect();
        let all = parts.par_iter().zip(places).zip(&moves);
        all.for_each(|(((part, _), to), by)| copy(&part.nodes, to, |child| child.moved(*by)));
        Wide {
            nodes,
            triangles: parts.iter().flat_map(|(part, _)| &part.triangles).copied().collect(),
            root: placed(root),
            stack: parts.iter().map(|(part, _)| part.stack).fold(top.stack, usize::max),
        }
    }
}

/// Copies nodes, with other children.
fn copy(from: &[Node], to: &mut [Node], child: impl Fn(Child) -> Child) {
    for (from, to) in from.iter().zip(to) {
        *to = *from;
        to.child = to.child.map(&child);
    }
}
