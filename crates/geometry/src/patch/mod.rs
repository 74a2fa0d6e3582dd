//! Bilinear patches: corners, surface, and drawing points.

mod bilinear;
mod sampling;

use bilinear::Bilinear;
use sparrow_math::{Aabb, Vec3, vec3};

use crate::bvh::{RawHit, gamma};
use crate::point::SurfacePoint;
use crate::ray::{Hit, Ray};
use crate::shape::BilinearMesh;

/// How a patch is treated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// It cannot be hit.
    Dropped,
    /// A parallelogram with right angles; intersected as two triangles.
    Rectangle,
    /// A parallelogram; intersected as two triangles.
    Parallelogram,
    /// Anything else.
    Curved,
}

/// A mesh of patches ready to be asked.
///
/// In the tree a patch has two numbers, `2 prim` and `2 prim + 1`, for the two triangles of a parallelogram; only
/// the first is used for others.
#[derive(Debug)]
pub(crate) struct Patches {
    mesh: BilinearMesh,
    kinds: Vec<Kind>,
    flip: bool,
}

/// Bilinear interpolation of vectors; order p00, p10, p01, p11.
#[inline]
fn lerp2(p: [Vec3<f32>; 4], u: f32, v: f32) -> Vec3<f32> {
    (p[0] * (1.0 - v) + p[2] * v) * (1.0 - u) + (p[1] * (1.0 - v) + p[3] * v) * u
}

/// Derivatives by `u` and `v` of bilinear interpolation.
#[inline]
fn lerp2_derivatives(p: [Vec3<f32>; 4], u: f32, v: f32) -> (Vec3<f32>, Vec3<f32>) {
    ((p[1] - p[0]) * (1.0 - v) + (p[3] - p[2]) * v, (p[2] - p[0]) * (1.0 - u) + (p[3] - p[1]) * u)
}

/// `v`, turned by the rotation that brings the unit vector `a` to the unit vector `b`, not opposite to it.
fn rotated(v: Vec3<f32>, a: Vec3<f32>, b: Vec3<f32>) -> Vec3<f32> {
    let axis = a.cross(b);
    let once = axis.cross(v);
    v + once + axis.cross(once) * (1.0 / (1.0 + a.dot(b)).max(1e-6))
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
        let kind = |at: &[u32; 4]| {
            let mut p = [Vec3::splat(0.0); 4];
            for (p, &i) in p.iter_mut().zip(at) {
                match mesh.p.get(i as usize) {
                    Some(&v) => *p = Vec3::from(v),
                    None => return Kind::Dropped,
                }
            }
            classify(p)
        };
        let kinds = mesh.indices.iter().map(kind).collect();
        Patches { mesh, kinds, flip }
    }
    pub(crate) fn len(&self) -> usize {
        self.kinds.len()
    }
    pub(crate) fn bytes(&self) -> usize {
        let m = &self.mesh;
        12 * (m.p.len() + m.n.len()) + 8 * m.uv.len() + 17 * m.indices.len()
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
            Kind::Rectangle | Kind::Parallelogram => (2 * prim..=2 * prim + 1)
                .map(|id| (id, around(&self.triangle(id).map(Vec3::from)), false))
                .collect(),
        }
    }
    /// The corners of one of the two triangles of a parallelogram.
    pub(crate) fn triangle(&self, id: u32) -> [[f32; 3]; 3] {
        let at = self.mesh.indices[(id / 2) as usize];
        let p = |i: usize| self.mesh.p[at[i] as usize];
        if id.is_multiple_of(2) { [p(0), p(1), p(3)] } else { [p(0), p(3), p(2)] }
    }
    /// Parameters of the patch at a point the tree found.
    pub(crate) fn parameters(&self, id: u32, raw: &RawHit) -> [f32; 2] {
        let sum = (raw.u + raw.v).min(1.0);
        match self.kinds[(id / 2) as usize] {
            Kind::Curved | Kind::Dropped => [raw.u, raw.v],
            Kind::Rectangle | Kind::Parallelogram if id.is_multiple_of(2) => [sum, raw.v.min(1.0)],
            Kind::Rectangle | Kind::Parallelogram => [raw.u.min(1.0), sum],
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
        let mut limit = t_max;
        let patch = self.bilinear(id / 2);
        for r in patch.roots(ray.o.to_f64(), ray.d.to_f64()).into_iter().flatten() {
            let t = r.t as f32;
            if r.is_inside() && t > 0.0 && t < limit {
                limit = found(RawHit { t, id: raw_id, u: r.u as f32, v: r.v as f32 });
            }
        }
        limit
    }

    /// Texture coordinates at parameters of the patch.
    fn uv(&self, prim: u32, u: f32, v: f32) -> [f32; 2] {
        if self.mesh.uv.is_empty() {
            return [u, v];
        }
        let st = lerp2(self.texture_corners(prim), u, v);
        [st.x, st.y]
    }
    /// Texture coordinates of the corners, as vectors.
    fn texture_corners(&self, prim: u32) -> [Vec3<f32>; 4] {
        let [a, b, c, d] = self.mesh.indices[prim as usize];
        let uv = |i: u32| {
            let [s, t] = self.mesh.uv[i as usize];
            vec3(s, t, 0.0)
        };
        [uv(a), uv(b), uv(c), uv(d)]
    }
    /// The interpolated shading normal, where the mesh has one.
    fn shading_normal(&self, prim: u32, u: f32, v: f32) -> Option<Vec3<f32>> {
        if self.mesh.n.is_empty() {
            return None;
        }
        let n = lerp2(self.normal_corners(prim), u, v);
        (n.length2() > 0.0).then(|| n.normalized())
    }
    fn normal_corners(&self, prim: u32) -> [Vec3<f32>; 4] {
        let [a, b, c, d] = self.mesh.indices[prim as usize];
        let n = |i: u32| Vec3::from(self.mesh.n[i as usize]);
        [n(a), n(b), n(c), n(d)]
    }
    /// A unit normal of the bilinear surface, turned to the side of the shading normal or as the orientation says.
    fn oriented(&self, n: Vec3<f64>, shading: Option<Vec3<f32>>) -> Vec3<f32> {
        let n = n.to_f32();
        let n = if self.flip { -n } else { n };
        shading.map_or(n, |ns| n.facing(ns))
    }
    /// Bound of the rounding error of a point, which covers what a parallelogram is taken to be flat.
    fn p_error([a, b, c, d]: [Vec3<f32>; 4]) -> Vec3<f32> {
        a.abs().max(b.abs()).max(c.abs().max(d.abs())) * gamma(6)
    }

    /// The surface at a hit; meanings as in pbrt-v4.
    pub(crate) fn surface(&self, hit: &Hit) -> SurfacePoint {
        let (prim, u, v) = (hit.prim, hit.u, hit.v);
        let p = self.corners(prim);
        let (du, dv) = lerp2_derivatives(p, u, v);
        let (u64, v64, patch) = (f64::from(u), f64::from(v), Bilinear::new(p));
        let (nu, nv) = match self.kinds[prim as usize] {
            Kind::Curved => patch.normal_derivatives(u64, v64),
            Kind::Rectangle | Kind::Parallelogram | Kind::Dropped => Default::default(),
        };
        let (mut dpdu, mut dpdv, mut dndu, mut dndv) = (du, dv, nu, nv);
        if !self.mesh.uv.is_empty() {
            let (st_u, st_v) = lerp2_derivatives(self.texture_corners(prim), u, v);
            // Each entry is inverted by itself, not the matrix: so does pbrt-v4.
            let inv = |d: f32| if d.abs() < 1e-8 { 0.0 } else { 1.0 / d };
            let (duds, dvds, dudt, dvdt) = (inv(st_u.x), inv(st_v.x), inv(st_u.y), inv(st_v.y));
            let (dpds, mut dpdt) = (du * duds + dv * dvds, du * dudt + dv * dvdt);
            let turned = dpds.cross(dpdt);
            if turned.length2() > 0.0 {
                dpdt = if du.cross(dv).dot(turned) < 0.0 { -dpdt } else { dpdt };
                (dpdu, dpdv) = (dpds, dpdt);
            }
            (dndu, dndv) = (nu * duds + nv * dvds, nu * dudt + nv * dvdt);
        }
        let shading = self.shading_normal(prim, u, v);
        let ng = self.oriented(patch.normal(u64, v64), shading);
        let ns = shading.unwrap_or(ng);
        let mut tangent = dpdu;
        if shading.is_some() {
            let t = rotated(dpdu, ng, ns);
            tangent = t - ns * ns.dot(t);
            (dndu, dndv) = lerp2_derivatives(self.normal_corners(prim), u, v);
        }
        SurfacePoint {
            p: lerp2(p, u, v),
            p_error: Self::p_error(p),
            ng,
            ns,
            dpdu,
            dpdv,
            dndu,
            dndv,
            uv: self.uv(prim, u, v),
            tangent,
            shape: hit.shape,
            prim,
        }
    }
}

/// Looks at the corners of a patch.
fn classify(p: [Vec3<f32>; 4]) -> Kind {
    let patch = Bilinear::new(p);
    let area = patch.area();
    if !p.iter().all(|p| p.is_finite()) || !area.is_finite() || area <= 0.0 {
        return Kind::Dropped;
    }
    let [a, b, c, d] = p.map(Vec3::to_f64);
    let largest = p.iter().map(|p| p.abs().max_component()).fold(0.0, f32::max);
    // The fourth corner may miss by rounding: then two triangles err by less than the bound of a point's error.
    if (a + d - b - c).abs().max_component() > f64::from(4.0 * f32::EPSILON * largest) {
        return Kind::Curved;
    }
    let (e, f) = (b - a, c - a);
    let right = e.dot(f).abs() <= 1e-5 * e.length() * f.length();
    if right { Kind::Rectangle } else { Kind::Parallelogram }
}
