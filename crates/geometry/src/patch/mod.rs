//! Bilinear patches: corners, surface, and drawing points.

mod bilinear;
mod deforming;
mod flat;
mod sampling;
mod surface;

use bilinear::Bilinear;
pub(crate) use deforming::DeformingPatches;
use flat::Flat;
use sparrow_math::{Aabb, Vec3};

use crate::bvh::RawHit;
use crate::ray::Ray;
use crate::shape::BilinearMesh;

/// How a patch is treated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// It cannot be hit.
    Dropped,
    /// A parallelogram, and its number among them; intersected as two triangles.
    Flat(u32),
    /// Anything else.
    Curved,
}

/// What the tree knows of a primitive: all of it, or one of the two triangles of a parallelogram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Whole = 0,
    First = 1,
    Second = 2,
}

impl Part {
    /// Parameters of the primitive for those that the tree found.
    #[inline(always)]
    pub(crate) fn parameters(self, u: f32, v: f32) -> [f32; 2] {
        // Which of the three it is cannot be foreseen: values are looked up, and no way is chosen.
        const WHICH: [[usize; 2]; 3] = [[0, 1], [4, 3], [2, 4]];
        let values = [u, v, u.min(1.0), v.min(1.0), (u + v).min(1.0)];
        WHICH[self as usize].map(|i| values[i])
    }
}

/// A mesh of patches ready to be asked.
///
/// In the tree a patch has two numbers, `2 prim` and `2 prim + 1`, for the two triangles of a parallelogram; only
/// the first is used for others.
#[derive(Debug)]
pub(crate) struct Patches {
    mesh: BilinearMesh,
    kinds: Vec<Kind>,
    flats: Vec<Flat>,
    flip: bool,
}

impl Patches {
    /// Takes a mesh; lists of a length that does not fit are dropped.
    pub(crate) fn new(mut mesh: BilinearMesh, flip: bool) -> Patches {
        if mesh.n.len() != mesh.p.len() {
            mesh.n = Vec::new();
        }
        if mesh.uv.len() != mesh.p.len() {
            mesh.uv = Vec::new();
        }
        let mut flats = Vec::new();
        let kind = |at: &[u32; 4]| {
            let mut p = [Vec3::splat(0.0); 4];
            for (p, &i) in p.iter_mut().zip(at) {
                match mesh.p.get(i as usize) {
                    Some(&v) => *p = Vec3::from(v),
                    None => return Kind::Dropped,
                }
            }
            if !is_usable(p) {
                return Kind::Dropped;
            }
            if !is_flat(p) {
                return Kind::Curved;
            }
            flats.push(Flat::new(p, flip));
            Kind::Flat(flats.len() as u32 - 1)
        };
        let kinds = mesh.indices.iter().map(kind).collect();
        Patches { mesh, kinds, flats, flip }
    }
    pub(crate) fn len(&self) -> usize {
        self.kinds.len()
    }
    pub(crate) fn bytes(&self) -> usize {
        let m = &self.mesh;
        12 * (m.p.len() + m.n.len()) + 8 * m.uv.len() + 24 * m.indices.len() + size_of_val(&*self.flats)
    }
    fn corners(&self, prim: u32) -> [Vec3<f32>; 4] {
        let [a, b, c, d] = self.mesh.indices[prim as usize];
        let p = |i: u32| Vec3::from(self.mesh.p[i as usize]);
        [p(a), p(b), p(c), p(d)]
    }
    fn bilinear(&self, prim: u32) -> Bilinear {
        Bilinear::new(self.corners(prim))
    }
    /// What the tree holds of a patch: numbers, boxes, and whether they are triangles.
    pub(crate) fn parts(&self, prim: u32) -> Vec<(u32, Aabb, bool)> {
        let around = |p: &[Vec3<f32>]| p.iter().fold(Aabb::EMPTY, |b, p| b.grow(*p));
        match self.kinds[prim as usize] {
            Kind::Dropped => Vec::new(),
            Kind::Curved => vec![(2 * prim, around(&self.corners(prim)), true)],
            Kind::Flat(_) => (2 * prim..=2 * prim + 1)
                .map(|id| (id, around(&self.triangle(id).map(Vec3::from)), false))
                .collect(),
        }
    }
    /// The box of the patch of which the tree has number `id`.
    pub(crate) fn bounds(&self, id: u32) -> Aabb {
        self.corners(id / 2).into_iter().fold(Aabb::EMPTY, Aabb::grow)
    }
    /// The corners of one of the two triangles of a parallelogram.
    pub(crate) fn triangle(&self, id: u32) -> [[f32; 3]; 3] {
        let at = self.mesh.indices[(id / 2) as usize];
        let p = |i: usize| self.mesh.p[at[i] as usize];
        if id.is_multiple_of(2) { [p(0), p(1), p(3)] } else { [p(0), p(3), p(2)] }
    }
    /// What a number of the tree is of its patch.
    pub(crate) fn part(&self, id: u32) -> Part {
        match self.kinds[(id / 2) as usize] {
            Kind::Curved | Kind::Dropped => Part::Whole,
            Kind::Flat(_) if id.is_multiple_of(2) => Part::First,
            Kind::Flat(_) => Part::Second,
        }
    }
    /// Offers the points of the ray on a curved patch; returns the last limit.
    pub(crate) fn hit(
        &self,
        raw_id: u32,
        id: u32,
        ray: &Ray,
        t_max: f32,
        found: &mut impl FnMut(RawHit) -> f32,
    ) -> f32 {
        hit_bilinear(&self.bilinear(id / 2), raw_id, ray, t_max, found)
    }
}

/// Offers the points of the ray on a patch as those of number `id`; returns the last limit.
#[inline(always)]
fn hit_bilinear(
    patch: &Bilinear,
    id: u32,
    ray: &Ray,
    t_max: f32,
    found: &mut (impl FnMut(RawHit) -> f32 + ?Sized),
) -> f32 {
    let mut limit = t_max;
    for r in patch.roots(ray.o.to_f64(), ray.d.to_f64()).into_iter().flatten() {
        let t = r.t as f32;
        if r.is_inside() && t > 0.0 && t < limit {
            limit = found(RawHit { t, id, u: r.u as f32, v: r.v as f32 });
        }
    }
    limit
}

/// The patch has an area.
fn is_usable(p: [Vec3<f32>; 4]) -> bool {
    let area = Bilinear::new(p).area();
    p.iter().all(|p| p.is_finite()) && area.is_finite() && area > 0.0
}

/// The patch is a parallelogram.
fn is_flat(p: [Vec3<f32>; 4]) -> bool {
    let [a, b, c, d] = p.map(Vec3::to_f64);
    let largest = p.iter().map(|p| p.abs().max_component()).fold(0.0, f32::max);
    // The fourth corner may miss by rounding: then two triangles err by less than the bound of a point's error.
    (a + d - b - c).abs().max_component() <= f64::from(4.0 * f32::EPSILON * largest)
}
