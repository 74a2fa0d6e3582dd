//! Shapes ready to be asked, of all kinds in one list: [`Bodies`].

use rayon::prelude::*;
use sparrow_math::{Aabb, Vec3};

use super::BuildBytes;
use crate::bvh::{Ball, Kind, MAX_PRIMS, Others, Owner, PrimRef, RAYS, RawHit};
use crate::curve::{Curves, DeformingCurves};
use crate::deforming::Deforming;
use crate::instance::padded;
use crate::patch::{DeformingPatches, Part, Patches};
use crate::progress::Progress;
use crate::quadric::Quadric;
use crate::ray::{Hit, Ray};
use crate::shape::{Shape, ShapeInstance};
use crate::triangle::{DeformingTriangles, Triangles};

/// A shape ready to be asked.
#[derive(Debug)]
pub(super) enum Body {
    Triangles(Triangles),
    Patches(Patches),
    Curves(Curves),
    /// `None` where nothing of it can be hit.
    Quadric(Option<Box<Quadric>>),
    /// Any of the first three whose points move.
    Deforming(Box<Deforming>),
}

impl Body {
    pub(super) fn new(s: ShapeInstance, progress: &Progress) -> Body {
        let (flip, deforming) = (s.flip_normal, |d: Deforming| Body::Deforming(Box::new(d)));
        match s.shape {
            Shape::Triangles(m) if m.deforms() => {
                deforming(Deforming::Triangles(DeformingTriangles::new(m, flip, progress)))
            }
            Shape::Patches(m) if m.deforms() => {
                deforming(Deforming::Patches(DeformingPatches::new(m, flip, progress)))
            }
            Shape::Curves(c) if c.deforms() => {
                deforming(Deforming::Curves(DeformingCurves::new(c, progress)))
            }
            Shape::Triangles(m) => Body::Triangles(Triangles::new(m, flip)),
            Shape::Patches(m) => Body::Patches(Patches::new(m, flip)),
            Shape::Curves(c) => Body::Curves(Curves::new(c, progress)),
            quadric @ (Shape::Sphere { .. } | Shape::Disk { .. } | Shape::Cylinder { .. }) => {
                Body::Quadric(Quadric::new(&quadric, &s.to_world, flip).map(Box::new))
            }
        }
    }
    pub(super) fn n_prims(&self) -> usize {
        match self {
            Body::Triangles(m) => m.len(),
            Body::Patches(m) => m.len(),
            Body::Curves(c) => c.len(),
            Body::Quadric(_) => 1,
            Body::Deforming(d) => d.len(),
        }
    }
    /// Numbers the tree sets aside.
    fn n_ids(&self) -> usize {
        match self {
            Body::Triangles(m) => m.len(),
            Body::Patches(m) => 2 * m.len(),
            Body::Curves(c) => c.n_ids(),
            Body::Quadric(_) => 1,
            Body::Deforming(d) => d.len(),
        }
    }
    /// Adds the memory of the shape to what it belongs to.
    pub(super) fn add_bytes(&self, to: &mut BuildBytes) {
        match self {
            Body::Triangles(m) => to.triangles += m.bytes(),
            Body::Patches(m) => to.patches += m.bytes(),
            Body::Curves(c) => {
                to.curves += c.bytes();
                to.hierarchy += c.tree_bytes();
            }
            Body::Quadric(_) => to.quadrics += size_of::<Quadric>(),
            Body::Deforming(d) => d.add_bytes(to),
        }
    }
    /// Nodes of a hierarchy of its own.
    pub(super) fn n_nodes(&self) -> usize {
        match self {
            Body::Deforming(d) => d.n_nodes(),
            Body::Triangles(_) | Body::Patches(_) | Body::Curves(_) | Body::Quadric(_) => 0,
        }
    }
    /// What the tree holds of this shape, numbered from `first`; and how many of its primitives that leaves out.
    fn refs(&self, first: u32, out: &mut Vec<PrimRef>) -> usize {
        let before = out.len();
        match self {
            Body::Triangles(m) => {
                let one = |i: u32| {
                    m.bounds(i).map_or(PrimRef::NONE, |b| PrimRef::new(first + i, b, Kind::Triangles))
                };
                // A list of known length is filled in place; gaps are rare.
                out.par_extend((0..m.len() as u32).into_par_iter().map(one));
                if out[before..].par_iter().any(PrimRef::is_none) {
                    out.retain(|r| !r.is_none());
                }
                m.len() - (out.len() - before)
            }
            Body::Patches(m) => {
                let mut dropped = 0;
                for i in 0..m.len() as u32 {
                    let parts = m.parts(i);
                    dropped += usize::from(parts.is_empty());
                    out.extend(parts.iter().map(|&(id, b, other)| {
                        PrimRef::new(first + id, b, if other { Kind::Others } else { Kind::Triangles })
                    }));
                }
                dropped
            }
            Body::Curves(c) => {
                let block = |(i, &b): (usize, &Aabb)| PrimRef::new(first + i as u32, b, Kind::Others);
                out.extend(c.blocks().iter().enumerate().map(block));
                c.dropped()
            }
            Body::Quadric(Some(q)) => {
                out.push(PrimRef::new(first, q.bounds(), Kind::Others));
                0
            }
            Body::Quadric(None) => 1,
            Body::Deforming(d) => {
                let b = Some(d.bounds()).filter(|b| !b.is_empty());
                out.extend(b.and_then(|b| padded(&b, 8)).map(|b| PrimRef::new(first, b, Kind::Others)));
                if out.len() > before { d.dropped() } else { d.len() }
            }
        }
    }
}

/// The shapes, and which numbers the tree gave to each.
#[derive(Debug)]
pub(super) struct Bodies {
    pub(super) bodies: Vec<Body>,
    /// The first number of each shape.
    first: Vec<u32>,
    /// The places of all numbers where these are few, else of none.
    places: Vec<Place>,
}

/// Numbers whose places are looked up, not searched.
const LOOKED_UP: usize = 1 << 10;

/// What a number of the tree stands for.
#[derive(Clone, Copy, Debug)]
struct Place {
    shape: u32,
    /// The number within those of the shape.
    local: u32,
    prim: u32,
    part: Part,
}

impl Bodies {
    /// Numbers what the tree may hold of all shapes; gives how many numbers that takes. A shape for which there are none left
    /// gets none.
    pub(super) fn new(bodies: Vec<Body>) -> (Bodies, usize) {
        let mut next = 0;
        let number = |b: &Body| {
            let first = next;
            if next + b.n_ids() <= MAX_PRIMS {
                next += b.n_ids();
            }
            first as u32
        };
        let first = bodies.iter().map(number).collect();
        let mut all = Bodies { bodies, first, places: Vec::new() };
        if next <= LOOKED_UP {
            all.places = (0..next as u32).map(|id| all.search(id)).collect();
        }
        (all, next)
    }
    /// What a tree over some of the shapes holds, and how many of their primitives that leaves out.
    pub(super) fn refs(&self, shapes: core::ops::Range<usize>) -> (Vec<PrimRef>, usize) {
        let (mut refs, mut dropped) = (Vec::new(), 0);
        for (body, &first) in self.bodies[shapes.clone()].iter().zip(&self.first[shapes]) {
            if first as usize + body.n_ids() <= MAX_PRIMS {
                dropped += body.refs(first, &mut refs);
            } else {
                dropped += body.n_prims();
            }
        }
        (refs, dropped)
    }
    /// The shape that a number of the tree belongs to, and the number within it.
    #[inline]
    fn locate(&self, id: u32) -> (u32, u32) {
        if let Some(p) = self.places.get(id as usize) {
            return (p.shape, p.local);
        }
        let shape = self.first.partition_point(|&f| f <= id) - 1;
        (shape as u32, id - self.first[shape])
    }
    fn search(&self, id: u32) -> Place {
        let (shape, local) = self.locate(id);
        let (prim, part) = match &self.bodies[shape as usize] {
            Body::Triangles(_) | Body::Curves(_) | Body::Deforming(_) => (local, Part::Whole),
            Body::Patches(m) => (local / 2, m.part(local)),
            Body::Quadric(_) => (0, Part::Whole),
        };
        Place { shape, local, prim, part }
    }
    /// What a hit on a number of the tree tells of it.
    pub(super) fn owner(&self, id: u32) -> Owner {
        let Place { shape, prim, part, .. } = self.search(id);
        Owner { shape, prim, half: [part == Part::First, part == Part::Second] }
    }
    pub(super) fn corners(&self, id: u32) -> [[f32; 3]; 3] {
        let (shape, local) = self.locate(id);
        match &self.bodies[shape as usize] {
            Body::Triangles(m) => m.raw_corners(local),
            Body::Patches(m) => m.triangle(local),
            Body::Curves(_) | Body::Quadric(_) | Body::Deforming(_) => [[f32::NAN; 3]; 3],
        }
    }
    /// A ball that holds a primitive, which is not a triangle; `None` where the points that a ray is offered of it depend on
    /// where the ray ends.
    pub(super) fn ball(&self, id: u32) -> Option<Ball> {
        let (shape, local) = self.locate(id);
        let around = |b: Aabb| {
            let center = ((b.lo + b.hi) * 0.5).to_array();
            Ball { center, radius: 0.5 * b.extent().length(), whole: false }
        };
        match &self.bodies[shape as usize] {
            Body::Patches(m) => Some(around(m.bounds(local))),
            Body::Quadric(q) => q.as_ref().map(|q| q.whole().unwrap_or_else(|| around(q.bounds()))),
            Body::Triangles(_) | Body::Curves(_) | Body::Deforming(_) => None,
        }
    }
    /// A ball around what can be hit of a shape.
    pub(super) fn ball_around(&self, shape: usize) -> Option<(Vec3<f32>, f32)> {
        if let Some(Body::Quadric(Some(q))) = self.bodies.get(shape)
            && let Some(ball) = q.whole()
        {
            return Some((ball.center.into(), ball.radius));
        }
        let (refs, _) = self.refs(shape..self.bodies.len().min(shape + 1));
        let around = refs.iter().fold(Aabb::EMPTY, |all, one| all.union(one.aabb()));
        (!around.is_empty()).then(|| (around.center(), around.radius()))
    }
    /// What the world knows of a point the tree found.
    #[inline]
    pub(super) fn to_hit(&self, raw: &RawHit) -> Hit {
        let place = self.places.get(raw.id as usize).copied();
        let Place { shape, prim, part, .. } = place.unwrap_or_else(|| self.search(raw.id));
        let [u, v] = part.parameters(raw.u, raw.v);
        Hit { t: raw.t, shape, prim, u, v, instance: None }
    }
}

impl Others for Bodies {
    fn hit(&self, id: u32, ray: &Ray, t_max: f32, found: &mut impl FnMut(RawHit) -> f32) -> f32 {
        let (shape, local) = self.locate(id);
        match &self.bodies[shape as usize] {
            Body::Patches(m) => m.hit(id, local, ray, t_max, found),
            Body::Curves(c) => c.hit(id - local, local, ray, t_max, found),
            Body::Quadric(Some(q)) => q.hit(id, ray, t_max, found),
            Body::Deforming(d) => d.hit(id - local, ray, t_max, found),
            Body::Triangles(_) | Body::Quadric(None) => t_max,
        }
    }
    #[inline(always)]
    fn roots(&self, id: u32, o: &[[f32; RAYS]; 3], d: &[[f32; RAYS]; 3]) -> Option<[[f32; RAYS]; 2]> {
        match &self.bodies[self.locate(id).0 as usize] {
            Body::Quadric(Some(q)) => q.roots(o, d),
            Body::Triangles(_)
            | Body::Patches(_)
            | Body::Curves(_)
            | Body::Quadric(None)
            | Body::Deforming(_) => None,
        }
    }
    #[inline(always)]
    fn ahead(&self, id: u32) {
        let (shape, local) = self.locate(id);
        if let Body::Curves(c) = &self.bodies[shape as usize] {
            c.ahead(local);
        }
    }
}
