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
    pub(super) frame: Frame<f32>,
}

impl RayFrame {
    #[inline(always)]
    pub(super) fn new(ray: &Ray) -> RayFrame {
        let d = ray.d.to_f64();
        let inv_d2 = 1.0 / d.length2();
        let inv_length = inv_d2.sqrt();
        let z = (d * inv_length).to_f32();
        RayFrame { o: ray.o.to_f64(), d, inv_d2, inv_length: inv_length as f32, frame: Frame::from_z(z) }
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
        let turned = |[x, y, z, radius]: [f32; 4], by: Vec3<f32>| {
            let v = by + Vec3 { x, y, z };
            [v.dot(r.frame.x), v.dot(r.frame.y), v.dot(r.frame.z), radius]
        };
        let zero = Vec3::splat(0.0);
        let [a, b, c, d] = c.a;
        RayCubic { a: [turned(a, q), turned(b, zero), turned(c, zero), turned(d, zero)], t: t as f32 }
    }

    /// A bound of the second derivative across the ray, squared.
    #[inline(always)]
    pub(super) fn bend2(&self) -> f32 {
        let [x, y] = [0, 1].map(|i| {
            let (c, d) = (2.0 * self.a[2][i], 6.0 * self.a[3][i]);
            c.abs().max((c + d).abs())
        });
        x * x + y * y
    }

    #[inline(always)]
    fn each<R: Real>(&self, f: impl Fn(R, R, R, R) -> R) -> LanePoint<R> {
        let at = |i: usize| {
            let c = |k: usize| R::of(f64::from(self.a[k][i]));
            f(c(0), c(1), c(2), c(3))
        };
        LanePoint { x: at(0), y: at(1), z: at(2), r: at(3) }
    }
    #[inline(always)]
    pub(super) fn at<R: Real>(&self, u: R) -> LanePoint<R> {
        self.each(
            #[inline(always)]
            |a, b, c, d| a + u * (b + u * (c + u * d)),
        )
    }
    #[inline(always)]
    pub(super) fn jet<R: Real>(&self, u: R) -> LaneJet<R> {
        let (two, three, six) = (R::of(2.0), R::of(3.0), R::of(6.0));
        LaneJet {
            p: self.at(u),
            d: self.each(
                #[inline(always)]
                |_, b, c, d| b + u * (two * c + u * (three * d)),
            ),
            dd: self.each(
                #[inline(always)]
                |_, _, c, d| two * c + u * (six * d),
            ),
        }
    }
}
