//! The rays: from a camera, bounced, and to a light. All are made with Sparrow, so that every tracer gets the same.

use sparrow_geometry::{Geometry, Ray, SurfacePoint};
use sparrow_math::{Frame, LocalDir, Real, Vec3, vec3, warp};

use crate::race::{Query, Tracer, race};

/// Uniform numbers in [0, 1). [Steele2014]
pub(crate) struct Rng(pub(crate) u64);

impl Rng {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    pub(crate) fn next(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1u32 << 24) as f32
    }
    pub(crate) fn sphere(&mut self) -> Vec3<f32> {
        warp::uniform_sphere([self.next(), self.next()])
    }
    fn cosine(&mut self, n: Vec3<f32>) -> Vec3<f32> {
        let w = warp::cosine_hemisphere([self.next(), self.next()]);
        Frame::from_z(n).to_world(LocalDir::new(w))
    }
    fn shuffle<T>(&mut self, v: &mut [T]) {
        for i in (1..v.len()).rev() {
            v.swap(i, (self.bits() % (i as u64 + 1)) as usize);
        }
    }
}

/// Rays of a camera at `eye`, jittered in `n` times `n` pixels, row by row.
pub(crate) fn camera(eye: Vec3<f32>, at: Vec3<f32>, fov_deg: f32, n: usize) -> Vec<Ray> {
    let mut rng = Rng(1);
    let forward = (at - eye).normalized();
    let right = forward.cross(vec3(0.0, 1.0, 0.0)).normalized();
    let up = right.cross(forward);
    let width = Real::tan(0.5 * fov_deg.to_radians());
    let mut rays = Vec::with_capacity(n * n);
    for y in 0..n {
        for x in 0..n {
            let a = ((x as f32 + rng.next()) / n as f32 * 2.0 - 1.0) * width;
            let b = (1.0 - (y as f32 + rng.next()) / n as f32 * 2.0) * width;
            rays.push(Ray::new(eye, (forward + right * a + up * b).normalized()));
        }
    }
    rays
}

/// The points that the rays meet, each with the side of the normal that they came from.
pub(crate) fn points(geometry: &Geometry, rays: &[Ray]) -> Vec<(SurfacePoint, Vec3<f32>)> {
    let point = |ray: &Ray| {
        let s = geometry.surface(ray, &geometry.intersect(ray)?);
        Some((s, s.ng.facing(-ray.d)))
    };
    rays.iter().filter_map(point).collect()
}

/// Diffuse reflections where the rays end.
fn bounced(geometry: &Geometry, rays: &[Ray], seed: u64) -> Vec<Ray> {
    let mut rng = Rng(seed);
    points(geometry, rays).into_iter().map(|(s, n)| s.spawn(rng.cosine(n))).collect()
}

/// Towards a ball of light, from where the rays end.
fn shadow(geometry: &Geometry, rays: &[Ray], light: Vec3<f32>, seed: u64) -> Vec<Ray> {
    let mut rng = Rng(seed);
    points(geometry, rays).into_iter().map(|(s, _)| s.spawn_to(light + rng.sphere())).collect()
}

/// The four sets of rays that a scene is timed with.
pub(crate) struct RaySets {
    pub(crate) camera: Vec<Ray>,
    /// First diffuse bounce, in the order of the camera's rays.
    pub(crate) bounce: Vec<Ray>,
    /// Second and third bounce, in random order.
    pub(crate) shuffled: Vec<Ray>,
    /// Shadow rays of the camera's points and of those of the first bounce.
    pub(crate) shadow: Vec<Ray>,
}

impl RaySets {
    pub(crate) fn new(geometry: &Geometry, camera: Vec<Ray>, light: Vec3<f32>) -> RaySets {
        let bounce = bounced(geometry, &camera, 2);
        let mut shuffled = bounced(geometry, &bounce, 3);
        shuffled.extend(bounced(geometry, &shuffled, 4));
        Rng(9).shuffle(&mut shuffled);
        let mut to_light = shadow(geometry, &camera, light, 5);
        to_light.extend(shadow(geometry, &bounce, light, 6));
        RaySets { camera, bounce, shuffled, shadow: to_light }
    }
    /// Times all sets.
    pub(crate) fn race(&self, tracers: &[Box<dyn Tracer + '_>], rounds: usize) {
        race("camera", tracers, &self.camera, rounds, Query::Closest);
        race("bounce", tracers, &self.bounce, rounds, Query::Closest);
        race("bounces 2 and 3, shuffled", tracers, &self.shuffled, rounds, Query::Closest);
        race("shadow, any hit", tracers, &self.shadow, rounds, Query::Any);
    }
}
