//! Surface points of many hits, in columns: [`SurfaceColumns`].

use sparrow_math::Vec3;

use crate::point::SurfacePoint;

/// What is asked of surface points beyond place, normals and tangent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SurfaceParts {
    /// Texture coordinates.
    pub uv: bool,
    /// Derivatives of the point by the texture coordinates.
    pub derivatives: bool,
}

/// Surface points, number by number; meanings as in [`SurfacePoint`]. Columns that are written have a place for each point, up to a
/// multiple of [`MAX_WIDTH`](sparrow_math::MAX_WIDTH); what stands beyond the last point is lost.
#[derive(Debug)]
pub struct SurfaceColumns<'a> {
    /// Points.
    pub p: [&'a mut [f32]; 3],
    /// Bounds of their rounding errors.
    pub p_error: [&'a mut [f32]; 3],
    /// Unit geometric normals.
    pub ng: [&'a mut [f32]; 3],
    /// Unit shading normals.
    pub ns: [&'a mut [f32]; 3],
    /// Shading tangents.
    pub tangent: [&'a mut [f32]; 3],
    /// Derivatives by the first texture coordinate; written only where [`SurfaceParts::derivatives`] says so.
    pub dpdu: [&'a mut [f32]; 3],
    /// Derivatives by the second; likewise.
    pub dpdv: [&'a mut [f32]; 3],
    /// Texture coordinates; written only where [`SurfaceParts::uv`] says so.
    pub uv: [&'a mut [f32]; 2],
}

/// Writes a vector to place `k`.
#[inline(always)]
fn put([x, y, z]: &mut [&mut [f32]; 3], k: usize, v: Vec3<f32>) {
    (x[k], y[k], z[k]) = (v.x, v.y, v.z);
}

impl SurfaceColumns<'_> {
    /// Writes a point to place `k`.
    #[inline]
    pub(crate) fn put(&mut self, k: usize, s: &SurfacePoint, parts: SurfaceParts) {
        put(&mut self.p, k, s.p);
        put(&mut self.p_error, k, s.p_error);
        put(&mut self.ng, k, s.ng);
        put(&mut self.ns, k, s.ns);
        put(&mut self.tangent, k, s.tangent);
        if parts.derivatives {
            put(&mut self.dpdu, k, s.dpdu);
            put(&mut self.dpdv, k, s.dpdv);
        }
        if parts.uv {
            [self.uv[0][k], self.uv[1][k]] = s.uv;
        }
    }
}
