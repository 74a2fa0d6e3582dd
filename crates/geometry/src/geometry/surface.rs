//! What is known of the points that rays met, one by one and many at once.

use sparrow_math::{MAX_WIDTH, Vec3, vec3};

use super::Geometry;
use super::body::Body;
use crate::columns::{PointBlock, SurfaceColumns, SurfaceParts, Vectors, set};
use crate::point::SurfacePoint;
use crate::quadric::Met;
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
    /// columns, to the bit. Places of numbers without a hit hold nothing of use.
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
        let (mut block, mut met, mut at) = (PointBlock::default(), Met::default(), Vectors::default());
        for (n, which) in which.chunks(MAX_WIDTH).enumerate() {
            let first = n * MAX_WIDTH;
            let one = together(hits, which, &mut at).and_then(|hit| Some((self.body(hit.shape)?, hit.prim)));
            match one {
                Some((Body::Patches(patches), prim)) if patches.is_plain(prim) => {
                    let [_, u, v] = at;
                    patches.surface_many(prim, &[u, v], first, (&mut *out, parts));
                    continue;
                }
                Some((Body::Quadric(Some(q)), _)) if q.is_ball() && parts == SurfaceParts::default() => {
                    for (k, (&i, t)) in which.iter().zip(at[0]).enumerate() {
                        met.set(k, &rays[i as usize], t);
                    }
                    q.surface_many(&met, &mut block);
                }
                _ => {
                    self.ahead(hits, which);
                    for (k, &i) in which.iter().enumerate() {
                        if let Some(hit) = &hits[i as usize] {
                            self.put(&rays[i as usize], hit, k, &mut block, parts);
                        }
                    }
                }
            }
            out.write(first, &block, parts);
        }
    }
    /// Asks for what the surface at these hits will read, where the first of them lies on a mesh.
    #[inline(always)]
    fn ahead(&self, hits: &[Option<Hit>], which: &[u32]) {
        let hit = |i: &u32| hits[*i as usize].as_ref();
        let mesh = |hit: &Hit| match self.body(hit.shape) {
            Some(Body::Triangles(m)) => Some(m),
            Some(_) | None => None,
        };
        if which.first().and_then(hit).and_then(mesh).is_none() {
            return;
        }
        let met = || which.iter().filter_map(hit).filter_map(|hit| Some((mesh(hit)?, hit.prim)));
        met().for_each(|(m, prim)| m.indices_ahead(prim));
        met().for_each(|(m, prim)| m.corners_ahead(prim));
    }
    /// The surface at a hit, to place `k` of a block.
    #[inline(always)]
    fn put(&self, ray: &Ray, hit: &Hit, k: usize, block: &mut PointBlock, parts: SurfaceParts) {
        match (hit.instance, &self.bodies.bodies[hit.shape as usize]) {
            (None, Body::Patches(m)) => m.put(hit, k, block, parts),
            (None, Body::Triangles(m)) => block.put(k, &m.surface(hit), parts),
            _ => block.put(k, &self.surface(ray, hit), parts),
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
            Body::Deforming(d) => d.normal_derivatives(ray, hit),
            Body::Curves(_) | Body::Quadric(None) => Default::default(),
        }
    }
}

/// The first of these hits, if all lie on the same primitive of the world; writes their parameters, along the ray and those on the primitive.
#[inline]
fn together<'a>(hits: &'a [Option<Hit>], which: &[u32], at: &mut Vectors) -> Option<&'a Hit> {
    let first = hits[*which.first()? as usize].as_ref()?;
    for (k, &i) in which.iter().take(MAX_WIDTH).enumerate() {
        let Some(Hit { t, shape, prim, u, v, instance: None }) = hits[i as usize] else { return None };
        if (shape, prim) != (first.shape, first.prim) {
            return None;
        }
        set(at, k, vec3(t, u, v));
    }
    Some(first)
}
