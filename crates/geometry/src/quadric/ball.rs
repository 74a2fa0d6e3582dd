//! Whole spheres that stay spheres in the world: [`Ball`].

use sparrow_math::Vec3;

use crate::ray::Ray;
use crate::sample;

/// Centre and radius in world space: such a sphere needs no object space to be met.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    pub(super) center: Vec3<f64>,
    pub(super) radius: f64,
    pub(super) object_radius: f64,
    /// The radius over that in object space.
    pub(super) scale: f64,
    /// The same for directions drawn to it.
    pub(super) single: sample::Ball,
}

impl Ball {
    pub(super) fn new(center: Vec3<f64>, object_radius: f64, scale: f64) -> Ball {
        let radius = object_radius * scale;
        Ball { center, radius, object_radius, scale, single: sample::Ball::new(center, radius) }
    }
    /// The origin of the ray, seen from the centre, and its direction.
    #[inline(always)]
    fn line(&self, ray: &Ray) -> (Vec3<f64>, Vec3<f64>) {
        (ray.o.to_f64() - self.center, ray.d.to_f64())
    }
    /// Where the ray's line meets the sphere, in order; `None` where it does not, or only behind the origin.
    #[inline(always)]
    pub(super) fn roots(&self, ray: &Ray) -> Option<[f64; 2]> {
        let (o, d) = self.line(ray);
        let line = Line::new(o, d, self.radius);
        if line.goes_away() || !line.meets() {
            return None;
        }
        let [x, y] = line.roots();
        Some(if line.b < 0.0 { [y, x] } else { [x, y] })
    }
    /// The same without a branch, so that loops run in lanes; not numbers where it does not, and nothing positive where it does behind the
    /// origin.
    #[inline(always)]
    pub(super) fn roots_or_nan(&self, ray: &Ray) -> [f64; 2] {
        let (o, d) = self.line(ray);
        let line = Line::new(o, d, self.radius);
        let [x, y] = line.roots();
        if line.b < 0.0 { [y, x] } else { [x, y] }
    }
    /// The unit vector from the centre to where the ray meets the sphere close to `t`.
    // Without a branch, so that loops run in lanes.
    #[inline(always)]
    pub(super) fn outward(&self, ray: &Ray, t: f32) -> Vec3<f64> {
        let ((o, d), t) = (self.line(ray), f64::from(t));
        let line = Line::new(o, d, self.radius);
        let [x, y] = line.roots();
        // The root itself, not its rounded value, which may lie far off the surface.
        let root = if (x - t).abs() < (y - t).abs() { x } else { y };
        let t = if line.meets() { root } else { t };
        (o + d * t).normalized()
    }
}

/// `a t^2 + 2 b t + c = 0` where a line meets a sphere around the origin.
struct Line {
    a: f64,
    b: f64,
    c: f64,
    /// `b^2 - a c`
    disc: f64,
}

impl Line {
    #[inline(always)]
    fn new(o: Vec3<f64>, d: Vec3<f64>, radius: f64) -> Line {
        let r2 = radius * radius;
        let (a, b, c) = (d.length2(), o.dot(d), o.length2() - r2);
        // The vector product is the distance of the line times |d|; it keeps its digits where b^2 - a c does not.
        Line { a, b, c, disc: a * r2 - o.cross(d).length2() }
    }
    /// The line begins outside and does not come nearer.
    #[inline(always)]
    fn goes_away(&self) -> bool {
        self.c > 0.0 && self.b >= 0.0
    }
    #[inline(always)]
    fn meets(&self) -> bool {
        self.disc >= 0.0 && self.a > 0.0
    }
    /// The larger in magnitude first; not numbers where it does not meet.
    #[inline(always)]
    fn roots(&self) -> [f64; 2] {
        let q = -(self.b + self.disc.sqrt().copysign(self.b));
        [q / self.a, self.c / q]
    }
}
