//! Surface points of many hits, in columns: [`SurfaceColumns`].

use sparrow_math::{InLanes, MAX_WIDTH, Real, Vec3, in_lanes, vec3};

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

/// Points of a ball side by side, on their way to the columns.
#[derive(Default)]
pub(crate) struct PointBlock {
    pub(crate) p: Vectors,
    pub(crate) p_error: Vectors,
    /// Of the geometry and for shading.
    pub(crate) n: Vectors,
    pub(crate) tangent: Vectors,
}

/// Eight numbers of a point.
pub(crate) type Row = [f32; 8];

/// Points one after the other, on their way to the columns: what is known of one stands in a few rows, which lanes turn.
#[derive(Default)]
pub(crate) struct PointRows {
    /// Place and texture coordinates.
    places: [Row; MAX_WIDTH],
    /// See [`normals`].
    normals: [[Row; 2]; MAX_WIDTH],
    /// Derivatives by both texture coordinates.
    derivatives: [Row; MAX_WIDTH],
}

/// Two vectors in a row.
fn pair(a: Vec3<f32>, b: Vec3<f32>) -> Row {
    [a.x, a.y, a.z, 0.0, b.x, b.y, b.z, 0.0]
}

/// Bound of the rounding error and geometric normal, shading normal and tangent.
#[inline(always)]
pub(crate) fn normals(p_error: Vec3<f32>, ng: Vec3<f32>, ns: Vec3<f32>, tangent: Vec3<f32>) -> [Row; 2] {
    [pair(p_error, ng), pair(ns, tangent)]
}

impl PointRows {
    /// Writes a point to place `k`, which is taken modulo the number of places.
    #[inline(always)]
    pub(crate) fn put(&mut self, k: usize, s: &SurfacePoint, parts: SurfaceParts) {
        self.put_on(k, s.p, s.uv, &normals(s.p_error, s.ng, s.ns, s.tangent));
        if parts.derivatives {
            self.derivatives[k % MAX_WIDTH] = pair(s.dpdu, s.dpdv);
        }
    }
    /// The same without derivatives, where normals and tangent are known.
    #[inline(always)]
    pub(crate) fn put_on(&mut self, k: usize, p: Vec3<f32>, [u, v]: [f32; 2], normals: &[Row; 2]) {
        let k = k % MAX_WIDTH;
        self.places[k] = [p.x, p.y, p.z, u, v, 0.0, 0.0, 0.0];
        self.normals[k] = *normals;
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
    /// Writes points of a ball to places from `first` on.
    pub(crate) fn write(&mut self, first: usize, block: &PointBlock) {
        copy(&mut self.p, first, &block.p);
        copy(&mut self.p_error, first, &block.p_error);
        copy(&mut self.ng, first, &block.n);
        copy(&mut self.ns, first, &block.n);
        copy(&mut self.tangent, first, &block.tangent);
    }
    /// Writes points to places from `first` on.
    pub(crate) fn turn(&mut self, first: usize, rows: &PointRows, parts: SurfaceParts) {
        in_lanes(Turn { rows, parts, first, to: self });
    }
}

/// The places of lanes among themselves.
const LANES: [u32; MAX_WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

struct Turn<'a, 'b> {
    rows: &'a PointRows,
    parts: SurfaceParts,
    first: usize,
    to: &'a mut SurfaceColumns<'b>,
}

impl InLanes for Turn<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Turn { rows, parts, first, to } = self;
        let normals = rows.normals.as_flattened();
        for k in (0..MAX_WIDTH).step_by(R::WIDTH) {
            let at = first + k;
            let [x, y, z, u, v, ..] = R::gather_rows(&rows.places[k..], &LANES);
            store([x, y, z], &mut to.p, at);
            let [x, y, z, _, nx, ny, nz, _] = R::gather_rows(&normals[2 * k..], &EVERY_OTHER);
            store([x, y, z], &mut to.p_error, at);
            store([nx, ny, nz], &mut to.ng, at);
            let [nx, ny, nz, _, x, y, z, _] = R::gather_rows(&normals[2 * k + 1..], &EVERY_OTHER);
            store([nx, ny, nz], &mut to.ns, at);
            store([x, y, z], &mut to.tangent, at);
            if parts.uv {
                store([u, v], &mut to.uv, at);
            }
            if parts.derivatives {
                let [x, y, z, _, a, b, c, _] = R::gather_rows(&rows.derivatives[k..], &LANES);
                store([x, y, z], &mut to.dpdu, at);
                store([a, b, c], &mut to.dpdv, at);
            }
        }
    }
}

/// Numbers of the first rows of points that have two.
const EVERY_OTHER: [u32; MAX_WIDTH] = [0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30];

#[inline(always)]
fn store<R: Real, const N: usize>(v: [R; N], to: &mut [&mut [f32]; N], at: usize) {
    for (v, to) in v.into_iter().zip(to) {
        v.store(to, at);
    }
}
