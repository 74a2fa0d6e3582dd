//! The hierarchy of lights: bounds eight to a node, a light chosen by going down. [ContyKulla2018]

use sparrow_math::{InLanes, Real, in_lanes};

use super::LitPoint;
use super::bounds::LightBounds;
use super::eight::{EIGHT, Eight, pick};
use super::group::{Grouped, group};

/// Marks the children of a node that are lights.
const LIGHT: u32 = 1 << 31;
/// A place where nothing is.
const NOWHERE: u32 = u32::MAX;

/// Bounds of eight children, each a light or another node.
#[derive(Clone, Debug)]
struct Node {
    bounds: Eight,
    /// A light with [`LIGHT`] set, or a node.
    children: [u32; EIGHT],
    /// Node and slot of this node, as `8 node + slot`; [`NOWHERE`] for the root.
    parent: u32,
}

/// Lights with places, in a tree. Building does not depend on the number of threads.
#[derive(Debug)]
pub(super) struct LightTree {
    nodes: Vec<Node>,
    /// Node and slot of each light of the scene, as `8 node + slot`, or [`NOWHERE`].
    slots: Vec<u32>,
}

impl LightTree {
    /// A tree over the given lights of a scene of `n`.
    pub(super) fn new(lights: &[(u32, LightBounds)], n: usize) -> LightTree {
        let mut tree = LightTree { nodes: Vec::with_capacity(lights.len() / 4 + 1), slots: vec![NOWHERE; n] };
        if let Some(root) = group(lights) {
            tree.add(vec![root], NOWHERE);
        }
        tree
    }

    /// Adds a node over a group, or several; returns its number.
    fn add(&mut self, mut children: Vec<Grouped>, parent: u32) -> u32 {
        // The group whose lights differ most is opened first.
        while children.len() < EIGHT {
            let worst = (0..children.len())
                .filter(|&i| children[i].parts.is_some())
                .max_by(|&a, &b| children[a].cost.total_cmp(&children[b].cost));
            let Some((a, b)) = worst.and_then(|i| children.swap_remove(i).parts.map(|p| *p)) else { break };
            children.extend([a, b]);
        }
        let index = self.nodes.len() as u32;
        self.nodes.push(Node { bounds: Eight::default(), children: [NOWHERE; EIGHT], parent });
        for (slot, child) in children.into_iter().enumerate() {
            let place = index * EIGHT as u32 + slot as u32;
            self.nodes[index as usize].bounds.set(slot, &child.bounds);
            self.nodes[index as usize].children[slot] = match child.parts {
                None => {
                    self.slots[child.light as usize] = place;
                    child.light | LIGHT
                }
                Some(parts) => self.add(vec![parts.0, parts.1], place),
            };
        }
        index
    }

    /// A light and its probability; none where nothing shines.
    pub(super) fn choose(&self, at: &LitPoint, u: f64) -> Option<(u32, f32)> {
        in_lanes(Down { tree: self, at, u })
    }

    /// Probability of that light; 0 for one that is not in the tree.
    pub(super) fn probability(&self, at: &LitPoint, light: u32) -> f32 {
        match self.slots.get(light as usize) {
            Some(&slot) if slot != NOWHERE => in_lanes(Up { tree: self, at, slot }),
            Some(_) | None => 0.0,
        }
    }
}

/// The way from the root to a light.
struct Down<'a> {
    tree: &'a LightTree,
    at: &'a LitPoint,
    u: f64,
}

impl InLanes for Down<'_> {
    type Output = Option<(u32, f32)>;
    #[inline(always)]
    fn run<R: Real>(self) -> Option<(u32, f32)> {
        let (mut node, mut u, mut probability) = (0, self.u, 1.0);
        loop {
            let Node { bounds, children, .. } = self.tree.nodes.get(node as usize)?;
            let weights = bounds.importances::<R>(self.at);
            let (slot, share, rest) = pick(&weights, weights.iter().sum(), u)?;
            probability *= share;
            u = rest;
            node = children[slot];
            if node & LIGHT != 0 {
                return Some((node & !LIGHT, probability));
            }
        }
    }
}

/// The way from a light to the root.
struct Up<'a> {
    tree: &'a LightTree,
    at: &'a LitPoint,
    slot: u32,
}

impl InLanes for Up<'_> {
    type Output = f32;
    #[inline(always)]
    fn run<R: Real>(self) -> f32 {
        let (mut place, mut probability) = (self.slot, 1.0);
        while place != NOWHERE {
            let (node, slot) = (place / EIGHT as u32, place % EIGHT as u32);
            let Node { bounds, parent, .. } = &self.tree.nodes[node as usize];
            let weights = bounds.importances::<R>(self.at);
            let own = weights[slot as usize];
            if !(own > 0.0) {
                return 0.0;
            }
            probability *= own / weights.iter().sum::<f32>();
            place = *parent;
        }
        probability
    }
}
