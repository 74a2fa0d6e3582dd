//! Curves whose control points move: [`DeformingCurves`].

#[cfg(target_arch = "x86_64")]
use sparrow_math::in_lanes;
use sparrow_math::{Aabb, InLanes, Lanes, Real};

use super::cubic::Cubic;
use super::frame::RayFrame;
use super::pieces::CurveHit;
use super::strands::{ControlPoints, Strands, is_usable};
use super::surface::{self, Segment};
use super::{EndNormals, group, hit_part, kind_of, part_of, split_of};
use crate::bvh::{Kind, MotionBvh, Others, Pages, RawHit};
use crate::instance::padded;
use crate::lerp::Lerp;
use crate::point::SurfacePoint;
use crate::progress::Progress;
use crate::ray::{Hit, Ray};
use crate::shape::{CurveKind, CurveSet};
use crate::simd::Unit;

/// Curves with control points at both ends of their motion. The tree knows pieces of segments by the boxes around them.
#[derive(Debug)]
pub(crate) struct DeformingCurves {
    /// Where motion starts.
    strands: Strands,
    /// Where it ends.
    end: Pages<[f32; 4]>,
    kind: CurveKind,
    /// Of ribbons: unit normals at the ends of segments, where motion starts and where it ends.
    normals: [Vec<[f32; 3]>; 2],
    /// Segments have `2^split` parts.
    split: u32,
    tree: MotionBvh,
    /// Segments that cannot be hit.
    dropped: usize,
    unit: Unit,
}

/// Control points at a time.
struct PointsAt<'a> {
    start: &'a [[f32; 4]],
    end: &'a [[f32; 4]],
    at: Lerp,
}

impl ControlPoints for PointsAt<'_> {
    #[inline(always)]
    fn at<const N: usize>(&self, i: usize) -> [[f32; 4]; N] {
        let (mut p, end): (_, [_; N]) = (self.start.at(i), self.end.at(i));
        for (p, end) in p.iter_mut().zip(end) {
            *p = self.at.array(*p, end);
        }
        p
    }
}

/// The boxes of a piece at both ends, with room for the rounding of control points between them.
fn boxes(ends: &[Cubic; 2], u: [f32; 2]) -> [Aabb; 2] {
    ends.each_ref().map(|c| {
        let b = group::bounds(&c.part(u));
        padded(&b, 8).unwrap_or(b)
    })
}

impl DeformingCurves {
    /// Takes curves with `points_end` as long as `points`. Ribbons without a normal for every end of a segment become flat; those
    /// where motion ends stay as at the start where they are not as many.
    pub(crate) fn new(mut set: CurveSet, progress: &Progress) -> DeformingCurves {
        let strands = Strands::new(&mut set);
        let n = strands.n_segments();
        let (split, kind) = (split_of(&set, n), kind_of(&set, n));
        if set.normals_end.len() != set.normals.len() {
            set.normals_end = set.normals.clone();
        }
        let normals =
            if kind == CurveKind::Ribbon { [set.normals, set.normals_end] } else { Default::default() };
        let end = Pages::from(set.points_end);
        let ends = |segment: u32| {
            let place = strands.place_of(segment);
            [strands.cubic_at(place), strands.cubic_of(place, &*end)]
        };
        // One that has length and radius at one end of the motion has them on the way.
        let finite = |c: &Cubic| c.a.as_flattened().iter().chain(&c.anchor).all(|v| v.is_finite());
        let can_be_hit = |ends: &[Cubic; 2]| {
            ends.iter().all(|c| finite(c) && c.reach().is_finite()) && ends.iter().any(is_usable)
        };
        let usable: Vec<u32> = (0..n as u32).filter(|&s| can_be_hit(&ends(s))).collect();
        let pieces: Vec<u32> =
            usable.iter().flat_map(|&s| (0..1 << split).map(move |i: u32| s << split | i)).collect();
        let boxes = |piece: u32| {
            let (segment, u) = part_of(piece, split);
            boxes(&ends(segment), u)
        };
        let none = |_| [[[f32::NAN; 3]; 3]; 2];
        let tree = MotionBvh::build_motion(Kind::Others, &pieces, boxes, none, progress);
        let dropped = n - usable.len();
        DeformingCurves { strands, end, kind, normals, split, tree, dropped, unit: Unit::choose() }
    }
    /// Segments.
    pub(crate) fn len(&self) -> usize {
        self.strands.n_segments()
    }
    pub(crate) fn dropped(&self) -> usize {
        self.dropped
    }
    pub(crate) fn tree(&self) -> &MotionBvh {
        &self.tree
    }
    pub(crate) fn bytes(&self) -> usize {
        let normals = self.normals.iter().map(|n| size_of_val(&**n)).sum::<usize>();
        self.strands.bytes() + size_of_val(&*self.end) + normals
    }
    pub(crate) fn area(&self, segment: u32) -> f32 {
        if (segment as usize) >= self.len() || !self.strands.is_usable(segment) {
            return 0.0;
        }
        surface::area(&self.strands.cubic(segment), self.kind)
    }
    #[inline(always)]
    fn points_at(&self, at: Lerp) -> PointsAt<'_> {
        PointsAt { start: self.strands.points(), end: &self.end, at }
    }
    #[inline(always)]
    fn cubic_at(&self, segment: u32, at: Lerp) -> Cubic {
        self.strands.cubic_of(self.strands.place_of(segment), &self.points_at(at))
    }
    fn end_normals(&self, segment: u32, at: Lerp) -> EndNormals {
        let [start, end] = self.normals.each_ref().map(|n| self.strands.normals_of(segment, n));
        EndNormals::new([at.array(start[0], end[0]), at.array(start[1], end[1])])
    }

    /// Offers points of the ray before its end to `found`, which answers with the new end.
    pub(crate) fn visit(&self, ray: &Ray, found: impl FnMut(RawHit) -> f32) {
        let seen = Seen { curves: self, frame: RayFrame::new(ray), at: Lerp::at(ray.time) };
        self.tree.visit(ray, &seen, found);
    }
    /// The surface at a hit, as of curves that stand where these are at the ray's time.
    pub(crate) fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let at = Lerp::at(ray.time);
        let (_, i, n) = self.strands.in_strand(hit.prim);
        let is_ribbon = self.kind == CurveKind::Ribbon;
        let ends = if is_ribbon { self.end_normals(hit.prim, at) } else { EndNormals::default() };
        Segment { cubic: self.cubic_at(hit.prim, at), kind: self.kind, ends, place: (i, n) }.surface(ray, hit)
    }
}

/// Curves as a ray sees them at its time.
struct Seen<'a> {
    curves: &'a DeformingCurves,
    frame: RayFrame,
    at: Lerp,
}

impl Seen<'_> {
    /// In lanes that every target has.
    #[inline(never)]
    fn hit_portable(&self, piece: u32, t_max: f32) -> Option<CurveHit> {
        PieceTest { seen: self, piece, t_max }.run::<Lanes<8>>()
    }
    /// In the registers of this processor.
    #[cfg(target_arch = "x86_64")]
    #[inline]
    fn hit_in_lanes(&self, piece: u32, t_max: f32) -> Option<CurveHit> {
        in_lanes(PieceTest { seen: self, piece, t_max })
    }
}

impl Others for Seen<'_> {
    fn hit(&self, piece: u32, _: &Ray, t_max: f32, found: &mut impl FnMut(RawHit) -> f32) -> f32 {
        let hit = match self.curves.unit {
            Unit::Portable => self.hit_portable(piece, t_max),
            #[cfg(target_arch = "x86_64")]
            Unit::Avx2(_) => self.hit_in_lanes(piece, t_max),
        };
        let id = piece >> self.curves.split;
        hit.map_or(t_max, |h| found(RawHit { t: h.t, id, u: h.u, v: 0.5 + 0.5 * h.h }))
    }
}

/// A ray and a piece.
struct PieceTest<'a> {
    seen: &'a Seen<'a>,
    piece: u32,
    t_max: f32,
}

impl InLanes for PieceTest<'_> {
    type Output = Option<CurveHit>;
    #[inline(always)]
    fn run<R: Real>(self) -> Option<CurveHit> {
        let Seen { curves, frame, at } = self.seen;
        let (segment, u) = part_of(self.piece, curves.split);
        let c = curves.cubic_at(segment, *at);
        hit_part::<R>(&c, u, curves.kind, || curves.end_normals(segment, *at), frame, self.t_max)
    }
}
