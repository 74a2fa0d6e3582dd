//! What is known of points of a triangle from its corners: [`Corners`].

use sparrow_math::{Frame, Vec3};

use crate::bvh::gamma;
use crate::point::SurfacePoint;
use crate::ray::Hit;

/// The corners of a triangle, with what they carry.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners {
    pub(super) p: [Vec3<f32>; 3],
    /// Shading normals.
    pub(super) n: Option<[Vec3<f32>; 3]>,
    /// Shading tangents.
    pub(super) s: Option<[Vec3<f32>; 3]>,
    /// Texture coordinates.
    pub(super) uv: [[f32; 2]; 3],
}

/// The weighted sum of three vectors.
#[inline(always)]
pub(super) fn mix(b: [f32; 3], p: [Vec3<f32>; 3]) -> Vec3<f32> {
    p[0] * b[0] + p[1] * b[1] + p[2] * b[2]
}

/// `a b - c d`, where the two sides may cancel.
#[inline(always)]
fn difference(a: f32, b: Vec3<f32>, c: f32, d: Vec3<f32>) -> Vec3<f32> {
    b * a - d * c
}

/// Twice the area, times the unit normal; exact enough for slivers.
#[inline(always)]
pub(super) fn double_area(p: [Vec3<f32>; 3]) -> Vec3<f64> {
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

impl Corners {
    /// The interpolated shading normal, where the mesh has one.
    #[inline(always)]
    pub(super) fn shading_normal(&self, b: [f32; 3]) -> Option<Vec3<f32>> {
        let n = mix(b, self.n?);
        (n.length2() > 0.0).then(|| n.normalized())
    }
    /// The geometric normal, on the side of the shading normal or as the orientation says.
    #[inline(always)]
    pub(super) fn normal(&self, ns: Option<Vec3<f32>>, flip: bool) -> Vec3<f32> {
        let n = double_area(self.p).normalized().to_f32();
        let n = if flip { -n } else { n };
        ns.map_or(n, |ns| n.facing(ns))
    }

    /// The surface at a hit; meanings as in pbrt-v4.
    #[inline(always)]
    pub(super) fn surface(&self, flip: bool, hit: &Hit) -> SurfacePoint {
        let p = self.p;
        let b = [1.0 - hit.u - hit.v, hit.u, hit.v];
        let map = Parametrisation::new(self.uv);
        let (mut dpdu, mut dpdv) = map.derivatives(p);
        let skew = dpdu.cross(dpdv).length2();
        if map.is_degenerate() || skew == 0.0 || !skew.is_finite() {
            let frame = Frame::from_z(-double_area(p).normalized().to_f32());
            (dpdu, dpdv) = (frame.x, frame.y);
        }
        let shading = self.shading_normal(b);
        let ng = self.normal(shading, flip);
        let ns = shading.unwrap_or(ng);
        let mut tangent = dpdu;
        if let Some(s) = self.s {
            let s = mix(b, s);
            tangent = if s.length2() > 0.0 { s } else { dpdu };
        }
        if shading.is_some() || self.s.is_some() {
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
    pub(super) fn normal_derivatives(&self) -> (Vec3<f32>, Vec3<f32>) {
        let zero = Vec3::splat(0.0);
        let Some(n) = self.n else { return (zero, zero) };
        let map = Parametrisation::new(self.uv);
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
}
