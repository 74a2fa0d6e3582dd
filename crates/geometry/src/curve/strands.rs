//! Strands of control points, and the segments they make: [`Strands`].

use sparrow_math::Vec3;

use super::cubic::Cubic;
use crate::bvh::Pages;
use crate::shape::{CurveBasis, CurveSet};
use crate::simd::prefetch;

/// The point before the first is mirrored: the segment begins its strand.
const FIRST: u32 = 1 << 31;
/// The point behind the last is mirrored: the segment ends its strand.
const LAST: u32 = 1 << 30;
const POINT: u32 = LAST - 1;

/// Control points with a list of segments: at most 20 bytes for each point.
#[derive(Debug)]
pub(super) struct Strands {
    points: Pages<[f32; 4]>,
    /// The first control point of each segment; of a Catmull-Rom spline the point where it begins, with marks.
    segments: Vec<u32>,
    /// The first segment of each strand, and their number.
    first: Vec<u32>,
    basis: CurveBasis,
}

/// Where control points are found.
pub(super) trait ControlPoints {
    /// Those from number `i` on.
    fn at<const N: usize>(&self, i: usize) -> [[f32; 4]; N];
}

impl ControlPoints for [[f32; 4]] {
    #[inline(always)]
    fn at<const N: usize>(&self, i: usize) -> [[f32; 4]; N] {
        let mut p = [[0.0; 4]; N];
        p.copy_from_slice(&self[i..i + N]);
        p
    }
}

/// Segments of a strand of `n` points.
fn n_segments(basis: CurveBasis, n: usize) -> usize {
    match basis {
        CurveBasis::Linear | CurveBasis::CatmullRom => n.saturating_sub(1),
        CurveBasis::Bezier => n.saturating_sub(1) / 3,
        CurveBasis::BSpline => n.saturating_sub(3),
    }
}

impl Strands {
    /// Strands out of order, or too short for a segment, and points beyond the first 2^30 have no segments.
    pub(super) fn new(set: &mut CurveSet) -> Strands {
        let points = core::mem::take(&mut set.points);
        let n_points = points.len().min(POINT as usize);
        let (mut segments, mut first) = (Vec::new(), Vec::with_capacity(set.strands.len() + 1));
        for (i, &start) in set.strands.iter().enumerate() {
            first.push(segments.len() as u32);
            let end = set.strands.get(i + 1).map_or(n_points, |&e| (e as usize).min(n_points));
            let n = n_segments(set.basis, end.saturating_sub(start as usize)) as u32;
            let step = if set.basis == CurveBasis::Bezier { 3 } else { 1 };
            segments.extend((0..n).map(|k| start + step * k));
            if let (CurveBasis::CatmullRom, [a, .., b]) = (set.basis, &mut segments[first[i] as usize..]) {
                *a |= FIRST;
                *b |= LAST;
            } else if let (CurveBasis::CatmullRom, [one]) = (set.basis, &mut segments[first[i] as usize..]) {
                *one |= FIRST | LAST;
            }
        }
        first.push(segments.len() as u32);
        segments.shrink_to_fit();
        Strands { points: points.into(), segments, first, basis: set.basis }
    }

    pub(super) fn n_segments(&self) -> usize {
        self.segments.len()
    }
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.points) + size_of_val(&*self.segments) + size_of_val(&*self.first)
    }

    /// The strand of a segment, and its place among those of the strand: which, and of how many.
    pub(super) fn in_strand(&self, segment: u32) -> (usize, u32, u32) {
        let strand = self.first.partition_point(|&f| f <= segment) - 1;
        let (start, end) = (self.first[strand], self.first[strand + 1]);
        (strand, segment - start, end - start)
    }

    /// A segment in the common form.
    pub(super) fn cubic(&self, segment: u32) -> Cubic {
        self.cubic_at(self.place_of(segment))
    }

    /// Where a segment has its control points.
    #[inline(always)]
    pub(super) fn place_of(&self, segment: u32) -> u32 {
        self.segments[segment as usize]
    }

    /// The segment with its control points at that place.
    #[inline(always)]
    pub(super) fn cubic_at(&self, s: u32) -> Cubic {
        self.cubic_of(s, &*self.points)
    }
    /// The same with other control points in these places.
    #[inline(always)]
    pub(super) fn cubic_of(&self, s: u32, points: &(impl ControlPoints + ?Sized)) -> Cubic {
        let i = (s & POINT) as usize;
        let p = match self.basis {
            CurveBasis::Linear => {
                let [a, b] = points.at(i);
                [a, b, b, b]
            }
            CurveBasis::Bezier | CurveBasis::BSpline => points.at(i),
            CurveBasis::CatmullRom => {
                let [a, b] = points.at(i);
                let mirrored = |a: [f32; 4], b: [f32; 4]| {
                    [2.0 * a[0] - b[0], 2.0 * a[1] - b[1], 2.0 * a[2] - b[2], 2.0 * a[3] - b[3]]
                };
                let one = |i: usize| {
                    let [p] = points.at(i);
                    p
                };
                let before = if s & FIRST != 0 { mirrored(a, b) } else { one(i - 1) };
                let behind = if s & LAST != 0 { mirrored(b, a) } else { one(i + 2) };
                [before, a, b, behind]
            }
        };
        Cubic::new(self.basis, &p)
    }
    /// All control points.
    pub(super) fn points(&self) -> &[[f32; 4]] {
        &self.points
    }

    /// Of a list with one for each end of a segment, those of one.
    pub(super) fn normals_of(&self, segment: u32, normals: &[[f32; 3]]) -> [[f32; 3]; 2] {
        let at = segment as usize + self.in_strand(segment).0;
        [normals[at], normals[at + 1]]
    }

    /// Asks for the points at a place ahead of their use.
    #[inline(always)]
    pub(super) fn ahead(&self, place: u32) {
        let i = (place & POINT) as usize;
        prefetch(&self.points, i);
        prefetch(&self.points, i + 3);
    }

    /// The segment can be hit: numbers are finite, it has a length, and somewhere a radius.
    pub(super) fn is_usable(&self, segment: u32) -> bool {
        is_usable(&self.cubic(segment))
    }
}

/// Such a segment can be hit.
pub(super) fn is_usable(c: &Cubic) -> bool {
    let moves = c.a[1..].iter().any(|a| Vec3::from([a[0], a[1], a[2]]).length2() > 0.0);
    let finite = c.a.iter().flatten().chain(&c.anchor).all(|v| v.is_finite());
    moves && finite && c.reach().is_finite() && c.largest_radius() > 0.0
}
