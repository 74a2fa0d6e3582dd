//! [`Geometry`]: shapes with a hierarchy over them.

use sparrow_math::{Aabb, Vec3};

use crate::point::{ShapeSample, SurfacePoint};
use crate::ray::{Hit, Ray};
use crate::shape::{Shape, ShapeInstance};

/// What building cost and gave.
#[derive(Clone, Copy, Debug, Default)]
pub struct BuildStats {
    /// Primitives in the hierarchy.
    pub primitives: usize,
    /// Primitives left out: without area, with coordinates that are not finite, or with vertices that do not exist.
    pub dropped: usize,
    /// Nodes of the hierarchy.
    pub nodes: usize,
    /// Bytes held by shapes and hierarchy together.
    pub bytes: usize,
    /// Time taken, in seconds.
    pub build_seconds: f64,
}

/// Shapes with a hierarchy over them. Immutable; shared freely between threads.
#[derive(Debug)]
pub struct Geometry {
    shapes: Vec<ShapeInstance>,
    bounds: Aabb,
    stats: BuildStats,
}

impl Geometry {
    /// Builds the hierarchy, in parallel on the current rayon pool; the result does not depend on the number of threads.
    ///
    /// Primitives that cannot be hit (zero area, coordinates that are not finite, indices without a vertex)
    /// are left out and counted in [`BuildStats::dropped`]; numbering does not change.
    pub fn build(shapes: Vec<ShapeInstance>) -> Geometry {
        Geometry { shapes, bounds: Aabb::EMPTY, stats: BuildStats::default() }
    }
    /// The nearest point of the ray on any shape.
    pub fn intersect(&self, _ray: &Ray) -> Option<Hit> {
        None
    }
    /// Something lies on the ray.
    pub fn occluded(&self, _ray: &Ray) -> bool {
        false
    }
    /// The nearest point of the ray that `accept` does not reject.
    pub fn intersect_where(&self, _ray: &Ray, _accept: impl Fn(&Hit) -> bool) -> Option<Hit> {
        None
    }
    /// Something that `accept` does not reject lies on the ray.
    pub fn occluded_where(&self, _ray: &Ray, _accept: impl Fn(&Hit) -> bool) -> bool {
        false
    }
    /// The surface at `hit`, which this geometry gave for `ray`.
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let z = Vec3::splat(0.0);
        SurfacePoint {
            p: ray.at(hit.t),
            p_error: z,
            ng: z,
            ns: z,
            dpdu: z,
            dpdv: z,
            dndu: z,
            dndv: z,
            uv: [0.0; 2],
            tangent: z,
            shape: hit.shape,
            prim: hit.prim,
        }
    }
    /// Box around everything that can be hit.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }
    /// What building cost and gave.
    pub fn stats(&self) -> BuildStats {
        self.stats
    }
    /// Number of shapes.
    pub fn n_shapes(&self) -> usize {
        self.shapes.len()
    }
    /// Number of primitives of a shape.
    pub fn n_prims(&self, shape: usize) -> usize {
        match &self.shapes[shape].shape {
            Shape::Triangles(m) => m.indices.len(),
            Shape::Patches(m) => m.indices.len(),
            Shape::Sphere { .. } | Shape::Disk { .. } | Shape::Cylinder { .. } => 1,
        }
    }
    /// World-space area of a primitive; zero for one that was dropped.
    pub fn area(&self, _shape: u32, _prim: u32) -> f32 {
        0.0
    }
    /// Draws a point of a primitive, by solid angle as seen from `from`. `None` where that density does not exist.
    pub fn sample_from(
        &self,
        _shape: u32,
        _prim: u32,
        _from: Vec3<f32>,
        _u: [f32; 2],
    ) -> Option<ShapeSample> {
        None
    }
    /// Density per steradian with which [`sample_from`](Self::sample_from) draws the direction `wi`, which met the
    /// primitive at `hit_p` with geometric normal `hit_n`.
    pub fn pdf_from(
        &self,
        _shape: u32,
        _prim: u32,
        _from: Vec3<f32>,
        _wi: Vec3<f32>,
        _hit_p: Vec3<f32>,
        _hit_n: Vec3<f32>,
    ) -> f32 {
        0.0
    }
    /// Draws a point of a primitive, uniformly by area where that is possible in closed form.
    pub fn sample_area(&self, _shape: u32, _prim: u32, _u: [f32; 2]) -> Option<ShapeSample> {
        None
    }
}
