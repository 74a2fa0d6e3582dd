//! [`Ray`]s and what they meet: [`Hit`].

use sparrow_math::Vec3;

/// The points `o + t d` with `0 < t < t_max`; `d` need not be of unit length.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Ray {
    /// Origin.
    pub o: Vec3<f32>,
    /// Direction.
    pub d: Vec3<f32>,
    /// Where it ends, in units of `d`; the end does not belong to it.
    pub t_max: f32,
    /// When: 0 where motion starts, 1 where it ends.
    pub time: f32,
}

impl Ray {
    /// A ray without end, at time 0.
    #[inline]
    pub fn new(o: Vec3<f32>, d: Vec3<f32>) -> Ray {
        Ray { o, d, t_max: f32::INFINITY, time: 0.0 }
    }
    /// The numbers of rays, each in the order of its fields.
    #[inline(always)]
    #[allow(unsafe_code, reason = "rays in lanes are read and written as rows")]
    pub fn rows(rays: &[Ray]) -> &[[f32; 8]] {
        // SAFETY: a ray is laid out as in C and is eight `f32`, so as many rows lie there.
        unsafe { core::slice::from_raw_parts(rays.as_ptr().cast(), rays.len()) }
    }
    /// [`rows`](Self::rows), to be written.
    #[inline(always)]
    #[allow(unsafe_code, reason = "rays in lanes are read and written as rows")]
    pub fn rows_mut(rays: &mut [Ray]) -> &mut [[f32; 8]] {
        // SAFETY: as above; any eight numbers are a ray.
        unsafe { core::slice::from_raw_parts_mut(rays.as_mut_ptr().cast(), rays.len()) }
    }
    /// Its numbers in the order of the fields.
    #[inline(always)]
    pub(crate) fn row(&self) -> &[f32; 8] {
        &Ray::rows(core::slice::from_ref(self))[0]
    }
    /// The point at parameter `t`.
    #[inline]
    pub fn at(&self, t: f32) -> Vec3<f32> {
        self.o + self.d * t
    }
}

/// Where a ray meets a primitive.
// As large as a power of two, so that lists of hits are looked up in quickly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(16))]
pub struct Hit {
    /// Parameter along the ray.
    pub t: f32,
    /// Number of the shape, in the order given to [`Geometry::build`](crate::Geometry::build).
    pub shape: u32,
    /// Number of the primitive in its shape; 0 for quadrics.
    pub prim: u32,
    /// Barycentric weight of the second corner; first parameter of a patch or a curve's
    /// segment; 0 for quadrics, whose texture
    /// coordinates [`Geometry::surface`](crate::Geometry::surface) works out.
    pub u: f32,
    /// Barycentric weight of the third corner; second parameter of a patch or segment; 0 for
    /// quadrics.
    pub v: f32,
    /// The instance it belongs to; none for shapes of the world.
    pub instance: Option<u32>,
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "the numbers are copied")]
mod tests {
    use sparrow_math::vec3;

    use super::*;

    #[test]
    fn rows_are_the_fields() {
        const _: () = assert!(size_of::<Ray>() == size_of::<[f32; 8]>());
        let ray = |x: f32| Ray {
            t_max: x + 6.0,
            time: x + 7.0,
            ..Ray::new(vec3(x, x + 1.0, x + 2.0), vec3(x + 3.0, x + 4.0, x + 5.0))
        };
        let mut rays = [ray(0.0), ray(10.0)];
        assert_eq!(Ray::rows(&rays), [[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0], *ray(10.0).row()]);
        Ray::rows_mut(&mut rays)[1][4] = 99.0;
        assert_eq!(rays[1].d.y, 99.0);
    }
}
