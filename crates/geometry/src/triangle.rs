//! Triangle meshes: corners, surface, and drawing points.

use sparrow_math::{Aabb, Frame, Vec3, warp};

use crate::bvh::gamma;
use crate::point::{ShapeSample, SurfacePoint};
use crate::ray::Hit;
use crate::sample::{Bilinear, SphericalTriangle, Viewpoint, WARPED, seen_from};
use crate::shape::TriangleMesh;

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

/// The weighted sum of three vectors.
#[inline(always)]
fn mix(b: [f32; 3], p: [Vec3<f32>; 3]) -> Vec3<f32> {
    p[0] * b[0] + p[1] * b[1] + p[2] * b[2]
}

/// The value of a list at three places.
#[inline(always)]
fn pick(list: &[[f32; 3]], at: [u32; 3]) -> [Vec3<f32>; 3] {
    let p = |i: usize| Vec3::from(list[at[i] as usize]);
    [p(0), p(1), p(2)]
}

/// `a b - c d`, where the two sides may cancel.
#[inline(always)]
fn difference(a: f32, b: Vec3<f32>, c: f32, d: Vec3<f32>) -> Vec3<f32> {
    b * a - d * c
}

/// Twice the area, times the unit normal; exact enough for slivers.
#[inline(always)]
fn double_area(p: [Vec3<f32>; 3]) -> Vec3<f64> {
    let [a, b, c] = p.map(Vec3::to_f64);
    (b - a).cross(c - a)
}

/// Derivatives by texture coordinates, or what to use where these have none.
struct Parametrisation {
    uv: [[f32; 2]; 3],
    duv: [[f32; 2]; 2],
    determinant: f32,
}

impl Parametrisation {
    fn new(uv: [[f32; 2]; 3]) -> Parametrisation {
        let d = |i: usize| [uv[i][0] - uv[2][0], uv[i][1] - uv[2][1]];
        let duv = [d(0), d(1)];
        let determinant = duv[0][0] * duv[1][1] - duv[0][1] * duv[1][0];
        Parametrisation { uv, duv, determinant }
    }
    fn is_degenerate(&self) -> bool {
        self.determinant.abs() < 1e-9
    }
    /// Derivatives by u and v of what takes the values `a` at the corners.
    fn derivatives(&self, a: [Vec3<f32>; 3]) -> (Vec3<f32>, Vec3<f32>) {
        let (a0, a1) = (a[0] - a[2], a[1] - a[2]);
        let [d0, d1] = self.duv;
        let inv = 1.0 / self.determinant;
        (difference(d1[1], a0, d0[1], a1) * inv, difference(d0[0], a1, d1[0], a0) * inv)
    }
    fn at(&self, b: [f32; 3]) -> [f32; 2] {
        let of = |k: usize| b[0] * self.uv[0][k] + b[1] * self.uv[1][k] + b[2] * self.uv[2][k];
        [of(0), of(1)]
    }
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
    fn corners(&self, prim: u32) -> [Vec3<f32>; 3] {
        self.raw_corners(prim).map(Vec3::from)
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
    fn parametrisation(&self, at: [u32; 3]) -> Parametrisation {
        Parametrisation::new(if self.mesh.uv.is_empty() {
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
        } else {
            let uv = |i: usize| self.mesh.uv[at[i] as usize];
            [uv(0), uv(1), uv(2)]
        })
    }
    /// The interpolated shading normal, where the mesh has one.
    fn shading_normal(&self, at: [u32; 3], b: [f32; 3]) -> Option<Vec3<f32>> {
        if self.mesh.n.is_empty() {
            return None;
        }
        let n = mix(b, pick(&self.mesh.n, at));
        (n.length2() > 0.0).then(|| n.normalized())
    }
    /// The geometric normal, on the side of the shading normal or as the orientation says.
    fn normal(&self, p: [Vec3<f32>; 3], ns: Option<Vec3<f32>>) -> Vec3<f32> {
        let n = double_area(p).normalized().to_f32();
        let n = if self.flip { -n } else { n };
        ns.map_or(n, |ns| n.facing(ns))
    }

    /// The surface at a hit; meanings as in pbrt-v4.
    pub(crate) fn surface(&self, hit: &Hit) -> SurfacePoint {
        let at = self.mesh.indices[hit.prim as usize];
        let p = self.corners(hit.prim);
        let b = [1.0 - hit.u - hit.v, hit.u, hit.v];
        let map = self.parametrisation(at);
        let (mut dpdu, mut dpdv) = map.derivatives(p);
        let skew = dpdu.cross(dpdv).length2();
        if map.is_degenerate() || skew == 0.0 || !skew.is_finite() {
            let frame = Frame::from_z(-double_area(p).normalized().to_f32());
            (dpdu, dpdv) = (frame.x, frame.y);
        }
        let shading = self.shading_normal(at, b);
        let ng = self.normal(p, shading);
        let ns = shading.unwrap_or(ng);
        let mut tangent = dpdu;
        if !self.mesh.s.is_empty() {
            let s = mix(b, pick(&self.mesh.s, at));
            tangent = if s.length2() > 0.0 { s } else { dpdu };
        }
        if shading.is_some() || !self.mesh.s.is_empty() {
            let t = ns.cross(tangent);
            tangent = if t.length2() > 0.0 { t.cross(ns) } else { Frame::from_z(ns).x };
        }
        SurfacePoint {
            p: mix(b, p),
            p_error: mix(b.map(f32::abs), p.map(Vec3::abs)) * gamma(7),
            ng,
            ns,
            dpdu,
            dpdv,
            uv: map.at(b),
            tangent,
            shape: hit.shape,
            prim: hit.prim,
            time: 0.0,
        }
    }

    /// Derivatives of the interpolated normal; its change of length is not taken out, as in pbrt-v4.
    pub(crate) fn normal_derivatives(&self, hit: &Hit) -> (Vec3<f32>, Vec3<f32>) {
        let zero = Vec3::splat(0.0);
        if self.mesh.n.is_empty() {
            return (zero, zero);
        }
        let at = self.mesh.indices[hit.prim as usize];
        let map = self.parametrisation(at);
        let n = pick(&self.mesh.n, at);
        if !map.is_degenerate() {
            return map.derivatives(n);
        }
        let around = (n[2] - n[0]).cross(n[1] - n[0]);
        if around.length2() == 0.0 {
            return (zero, zero);
        }
        let frame = Frame::from_z(around.normalized());
        (frame.x, frame.y)
    }

    /// A point given by the weights of its corners, drawn with density `pdf` per area.
    fn sample_at(&self, prim: u32, p: [Vec3<f32>; 3], b: [f32; 3], pdf: f32) -> ShapeSample {
        let at = self.mesh.indices[prim as usize];
        ShapeSample {
            p: mix(b, p),
            p_error: mix(b.map(f32::abs), p.map(Vec3::abs)) * gamma(6),
            n: self.normal(p, self.shading_normal(at, b)),
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
