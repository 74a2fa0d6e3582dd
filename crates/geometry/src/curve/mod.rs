//! Curves: strips and tubes along splines. What they mean stands in [README.md](README.md).

mod cubic;
mod deforming;
mod frame;
mod group;
mod obb;
mod pieces;
mod strands;
mod strip;
mod surface;
mod tube;

use cubic::Cubic;
pub(crate) use deforming::DeformingCurves;
use frame::{RayCubic, RayFrame};
use obb::{Entries, ObbBlock, WIDTH};
use pieces::{CurveHit, Pieces};
#[cfg(target_arch = "x86_64")]
use sparrow_math::in_lanes;
use sparrow_math::{Aabb, InLanes, Lanes, Real, Vec3};
use strands::Strands;
use strip::Width;

use crate::bvh::{Pages, RawHit};
use crate::progress::Progress;
use crate::ray::Ray;
use crate::shape::{CurveKind, CurveSet};
use crate::simd::{Unit, prefetch};

/// Parts of a segment at most, as a power of two.
const MAX_SPLIT: u32 = 2;
/// Segments a set can number, parts included.
const MAX_SEGMENTS: usize = 1 << 28;

/// Curves ready to be asked. Their primitives are segments; the tree knows them by blocks of eight.
#[derive(Debug)]
pub(crate) struct Curves {
    strands: Strands,
    kind: CurveKind,
    /// Of ribbons: unit normals at the ends of segments, one more a strand than it has segments.
    normals: Vec<[f32; 3]>,
    /// Segments have `2^split` parts.
    split: u32,
    blocks: Pages<ObbBlock>,
    /// The box around each block.
    bounds: Vec<Aabb>,
    /// Segments that cannot be hit.
    dropped: usize,
    /// What queries run on.
    unit: Unit,
}

/// Into how many parts `n` segments are cut, as a power of two.
fn split_of(set: &CurveSet, n: usize) -> u32 {
    let mut split = u32::from(set.split_depth).min(MAX_SPLIT);
    while n << split > MAX_SEGMENTS && split > 0 {
        split -= 1;
    }
    split
}

/// What surface `n` segments have: ribbons need a normal for each end of a segment.
fn kind_of(set: &CurveSet, n: usize) -> CurveKind {
    let fits = set.normals.len() == n + set.strands.len();
    if set.kind == CurveKind::Ribbon && !fits { CurveKind::Flat } else { set.kind }
}

impl Curves {
    /// Takes curves. Ribbons without a normal for every end of a segment become flat.
    pub(crate) fn new(mut set: CurveSet, progress: &Progress) -> Curves {
        let strands = Strands::new(&mut set);
        let n = strands.n_segments();
        let split = split_of(&set, n);
        let kind = kind_of(&set, n);
        let normals = if kind == CurveKind::Ribbon { set.normals } else { Vec::new() };
        let (mut pieces, dropped) = group::pieces(&strands, split);
        let make = |id: u32| {
            let (segment, u) = part_of(id, split);
            let c = strands.cubic(segment);
            if split == 0 { c } else { c.part(u) }
        };
        let (bounds, blocks) = group::blocks(&mut pieces, &make, progress);
        drop(pieces);
        Curves { strands, kind, normals, split, blocks, bounds, dropped, unit: Unit::choose() }
    }
    /// Segments.
    pub(crate) fn len(&self) -> usize {
        self.strands.n_segments()
    }
    /// Numbers the tree sets aside: for segments, and for blocks.
    pub(crate) fn n_ids(&self) -> usize {
        self.len().max(self.blocks.len())
    }
    /// Segments that cannot be hit.
    pub(crate) fn dropped(&self) -> usize {
        self.dropped
    }
    pub(crate) fn bytes(&self) -> usize {
        self.strands.bytes() + size_of_val(&*self.normals)
    }
    /// Bytes of the boxes.
    pub(crate) fn tree_bytes(&self) -> usize {
        size_of_val(&*self.blocks) + size_of_val(&*self.bounds)
    }
    /// Boxes of what the tree holds.
    pub(crate) fn blocks(&self) -> &[Aabb] {
        &self.bounds
    }

    /// Asks for a block ahead of its use.
    #[inline(always)]
    pub(crate) fn ahead(&self, block: u32) {
        prefetch(&self.blocks, block as usize);
    }

    /// Offers the points of the ray on the segments of a block, which the tree numbers from `first`; returns the last
    /// limit.
    pub(crate) fn hit(
        &self,
        first: u32,
        block: u32,
        ray: &Ray,
        t_max: f32,
        found: &mut impl FnMut(RawHit) -> f32,
    ) -> f32 {
        let block = &self.blocks[block as usize];
        match self.unit {
            Unit::Portable => self.hit_portable(BlockTest { curves: self, block, ray, first, t_max, found }),
            #[cfg(target_arch = "x86_64")]
            Unit::Avx2(_) => self.hit_in_lanes(BlockTest { curves: self, block, ray, first, t_max, found }),
        }
    }
    // The work is compiled once, whatever waits for the hits: that takes long.

    /// In lanes that every target has.
    #[inline(never)]
    fn hit_portable(&self, test: BlockTest<dyn FnMut(RawHit) -> f32 + '_>) -> f32 {
        test.run::<Lanes<8>>()
    }
    /// In the registers of this processor.
    #[cfg(target_arch = "x86_64")]
    #[inline]
    fn hit_in_lanes(&self, test: BlockTest<dyn FnMut(RawHit) -> f32 + '_>) -> f32 {
        in_lanes(test)
    }

    /// The nearest point of the ray on piece `i` of a block.
    #[inline(always)]
    fn hit_piece<R: Real>(&self, block: &ObbBlock, i: usize, r: &RayFrame, t_max: f32) -> Option<CurveHit> {
        let (segment, u) = part_of(block.id[i], self.split);
        let c = self.strands.cubic_at(block.place[i]);
        hit_part::<R>(&c, u, self.kind, || self.end_normals(segment), r, t_max)
    }
    /// Unit normals of a ribbon at the ends of a segment.
    fn end_normals(&self, segment: u32) -> EndNormals {
        EndNormals::new(self.strands.normals_of(segment, &self.normals))
    }
}

/// Unit normals of a ribbon at the ends of a segment, and the angle between them.
#[derive(Clone, Copy, Debug, Default)]
struct EndNormals {
    n: [Vec3<f32>; 2],
    angle: f32,
}

impl EndNormals {
    fn new(n: [[f32; 3]; 2]) -> EndNormals {
        let unit = |n: [f32; 3]| {
            let n = Vec3::from(n);
            if n.length2() > 0.0 && n.is_finite() { n.normalized() } else { Vec3::splat(0.0) }
        };
        let n = n.map(unit);
        EndNormals { n, angle: Real::acos(n[0].dot(n[1])) }
    }
}

/// The nearest point of the ray on the part of a segment between two parameters; `ends` are asked of ribbons.
#[inline(always)]
fn hit_part<R: Real>(
    c: &Cubic,
    u: [f32; 2],
    kind: CurveKind,
    ends: impl FnOnce() -> EndNormals,
    r: &RayFrame,
    t_max: f32,
) -> Option<CurveHit> {
    let seen = RayCubic::new(c, r);
    let pieces = Pieces::new(&seen, u, c.largest_radius());
    match kind {
        CurveKind::Round => tube::hit::<R>(&seen, &pieces, r.inv_length, t_max),
        CurveKind::Flat | CurveKind::Cylinder => {
            strip::hit::<R>(&seen, &pieces, Width::Full, r.inv_length, t_max)
        }
        CurveKind::Ribbon => {
            let EndNormals { n, angle } = ends();
            let along = n.map(|n| n.dot(r.z));
            strip::hit::<R>(&seen, &pieces, Width::Ribbon { angle, along }, r.inv_length, t_max)
        }
    }
}

/// The segment of a piece, and the part it is.
#[inline(always)]
fn part_of(id: u32, split: u32) -> (u32, [f32; 2]) {
    let n = 1_u32 << split;
    let i = id & (n - 1);
    (id >> split, [i as f32 / n as f32, (i + 1) as f32 / n as f32])
}

/// A ray and a block.
struct BlockTest<'a, F: ?Sized> {
    curves: &'a Curves,
    block: &'a ObbBlock,
    ray: &'a Ray,
    first: u32,
    t_max: f32,
    found: &'a mut F,
}

impl<F: FnMut(RawHit) -> f32 + ?Sized> InLanes for BlockTest<'_, F> {
    type Output = f32;
    /// The last limit.
    #[inline(always)]
    fn run<R: Real>(self) -> f32 {
        let Entries { mut mask, t } = self.block.hit(self.curves.unit, self.ray.o, self.ray.d, self.t_max);
        let mut limit = self.t_max;
        if mask == 0 {
            return limit;
        }
        let mut rest = mask;
        while rest != 0 {
            let i = rest.trailing_zeros() as usize & (WIDTH - 1);
            rest &= rest - 1;
            self.curves.strands.ahead(self.block.place[i]);
        }
        let r = RayFrame::new(self.ray);
        while mask != 0 {
            // The box that is entered first; a point found there often spares the others.
            let mut i = mask.trailing_zeros() as usize & (WIDTH - 1);
            let mut rest = mask & (mask - 1);
            while rest != 0 {
                let k = rest.trailing_zeros() as usize & (WIDTH - 1);
                rest &= rest - 1;
                i = if t[k] < t[i] { k } else { i };
            }
            mask &= !(1 << i);
            if t[i] > limit {
                break;
            }
            if let Some(h) = self.curves.hit_piece::<R>(self.block, i, &r, limit) {
                let segment = self.block.id[i] >> self.curves.split;
                limit = (self.found)(RawHit { t: h.t, id: self.first + segment, u: h.u, v: 0.5 + 0.5 * h.h });
            }
        }
        limit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::CurveBasis;
    use sparrow_math::vec3;

    /// Every unit finds the same points, to the bit.
    #[test]
    fn units_agree_to_the_bit() {
        let wave = |k: u32, f: f32| 0.3 * (k as f32 * f).rem_euclid(2.0) - 0.3;
        let points = |n: u32| -> Vec<[f32; 4]> {
            (0..n)
                .map(|k| [wave(k, 0.37), wave(k, 0.73), wave(k, 1.13), 0.01 + 0.002 * wave(k, 0.9)])
                .collect()
        };
        for kind in [CurveKind::Round, CurveKind::Flat, CurveKind::Ribbon] {
            let normals = (0..58).map(|k| [1.0, wave(k, 0.5), wave(k, 0.8)]).collect();
            let set = || CurveSet {
                points: points(60),
                strands: vec![0],
                basis: CurveBasis::BSpline,
                kind,
                normals: if kind == CurveKind::Ribbon { Clone::clone(&normals) } else { Vec::new() },
                split_depth: 1,
                ..CurveSet::default()
            };
            let none = &Progress::new(None, 0);
            let (mut portable, mut best) = (Curves::new(set(), none), Curves::new(set(), none));
            assert_eq!(portable.kind, kind);
            (portable.unit, best.unit) = (Unit::named("portable"), Unit::named(""));
            let mut hits = 0;
            for k in 0..3000 {
                let target = vec3(wave(k, 0.119), wave(k, 0.233), wave(k, 0.317));
                let o = vec3(wave(k, 0.51), wave(k, 0.61), 2.0);
                let ray = Ray::new(o, target - o);
                for block in 0..best.blocks.len() as u32 {
                    let of = |c: &Curves| {
                        let mut found = Vec::new();
                        let last = c.hit(0, block, &ray, f32::INFINITY, &mut |h: RawHit| {
                            found.push([h.t.to_bits(), h.id, h.u.to_bits(), h.v.to_bits()]);
                            h.t
                        });
                        (found, last.to_bits())
                    };
                    let (a, b) = (of(&portable), of(&best));
                    hits += a.0.len();
                    assert_eq!(a, b, "{kind:?} {ray:?}");
                }
            }
            assert!(hits > 100, "{kind:?}: {hits}");
        }
    }
}
