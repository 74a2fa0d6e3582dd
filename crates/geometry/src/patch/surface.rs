//! What is known of points of a patch.

use sparrow_math::{Vec3, vec3};

use super::{Bilinear, Kind, Patches};
use crate::bvh::gamma;
use crate::point::SurfacePoint;
use crate::ray::Hit;

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
    /// Texture coordinates at parameters of the patch.
    pub(super) fn uv(&self, prim: u32, u: f32, v: f32) -> [f32; 2] {
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
    pub(super) fn shading_normal(&self, prim: u32, u: f32, v: f32) -> Option<Vec3<f32>> {
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
    pub(super) fn oriented(&self, n: Vec3<f64>, shading: Option<Vec3<f32>>) -> Vec3<f32> {
        let n = n.to_f32();
        let n = if self.flip { -n } else { n };
        shading.map_or(n, |ns| n.facing(ns))
    }
    /// Bound of the rounding error of a point, which covers what a parallelogram is taken to be flat.
    pub(super) fn p_error([a, b, c, d]: [Vec3<f32>; 4]) -> Vec3<f32> {
        a.abs().max(b.abs()).max(c.abs().max(d.abs())) * gamma(6)
    }

    /// Derivatives of the patch's own parameters by the texture coordinates: `[[duds, dvds], [dudt, dvdt]]`.
    ///
    /// Each entry of the inverse is inverted by itself, not the matrix: so does pbrt-v4.
    fn inverse_textures(&self, prim: u32, u: f32, v: f32) -> [[f32; 2]; 2] {
        let (st_u, st_v) = lerp2_derivatives(self.texture_corners(prim), u, v);
        let inv = |d: f32| if d.abs() < 1e-8 { 0.0 } else { 1.0 / d };
        [[inv(st_u.x), inv(st_v.x)], [inv(st_u.y), inv(st_v.y)]]
    }

    /// The surface at a hit; meanings as in pbrt-v4.
    pub(crate) fn surface(&self, hit: &Hit) -> SurfacePoint {
        let (prim, u, v) = (hit.prim, hit.u, hit.v);
        let p = self.corners(prim);
        let (du, dv) = lerp2_derivatives(p, u, v);
        let (mut dpdu, mut dpdv) = (du, dv);
        if !self.mesh.uv.is_empty() {
            let [[duds, dvds], [dudt, dvdt]] = self.inverse_textures(prim, u, v);
            let (dpds, mut dpdt) = (du * duds + dv * dvds, du * dudt + dv * dvdt);
            let turned = dpds.cross(dpdt);
            if turned.length2() > 0.0 {
                dpdt = if du.cross(dv).dot(turned) < 0.0 { -dpdt } else { dpdt };
                (dpdu, dpdv) = (dpds, dpdt);
            }
        }
        let shading = self.shading_normal(prim, u, v);
        let ng = self.oriented(Bilinear::new(p).normal(u.into(), v.into()), shading);
        let ns = shading.unwrap_or(ng);
        let mut tangent = dpdu;
        if shading.is_some() {
            let t = rotated(dpdu, ng, ns);
            tangent = t - ns * ns.dot(t);
        }
        SurfacePoint {
            p: lerp2(p, u, v),
            p_error: Self::p_error(p),
            ng,
            ns,
            dpdu,
            dpdv,
            uv: self.uv(prim, u, v),
            tangent,
            shape: hit.shape,
            prim,
        }
    }

    /// Derivatives of the shading normal by the texture coordinates.
    pub(crate) fn normal_derivatives(&self, hit: &Hit) -> (Vec3<f32>, Vec3<f32>) {
        let (prim, u, v) = (hit.prim, hit.u, hit.v);
        if self.shading_normal(prim, u, v).is_some() {
            return lerp2_derivatives(self.normal_corners(prim), u, v);
        }
        let (du, dv) = match self.kinds[prim as usize] {
            Kind::Curved => self.bilinear(prim).normal_derivatives(u.into(), v.into()),
            Kind::Rectangle | Kind::Parallelogram | Kind::Dropped => Default::default(),
        };
        if self.mesh.uv.is_empty() {
            return (du, dv);
        }
        let [[duds, dvds], [dudt, dvdt]] = self.inverse_textures(prim, u, v);
        (du * duds + dv * dvds, du * dudt + dv * dvdt)
    }
}
