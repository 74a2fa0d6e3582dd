//! A segment as a ray sees it: [`RayFrame`], [`RayCubic`].

use sparrow_math::{Frame, Real, Vec3};

use super::cubic::Cubic;
use crate::ray::Ray;

/// What the tests of segments need of a ray, worked out once a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayFrame {
    o: Vec3<f64>,
    d: Vec3<f64>,
    inv_d2: f64,
    pub(super) inv_length: f32,
    /// The map to the frame of the ray, by columns; radii pass unchanged.
    columns: [[f32; 4]; 4],
    /// The direction of the ray.
    pub(super) z: Vec3<f32>,
}

impl RayFrame {
    #[inline(always)]
    pub(super) fn new(ray: &Ray) -> RayFrame {
        let d = ray.d.to_f64();
        let inv_length = 1.0 / ray.d.length();
        let Frame { x, y, z } = Frame::from_z(ray.d * inv_length);
        RayFrame {
            o: ray.o.to_f64(),
            d,
            inv_d2: 1.0 / d.length2(),
            inv_length,
            columns: [[x.x, y.x, z.x, 0.0], [x.y, y.y, z.y, 0.0], [x.z, y.z, z.z, 0.0], [0.0, 0.0, 0.0, 1.0]],
            z,
        }
    }
    #[inline(always)]
    fn turned(&self, v: [f32; 4]) -> [f32; 4] {
        let mut out = [0.0; 4];
        for (v, column) in v.iter().zip(&self.columns) {
            for (out, c) in out.iter_mut().zip(column) {
                *out += c * v;
            }
        }
        out
    }
}

/// A segment in the frame of a ray that runs along z, through the point nearest to the segment's anchor.
///
/// That point is found in double precision, so the distance of the origin leaves no rounding error.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayCubic {
    /// As in [`Cubic`].
    a: [[f32; 4]; 4],
    /// The ray's parameter where z is zero.
    pub(super) t: f32,
}

/// Points of a segment, one a lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct LanePoint<R> {
    pub(super) x: R,
    pub(super) y: R,
    pub(super) z: R,
    pub(super) r: R,
}

/// Points of a segment with derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneJet<R> {
    pub(super) p: LanePoint<R>,
    pub(super) d: LanePoint<R>,
    pub(super) dd: LanePoint<R>,
}

impl RayCubic {
    #[inline(always)]
    pub(super) fn new(c: &Cubic, r: &RayFrame) -> RayCubic {
        let q = Vec3::from(c.anchor).to_f64() - r.o;
        let t = q.dot(r.d) * r.inv_d2;
        let q = (q - r.d * t).to_f32();
        let [mut a, b, c, d] = c.a;
        for (a, q) in a.iter_mut().zip([q.x, q.y, q.z]) {
            *a += q;
        }
        RayCubic { a: [r.turned(a), r.turned(b), r.turned(c), r.turned(d)], t: t as f32 }
    }

    /// A bound of the second derivative across the ray, squared.
    #[inline(always)]
    pub(super) fn bend2(&self) -> f32 {
        let along = |c: f32, d: f32| (2.0 * c).abs().max((2.0 * c + 6.0 * d).abs());
        let x = along(self.a[2][0], self.a[3][0]);
        let y = along(self.a[2][1], self.a[3][1]);
        x * x + y * y
    }

    /// Coefficients of a coordinate.
    #[inline(always)]
    fn of<R: Real>(&self, i: usize) -> [R; 4] {
        let [a, b, c, d] = &self.a;
        [R::of(f64::from(a[i])), R::of(f64::from(b[i])), R::of(f64::from(c[i])), R::of(f64::from(d[i]))]
    }
    #[inline(always)]
    fn each<R: Real>(&self, f: impl Fn([R; 4]) -> R) -> LanePoint<R> {
        LanePoint { x: f(self.of(0)), y: f(self.of(1)), z: f(self.of(2)), r: f(self.of(3)) }
    }
    #[inline(always)]
    pub(super) fn at<R: Real>(&self, u: R) -> LanePoint<R> {
        self.each(
            #[inline(always)]
            |[a, b, c, d]| a + u * (b + u * (c + u * d)),
        )
    }
    #[inline(always)]
    pub(super) fn jet<R: Real>(&self, u: R) -> LaneJet<R> {
        let (two, three, six) = (R::of(2.0), R::of(3.0), R::of(6.0));
        LaneJet {
            p: self.at(u),
            d: self.each(
                #[inline(always)]
                |[_, b, c, d]| b + u * (two * c + u * (three * d)),
            ),
            dd: self.each(
                #[inline(always)]
                |[_, _, c, d]| two * c + u * (six * d),
            ),
        }
    }
}
