//! Groups of shapes that stand in many places, or move: [`Instance`], [`MovingInstance`], [`Instances`].

use core::cell::Cell;

use rayon::prelude::*;
use sparrow_math::{Aabb, Motion, Vec3, vec3};

use crate::bvh::{Bvh, Kind, Others, PrimRef, RawHit, gamma};
use crate::point::SurfacePoint;
use crate::ray::Ray;

/// A prototype at a place.
#[derive(Clone, Copy, Debug)]
pub struct Instance {
    /// World space from the prototype's space: rows of a matrix, the translation in the fourth column. Any affine map that has
    /// an inverse.
    pub to_world: [[f32; 4]; 3],
    /// Number of the prototype, in the order given to [`Geometry::build_instanced`](crate::Geometry::build_instanced).
    pub prototype: u32,
}

/// A prototype that moves.
#[derive(Clone, Copy, Debug)]
pub struct MovingInstance {
    /// World space from the prototype's space.
    pub motion: Motion,
    /// Number of the prototype, as for [`Instance`].
    pub prototype: u32,
}

/// An affine map: rows, the translation in the fourth column.
type Rows<T> = [[T; 4]; 3];

/// Maps a point.
fn point(m: &Rows<f64>, p: Vec3<f64>) -> Vec3<f64> {
    let row = |r: &[f64; 4]| r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
    vec3(row(&m[0]), row(&m[1]), row(&m[2]))
}

/// Maps a direction.
fn vector(m: &Rows<f64>, v: Vec3<f64>) -> Vec3<f64> {
    let row = |r: &[f64; 4]| r[0] * v.x + r[1] * v.y + r[2] * v.z;
    vec3(row(&m[0]), row(&m[1]), row(&m[2]))
}

/// Maps a normal back by the inverse transpose. The length changes.
fn normal(back: &Rows<f64>, n: Vec3<f32>) -> Vec3<f64> {
    let n = n.to_f64();
    let column = |j: usize| n.x * back[0][j] + n.y * back[1][j] + n.z * back[2][j];
    vec3(column(0), column(1), column(2))
}

/// Bounds the sum of the terms of a mapped point that lies within `p` of the origin along each axis.
fn magnitude(m: &Rows<f64>, p: Vec3<f64>) -> Vec3<f64> {
    point(&m.map(|r| r.map(f64::abs)), p.abs())
}

/// The way back; `None` where there is none, or its entries are not finite in single precision.
fn inverse(m: &Rows<f64>) -> Option<Rows<f64>> {
    let column = |j: usize| vec3(m[0][j], m[1][j], m[2][j]);
    let [a, b, c, t] = [column(0), column(1), column(2), column(3)];
    let determinant = a.dot(b.cross(c));
    let row = |r: Vec3<f64>| {
        let r = r / determinant;
        [r.x, r.y, r.z, -r.dot(t)]
    };
    let rows = [row(b.cross(c)), row(c.cross(a)), row(a.cross(b))];
    rows.iter().flatten().all(|x| (*x as f32).is_finite()).then_some(rows)
}

/// An instance as rays need it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    /// The prototype's space from world space. It alone says where the instance is: both ways are worked out from it.
    to_local: Rows<f32>,
    prototype: u32,
}

impl Placed {
    /// Where there is no inverse there is no box either, which keeps the instance out of the tree.
    fn new(to_world: &Rows<f64>, prototype: u32) -> Placed {
        let to_local = inverse(to_world).map_or([[f32::NAN; 4]; 3], |m| m.map(|r| r.map(|x| x as f32)));
        Placed { to_local, prototype }
    }
    /// The ray in the prototype's space, with the same parameter along it.
    #[inline]
    pub(crate) fn ray(&self, ray: &Ray) -> Ray {
        let [x, y, z] = &self.to_local;
        let (o, d) = (ray.o, ray.d);
        let point = |r: &[f32; 4]| r[0] * o.x + r[1] * o.y + r[2] * o.z + r[3];
        let vector = |r: &[f32; 4]| r[0] * d.x + r[1] * d.y + r[2] * d.z;
        Ray { o: vec3(point(x), point(y), point(z)), d: vec3(vector(x), vector(y), vector(z)), ..*ray }
    }
    fn both(&self) -> (Rows<f64>, Option<Rows<f64>>) {
        let to_local = self.to_local.map(|r| r.map(f64::from));
        (to_local, inverse(&to_local))
    }
    /// The box in world space around a box in the prototype's; `None` where it is not finite.
    fn bounds(&self, b: &Aabb) -> Option<Aabb> {
        let (_, to_world) = self.both();
        let to_world = to_world?;
        let corner = |i: usize| {
            let pick = |axis: usize| f64::from(if i >> axis & 1 == 0 { b.lo[axis] } else { b.hi[axis] });
            point(&to_world, vec3(pick(0), pick(1), pick(2))).to_f32()
        };
        let around = (0..8).map(corner).fold(Aabb::EMPTY, Aabb::grow);
        // A ray is mapped with rounding errors as large as its origin is far: here, as far as the box.
        padded(&around, 8).filter(|_| !b.is_empty())
    }
    /// Maps a normal of the prototype to world space. The length changes.
    pub(crate) fn normal(&self, n: Vec3<f32>) -> Vec3<f32> {
        normal(&self.both().0, n).to_f32()
    }
    /// A surface point of the prototype, brought to world space.
    pub(crate) fn surface(&self, s: &SurfacePoint) -> SurfacePoint {
        let (to_local, Some(to_world)) = self.both() else { return *s };
        let normal = |n: Vec3<f32>| normal(&to_local, n).normalized().to_f32();
        let along = |v: Vec3<f32>| vector(&to_world, v.to_f64()).to_f32();
        let p = point(&to_world, s.p.to_f64());
        // What the point errs there, and what a ray that leaves it will err when it is mapped back.
        let local = s.p_error.to_f64() + magnitude(&to_local, p) * f64::from(gamma(4));
        let stretched = magnitude(&to_world.map(|[a, b, c, _]| [a, b, c, 0.0]), local);
        let p_error = (stretched + p.abs() * f64::from(f32::EPSILON)).to_f32();
        SurfacePoint {
            p: p.to_f32(),
            p_error,
            ng: normal(s.ng),
            ns: normal(s.ns),
            dpdu: along(s.dpdu),
            dpdv: along(s.dpdv),
            tangent: along(s.tangent),
            ..*s
        }
    }
}

/// A box with room for `n` roundings in a row of numbers as large as its corners; `None` where it is not finite.
pub(crate) fn padded(b: &Aabb, n: u32) -> Option<Aabb> {
    let pad = (b.lo.abs().max(b.hi.abs()) + b.extent()) * gamma(n);
    let (lo, hi) = (b.lo - pad, b.hi + pad);
    (lo.is_finite() && hi.is_finite()).then_some(Aabb { lo, hi })
}

/// The way back of what only shifts: the same map at all times, but for its translation.
#[derive(Clone, Copy, Debug)]
struct Shift {
    start: Rows<f64>,
    /// What is added to the translation from start to end.
    by: [f64; 3],
}

impl Shift {
    /// `None` where the motion turns or stretches, or has no inverse.
    fn of(motion: &Motion) -> Option<Shift> {
        let (start, end) = (motion.at(0.0), motion.at(1.0));
        let linear = |m: &Rows<f64>| m.map(|[a, b, c, _]| [a, b, c]);
        if linear(&start) != linear(&end) {
            return None;
        }
        let (start, end) = (inverse(&start)?, inverse(&end)?);
        Some(Shift { start, by: [0, 1, 2].map(|i: usize| end[i][3] - start[i][3]) })
    }
    fn at(&self, time: f32, prototype: u32) -> Placed {
        let mut to_local = self.start.map(|r| r.map(|x| x as f32));
        for ((row, start), by) in to_local.iter_mut().zip(&self.start).zip(self.by) {
            row[3] = (start[3] + by * f64::from(time)) as f32;
        }
        Placed { to_local, prototype }
    }
}

/// A moving instance as rays need it.
#[derive(Clone, Copy, Debug)]
struct Moving {
    instance: MovingInstance,
    /// Spares every ray an inversion.
    shift: Option<Shift>,
}

impl Moving {
    fn new(instance: MovingInstance) -> Moving {
        Moving { instance, shift: Shift::of(&instance.motion) }
    }
    fn at(&self, time: f32) -> Placed {
        let MovingInstance { motion, prototype } = &self.instance;
        match &self.shift {
            Some(shift) => shift.at(time, *prototype),
            None => Placed::new(&motion.at(f64::from(time)), *prototype),
        }
    }
    /// The box around all places of a box in the prototype's space; `None` where it is not finite.
    fn bounds(&self, b: &Aabb) -> Option<Aabb> {
        // The way back is rounded anew at every time, on top of the roundings of a ray that is mapped.
        padded(&self.instance.motion.bounds(b), 64).filter(|_| !b.is_empty())
    }
}

/// All instances of a geometry and the trees of their prototypes. In the tree over everything an instance is one primitive.
#[derive(Debug, Default)]
pub(crate) struct Instances {
    prototypes: Vec<Bvh>,
    placed: Vec<Placed>,
    moving: Vec<Moving>,
}

impl Instances {
    pub(crate) fn new(
        prototypes: Vec<Bvh>,
        instances: Vec<Instance>,
        moving: Vec<MovingInstance>,
    ) -> Instances {
        let place = |i: Instance| Placed::new(&i.to_world.map(|r| r.map(f64::from)), i.prototype);
        let moving = moving.into_par_iter().map(Moving::new).collect();
        Instances { prototypes, placed: instances.into_par_iter().map(place).collect(), moving }
    }
    pub(crate) fn len(&self) -> usize {
        self.placed.len() + self.moving.len()
    }
    /// Bytes of the places.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.placed) + size_of_val(&*self.moving)
    }
    /// Bytes of the prototypes' trees.
    pub(crate) fn tree_bytes(&self) -> usize {
        self.prototypes.iter().map(Bvh::bytes).sum()
    }
    pub(crate) fn n_nodes(&self) -> usize {
        self.prototypes.iter().map(Bvh::n_nodes).sum()
    }
    /// What the tree over everything holds of them, numbered from `first`; and how many of them that leaves out.
    pub(crate) fn refs(&self, first: u32, out: &mut Vec<PrimRef>) -> usize {
        let before = out.len();
        let one = |i: u32| {
            let of = |prototype: u32| self.prototypes.get(prototype as usize).map(Bvh::bounds);
            let b = match self.placed.get(i as usize) {
                Some(placed) => placed.bounds(&of(placed.prototype)?)?,
                None => {
                    let moving = &self.moving[i as usize - self.placed.len()];
                    moving.bounds(&of(moving.instance.prototype)?)?
                }
            };
            Some(PrimRef::new(first + i, b, Kind::Others))
        };
        out.par_extend((0..self.len() as u32).into_par_iter().filter_map(one));
        self.len() - (out.len() - before)
    }
    /// An instance where it is at `time`.
    #[inline]
    pub(crate) fn at(&self, instance: u32, time: f32) -> Placed {
        match self.placed.get(instance as usize) {
            Some(placed) => *placed,
            None => self.moving[instance as usize - self.placed.len()].at(time),
        }
    }
}

/// Everything that is not a triangle of the world: its other primitives, and from `first` on its instances.
pub(crate) struct World<'a, O> {
    pub(crate) others: &'a O,
    pub(crate) instances: &'a Instances,
    pub(crate) first: u32,
    /// The instance whose points are being offered.
    pub(crate) current: Cell<Option<u32>>,
}

impl<O: Others> Others for World<'_, O> {
    #[inline]
    fn hit(&self, id: u32, ray: &Ray, t_max: f32, found: &mut impl FnMut(RawHit) -> f32) -> f32 {
        let Some(i) = id.checked_sub(self.first) else { return self.others.hit(id, ray, t_max, found) };
        let placed = self.instances.at(i, ray.time);
        let Some(tree) = self.instances.prototypes.get(placed.prototype as usize) else { return t_max };
        let local = Ray { t_max, ..placed.ray(ray) };
        self.current.set(Some(i));
        let mut last = t_max;
        tree.visit(&local, self.others, |h| {
            last = found(h);
            last
        });
        self.current.set(None);
        last
    }
    #[inline]
    fn ahead(&self, id: u32) {
        if id < self.first {
            self.others.ahead(id);
        }
    }
}
