//! Points on surfaces: [`SurfacePoint`], met by a ray, and [`ShapeSample`], drawn at random.

use sparrow_math::{Real, Vec3, vec3};

use crate::ray::{Hit, Ray};

/// Where a shadow ray ends, as a share of the way to its target; pbrt-v4's value.
pub const SHADOW_END: f32 = 1.0 - 1e-4;

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

/// A point of a surface as arithmetic has it: for one point or for lanes of them.
#[derive(Clone, Copy, Debug)]
pub struct RoundedPoint<R> {
    /// The point.
    pub p: Vec3<R>,
    /// Bound of its rounding error, component by component.
    pub p_error: Vec3<R>,
    /// Unit geometric normal.
    pub n: Vec3<R>,
}

impl<R: Real> RoundedPoint<R> {
    /// A point in space, of no surface.
    #[inline(always)]
    pub fn exact(p: Vec3<R>) -> Self {
        RoundedPoint { p, p_error: Vec3::splat(R::ZERO), n: Vec3::splat(R::ZERO) }
    }
    /// The point, moved along the normal to the side of `w`, beyond its rounding error. [PharrJakobHumphreys2023, section 6.8.6]
    #[inline(always)]
    pub fn towards(&self, w: Vec3<R>) -> Vec3<R> {
        let RoundedPoint { p, p_error, n } = *self;
        let d = n.abs().dot(p_error);
        let offset = n * R::select(w.dot(n).lt(R::ZERO), -d, d);
        vec3(step_away(p.x, offset.x), step_away(p.y, offset.y), step_away(p.z, offset.z))
    }
    /// The shadow ray to another point, beside the rounding errors of both: origin, and direction of the length from end to end.
    /// It runs to [`SHADOW_END`].
    #[inline(always)]
    pub fn segment_to(&self, end: &RoundedPoint<R>) -> (Vec3<R>, Vec3<R>) {
        let o = self.towards(end.p - self.p);
        (o, end.towards(o - end.p) - o)
    }
}

/// `p + o`, and a step of one unit in the last place further; no step where there is no offset. A sum that is zero is exact.
#[inline(always)]
fn step_away<R: Real>(p: R, o: R) -> R {
    let q = p + o;
    let step = q + (q * R::of(f64::from(ULP))).copysign(o);
    R::select(o.abs().gt(R::ZERO), step, p)
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
    /// Its place.
    #[inline]
    pub fn rounded(&self) -> RoundedPoint<f32> {
        RoundedPoint { p: self.p, p_error: self.p_error, n: self.ng }
    }
    /// The ray that leaves in direction `d` and does not meet its own surface again through rounding.
    #[inline]
    pub fn spawn(&self, d: Vec3<f32>) -> Ray {
        Ray { time: self.time, ..Ray::new(self.rounded().towards(d), d) }
    }
    /// The shadow ray to a point in space; it ends just before.
    #[inline]
    pub fn spawn_to(&self, p: Vec3<f32>) -> Ray {
        self.segment(&RoundedPoint::exact(p))
    }
    /// The shadow ray to a point of another surface; it ends just before, and beside that surface's rounding error.
    #[inline]
    pub fn spawn_to_sample(&self, s: &ShapeSample) -> Ray {
        self.segment(&RoundedPoint { p: s.p, p_error: s.p_error, n: s.n })
    }
    #[inline]
    fn segment(&self, end: &RoundedPoint<f32>) -> Ray {
        let (o, d) = self.rounded().segment_to(end);
        Ray { o, d, t_max: SHADOW_END, time: self.time }
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

    /// Where the offset itself is lost in rounding, the step to the next number remains.
    #[test]
    fn offsets_are_never_lost() {
        for i in 0..20_000_u32 {
            let x = f32::from_bits(0x3000_0000 + i * 40_009) * if i % 2 == 0 { 1.0 } else { -1.0 };
            let p = vec3(x, 0.0, x);
            let tiny = vec3(1e-30, 0.0, 0.0);
            let n = vec3(1.0, 0.0, 0.0);
            let point = RoundedPoint { p, p_error: tiny, n };
            let (out, back) = (point.towards(n), point.towards(-n));
            assert_eq!((out.x, back.x), (x.next_up(), x.next_down()));
            assert_eq!((out.y, out.z), (0.0, x));
        }
    }
}
