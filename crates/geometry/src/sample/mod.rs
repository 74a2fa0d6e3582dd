//! Drawing directions to shapes.

mod ball;
mod balls;
mod bilinear;
mod many;
mod rectangle;
mod triangle;
mod viewpoint;

pub(crate) use ball::Ball;
pub use balls::Balls;
pub(crate) use bilinear::Bilinear;
pub(crate) use many::{Draw, Drawn};
pub use many::{PdfColumns, SampleColumns};
pub(crate) use rectangle::{Edges, Rectangle};
pub(crate) use triangle::SphericalTriangle;
pub use viewpoint::Viewpoint;

use sparrow_math::{Real, Vec3, vec3};

use crate::point::ShapeSample;

/// Solid angles for which directions follow the cosine: smaller shapes are seen under one, and of larger ones the corners say
/// little about the middle.
pub(crate) const WARPED: core::ops::RangeInclusive<f64> = 0.1..=3.0;

/// The same vector in every lane.
#[inline(always)]
fn spread<R: Real>(v: Vec3<f32>) -> Vec3<R> {
    vec3(R::of(v.x.into()), R::of(v.y.into()), R::of(v.z.into()))
}

#[inline(always)]
fn spread_all<R: Real>(v: [Vec3<f32>; 3]) -> [Vec3<R>; 3] {
    [spread(v[0]), spread(v[1]), spread(v[2])]
}

/// A density per area at a point, as one per steradian seen from elsewhere; `None` where that is infinite.
pub(crate) fn per_steradian(pdf: f64, from: Vec3<f32>, p: Vec3<f32>, n: Vec3<f32>) -> Option<f32> {
    let d = p.to_f64() - from.to_f64();
    let len2 = d.length2();
    let pdf = (pdf * len2 * len2.sqrt() / d.dot(n.to_f64()).abs()) as f32;
    (len2 > 0.0 && pdf.is_finite()).then_some(pdf)
}

/// The unit direction and the distance from one point to another; `None` where they are the same.
#[inline]
pub(crate) fn direction(from: Vec3<f32>, to: Vec3<f32>) -> Option<(Vec3<f32>, f32)> {
    let d = to.to_f64() - from.to_f64();
    let distance = d.length();
    let inv = 1.0 / distance;
    (inv > 0.0 && inv.is_finite()).then(|| ((d * inv).to_f32(), distance as f32))
}

/// A sample drawn by area, as seen from a point; `None` where it is seen edge-on or lies at that point.
pub(crate) fn seen_from(s: ShapeSample, from: Vec3<f32>) -> Option<ShapeSample> {
    let (wi, distance) = direction(from, s.p)?;
    let pdf = per_steradian(f64::from(s.pdf), from, s.p, s.n)?;
    Some(ShapeSample { wi, distance, pdf, ..s })
}
