//! What rays ask of a [`Geometry`], one by one and many at once.

use core::cell::Cell;

use super::Geometry;
use super::body::Bodies;
use crate::bvh::{Answers, Eight, RAYS, RawHit};
use crate::instance::World;
use crate::ray::{Hit, Ray};

/// The nearest points of a list of rays.
struct Nearest<'a> {
    bodies: &'a Bodies,
    out: &'a mut [Option<Hit>],
}

impl Answers for Nearest<'_> {
    #[inline(always)]
    fn one(&mut self, i: usize, hit: Option<RawHit>) {
        self.out[i] = hit.map(|raw| self.bodies.to_hit(&raw));
    }
    // Read from memory in rows, which the compiler would otherwise take to pieces.
    #[inline(never)]
    fn eight(&mut self, first: usize, hits: &Eight) {
        for (i, out) in self.out[first..first + RAYS].iter_mut().enumerate() {
            *out = hits.get(i);
        }
    }
}

/// Whether the rays of a list meet anything.
struct Any<'a>(&'a mut [bool]);

impl Answers for Any<'_> {
    #[inline(always)]
    fn one(&mut self, i: usize, hit: Option<RawHit>) {
        self.0[i] = hit.is_some();
    }
    #[inline(always)]
    fn eight(&mut self, first: usize, hits: &Eight) {
        self.0[first..first + RAYS].copy_from_slice(&hits.met());
    }
}

impl Geometry {
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
    /// [`intersect`](Self::intersect) for each of `rays`, to the bit, into as many places of `out`; what is longer is not looked at.
    pub fn intersect_many(&self, rays: &[Ray], out: &mut [Option<Hit>]) {
        let rays = &rays[..rays.len().min(out.len())];
        if self.instances.len() > 0 {
            return self.intersect_many_where(rays, out, |_, _| true);
        }
        let mut answers = Nearest { bodies: &self.bodies, out };
        self.bvh.hits::<false>(self.few.as_ref(), rays, &self.bodies, &mut answers);
    }
    /// [`occluded`](Self::occluded) for each of `rays`, into as many places of `out`; what is longer is not looked at.
    pub fn occluded_many(&self, rays: &[Ray], out: &mut [bool]) {
        let rays = &rays[..rays.len().min(out.len())];
        if self.instances.len() > 0 {
            return self.occluded_many_where(rays, out, |_, _| true);
        }
        self.bvh.hits::<true>(self.few.as_ref(), rays, &self.bodies, &mut Any(out));
    }
    /// [`intersect_where`](Self::intersect_where) for each of `rays`; `accept` is told the number of the ray.
    pub fn intersect_many_where(
        &self,
        rays: &[Ray],
        out: &mut [Option<Hit>],
        accept: impl Fn(usize, &Hit) -> bool,
    ) {
        for (i, (ray, out)) in rays.iter().zip(out).enumerate() {
            *out = self.among_instances::<false>(ray, |hit| accept(i, hit));
        }
    }
    /// [`occluded_where`](Self::occluded_where) for each of `rays`; `accept` is told the number of the ray.
    pub fn occluded_many_where(&self, rays: &[Ray], out: &mut [bool], accept: impl Fn(usize, &Hit) -> bool) {
        for (i, (ray, out)) in rays.iter().zip(out).enumerate() {
            *out = self.among_instances::<true>(ray, |hit| accept(i, hit)).is_some();
        }
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
}
