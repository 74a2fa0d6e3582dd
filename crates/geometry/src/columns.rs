//! Surface points of many hits, in columns: [`SurfaceColumns`].

use sparrow_math::{MAX_WIDTH, Vec3, vec3};

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

/// A vector for each of so many points as fill the widest registers, axis by axis.
pub(crate) type Vectors = [[f32; MAX_WIDTH]; 3];

/// Writes a vector to place `k`.
#[inline(always)]
pub(crate) fn set(to: &mut Vectors, k: usize, v: Vec3<f32>) {
    [to[0][k], to[1][k], to[2][k]] = v.to_array();
}
/// The vector in place `k`.
#[inline(always)]
pub(crate) fn get(from: &Vectors, k: usize) -> Vec3<f32> {
    vec3(from[0][k], from[1][k], from[2][k])
}

/// Points side by side, on their way to the columns.
#[derive(Default)]
pub(crate) struct PointBlock {
    pub(crate) p: Vectors,
    pub(crate) p_error: Vectors,
    pub(crate) ng: Vectors,
    pub(crate) ns: Vectors,
    pub(crate) tangent: Vectors,
    dpdu: Vectors,
    dpdv: Vectors,
    uv: [[f32; MAX_WIDTH]; 2],
}

impl PointBlock {
    /// Writes a point to place `k`, which is taken modulo the number of places.
    #[inline(always)]
    pub(crate) fn put(&mut self, k: usize, s: &SurfacePoint, parts: SurfaceParts) {
        let k = k % MAX_WIDTH;
        set(&mut self.p, k, s.p);
        set(&mut self.p_error, k, s.p_error);
        set(&mut self.ng, k, s.ng);
        set(&mut self.ns, k, s.ns);
        set(&mut self.tangent, k, s.tangent);
        if parts.derivatives {
            set(&mut self.dpdu, k, s.dpdu);
            set(&mut self.dpdv, k, s.dpdv);
        }
        if parts.uv {
            [self.uv[0][k], self.uv[1][k]] = s.uv;
        }
    }
}

/// Writes the same vector to whole registers from `first` on.
#[inline(always)]
fn fill(to: &mut [&mut [f32]; 3], first: usize, v: Vec3<f32>) {
    for (to, x) in to.iter_mut().zip(v.to_array()) {
        to[first..first + MAX_WIDTH].fill(x);
    }
}
/// Writes whole registers to places from `first` on.
#[inline(always)]
fn copy<const N: usize>(to: &mut [&mut [f32]; N], first: usize, from: &[[f32; MAX_WIDTH]; N]) {
    for (to, from) in to.iter_mut().zip(from) {
        to[first..first + MAX_WIDTH].copy_from_slice(from);
    }
}

impl SurfaceColumns<'_> {
    /// Writes a block to places from `first` on.
    pub(crate) fn write(&mut self, first: usize, block: &PointBlock, parts: SurfaceParts) {
        copy(&mut self.p, first, &block.p);
        copy(&mut self.p_error, first, &block.p_error);
        copy(&mut self.ng, first, &block.ng);
        copy(&mut self.ns, first, &block.ns);
        copy(&mut self.tangent, first, &block.tangent);
        if parts.derivatives {
            copy(&mut self.dpdu, first, &block.dpdu);
            copy(&mut self.dpdv, first, &block.dpdv);
        }
        if parts.uv {
            copy(&mut self.uv, first, &block.uv);
        }
    }
    /// Writes points of a plane to as many places from `first` on: where they are, their texture coordinates, and all else as at `one`.
    pub(crate) fn write_flat(
        &mut self,
        first: usize,
        one: &SurfacePoint,
        (p, uv): (&Vectors, &[[f32; MAX_WIDTH]; 2]),
        parts: SurfaceParts,
    ) {
        copy(&mut self.p, first, p);
        fill(&mut self.p_error, first, one.p_error);
        fill(&mut self.ng, first, one.ng);
        fill(&mut self.ns, first, one.ns);
        fill(&mut self.tangent, first, one.tangent);
        if parts.derivatives {
            fill(&mut self.dpdu, first, one.dpdu);
            fill(&mut self.dpdv, first, one.dpdv);
        }
        if parts.uv {
            copy(&mut self.uv, first, uv);
        }
    }
}
