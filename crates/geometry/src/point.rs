//! Points on surfaces: [`SurfacePoint`], met by a ray, and [`ShapeSample`], drawn at random.

use sparrow_math::Vec3;

use crate::ray::{Hit, Ray};

/// How far from the target a shadow ray ends, relative to its length; pbrt-v4's value.
const SHADOW_GAP: f32 = 1e-4;

/// The surface where a ray met it.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// The point.
    pub p: Vec3<f32>,
    /// Bound of the rounding error of `p`, component by component.
    pub p_error: Vec3<f32>,
    /// Unit geometric normal; on the side of `ns` where the mesh has normals.
    pub ng: Vec3<f32>,
    /// Unit shading normal.
    pub ns: Vec3<f32>,
    /// Derivative of the point by the first texture coordinate.
    pub dpdu: Vec3<f32>,
    /// Derivative of the point by the second texture coordinate.
    pub dpdv: Vec3<f32>,
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// Shading tangent, perpendicular to `ns`, not of unit length: after `dpdu` or the mesh's own tangents.
    pub tangent: Vec3<f32>,
    /// Number of the shape.
    pub shape: u32,
    /// Number of the primitive in its shape.
    pub prim: u32,
    /// When the ray met it; rays that leave it have the same time.
    pub time: f32,
}

/// Adding this part of a number to its magnitude gives the next number, taking it away the one before: it is a little
/// more than half of their distance, and never more than one and a half.
const ULP: f32 = 0.5 * f32::EPSILON * (1.0 + f32::EPSILON);

/// Moves `p` along the unit normal `n`, to the side of `w`, beyond its rounding error. [PharrJakobHumphreys2023, section 6.8.6]
#[inline]
pub(crate) fn offset_point(p: Vec3<f32>, p_error: Vec3<f32>, n: Vec3<f32>, w: Vec3<f32>) -> Vec3<f32> {
    let d = n.abs().dot(p_error);
    let offset = n * if w.dot(n) < 0.0 { -d } else { d };
    // A step of one unit in the last place outwards; no step where there is no offset. A sum that is zero is exact.
    let away = |p: f32, o: f32| {
        let q = p + o;
        let step = q + (q * ULP).copysign(o);
        if o == 0.0 { p } else { step }
    };
    sparrow_math::vec3(away(p.x, offset.x), away(p.y, offset.y), away(p.z, offset.z))
}

impl SurfacePoint {
    /// What a hit that this geometry cannot have given is answered with.
    pub(crate) fn nowhere(ray: &Ray, hit: &Hit) -> SurfacePoint {
        let (zero, back) = (Vec3::splat(0.0), (-ray.d).normalized());
        SurfacePoint {
            p: ray.at(hit.t),
            p_error: zero,
            ng: back,
            ns: back,
            dpdu: zero,
            dpdv: zero,
            uv: [hit.u, hit.v],
            tangent: zero,
            shape: hit.shape,
            prim: hit.prim,
            time: ray.time,
        }
    }
    /// Offset across the fibre, in [-1, 1], for points of curves: the sine of the angle from the direction the ray came
    /// from to the outward normal, around the tangent. pbrt-v4's `h`.
    #[inline]
    pub fn h(&self) -> f32 {
        2.0 * self.uv[1] - 1.0
    }
    /// The ray that leaves in direction `d` and does not meet its own surface again through rounding.
    #[inline]
    pub fn spawn(&self, d: Vec3<f32>) -> Ray {
        Ray { time: self.time, ..Ray::new(offset_point(self.p, self.p_error, self.ng, d), d) }
    }
    /// The shadow ray to a point in space; it ends just before.
    #[inline]
    pub fn spawn_to(&self, p: Vec3<f32>) -> Ray {
        let o = offset_point(self.p, self.p_error, self.ng, p - self.p);
        Ray { o, d: p - o, t_max: 1.0 - SHADOW_GAP, time: self.time }
    }
    /// The shadow ray to a point of another surface; it ends just before, and beside that surface's rounding error.
    #[inline]
    pub fn spawn_to_sample(&self, s: &ShapeSample) -> Ray {
        let o = offset_point(self.p, self.p_error, self.ng, s.p - self.p);
        let p = offset_point(s.p, s.p_error, s.n, o - s.p);
        Ray { o, d: p - o, t_max: 1.0 - SHADOW_GAP, time: self.time }
    }
}

/// A point drawn on a primitive.
#[derive(Clone, Copy, Debug)]
pub struct ShapeSample {
    /// The point.
    pub p: Vec3<f32>,
    /// Bound of the rounding error of `p`, component by component.
    pub p_error: Vec3<f32>,
    /// Unit geometric normal, on the side [`SurfacePoint::ng`] has there.
    pub n: Vec3<f32>,
    /// Unit direction from the observer to the point; zero where there is no observer.
    pub wi: Vec3<f32>,
    /// Distance to the observer; zero where there is none.
    pub distance: f32,
    /// Density: per steradian at the observer, or per area where there is none.
    pub pdf: f32,
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::vec3;

    /// Where the offset itself is lost in rounding, the step to the next number remains.
    #[test]
    fn offsets_are_never_lost() {
        for i in 0..20_000_u32 {
            let x = f32::from_bits(0x3000_0000 + i * 40_009) * if i % 2 == 0 { 1.0 } else { -1.0 };
            let p = vec3(x, 0.0, x);
            let tiny = vec3(1e-30, 0.0, 0.0);
            let n = vec3(1.0, 0.0, 0.0);
            let (out, back) = (offset_point(p, tiny, n, n), offset_point(p, tiny, n, -n));
            assert_eq!((out.x, back.x), (x.next_up(), x.next_down()));
            assert_eq!((out.y, out.z), (0.0, x));
        }
    }
}
