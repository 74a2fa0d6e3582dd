//! What is known of the points that rays met, one by one and many at once.

use sparrow_math::Vec3;

use super::Geometry;
use super::body::Body;
use crate::columns::{SurfaceColumns, SurfaceParts};
use crate::point::SurfacePoint;
use crate::quadric::MIN_MANY;
use crate::ray::{Hit, Ray};

impl Geometry {
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
            Body::Deforming(d) => d.surface(ray, hit),
        }
    }

    /// [`surface`](Self::surface) of the hits numbered `which`, which this geometry gave for `rays`, the k-th to place k of the
    /// columns, to the bit. Places of numbers without a hit are left as they are.
    ///
    /// Panics for a hit of another geometry, or returns nonsense; and where there is no ray of such a number, or columns are shorter than
    /// `which`, rounded up to whole registers.
    pub fn surface_many(
        &self,
        rays: &[Ray],
        hits: &[Option<Hit>],
        which: &[u32],
        parts: SurfaceParts,
        out: &mut SurfaceColumns<'_>,
    ) {
        let plain = parts == SurfaceParts::default();
        let mut k = 0;
        while let Some(&i) = which.get(k) {
            let (ray, hit) = (&rays[i as usize], &hits[i as usize]);
            let n = if plain { self.quadric_many(rays, hits, &which[k..], k, out) } else { 0 };
            if let (0, Some(hit)) = (n, hit) {
                out.put(k, &self.surface(ray, hit), parts);
            }
            k += n.max(1);
        }
    }
    /// The surface at as many of the first hits as lie on one quadric of the world, if it has a way for many; their number, else 0.
    #[inline]
    fn quadric_many(
        &self,
        rays: &[Ray],
        hits: &[Option<Hit>],
        which: &[u32],
        first: usize,
        out: &mut SurfaceColumns<'_>,
    ) -> usize {
        let on = |i: u32| hits[i as usize].filter(|hit| hit.instance.is_none()).map(|hit| hit.shape);
        let shape = on(which[0]);
        let Some(Body::Quadric(Some(q))) = shape.and_then(|shape| self.body(shape)) else { return 0 };
        let n = which.iter().take_while(|i| on(**i) == shape).count();
        if n >= MIN_MANY && q.surface_many(rays, hits, &which[..n], first, out) { n } else { 0 }
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
            Body::Deforming(d) => d.normal_derivatives(ray, hit),
            Body::Curves(_) | Body::Quadric(None) => Default::default(),
        }
    }
}
