//! What is known of the points that rays met, one by one and many at once.

use sparrow_math::{MAX_WIDTH, Vec3};

use super::Geometry;
use super::body::Body;
use crate::columns::{PointBlock, SurfaceColumns, SurfaceParts};
use crate::patch::Patches;
use crate::point::SurfacePoint;
use crate::quadric::{Met, Quadric};
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
        let (mut block, mut met) = (PointBlock::default(), Met::default());
        for (n, which) in which.chunks(MAX_WIDTH).enumerate() {
            if let Some(ball) = self.ball_of(hits, which).filter(|_| parts == SurfaceParts::default()) {
                for (k, &i) in which.iter().enumerate() {
                    let t = hits[i as usize].map_or(0.0, |hit| hit.t);
                    met.set(k, &rays[i as usize], t);
                }
                ball.surface_many(&met, &mut block);
            } else if let Some((patches, prim)) = self.plain_of(hits, which) {
                let mut uv = [[0.0; MAX_WIDTH]; 2];
                for (k, &i) in which.iter().enumerate() {
                    [uv[0][k], uv[1][k]] = hits[i as usize].map_or([0.0; 2], |hit| [hit.u, hit.v]);
                }
                patches.surface_many(prim, &uv, &mut block);
            } else {
                self.ahead(hits, which);
                for (k, &i) in which.iter().enumerate() {
                    if let Some(hit) = &hits[i as usize] {
                        self.put(&rays[i as usize], hit, k, &mut block, parts);
                    }
                }
            }
            out.write(n * MAX_WIDTH, &block, parts);
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
    /// The whole ball of the world on which all of these hits lie.
    #[inline]
    fn ball_of(&self, hits: &[Option<Hit>], which: &[u32]) -> Option<&Quadric> {
        let on = |i: &u32| hits[*i as usize].filter(|hit| hit.instance.is_none()).map(|hit| hit.shape);
        let shape = on(which.first()?)?;
        let Some(Body::Quadric(Some(q))) = self.body(shape) else { return None };
        (q.is_ball() && which.iter().all(|i| on(i) == Some(shape))).then_some(q)
    }

    /// The parallelogram of the world on which all of these hits lie, and its number, if shading and textures say nothing of it.
    #[inline]
    fn plain_of(&self, hits: &[Option<Hit>], which: &[u32]) -> Option<(&Patches, u32)> {
        let on = |i: &u32| hits[*i as usize].filter(|hit| hit.instance.is_none()).map(|h| (h.shape, h.prim));
        let first @ (shape, prim) = on(which.first()?)?;
        let Some(Body::Patches(m)) = self.body(shape) else { return None };
        (which.iter().all(|i| on(i) == Some(first)) && m.is_plain(prim)).then_some((m, prim))
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
