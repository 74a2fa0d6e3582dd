//! [`Geometry`]: shapes with a hierarchy over them.

mod body;
mod query;
mod stats;
mod surface;

use std::time::Instant;

use body::{Bodies, Body};
use sparrow_math::{Aabb, Vec3};
pub use stats::{BuildBytes, BuildStats};

use crate::bvh::{Bvh, Few, MAX_PRIMS};
use crate::instance::{Instance, Instances, MovingInstance};
use crate::point::ShapeSample;
use crate::progress::{BuildObserver, Progress};
use crate::sample::{Balls, PdfColumns, SampleColumns, Viewpoint, per_steradian};
use crate::shape::{Shape, ShapeInstance};

/// What a geometry is built from.
#[derive(Debug, Default)]
pub struct GeometryParts {
    /// Shapes of the world.
    pub shapes: Vec<ShapeInstance>,
    /// Groups of shapes, each in a space of its own, that stand wherever instances place them.
    pub prototypes: Vec<Vec<ShapeInstance>>,
    /// Where they stand.
    pub instances: Vec<Instance>,
    /// Where they move, numbered on from those that stand.
    pub moving: Vec<MovingInstance>,
}

impl GeometryParts {
    /// What has to be placed in trees; of curves, their pieces and the blocks of eight that these fill.
    fn n_to_place(&self) -> usize {
        let of = |s: &ShapeInstance| match &s.shape {
            Shape::Triangles(m) => m.indices.len(),
            Shape::Patches(m) => m.indices.len(),
            Shape::Curves(c) => {
                let pieces = c.points.len() << c.split_depth.min(2);
                pieces + pieces.div_ceil(8)
            }
            Shape::Sphere { .. } | Shape::Disk { .. } | Shape::Cylinder { .. } => 1,
        };
        let shapes = self.shapes.iter().chain(self.prototypes.iter().flatten());
        shapes.map(of).sum::<usize>() + self.instances.len() + self.moving.len()
    }
}

/// Shapes with a hierarchy over them. Immutable; shared freely between threads.
#[derive(Debug)]
pub struct Geometry {
    bodies: Bodies,
    instances: Instances,
    /// The number that the tree gave to the first instance.
    first_instance: u32,
    bvh: Bvh,
    /// The tree once more, for lists of rays, where it is small.
    few: Option<Few>,
    stats: BuildStats,
}

impl Geometry {
    /// Builds the hierarchy, in parallel on the current rayon pool; the result does not depend on the number of threads.
    ///
    /// Primitives that cannot be hit (zero area, coordinates that are not finite, indices without a vertex)
    /// are left out and counted in [`BuildStats::dropped`]; numbering does not change. So are those beyond the
    /// first 2^28. Of maps to world space only the affine part is used.
    pub fn build(shapes: Vec<ShapeInstance>) -> Geometry {
        Geometry::build_instanced(shapes, Vec::new(), Vec::new())
    }
    /// The same with groups of shapes, each in a space of its own, that stand wherever instances place them.
    ///
    /// Shapes of prototypes are numbered on from those of the world. A prototype costs what it holds, an instance about a
    /// hundred bytes. Instances without an inverse or of a prototype that does not exist are left out and counted as dropped.
    pub fn build_instanced(
        shapes: Vec<ShapeInstance>,
        prototypes: Vec<Vec<ShapeInstance>>,
        instances: Vec<Instance>,
    ) -> Geometry {
        Geometry::build_moving(shapes, prototypes, instances, Vec::new())
    }
    /// The same with instances that move, numbered on from those that do not. Rays meet them where they are at the rays' time.
    pub fn build_moving(
        shapes: Vec<ShapeInstance>,
        prototypes: Vec<Vec<ShapeInstance>>,
        instances: Vec<Instance>,
        moving: Vec<MovingInstance>,
    ) -> Geometry {
        Geometry::build_observed(GeometryParts { shapes, prototypes, instances, moving }, None)
    }
    /// The same, and tells how far it is.
    pub fn build_observed(parts: GeometryParts, observer: Option<BuildObserver<'_>>) -> Geometry {
        let start = Instant::now();
        let progress = &Progress::new(observer, parts.n_to_place());
        let GeometryParts { shapes, prototypes, mut instances, mut moving } = parts;
        let sizes: Vec<usize> = prototypes.iter().map(Vec::len).collect();
        let n_world = shapes.len();
        let all = shapes.into_iter().chain(prototypes.into_iter().flatten());
        let (bodies, n_ids) = Bodies::new(all.map(|s| Body::new(s, progress)).collect());
        let (mut refs, mut dropped) = bodies.refs(0..n_world);
        let (mut trees, mut next) = (Vec::with_capacity(sizes.len()), n_world);
        for n in sizes {
            let (refs, lost) = bodies.refs(next..next + n);
            trees.push(Bvh::build(refs, |id| bodies.corners(id), progress));
            dropped += lost;
            next += n;
        }
        let n_places = instances.len() + moving.len();
        instances.truncate(MAX_PRIMS - n_ids);
        moving.truncate(MAX_PRIMS - n_ids - instances.len());
        dropped += n_places - instances.len() - moving.len();
        let (instances, first_instance) = (Instances::new(trees, instances, moving), n_ids as u32);
        dropped += instances.refs(first_instance, &mut refs);
        let bvh = Bvh::build(refs, |id| bodies.corners(id), progress);
        let bodies_of = &bodies.bodies;
        let n_prims = bodies_of.iter().map(Body::n_prims).sum::<usize>() + instances.len();
        let mut bytes = BuildBytes {
            instances: instances.bytes(),
            hierarchy: bvh.bytes() + instances.tree_bytes(),
            ..BuildBytes::default()
        };
        bodies_of.iter().for_each(|b| b.add_bytes(&mut bytes));
        let stats = BuildStats {
            primitives: n_prims.saturating_sub(dropped),
            dropped,
            nodes: bvh.n_nodes() + instances.n_nodes() + bodies_of.iter().map(Body::n_nodes).sum::<usize>(),
            bytes,
            build_seconds: start.elapsed().as_secs_f64(),
        };
        let alone = instances.len() == 0;
        let few = alone.then(|| Few::new(&bvh, |id| bodies.owner(id), |id| bodies.ball(id))).flatten();
        progress.finish();
        Geometry { bodies, instances, first_instance, bvh, few, stats }
    }
    /// There are so few primitives that lists of rays ask for all of them, eight rays at once.
    pub fn is_small(&self) -> bool {
        self.few.is_some()
    }

    /// Box around everything that can be hit.
    pub fn bounds(&self) -> Aabb {
        self.bvh.bounds()
    }
    /// A ball around a shape, centre and radius, up to rounding, in the space of its group; `None` where nothing of it can be hit.
    pub fn ball_around(&self, shape: u32) -> Option<(Vec3<f32>, f32)> {
        self.bodies.ball_around(shape as usize)
    }
    /// What building cost and gave.
    pub fn stats(&self) -> BuildStats {
        self.stats
    }
    /// Number of shapes.
    pub fn n_shapes(&self) -> usize {
        self.bodies.bodies.len()
    }
    /// Number of primitives of a shape, the dropped ones included; 0 for a shape that does not exist.
    pub fn n_prims(&self, shape: usize) -> usize {
        self.bodies.bodies.get(shape).map_or(0, Body::n_prims)
    }

    #[inline]
    fn body(&self, shape: u32) -> Option<&Body> {
        self.bodies.bodies.get(shape as usize)
    }
    /// World-space area of a primitive; zero for one that was dropped.
    ///
    /// Exact for triangles, flat patches, and quadrics that are moved, turned and scaled evenly; else by a fixed
    /// quadrature, to about three digits.
    pub fn area(&self, shape: u32, prim: u32) -> f32 {
        match self.body(shape) {
            Some(Body::Triangles(m)) => m.area(prim),
            Some(Body::Patches(m)) => m.area(prim),
            Some(Body::Curves(c)) => c.area(prim),
            Some(Body::Quadric(Some(q))) => q.area(),
            Some(Body::Deforming(d)) => d.area(prim),
            Some(Body::Quadric(None)) | None => 0.0,
        }
    }
    /// Draws a point of a primitive, with a density over the directions in which it is seen from `from`: uniform for
    /// triangles, rectangles and whole spheres of sensible size, else uniform over the surface. For triangles and
    /// rectangles that are seen large it follows the cosine at `from`. `None` where such a density does not exist: seen
    /// edge-on, dropped, or a curve's.
    #[inline]
    pub fn sample_from(
        &self,
        shape: u32,
        prim: u32,
        from: impl Into<Viewpoint>,
        u: [f32; 2],
    ) -> Option<ShapeSample> {
        let from = &from.into();
        match self.body(shape)? {
            Body::Triangles(m) => m.sample_from(prim, from, u),
            Body::Patches(m) => m.sample_from(prim, from, u),
            Body::Curves(_) | Body::Deforming(_) => None,
            Body::Quadric(q) => q.as_ref()?.sample_from(from, u),
        }
    }
    /// [`sample_from_many`](Self::sample_from_many) has lanes for that primitive: a rectangle or a whole ball.
    pub fn samples_in_lanes(&self, shape: u32, prim: u32) -> bool {
        match self.body(shape) {
            Some(Body::Patches(m)) => m.is_rectangle(prim),
            Some(Body::Quadric(Some(q))) => q.whole().is_some(),
            Some(_) | None => false,
        }
    }
    /// [`sample_from`](Self::sample_from) from each of the first `n` viewpoints of `columns`, in lanes, to the bit: where that gives
    /// nothing the density is zero. Returns the bound of the rounding error of all points; `None`, and nothing done, where such
    /// primitives are drawn one by one.
    ///
    /// Panics where columns are shorter than `n`, rounded up to whole registers.
    pub fn sample_from_many(
        &self,
        shape: u32,
        prim: u32,
        columns: &mut SampleColumns<'_>,
        n: usize,
    ) -> Option<Vec3<f32>> {
        match self.body(shape) {
            Some(Body::Patches(m)) => m.sample_from_many(prim, columns, n),
            Some(Body::Quadric(Some(q))) => q.sample_from_many(columns, n),
            Some(Body::Triangles(_) | Body::Curves(_) | Body::Quadric(None) | Body::Deforming(_)) | None => {
                None
            }
        }
    }
    /// Those of `shapes` that are whole balls, in their places.
    pub fn balls(&self, shapes: impl Iterator<Item = Option<u32>>) -> Balls {
        let mut balls = Balls::default();
        for shape in shapes {
            balls.push(match shape.and_then(|shape| self.body(shape)) {
                Some(Body::Quadric(Some(q))) => q.drawn_ball(),
                Some(_) | None => None,
            });
        }
        balls
    }
    /// Whether the shape is a whole ball.
    pub fn is_ball(&self, shape: u32) -> bool {
        matches!(self.body(shape), Some(Body::Quadric(Some(q))) if q.drawn_ball().is_some())
    }
    /// [`pdf_from`](Self::pdf_from) for each of the first `n` points of `columns`, in lanes, to the bit; false, and nothing done, where
    /// such primitives are drawn one by one.
    ///
    /// Panics where columns are shorter than `n`, rounded up to whole registers.
    pub fn pdf_from_many(&self, shape: u32, prim: u32, columns: &mut PdfColumns<'_>, n: usize) -> bool {
        match self.body(shape) {
            Some(Body::Patches(m)) => m.pdf_from_many(prim, columns, n),
            Some(Body::Quadric(Some(q))) => q.pdf_from_many(columns, n),
            Some(Body::Triangles(_) | Body::Curves(_) | Body::Quadric(None) | Body::Deforming(_)) | None => {
                false
            }
        }
    }
    /// Density per steradian with which [`sample_from`](Self::sample_from) draws the direction that met the primitive at
    /// `hit_p` with geometric normal `hit_n`.
    #[inline]
    pub fn pdf_from(
        &self,
        shape: u32,
        prim: u32,
        from: impl Into<Viewpoint>,
        hit_p: Vec3<f32>,
        hit_n: Vec3<f32>,
    ) -> f32 {
        let from = &from.into();
        let per_area = |pdf: f64| per_steradian(pdf, from.p, hit_p, hit_n).unwrap_or(0.0);
        match self.body(shape) {
            Some(Body::Triangles(m)) => m.pdf_from(prim, from, hit_p, per_area),
            Some(Body::Patches(m)) => m.pdf_from(prim, from, hit_p, hit_n, per_area),
            Some(Body::Quadric(Some(q))) => q.pdf_from(from, hit_n, per_area),
            Some(Body::Curves(_) | Body::Quadric(None) | Body::Deforming(_)) | None => 0.0,
        }
    }
    /// Draws a point of a primitive, with a density per area: uniform for triangles, parallelograms and evenly
    /// stretched quadrics, close to uniform for others.
    pub fn sample_area(&self, shape: u32, prim: u32, u: [f32; 2]) -> Option<ShapeSample> {
        match self.body(shape)? {
            Body::Triangles(m) => m.sample_area(prim, u),
            Body::Patches(m) => m.sample_area(prim, u),
            Body::Curves(_) | Body::Deforming(_) => None,
            Body::Quadric(q) => q.as_ref()?.sample_area(u),
        }
    }
}
