//! What the world knows of a point on a curve.

use core::f64::consts::FRAC_PI_2;

use sparrow_math::{Real, Vec3};

use super::cubic::{Cubic, CubicPoint};
use super::strip::slerp_weights;
use super::{Curves, EndNormals};
use crate::point::SurfacePoint;
use crate::ray::{Hit, Ray};
use crate::shape::CurveKind;

/// Rounding errors of a tube's points, as a part of the segment's size: some ten operations in single precision.
const LOCAL_ERROR: f32 = 16.0 * f32::EPSILON;

/// Directions at a point of a curve, all of unit length, and its error.
struct Local {
    p: Vec3<f64>,
    p_error: Vec3<f32>,
    n: Vec3<f64>,
    /// Where the offset grows.
    across: Vec3<f64>,
}

/// `v` without its part along the unit vector `t`, of unit length; `None` where nothing is left.
fn perpendicular(v: Vec3<f64>, t: Vec3<f64>) -> Option<Vec3<f64>> {
    let v = v - t * v.dot(t);
    (v.length2() > 1e-20).then(|| v.normalized())
}

/// What a segment's surface follows from.
pub(super) struct Segment {
    pub(super) cubic: Cubic,
    pub(super) kind: CurveKind,
    /// Of ribbons.
    pub(super) ends: EndNormals,
    /// Its place in its strand: which, and of how many.
    pub(super) place: (u32, u32),
}

impl Curves {
    /// The surface at a hit, as of a [`Segment`].
    pub(crate) fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let (_, i, n) = self.strands.in_strand(hit.prim);
        let is_ribbon = self.kind == CurveKind::Ribbon;
        let ends = if is_ribbon { self.end_normals(hit.prim) } else { EndNormals::default() };
        let cubic = self.strands.cubic(hit.prim);
        Segment { cubic, kind: self.kind, ends, place: (i, n) }.surface(ray, hit)
    }

    /// Area of a segment's surface: of a strip seen face on, or of a tube without ends. To about three digits.
    pub(crate) fn area(&self, segment: u32) -> f32 {
        if (segment as usize) >= self.len() || !self.strands.is_usable(segment) {
            return 0.0;
        }
        area(&self.strands.cubic(segment), self.kind)
    }
}

/// Area of a segment's surface: of a strip seen face on, or of a tube without ends. To about three digits.
pub(super) fn area(c: &Cubic, kind: CurveKind) -> f32 {
    const N: u32 = 16;
    let mid = |i: u32| (f64::from(i) + 0.5) / f64::from(N);
    let length = |p: CubicPoint| p.dp.length() * p.r;
    let half = (0..N).map(|i| length(c.at(mid(i)))).sum::<f64>() / f64::from(N);
    let around = if kind == CurveKind::Round { core::f64::consts::TAU } else { 2.0 };
    (around * half) as f32
}

impl Segment {
    /// The surface at a hit: `dpdu` runs along the strand, from 0 at its root to 1 at its tip; the second coordinate
    /// is `(1 + h) / 2`.
    pub(super) fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let c = self.cubic.at(f64::from(hit.u));
        let (i, n) = self.place;
        let d = ray.d.to_f64().normalized();
        let t = perpendicular(c.dp, Vec3::splat(0.0)).unwrap_or(d);
        let facing = perpendicular(-d, t).unwrap_or_else(|| sparrow_math::Frame::from_z(t).x);
        let h = 2.0 * f64::from(hit.v) - 1.0;
        let local = match self.kind {
            CurveKind::Round => self.on_tube(ray, hit, &c, t, facing),
            CurveKind::Flat | CurveKind::Cylinder | CurveKind::Ribbon => {
                self.on_strip(ray, hit, &c, t, facing, h)
            }
        };
        let (ng, dpdu) = (local.n.to_f32(), (c.dp * f64::from(n)).to_f32());
        SurfacePoint {
            p: local.p.to_f32(),
            p_error: local.p_error,
            ng,
            ns: ng,
            dpdu,
            dpdv: (local.across * (2.0 * c.r)).to_f32(),
            uv: [(i as f32 + hit.u) / n as f32, hit.v],
            tangent: t.to_f32(),
            shape: hit.shape,
            prim: hit.prim,
            time: 0.0,
        }
    }

    /// A strip has no thickness of its own. Rays that leave it start a width away, as in pbrt-v4, so that none meets
    /// the strip that the same fibre turns towards it.
    fn on_strip(
        &self,
        ray: &Ray,
        hit: &Hit,
        c: &CubicPoint,
        t: Vec3<f64>,
        facing: Vec3<f64>,
        h: f64,
    ) -> Local {
        let across = t.cross(facing);
        let (n, seen) = match self.kind {
            CurveKind::Cylinder => {
                // By 90 degrees at the edges and in proportion between, as in pbrt-v4: not by asin h.
                let (s, c) = Real::sin_cos(h * FRAC_PI_2);
                (facing * c + across * s, 1.0)
            }
            CurveKind::Ribbon => {
                let EndNormals { n: [n0, n1], angle } = self.ends;
                let [a, b] = slerp_weights(angle, f64::from(hit.u));
                let n = n0.to_f64() * a + n1.to_f64() * b;
                (perpendicular(n, t).unwrap_or(facing), n.dot(ray.d.to_f64().normalized()).abs().min(1.0))
            }
            CurveKind::Flat | CurveKind::Round => (facing, 1.0),
        };
        let p = ray.o.to_f64() + ray.d.to_f64() * f64::from(hit.t);
        let width = (2.0 * c.r * seen) as f32;
        let p_error = p.to_f32().abs() * f32::EPSILON + Vec3::splat(width);
        Local { p, p_error, n, across }
    }

    fn on_tube(&self, ray: &Ray, hit: &Hit, c: &CubicPoint, t: Vec3<f64>, facing: Vec3<f64>) -> Local {
        let from_axis = ray.o.to_f64() + ray.d.to_f64() * f64::from(hit.t) - c.p;
        let out = perpendicular(from_axis, t).unwrap_or(facing);
        let p = c.p + out * c.r;
        let speed2 = c.dp.length2();
        // The rate of the radius along the outline, which is longer or shorter than the axis where that bends.
        let along = speed2 - c.r * out.dot(c.ddp);
        let slope = if along > 0.0 { c.dr * speed2.sqrt() / along } else { 0.0 };
        let p_error = p.to_f32().abs() * f32::EPSILON + Vec3::splat(LOCAL_ERROR * self.cubic.reach());
        Local { p, p_error, n: (out - t * slope).normalized(), across: t.cross(out) }
    }
}
