//! What is known of points of a patch.

use sparrow_math::{InLanes, MAX_WIDTH, Real, Vec3, in_lanes, vec3};

use super::flat::p_error;
use super::{Bilinear, Flat, Kind, Patches};
use crate::columns::{PointBlock, SurfaceColumns, SurfaceParts, Vectors, set};
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

/// A point of a patch without what the mesh says of shading and textures.
pub(super) struct Place {
    pub(super) p: Vec3<f32>,
    pub(super) p_error: Vec3<f32>,
    /// Unit normal, turned as the orientation says.
    pub(super) n: Vec3<f32>,
    /// Derivatives by the patch's own parameters.
    pub(super) du: Vec3<f32>,
    pub(super) dv: Vec3<f32>,
}

/// Points of a parallelogram, in a loop that the compiler fills lanes with.
struct Points<'a> {
    flat: &'a Flat,
    uv: &'a [[f32; MAX_WIDTH]; 2],
    p: &'a mut Vectors,
}

impl InLanes for Points<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        for k in 0..MAX_WIDTH {
            set(self.p, k, self.flat.at(self.uv[0][k], self.uv[1][k]));
        }
    }
}

impl Patches {
    /// Texture coordinates at parameters of the patch.
    #[inline]
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
    #[inline]
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
    /// Where a patch is, at parameters of it.
    #[inline(always)]
    pub(super) fn place(&self, prim: u32, u: f32, v: f32) -> Place {
        if let Kind::Flat(i) = self.kinds[prim as usize] {
            let f = &self.flats[i as usize];
            let [du, dv] = f.derivatives;
            return Place { p: f.at(u, v), p_error: f.p_error, n: f.n, du, dv };
        }
        let p = self.corners(prim);
        let (du, dv) = lerp2_derivatives(p, u, v);
        let patch = Bilinear::new(p);
        let n = patch.normal(u.into(), v.into()).to_f32();
        Place {
            p: patch.at(u.into(), v.into()).to_f32(),
            p_error: p_error(p),
            n: if self.flip { -n } else { n },
            du,
            dv,
        }
    }

    /// Derivatives of the patch's own parameters by the texture coordinates: `[[duds, dvds], [dudt, dvdt]]`.
    ///
    /// Each entry of the inverse is inverted by itself, not the matrix: so does pbrt-v4.
    fn inverse_textures(&self, prim: u32, u: f32, v: f32) -> [[f32; 2]; 2] {
        let (st_u, st_v) = lerp2_derivatives(self.texture_corners(prim), u, v);
        let inv = |d: f32| if d.abs() < 1e-8 { 0.0 } else { 1.0 / d };
        [[inv(st_u.x), inv(st_v.x)], [inv(st_u.y), inv(st_v.y)]]
    }

    /// The parallelogram that a patch is, where the mesh says nothing of shading and textures.
    #[inline(always)]
    fn plain(&self, prim: u32) -> Option<&Flat> {
        match self.kinds[prim as usize] {
            Kind::Flat(i) if self.mesh.n.is_empty() && self.mesh.uv.is_empty() => {
                Some(&self.flats[i as usize])
            }
            Kind::Flat(_) | Kind::Curved | Kind::Dropped => None,
        }
    }

    /// The surface at a hit; meanings as in pbrt-v4.
    #[inline(always)]
    pub(crate) fn surface(&self, hit: &Hit) -> SurfacePoint {
        match self.plain(hit.prim) {
            Some(flat) => flat.surface(hit),
            None => self.surface_of_any(hit),
        }
    }
    /// The same, to place `k` of a block.
    #[inline(always)]
    pub(crate) fn put(&self, hit: &Hit, k: usize, block: &mut PointBlock, parts: SurfaceParts) {
        match self.plain(hit.prim) {
            Some(flat) => block.put(k, &flat.surface(hit), parts),
            None => block.put(k, &self.surface_of_any(hit), parts),
        }
    }
    /// A patch is a parallelogram of whose points shading and textures say nothing.
    #[inline(always)]
    pub(crate) fn is_plain(&self, prim: u32) -> bool {
        self.plain(prim).is_some()
    }
    /// The surface at points of such a patch, given its parameters, to places from `first` on; nothing on others.
    pub(crate) fn surface_many(
        &self,
        prim: u32,
        uv: &[[f32; MAX_WIDTH]; 2],
        first: usize,
        (out, parts): (&mut SurfaceColumns<'_>, SurfaceParts),
    ) {
        if let Some(flat) = self.plain(prim) {
            let mut p = Vectors::default();
            in_lanes(Points { flat, uv, p: &mut p });
            let one = flat.surface(&Hit { t: 0.0, shape: 0, prim, u: 0.0, v: 0.0, instance: None });
            out.write_flat(first, &one, (&p, uv), parts);
        }
    }
    fn surface_of_any(&self, hit: &Hit) -> SurfacePoint {
        let (prim, u, v) = (hit.prim, hit.u, hit.v);
        let Place { p, p_error, n, du, dv } = self.place(prim, u, v);
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
        let ng = shading.map_or(n, |ns| n.facing(ns));
        let ns = shading.unwrap_or(ng);
        let mut tangent = dpdu;
        if shading.is_some() {
            let t = rotated(dpdu, ng, ns);
            tangent = t - ns * ns.dot(t);
        }
        SurfacePoint {
            p,
            p_error,
            ng,
            ns,
            dpdu,
            dpdv,
            uv: self.uv(prim, u, v),
            time: 0.0,
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
            Kind::Flat(_) | Kind::Dropped => Default::default(),
        };
        if self.mesh.uv.is_empty() {
            return (du, dv);
        }
        let [[duds, dvds], [dudt, dvdt]] = self.inverse_textures(prim, u, v);
        (du * duds + dv * dvds, du * dudt + dv * dvdt)
    }
}
