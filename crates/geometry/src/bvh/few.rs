//! A tree of one node, laid out for many rays at once: [`Few`].

use sparrow_math::{Aabb, Vec3};

use super::Bvh;
use super::block::TriBlock;
use super::face::{Face, Frame, Wall};

/// Room for the primitives, of which there are fewer.
pub(crate) const MAX_PLACES: usize = 64;
/// Most triangles.
const MAX_TRIANGLES: usize = 40;

/// What a hit tells of a primitive of the tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Owner {
    pub(crate) shape: u32,
    pub(crate) prim: u32,
    /// It is the first, or the second of the two triangles of a parallelogram.
    pub(crate) half: [bool; 2],
}

/// A primitive as rows of eight numbers: the corners of a triangle, one after the other, then the bits of the shape's and the
/// primitive's numbers, and ones where it is the first or the second half of a parallelogram.
pub(crate) type Rows = [[f32; 8]; 2];

fn rows(owner: Owner, [a, b, c]: [[f32; 3]; 3]) -> Rows {
    let Owner { shape, prim, half: [first, second] } = owner;
    let which = [f32::from(u8::from(first)), f32::from(u8::from(second))];
    let [shape, prim] = [shape, prim].map(f32::from_bits);
    [[a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1]], [c[2], shape, prim, which[0], which[1], 0.0, 0.0, 0.0]]
}

/// The leaves of a tree of one node.
#[derive(Clone, Debug)]
pub(crate) struct Few {
    /// Pairs of triangles that are rectangles along the axes.
    pub(crate) walls: Vec<Wall>,
    /// Other pairs that are parallelograms.
    pub(crate) squares: Vec<Face>,
    /// The other triangles.
    pub(crate) triangles: Vec<Face>,
    pub(crate) others: Vec<Other>,
    /// All primitives, each in its place.
    pub(crate) rows: Box<[Rows; MAX_PLACES]>,
    /// Nothing lies further from the origin.
    pub(crate) radius: f32,
}

/// A primitive that is not a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Other {
    pub(crate) bounds: Aabb,
    pub(crate) id: u32,
    pub(crate) place: u32,
    pub(crate) ball: Ball,
}

/// A ball that holds a primitive; rounded to the nearest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    pub(crate) center: [f32; 3],
    pub(crate) radius: f32,
    /// It is the primitive.
    pub(crate) whole: bool,
}

/// A triangle of the tree.
#[derive(Clone, Copy)]
struct Triangle {
    id: u32,
    corners: [[f32; 3]; 3],
}

impl Triangle {
    fn exact(&self) -> [Vec3<f64>; 3] {
        self.corners.map(|c| Vec3::from(c).to_f64())
    }
    /// The corners of the parallelogram that this triangle is half of, and `other` the other half: one, that across the side which they
    /// share in this triangle and the other, and the last.
    fn square_with(&self, other: &Triangle) -> Option<[Vec3<f64>; 4]> {
        let turned = |[a, b, c]: [[f32; 3]; 3]| [[a, b, c], [b, c, a], [c, a, b]];
        let bits = |c: [f32; 3]| c.map(f32::to_bits);
        // Seen from the same side, triangles go opposite ways along the side that they share.
        let shared = |[a, b, c]: [[f32; 3]; 3]| {
            let opposite = |[d, e, _]: &[[f32; 3]; 3]| bits(a) == bits(*e) && bits(b) == bits(*d);
            turned(other.corners).into_iter().find(opposite).map(|[_, _, f]| [a, c, f, b])
        };
        let corners = turned(self.corners).into_iter().find_map(shared)?;
        let [p, q, r, across] = corners.map(|c| Vec3::from(c).to_f64());
        let largest = corners.as_flattened().iter().fold(0.0, |a: f32, x| a.max(x.abs()));
        let miss = (p + across - q - r).abs().max_component();
        (miss <= f64::from(4.0 * f32::EPSILON * largest)).then_some([p, q, r, across])
    }
}

impl Few {
    /// Takes the leaves of `bvh`. `None` where it has more than a node, or more of anything than pays; where a triangle
    /// lies in two leaves or is too narrow; or where `ball` has none to hold another primitive. Of those that have one, the points that a
    /// ray is offered must not depend on where the ray ends.
    pub(crate) fn new(
        bvh: &Bvh,
        owner: impl Fn(u32) -> Owner,
        ball: impl Fn(u32) -> Option<Ball>,
    ) -> Option<Few> {
        let [node] = &*bvh.nodes else { return None };
        let mut alone: Vec<Triangle> =
            bvh.triangles.iter().flat_map(TriBlock::triangles).map(Triangle::from).collect();
        let mut ids: Vec<u32> = alone.iter().map(|t| t.id).collect();
        ids.sort_unstable();
        if ids.len() > MAX_TRIANGLES || ids.windows(2).any(|two| two[0] == two[1]) {
            return None;
        }
        let corners = alone.iter().flat_map(|t| t.exact()).map(Vec3::length);
        let mut radius = corners.fold(0.0, f64::max);
        let mut all = Vec::new();
        let (mut walls, mut squares, mut triangles, mut others) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        while let Some(one) = alone.pop() {
            let place = all.len() as u32;
            let half = |(i, other)| Some((i, one.square_with(other)?));
            let Some((i, [p, q, r, across])) = alone.iter().enumerate().find_map(half) else {
                all.push(rows(owner(one.id), one.corners));
                triangles.push(Frame::new(one.exact(), &one.exact(), place)?.face());
                continue;
            };
            let other = alone.remove(i);
            let frame = Frame::new([p, q, r], &[p, q, r, across], place)?;
            match frame.wall() {
                Some(wall) => walls.push(wall),
                None => squares.push(frame.face()),
            }
            all.extend([one, other].map(|t| rows(owner(t.id), t.corners)));
        }
        for (i, child) in node.child.iter().enumerate().filter(|(_, c)| c.is_leaf() && c.is_others()) {
            let Some(bounds) = node.bounds_of(i) else { continue };
            let (id, place) = (child.index() as u32, all.len() as u32);
            let ball = ball(id)?;
            radius = radius.max(Vec3::from(ball.center).to_f64().length() + f64::from(ball.radius));
            all.push(rows(owner(id), [[0.0; 3]; 3]));
            others.push(Other { bounds, id, place, ball });
        }
        if all.is_empty() {
            return None;
        }
        all.resize(MAX_PLACES, [[0.0; 8]; 2]);
        let rows = all.into_boxed_slice().try_into().ok()?;
        Some(Few { walls, squares, triangles, others, rows, radius: radius as f32 * 1.001 })
    }
}

impl From<(u32, [[f32; 3]; 3])> for Triangle {
    fn from((id, corners): (u32, [[f32; 3]; 3])) -> Triangle {
        Triangle { id, corners }
    }
}
