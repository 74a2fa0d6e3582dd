//! [`Geometry`]: shapes with a hierarchy over them.

use core::cell::Cell;
use std::time::Instant;

use rayon::prelude::*;
use sparrow_math::{Aabb, Vec3};

use crate::bvh::{Bvh, Kind, MAX_PRIMS, Others, PrimRef, RawHit};
use crate::curve::Curves;
use crate::instance::{Instance, Instances, MovingInstance, World};
use crate::patch::Patches;
use crate::point::{ShapeSample, SurfacePoint};
use crate::quadric::Quadric;
use crate::ray::{Hit, Ray};
use crate::sample::{Viewpoint, per_steradian};
use crate::shape::{Shape, ShapeInstance};
use crate::triangle::Triangles;

/// What building cost and gave.
#[derive(Clone, Copy, Debug, Default)]
pub struct BuildStats {
    /// Primitives that can be hit.
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

/// A shape ready to be asked.
#[derive(Debug)]
enum Body {
    Triangles(Triangles),
    Patches(Patches),
    Curves(Curves),
    /// `None` where nothing of it can be hit.
    Quadric(Option<Box<Quadric>>),
}

impl Body {
    fn new(s: ShapeInstance) -> Body {
        match s.shape {
            Shape::Triangles(m) => Body::Triangles(Triangles::new(m, s.flip_normal)),
            Shape::Patches(m) => Body::Patches(Patches::new(m, s.flip_normal)),
            Shape::Curves(c) => Body::Curves(Curves::new(c)),
            quadric @ (Shape::Sphere { .. } | Shape::Disk { .. } | Shape::Cylinder { .. }) => {
                Body::Quadric(Quadric::new(&quadric, &s.to_world, s.flip_normal).map(Box::new))
            }
        }
    }
    fn n_prims(&self) -> usize {
        match self {
            Body::Triangles(m) => m.len(),
            Body::Patches(m) => m.len(),
            Body::Curves(c) => c.len(),
            Body::Quadric(_) => 1,
        }
    }
    /// Numbers the tree sets aside.
    fn n_ids(&self) -> usize {
        match self {
            Body::Triangles(m) => m.len(),
            Body::Patches(m) => 2 * m.len(),
            Body::Curves(c) => c.n_ids(),
            Body::Quadric(_) => 1,
        }
    }
    fn bytes(&self) -> usize {
        match self {
            Body::Triangles(m) => m.bytes(),
            Body::Patches(m) => m.bytes(),
            Body::Curves(c) => c.bytes(),
            Body::Quadric(_) => size_of::<Quadric>(),
        }
    }
    /// What the tree holds of this shape, numbered from `first`; and how many of its primitives that leaves out.
    fn refs(&self, first: u32, out: &mut Vec<PrimRef>) -> usize {
        let before = out.len();
        match self {
            Body::Triangles(m) => {
                let one = |i: u32| m.bounds(i).map(|b| PrimRef::new(first + i, b, Kind::Triangles));
                out.par_extend((0..m.len() as u32).into_par_iter().filter_map(one));
                m.len() - (out.len() - before)
            }
            Body::Patches(m) => {
                let mut dropped = 0;
                for i in 0..m.len() as u32 {
                    let parts = m.parts(i);
                    dropped += usize::from(parts.is_empty());
                    out.extend(parts.iter().map(|&(id, b, other)| {
                        PrimRef::new(first + id, b, if other { Kind::Others } else { Kind::Triangles })
                    }));
                }
                dropped
            }
            Body::Curves(c) => {
                let block = |(i, &b): (usize, &Aabb)| PrimRef::new(first + i as u32, b, Kind::Others);
                out.extend(c.blocks().iter().enumerate().map(block));
                c.dropped()
            }
            Body::Quadric(Some(q)) => {
                out.push(PrimRef::new(first, q.bounds(), Kind::Others));
                0
            }
            Body::Quadric(None) => 1,
        }
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
    stats: BuildStats,
}

/// The shapes, and which numbers the tree gave to each.
#[derive(Debug)]
struct Bodies {
    bodies: Vec<Body>,
    /// The first number of each shape.
    first: Vec<u32>,
}

impl Bodies {
    /// Numbers what the tree may hold of all shapes; gives how many numbers that takes. A shape for which there are none left
    /// gets none.
    fn new(bodies: Vec<Body>) -> (Bodies, usize) {
        let mut next = 0;
        let number = |b: &Body| {
            let first = next;
            if next + b.n_ids() <= MAX_PRIMS {
                next += b.n_ids();
            }
            first as u32
        };
        let first = bodies.iter().map(number).collect();
        (Bodies { bodies, first }, next)
    }
    /// What a tree over some of the shapes holds, and how many of their primitives that leaves out.
    fn refs(&self, shapes: core::ops::Range<usize>) -> (Vec<PrimRef>, usize) {
        let (mut refs, mut dropped) = (Vec::new(), 0);
        for (body, &first) in self.bodies[shapes.clone()].iter().zip(&self.first[shapes]) {
            if first as usize + body.n_ids() <= MAX_PRIMS {
                dropped += body.refs(first, &mut refs);
            } else {
                dropped += body.n_prims();
            }
        }
        (refs, dropped)
    }
    /// The shape that a number of the tree belongs to, and the number within it.
    #[inline]
    fn locate(&self, id: u32) -> (u32, u32) {
        let shape = self.first.partition_point(|&f| f <= id) - 1;
        (shape as u32, id - self.first[shape])
    }
    fn corners(&self, id: u32) -> [[f32; 3]; 3] {
        let (shape, local) = self.locate(id);
        match &self.bodies[shape as usize] {
            Body::Triangles(m) => m.raw_corners(local),
            Body::Patches(m) => m.triangle(local),
            Body::Curves(_) | Body::Quadric(_) => [[f32::NAN; 3]; 3],
        }
    }
    /// What the world knows of a point the tree found.
    #[inline]
    fn to_hit(&self, raw: &RawHit) -> Hit {
        let (shape, local) = self.locate(raw.id);
        let (prim, [u, v]) = match &self.bodies[shape as usize] {
            Body::Triangles(_) | Body::Curves(_) => (local, [raw.u, raw.v]),
            Body::Patches(m) => (local / 2, m.parameters(local, raw)),
            Body::Quadric(_) => (0, [0.0; 2]),
        };
        Hit { t: raw.t, shape, prim, u, v, instance: None }
    }
}

impl Others for Bodies {
    fn hit(&self, id: u32, ray: &Ray, t_max: f32, found: &mut impl FnMut(RawHit) -> f32) -> f32 {
        let (shape, local) = self.locate(id);
        match &self.bodies[shape as usize] {
            Body::Patches(m) => m.hit(id, local, ray, t_max, found),
            Body::Curves(c) => c.hit(id - local, local, ray, t_max, found),
            Body::Quadric(Some(q)) => q.hit(id, ray, t_max, found),
            Body::Triangles(_) | Body::Quadric(None) => t_max,
        }
    }
    fn ahead(&self, id: u32) {
        let (shape, local) = self.locate(id);
        if let Body::Curves(c) = &self.bodies[shape as usize] {
            c.ahead(local);
        }
    }
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
        let start = Instant::now();
        let sizes: Vec<usize> = prototypes.iter().map(Vec::len).collect();
        let n_world = shapes.len();
        let bodies = shapes.into_iter().chain(prototypes.into_iter().flatten()).map(Body::new).collect();
        let (bodies, n_ids) = Bodies::new(bodies);
        let (mut refs, mut dropped) = bodies.refs(0..n_world);
        let (mut trees, mut next) = (Vec::with_capacity(sizes.len()), n_world);
        for n in sizes {
            let (refs, lost) = bodies.refs(next..next + n);
            trees.push(Bvh::build(refs, |id| bodies.corners(id)));
            dropped += lost;
            next += n;
        }
        let (mut instances, mut moving) = (instances, moving);
        let n_places = instances.len() + moving.len();
        instances.truncate(MAX_PRIMS - n_ids);
        moving.truncate(MAX_PRIMS - n_ids - instances.len());
        dropped += n_places - instances.len() - moving.len();
        let (instances, first_instance) = (Instances::new(trees, instances, moving), n_ids as u32);
        dropped += instances.refs(first_instance, &mut refs);
        let bvh = Bvh::build(refs, |id| bodies.corners(id));
        let n_prims = bodies.bodies.iter().map(Body::n_prims).sum::<usize>() + instances.len();
        let bytes = bvh.bytes() + instances.bytes() + bodies.bodies.iter().map(Body::bytes).sum::<usize>();
        let stats = BuildStats {
            primitives: n_prims.saturating_sub(dropped),
            dropped,
            nodes: bvh.n_nodes() + instances.n_nodes(),
            bytes,
            build_seconds: start.elapsed().as_secs_f64(),
        };
        Geometry { bodies, instances, first_instance, bvh, stats }
    }

    /// The nearest point of the ray on any shape.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        if self.instances.len() > 0 {
            return self.among_instances::<false>(ray, |_| true);
        }
        let raw = self.bvh.hit::<false>(ray, &self.bodies, |_| true)?;
        Some(self.bodies.to_hit(&raw))
    }
    /// Something lies on the ray.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        if self.instances.len() > 0 {
            return self.among_instances::<true>(ray, |_| true).is_some();
        }
        self.bvh.hit::<true>(ray, &self.bodies, |_| true).is_some()
    }
    /// The nearest point of the ray that `accept` does not reject.
    pub fn intersect_where(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> Option<Hit> {
        self.among_instances::<false>(ray, accept)
    }
    /// Something that `accept` does not reject lies on the ray.
    pub fn occluded_where(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> bool {
        self.among_instances::<true>(ray, accept).is_some()
    }
    /// [`intersect`](Self::intersect) for each of `rays`, into as many places of `out`; what is longer is not looked at.
    pub fn intersect_many(&self, rays: &[Ray], out: &mut [Option<Hit>]) {
        let rays = &rays[..rays.len().min(out.len())];
        if self.instances.len() > 0 {
            rays.iter().zip(out).for_each(|(ray, out)| *out = self.intersect(ray));
            return;
        }
        let put = |i: usize, raw: Option<RawHit>| out[i] = raw.map(|raw| self.bodies.to_hit(&raw));
        self.bvh.hits::<false>(rays, &self.bodies, |_| true, put);
    }
    /// [`occluded`](Self::occluded) for each of `rays`, into as many places of `out`; what is longer is not looked at.
    pub fn occluded_many(&self, rays: &[Ray], out: &mut [bool]) {
        let rays = &rays[..rays.len().min(out.len())];
        if self.instances.len() > 0 {
            rays.iter().zip(out).for_each(|(ray, out)| *out = self.occluded(ray));
            return;
        }
        self.bvh.hits::<true>(rays, &self.bodies, |_| true, |i, raw| out[i] = raw.is_some());
    }
    fn among_instances<const ANY: bool>(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> Option<Hit> {
        let (instances, first) = (&self.instances, self.first_instance);
        let world = World { others: &self.bodies, instances, first, current: Cell::new(None) };
        let best = Cell::new(None);
        let accept = |raw: &RawHit| {
            let hit = Hit { instance: world.current.get(), ..self.bodies.to_hit(raw) };
            let accepted = accept(&hit);
            if accepted {
                best.set(Some(hit));
            }
            accepted
        };
        self.bvh.hit::<ANY>(ray, &world, accept);
        best.get()
    }
    /// The surface at `hit`, which this geometry gave for `ray`.
    ///
    /// Panics for a hit of another geometry, or returns nonsense.
    #[inline]
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let there = hit.instance.map(|i| self.instances.at(i, ray.time));
        let point = match there {
            None => self.local_surface(ray, hit),
            Some(placed) => placed.surface(&self.local_surface(&placed.ray(ray), hit)),
        };
        SurfacePoint { time: ray.time, ..point }
    }
    /// The surface in the space of the shape.
    #[inline]
    fn local_surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        match &self.bodies.bodies[hit.shape as usize] {
            Body::Triangles(m) => m.surface(hit),
            Body::Patches(m) => m.surface(hit),
            Body::Curves(c) => c.surface(ray, hit),
            Body::Quadric(q) => match q {
                Some(q) => q.surface(ray, hit),
                None => SurfacePoint::nowhere(ray, hit),
            },
        }
    }

    /// Derivatives of the shading normal by the texture coordinates at `hit`, which this geometry gave for `ray`.
    ///
    /// Few materials ask for them, so they are not part of [`SurfacePoint`]. Zero for curves.
    pub fn normal_derivatives(&self, ray: &Ray, hit: &Hit) -> (Vec3<f32>, Vec3<f32>) {
        if let Some(i) = hit.instance {
            let (placed, local) = (self.instances.at(i, ray.time), Hit { instance: None, ..*hit });
            let (u, v) = self.normal_derivatives(&placed.ray(ray), &local);
            return (placed.normal(u), placed.normal(v));
        }
        match &self.bodies.bodies[hit.shape as usize] {
            Body::Triangles(m) => m.normal_derivatives(hit),
            Body::Patches(m) => m.normal_derivatives(hit),
            Body::Quadric(Some(q)) => q.normal_derivatives(ray, hit),
            Body::Curves(_) | Body::Quadric(None) => Default::default(),
        }
    }

    /// Box around everything that can be hit.
    pub fn bounds(&self) -> Aabb {
        self.bvh.bounds()
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
            Body::Curves(_) => None,
            Body::Quadric(q) => q.as_ref()?.sample_from(from.p, u),
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
            Some(Body::Quadric(Some(q))) => q.pdf_from(from.p, hit_n, per_area),
            Some(Body::Curves(_) | Body::Quadric(None)) | None => 0.0,
        }
    }
    /// Draws a point of a primitive, with a density per area: uniform for triangles, parallelograms and evenly
    /// stretched quadrics, close to uniform for others.
    pub fn sample_area(&self, shape: u32, prim: u32, u: [f32; 2]) -> Option<ShapeSample> {
        match self.body(shape)? {
            Body::Triangles(m) => m.sample_area(prim, u),
            Body::Patches(m) => m.sample_area(prim, u),
            Body::Curves(_) => None,
            Body::Quadric(q) => q.as_ref()?.sample_area(u),
        }
    }
}
