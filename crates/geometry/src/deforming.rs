//! Shapes whose points move, each in a straight line of its own: [`Deforming`].
//!
//! A ray meets the shape whose points lie where they are at the ray's time, rounded to single precision once; all that is
//! worked out from them then is what it is for a shape that stands there. In the tree over everything such a shape is one
//! primitive, with a tree of its own over the boxes of both ends of the motion. What stands still knows nothing of this.

use sparrow_math::{Aabb, Vec3};

use crate::bvh::{Others, RawHit};
use crate::curve::DeformingCurves;
use crate::geometry::BuildBytes;
use crate::patch::DeformingPatches;
use crate::point::SurfacePoint;
use crate::ray::{Hit, Ray};
use crate::triangle::DeformingTriangles;

/// Corners of a primitive at both ends of its motion, if they exist and are finite.
pub(crate) fn corners_at_ends<const N: usize>(
    points: &[&Vec<[f32; 3]>; 2],
    at: &[u32; N],
) -> Option<[[[f32; 3]; N]; 2]> {
    let mut ends = [[[0.0; 3]; N]; 2];
    for (end, list) in ends.iter_mut().zip(points) {
        for (p, &i) in end.iter_mut().zip(at) {
            *p = *list.get(i as usize)?;
        }
    }
    ends.as_flattened().as_flattened().iter().all(|v| v.is_finite()).then_some(ends)
}

/// A shape that deforms, ready to be asked.
#[derive(Debug)]
pub(crate) enum Deforming {
    Triangles(DeformingTriangles),
    Patches(DeformingPatches),
    Curves(DeformingCurves),
}

/// Asked of primitives that are not triangles where all are.
pub(crate) struct NoOthers;

impl Others for NoOthers {
    fn hit(&self, _: u32, _: &Ray, t_max: f32, _: &mut impl FnMut(RawHit) -> f32) -> f32 {
        t_max
    }
}

/// Calls one function or the other, whichever shape it is.
macro_rules! each {
    ($self:ident, $s:ident => $e:expr) => {
        match $self {
            Deforming::Triangles($s) => $e,
            Deforming::Patches($s) => $e,
            Deforming::Curves($s) => $e,
        }
    };
}

impl Deforming {
    /// Primitives.
    pub(crate) fn len(&self) -> usize {
        each!(self, s => s.len())
    }
    /// Primitives that cannot be hit.
    pub(crate) fn dropped(&self) -> usize {
        each!(self, s => s.dropped())
    }
    /// The box around all that the shape passes; empty where nothing of it can be hit.
    pub(crate) fn bounds(&self) -> Aabb {
        each!(self, s => s.tree().bounds())
    }
    pub(crate) fn n_nodes(&self) -> usize {
        each!(self, s => s.tree().n_nodes())
    }
    /// Adds the memory of the shape to what it belongs to.
    pub(crate) fn add_bytes(&self, to: &mut BuildBytes) {
        match self {
            Deforming::Triangles(m) => to.triangles += m.bytes(),
            Deforming::Patches(m) => to.patches += m.bytes(),
            Deforming::Curves(c) => to.curves += c.bytes(),
        }
        to.hierarchy += each!(self, s => s.tree().bytes());
    }
    /// Area of a primitive where motion starts.
    pub(crate) fn area(&self, prim: u32) -> f32 {
        each!(self, s => s.area(prim))
    }

    /// Offers the points of the ray on the shape, which the tree numbers from `first`; returns the last limit.
    // Compiled once, whatever waits for the hits.
    #[inline(never)]
    pub(crate) fn hit(&self, first: u32, ray: &Ray, t_max: f32, found: &mut dyn FnMut(RawHit) -> f32) -> f32 {
        let (ray, mut last) = (&Ray { t_max, ..*ray }, t_max);
        let mut found = |h: RawHit| {
            last = found(RawHit { id: first + h.id, ..h });
            last
        };
        match self {
            Deforming::Triangles(m) => m.tree().visit(ray, &NoOthers, &mut found),
            Deforming::Patches(m) => m.tree().visit(ray, m, &mut found),
            Deforming::Curves(c) => c.visit(ray, &mut found),
        }
        last
    }
    /// The surface at a hit, at the ray's time.
    pub(crate) fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        match self {
            Deforming::Triangles(m) => m.surface(ray, hit),
            Deforming::Patches(m) => m.surface(ray, hit),
            Deforming::Curves(c) => c.surface(ray, hit),
        }
    }
    /// Derivatives of the shading normal, at the ray's time.
    pub(crate) fn normal_derivatives(&self, ray: &Ray, hit: &Hit) -> (Vec3<f32>, Vec3<f32>) {
        match self {
            Deforming::Triangles(m) => m.normal_derivatives(ray, hit),
            Deforming::Patches(m) => m.normal_derivatives(ray, hit),
            Deforming::Curves(_) => Default::default(),
        }
    }
}
