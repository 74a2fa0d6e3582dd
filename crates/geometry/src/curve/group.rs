//! Which segments share a block: cuts by the surface area heuristic until eight are left.

use rayon::prelude::*;
use sparrow_math::Aabb;

use super::cubic::Cubic;
use super::obb::{ObbBlock, WIDTH};
use super::strands::Strands;
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

impl Piece {
    fn center2(&self, axis: usize) -> f32 {
        self.bounds.lo[axis] + self.bounds.hi[axis]
    }
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

/// Puts pieces into blocks; each with the box around it.
pub(super) fn blocks(
    pieces: &mut [Piece],
    make: &(impl Fn(u32) -> Cubic + Sync),
    progress: &Progress,
) -> Vec<(Aabb, ObbBlock)> {
    told(pieces, 0, make, progress)
}

/// Cuts a part that another thread may work on, and tells what has its place.
fn told(
    pieces: &mut [Piece],
    depth: u32,
    make: &(impl Fn(u32) -> Cubic + Sync),
    progress: &Progress,
) -> Vec<(Aabb, ObbBlock)> {
    let n = pieces.len();
    let blocks = cut(pieces, depth, make, progress);
    // Of more, their parts were told.
    if n <= PARALLEL {
        progress.add(n);
    }
    blocks
}

fn cut(
    pieces: &mut [Piece],
    depth: u32,
    make: &(impl Fn(u32) -> Cubic + Sync),
    progress: &Progress,
) -> Vec<(Aabb, ObbBlock)> {
    let n = pieces.len();
    if n <= WIDTH {
        let around = pieces.iter().fold(Aabb::EMPTY, |b, p| b.union(p.bounds));
        let members: Vec<(u32, Cubic)> = pieces.iter().map(|p| (p.id, make(p.id))).collect();
        if n == 0 {
            return Vec::new();
        }
        let mut block = ObbBlock::around(&members);
        for (to, p) in block.place.iter_mut().zip(pieces.iter()) {
            *to = p.place;
        }
        return vec![(around, block)];
    }
    let mid = match best_cut(pieces) {
        Some((axis, lo, scale, cut)) if depth < MAX_DEPTH => {
            bring_to_front(pieces, |p| bin(p.center2(axis), lo, scale) < cut)
        }
        _ => 0,
    };
    let mid = if mid == 0 || mid == n { n / 2 } else { mid };
    let (a, b) = pieces.split_at_mut(mid);
    let (mut a, b) = if n > PARALLEL {
        rayon::join(|| told(a, depth + 1, make, progress), || told(b, depth + 1, make, progress))
    } else {
        (cut(a, depth + 1, make, progress), cut(b, depth + 1, make, progress))
    };
    a.extend(b);
    a
}

fn bin(center2: f32, lo: f32, scale: f32) -> usize {
    // The cast sends what is not a number to bin 0.
    (((center2 - lo) * scale) as usize).min(BINS - 1)
}

/// The cheapest cut: its axis, the map from centres to bins, and the number of bins before it.
fn best_cut(pieces: &[Piece]) -> Option<(usize, f32, f32, usize)> {
    let cost_of = |b: Aabb, n: usize| if n == 0 { 0.0 } else { b.half_area() * n.div_ceil(WIDTH) as f32 };
    let mut best = None;
    let mut least = f32::INFINITY;
    for axis in 0..3 {
        let centers = pieces.iter().map(|p| p.center2(axis));
        let (lo, hi) = centers.fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), c| (a.min(c), b.max(c)));
        let scale = BINS as f32 * (1.0 - 1e-5) / (hi - lo);
        if !(hi > lo) || !scale.is_finite() {
            continue;
        }
        let mut bins = [(Aabb::EMPTY, 0_usize); BINS];
        for p in pieces {
            let b = &mut bins[bin(p.center2(axis), lo, scale)];
            *b = (b.0.union(p.bounds), b.1 + 1);
        }
        let join = |a: (Aabb, usize), b: (Aabb, usize)| (a.0.union(b.0), a.1 + b.1);
        let mut behind = [(Aabb::EMPTY, 0); BINS + 1];
        for i in (0..BINS).rev() {
            behind[i] = join(behind[i + 1], bins[i]);
        }
        let mut before = (Aabb::EMPTY, 0);
        for i in 1..BINS {
            before = join(before, bins[i - 1]);
            let cost = cost_of(before.0, before.1) + cost_of(behind[i].0, behind[i].1);
            if before.1 > 0 && behind[i].1 > 0 && cost < least {
                (least, best) = (cost, Some((axis, lo, scale, i)));
            }
        }
    }
    best
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
