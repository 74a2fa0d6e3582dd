//! Whole spheres that stay spheres in the world: [`Ball`].

use sparrow_math::Vec3;

use crate::ray::Ray;
use crate::sample;

/// Centre and radius in world space: such a sphere needs no object space to be met.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    pub(super) center: Vec3<f64>,
    pub(super) radius: f64,
    /// Over the radius in object space.
    pub(super) scale: f64,
    /// The same for directions drawn to it.
    pub(super) single: sample::Ball,
}

impl Ball {
    pub(super) fn new(center: Vec3<f64>, object_radius: f64, scale: f64) -> Ball {
        let radius = object_radius * scale;
        Ball { center, radius, scale, single: sample::Ball::new(center, radius) }
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
        let r2 = self.radius * self.radius;
        let (a, b, c) = (d.length2(), o.dot(d), o.length2() - r2);
        if c > 0.0 && b >= 0.0 {
            return None;
        }
        // The vector product is the distance of the line times |d|; it keeps its digits where b^2 - a c does not.
        let disc = a * r2 - o.cross(d).length2();
        if !(disc >= 0.0 && a > 0.0) {
            return None;
        }
        let q = -(b + disc.sqrt().copysign(b));
        let (x, y) = (q / a, c / q);
        Some(if b < 0.0 { [y, x] } else { [x, y] })
    }
    /// The unit vector from the centre to where the ray meets the sphere close to `t`.
    #[inline]
    pub(super) fn outward(&self, ray: &Ray, t: f32) -> Vec3<f64> {
        let t = f64::from(t);
        // The root itself, not its rounded value, which may lie far off the surface.
        let t = match self.roots(ray) {
            Some([near, far]) if (near - t).abs() < (far - t).abs() => near,
            Some([_, far]) => far,
            None => t,
        };
        let (o, d) = self.line(ray);
        (o + d * t).normalized()
    }
}
