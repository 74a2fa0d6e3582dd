//! Triangle meshes: corners, surface, and drawing points.

mod corners;
mod deforming;

use corners::{Corners, double_area, mix};
pub(crate) use deforming::DeformingTriangles;
use sparrow_math::{Aabb, Vec3, warp};

use crate::bvh::gamma;
use crate::point::{ShapeSample, SurfacePoint};
use crate::ray::Hit;
use crate::sample::{Bilinear, SphericalTriangle, Viewpoint, WARPED, seen_from};
use crate::shape::TriangleMesh;
use crate::simd::prefetch;

/// Triangles are drawn by area where they fill less of the sphere than this; values of pbrt-v4.
const MIN_SOLID_ANGLE: f64 = 3e-4;
/// Or more than this.
const MAX_SOLID_ANGLE: f64 = 6.22;

/// A mesh ready to be asked.
#[derive(Debug)]
pub(crate) struct Triangles {
    mesh: TriangleMesh,
    flip: bool,
}

/// The value of a list at three places.
#[inline(always)]
fn pick(list: &[[f32; 3]], at: [u32; 3]) -> [Vec3<f32>; 3] {
    let p = |i: usize| Vec3::from(list[at[i] as usize]);
    [p(0), p(1), p(2)]
}

/// Texture coordinates of three corners; of a mesh that has none, pbrt-v4's.
#[inline(always)]
fn texture_coordinates(uv: &[[f32; 2]], at: [u32; 3]) -> [[f32; 2]; 3] {
    if uv.is_empty() {
        return [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
    }
    let uv = |i: usize| uv[at[i] as usize];
    [uv(0), uv(1), uv(2)]
}

impl Triangles {
    /// Takes a mesh; lists of a length that does not fit are dropped.
    pub(crate) fn new(mut mesh: TriangleMesh, flip: bool) -> Triangles {
        let n = mesh.p.len();
        if mesh.n.len() != n {
            mesh.n = Vec::new();
        }
        if mesh.s.len() != n {
            mesh.s = Vec::new();
        }
        if mesh.uv.len() != n {
            mesh.uv = Vec::new();
        }
        Triangles { mesh, flip }
    }
    pub(crate) fn len(&self) -> usize {
        self.mesh.indices.len()
    }
    pub(crate) fn bytes(&self) -> usize {
        let m = &self.mesh;
        12 * (m.p.len() + m.indices.len() + m.n.len() + m.s.len()) + 8 * m.uv.len()
    }
    /// The corners of a triangle that is in the tree.
    #[inline(always)]
    pub(crate) fn raw_corners(&self, prim: u32) -> [[f32; 3]; 3] {
        let at = self.mesh.indices[prim as usize];
        let p = |i: usize| self.mesh.p[at[i] as usize];
        [p(0), p(1), p(2)]
    }
    /// The box of a triangle; `None` where it cannot be hit.
    pub(crate) fn bounds(&self, prim: u32) -> Option<Aabb> {
        let p = self.usable_corners(prim)?;
        Some(p.into_iter().fold(Aabb::EMPTY, Aabb::grow))
    }
    /// The corners, if they exist, are finite and span an area.
    fn usable_corners(&self, prim: u32) -> Option<[Vec3<f32>; 3]> {
        let at = self.mesh.indices.get(prim as usize)?;
        let mut p = [Vec3::splat(0.0); 3];
        for (p, &i) in p.iter_mut().zip(at) {
            *p = Vec3::from(*self.mesh.p.get(i as usize)?);
        }
        let area = double_area(p).length2();
        (p.iter().all(|p| p.is_finite()) && area > 0.0 && area.is_finite()).then_some(p)
    }
    pub(crate) fn area(&self, prim: u32) -> f32 {
        self.usable_corners(prim).map_or(0.0, |p| (0.5 * double_area(p).length()) as f32)
    }
    /// A triangle with what its corners carry.
    #[inline(always)]
    fn with_corners(&self, prim: u32) -> Corners {
        let (m, at) = (&self.mesh, self.mesh.indices[prim as usize]);
        let of = |list: &[[f32; 3]]| (!list.is_empty()).then(|| pick(list, at));
        Corners { p: pick(&m.p, at), n: of(&m.n), s: of(&m.s), uv: texture_coordinates(&m.uv, at) }
    }
    /// Asks for the numbers of a triangle's corners ahead of their use.
    #[inline(always)]
    pub(crate) fn indices_ahead(&self, prim: u32) {
        prefetch(&self.mesh.indices, prim as usize);
    }
    /// The same for what its corners carry.
    #[inline(always)]
    pub(crate) fn corners_ahead(&self, prim: u32) {
        let m = &self.mesh;
        for i in m.indices[prim as usize].map(|i| i as usize) {
            prefetch(&m.p, i);
            prefetch(&m.n, i);
            prefetch(&m.uv, i);
        }
    }
    /// The surface at a hit; meanings as in pbrt-v4.
    #[inline]
    pub(crate) fn surface(&self, hit: &Hit) -> SurfacePoint {
        self.with_corners(hit.prim).surface(self.flip, hit)
    }
    /// Derivatives of the interpolated normal; its change of length is not taken out, as in pbrt-v4.
    pub(crate) fn normal_derivatives(&self, hit: &Hit) -> (Vec3<f32>, Vec3<f32>) {
        self.with_corners(hit.prim).normal_derivatives()
    }

    /// A point given by the weights of its corners, drawn with density `pdf` per area.
    fn sample_at(&self, prim: u32, p: [Vec3<f32>; 3], b: [f32; 3], pdf: f32) -> ShapeSample {
        let corners = self.with_corners(prim);
        ShapeSample {
            p: mix(b, p),
            p_error: mix(b.map(f32::abs), p.map(Vec3::abs)) * gamma(6),
            n: corners.normal(corners.shading_normal(b), self.flip),
            wi: Vec3::splat(0.0),
            distance: 0.0,
            pdf,
        }
    }
    pub(crate) fn sample_area(&self, prim: u32, u: [f32; 2]) -> Option<ShapeSample> {
        let p = self.usable_corners(prim)?;
        let [b0, b1] = warp::uniform_triangle(u);
        let pdf = 1.0 / (0.5 * double_area(p).length());
        Some(self.sample_at(prim, p, [b0, b1, 1.0 - b0 - b1], pdf as f32))
    }
    pub(crate) fn sample_from(&self, prim: u32, from: &Viewpoint, u: [f32; 2]) -> Option<ShapeSample> {
        let p = self.usable_corners(prim)?;
        let Some(t) = by_solid_angle(p, from.p) else {
            return seen_from(self.sample_area(prim, u)?, from.p);
        };
        let (u, density) = match follow_cosine(&t, from) {
            Some(warp) => {
                let u = warp.sample(u.map(f64::from));
                (u, warp.pdf(u))
            }
            None => (u.map(f64::from), 1.0),
        };
        let s = self.sample_at(prim, p, t.sample(u)?, 0.0);
        let pdf = (density / t.solid_angle) as f32;
        seen_from(s, from.p).map(|s| ShapeSample { pdf, ..s })
    }
    /// Density per steradian of [`sample_from`](Self::sample_from) for a direction that met the triangle at `hit_p`;
    /// `per_area` turns densities per area into it.
    pub(crate) fn pdf_from(
        &self,
        prim: u32,
        from: &Viewpoint,
        hit_p: Vec3<f32>,
        per_area: impl Fn(f64) -> f32,
    ) -> f32 {
        let Some(p) = self.usable_corners(prim) else { return 0.0 };
        let Some(t) = by_solid_angle(p, from.p) else {
            return per_area(1.0 / (0.5 * double_area(p).length()));
        };
        let wi = hit_p.to_f64() - from.p.to_f64();
        let density = follow_cosine(&t, from).map_or(1.0, |warp| warp.pdf(t.invert(wi)));
        (density / t.solid_angle) as f32
    }
}

/// The density of the unit square by which directions to a triangle follow the cosine at the viewpoint.
fn follow_cosine(t: &SphericalTriangle, from: &Viewpoint) -> Option<Bilinear<f64>> {
    let n = from.n.filter(|_| WARPED.contains(&t.solid_angle))?.to_f64();
    Some(Bilinear::of_cosines(t.square().map(|d| n.dot(d))))
}

/// The triangle on the sphere around `from`, if it is to be drawn by solid angle.
fn by_solid_angle(p: [Vec3<f32>; 3], from: Vec3<f32>) -> Option<SphericalTriangle> {
    let t = SphericalTriangle::new(p, from)?;
    (MIN_SOLID_ANGLE..=MAX_SOLID_ANGLE).contains(&t.solid_angle).then_some(t)
}
