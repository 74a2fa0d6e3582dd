//! Which segments share a block: cuts by the surface area heuristic until eight are left.

use rayon::prelude::*;
use sparrow_math::Aabb;
use wide::{f32x4, i32x4};

use super::cubic::Cubic;
use super::obb::{ObbBlock, WIDTH};
use super::strands::Strands;
use crate::bvh::{Box4, Pages};
use crate::progress::Progress;

/// Bins an axis.
const BINS: usize = 16;
/// Below this size one thread goes on alone.
const PARALLEL: usize = 1 << 13;
/// Below this depth ranges are halved.
const MAX_DEPTH: u32 = 64;

/// A piece of a segment with its box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// The segment, and which of its parts.
    pub(super) id: u32,
    /// Where the segment has its control points.
    place: u32,
    bounds: Aabb,
}

/// The box of a segment or a part of one.
pub(super) fn bounds(c: &Cubic) -> Aabb {
    let mut b = Aabb::EMPTY;
    for [x, y, z, r] in c.hull() {
        let r = r.max(0.0);
        let at = |i: usize, v: f32, r: f32| c.anchor[i] + (v + r);
        let corner = |r: f32| [at(0, x, r), at(1, y, r), at(2, z, r)].into();
        b = b.grow(corner(r)).grow(corner(-r));
    }
    // Sums of three numbers were rounded to the nearest.
    let pad = |v: f32| 4.0 * f32::EPSILON * v.abs();
    for axis in 0..3 {
        let (lo, hi) = (b.lo[axis], b.hi[axis]);
        let by = pad(lo).max(pad(hi)) + 4.0 * f32::EPSILON * c.reach();
        let set = |v: &mut sparrow_math::Vec3<f32>, to: f32| match axis {
            0 => v.x = to,
            1 => v.y = to,
            _ => v.z = to,
        };
        set(&mut b.lo, lo - by);
        set(&mut b.hi, hi + by);
    }
    b
}

/// All pieces of the segments that can be hit, each cut into `2^split` parts; and how many segments were left out.
pub(super) fn pieces(strands: &Strands, split: u32) -> (Vec<Piece>, usize) {
    let n = 1_u32 << split;
    let of = |s: u32| {
        let usable = strands.is_usable(s);
        let whole = strands.cubic(s);
        (0..if usable { n } else { 0 }).map(move |i| {
            let part = |i: u32| i as f32 / n as f32;
            let c = if n == 1 { whole } else { whole.part([part(i), part(i + 1)]) };
            Piece { id: s << split | i, place: strands.place_of(s), bounds: bounds(&c) }
        })
    };
    let all = 0..strands.n_segments() as u32;
    let pieces: Vec<Piece> = all.into_par_iter().flat_map_iter(of).collect();
    let dropped = strands.n_segments() - pieces.len() / n as usize;
    (pieces, dropped)
}

/// Blocks with the boxes around them, of neighbours.
type Part = Vec<(Aabb, ObbBlock)>;

/// Puts pieces into blocks; each with the box around it.
pub(super) fn blocks(
    pieces: &mut [Piece],
    make: &(impl Fn(u32) -> Cubic + Sync),
    progress: &Progress,
) -> (Vec<Aabb>, Pages<ObbBlock>) {
    let parts = told(pieces, 0, make, progress);
    let bounds: Vec<Aabb> = parts.iter().flatten().map(|(around, _)| *around).collect();
    let mut blocks = Pages::zeroed(bounds.len());
    let mut rest = &mut blocks[..];
    let places: Vec<&mut [ObbBlock]> =
        parts.iter().map(|part| rest.split_off_mut(..part.len()).unwrap_or_default()).collect();
    parts.into_par_iter().zip(places).for_each(|(part, to)| {
        to.iter_mut().zip(part).for_each(|(to, (_, block))| *to = block);
    });
    (bounds, blocks)
}

/// Cuts a part that another thread may work on, and tells what has its place.
fn told(
    pieces: &mut [Piece],
    depth: u32,
    make: &(impl Fn(u32) -> Cubic + Sync),
    progress: &Progress,
) -> Vec<Part> {
    let n = pieces.len();
    if n > PARALLEL {
        let (a, b) = halves(pieces, depth);
        let cut = |part| told(part, depth + 1, make, progress);
        let (mut a, b) = rayon::join(|| cut(a), || cut(b));
        a.extend(b);
        return a;
    }
    let mut part = Vec::with_capacity(n.div_ceil(WIDTH) * 9 / 8);
    cut(pieces, depth, make, &mut part);
    progress.add(n);
    vec![part]
}

/// Cuts a part down to blocks.
fn cut(pieces: &mut [Piece], depth: u32, make: &impl Fn(u32) -> Cubic, blocks: &mut Vec<(Aabb, ObbBlock)>) {
    if pieces.len() > WIDTH {
        let (a, b) = halves(pieces, depth);
        cut(a, depth + 1, make, blocks);
        cut(b, depth + 1, make, blocks);
    } else if !pieces.is_empty() {
        let around = pieces.iter().fold(Aabb::EMPTY, |b, p| b.union(p.bounds));
        let members: Vec<(u32, Cubic)> = pieces.iter().map(|p| (p.id, make(p.id))).collect();
        let mut block = ObbBlock::around(&members);
        for (to, p) in block.place.iter_mut().zip(pieces.iter()) {
            *to = p.place;
        }
        blocks.push((around, block));
    }
}

/// Cuts pieces in two where it costs least, or in the middle.
fn halves(pieces: &mut [Piece], depth: u32) -> (&mut [Piece], &mut [Piece]) {
    let n = pieces.len();
    let mid = match Cut::best(pieces) {
        Some(cut) if depth < MAX_DEPTH => bring_to_front(pieces, |p| cut.is_before(p)),
        _ => 0,
    };
    pieces.split_at_mut(if mid == 0 || mid == n { n / 2 } else { mid })
}

/// Maps centres to bins, along the three axes.
#[derive(Clone, Copy)]
struct Slicer {
    lo: f32x4,
    scale: f32x4,
}

impl Slicer {
    fn new(pieces: &[Piece]) -> Slicer {
        let centers = pieces.iter().fold(Box4::EMPTY, |b, p| b.grow(center2(&Box4::of(&p.bounds))));
        // An axis without extent gets one bin, which offers no cut.
        let scale = |e: f32| {
            let scale = BINS as f32 * (1.0 - 1e-5) / e;
            if e > 0.0 && scale.is_finite() { scale } else { 0.0 }
        };
        Slicer { lo: centers.lo, scale: f32x4::new((centers.hi - centers.lo).to_array().map(scale)) }
    }
    /// The bins of a piece; what is not a number goes to some bin.
    #[inline(always)]
    fn bins(&self, b: &Box4) -> [usize; 3] {
        let at = ((center2(b) - self.lo) * self.scale).fast_trunc_int();
        let [x, y, z, _] = at.max(i32x4::splat(0)).min(i32x4::splat(BINS as i32 - 1)).to_array();
        [x as usize, y as usize, z as usize]
    }
}

/// Twice the centre of a box.
#[inline(always)]
fn center2(b: &Box4) -> f32x4 {
    b.lo + b.hi
}

/// A cut: its axis and the number of bins before it.
struct Cut {
    slicer: Slicer,
    axis: usize,
    bin: usize,
}

impl Cut {
    /// The cheapest cut; none where all centres lie in one place.
    fn best(pieces: &[Piece]) -> Option<Cut> {
        let slicer = Slicer::new(pieces);
        let mut bins = [[(Box4::EMPTY, 0); BINS]; 3];
        for p in pieces {
            let b = Box4::of(&p.bounds);
            for (bins, i) in bins.iter_mut().zip(slicer.bins(&b)) {
                let (bounds, n) = &mut bins[i % BINS];
                (*bounds, *n) = (bounds.union(b), *n + 1);
            }
        }
        let join = |a: (Box4, usize), b: (Box4, usize)| (a.0.union(b.0), a.1 + b.1);
        let cost_of = |(b, n): (Box4, usize)| b.half_area() * n.div_ceil(WIDTH) as f32;
        let mut best = None;
        let mut least = f32::INFINITY;
        for (axis, bins) in bins.iter().enumerate() {
            let mut behind = [(Box4::EMPTY, 0); BINS + 1];
            for i in (0..BINS).rev() {
                behind[i] = join(behind[i + 1], bins[i]);
            }
            let mut before = (Box4::EMPTY, 0);
            for i in 1..BINS {
                before = join(before, bins[i - 1]);
                let cost = cost_of(before) + cost_of(behind[i]);
                if before.1 > 0 && behind[i].1 > 0 && cost < least {
                    (least, best) = (cost, Some(Cut { slicer, axis, bin: i }));
                }
            }
        }
        best
    }
    #[inline(always)]
    fn is_before(&self, p: &Piece) -> bool {
        self.slicer.bins(&Box4::of(&p.bounds))[self.axis % 3] < self.bin
    }
}

/// Brings those with `first` to the front and counts them.
fn bring_to_front(pieces: &mut [Piece], first: impl Fn(&Piece) -> bool) -> usize {
    let mut n = 0;
    for i in 0..pieces.len() {
        if first(&pieces[i]) {
            pieces.swap(n, i);
            n += 1;
        }
    }
    n
}
