//! Where to cut a range of primitives in two.

use rayon::prelude::*;
use sparrow_math::{Aabb, Vec3};

use super::block::LEAF_SIZE;
use super::build::PrimRef;

/// Bins an axis.
const BINS: usize = 16;
/// From this size on a range is put into bins by several threads, in chunks of this size.
const CHUNK: usize = 1 << 15;
/// Below this depth ranges are halved, so that no input makes the tree deeper than its traversal allows.
const MAX_DEPTH: u32 = 48;

/// Primitives that lie side by side in the list, and what is known about them.
pub(crate) struct Range<'a> {
    pub(crate) prims: &'a mut [PrimRef],
    /// Place of the first one in the whole list.
    pub(crate) first: usize,
    pub(crate) bounds: Aabb,
    /// Box around twice the centres.
    centers2: Aabb,
}

impl<'a> Range<'a> {
    /// All primitives; `None` where there are none.
    pub(crate) fn whole(prims: &'a mut [PrimRef]) -> Option<Range<'a>> {
        (!prims.is_empty()).then(|| Range::of(prims, 0))
    }
    fn of(prims: &'a mut [PrimRef], first: usize) -> Range<'a> {
        let measure = |chunk: &[PrimRef]| {
            chunk
                .iter()
                .fold((Aabb::EMPTY, Aabb::EMPTY), |(b, c), p| (b.union(p.bounds()), c.grow(p.center2())))
        };
        let (bounds, centers2) = if prims.len() > CHUNK {
            let parts: Vec<_> = prims.par_chunks(CHUNK).map(measure).collect();
            parts.iter().fold((Aabb::EMPTY, Aabb::EMPTY), |(b, c), p| (b.union(p.0), c.union(p.1)))
        } else {
            measure(prims)
        };
        Range { prims, first, bounds, centers2 }
    }
    /// It fits into one leaf, and all its primitives are of one sort.
    pub(crate) fn is_leaf(&self) -> bool {
        self.prims.len() <= LEAF_SIZE && self.prims.iter().all(|p| p.other == self.prims[0].other)
    }
    fn split_at(self, mid: usize) -> (Range<'a>, Range<'a>) {
        let (a, b) = self.prims.split_at_mut(mid);
        (Range::of(a, self.first), Range::of(b, self.first + mid))
    }
}

/// Primitives whose centres lie in one slice of the range.
#[derive(Clone, Copy)]
struct Bin {
    bounds: Aabb,
    count: usize,
}

type Bins = [[Bin; BINS]; 3];

const NO_BINS: Bins = [[Bin { bounds: Aabb::EMPTY, count: 0 }; BINS]; 3];

/// Maps centres to bins.
struct Slicer {
    lo: Vec3<f32>,
    scale: [f32; 3],
}

impl Slicer {
    fn new(centers2: Aabb) -> Slicer {
        let e = centers2.extent();
        // An axis without extent gets one bin, which offers no cut.
        let scale = |e: f32| if e > 0.0 && e.is_finite() { BINS as f32 * (1.0 - 1e-5) / e } else { 0.0 };
        Slicer { lo: centers2.lo, scale: [scale(e.x), scale(e.y), scale(e.z)] }
    }
    #[inline(always)]
    fn bin(&self, c: Vec3<f32>, axis: usize) -> usize {
        // The cast sends what is not a number to bin 0.
        (((c[axis] - self.lo[axis]) * self.scale[axis]) as usize).min(BINS - 1)
    }
    fn fill(&self, prims: &[PrimRef]) -> Bins {
        let mut bins = NO_BINS;
        for p in prims {
            let (b, c) = (p.bounds(), p.center2());
            for (axis, bins) in bins.iter_mut().enumerate() {
                let bin = &mut bins[self.bin(c, axis)];
                bin.bounds = bin.bounds.union(b);
                bin.count += 1;
            }
        }
        bins
    }
    fn fill_parallel(&self, prims: &[PrimRef]) -> Bins {
        let parts: Vec<Bins> = prims.par_chunks(CHUNK).map(|c| self.fill(c)).collect();
        let mut sum = NO_BINS;
        for part in &parts {
            for (to, from) in sum.iter_mut().flatten().zip(part.iter().flatten()) {
                to.bounds = to.bounds.union(from.bounds);
                to.count += from.count;
            }
        }
        sum
    }
}

/// Leaves that `n` primitives fill.
fn blocks(n: usize) -> f32 {
    n.div_ceil(LEAF_SIZE) as f32
}

/// The cheapest cut along one axis: its cost, and the number of bins before it.
fn best_cut(bins: &[Bin; BINS]) -> Option<(f32, usize)> {
    let mut right = [0.0; BINS];
    let (mut b, mut n) = (Aabb::EMPTY, 0);
    for i in (1..BINS).rev() {
        b = b.union(bins[i].bounds);
        n += bins[i].count;
        right[i] = if n == 0 { f32::INFINITY } else { b.half_area() * blocks(n) };
    }
    let mut best = None;
    (b, n) = (Aabb::EMPTY, 0);
    for i in 1..BINS {
        b = b.union(bins[i - 1].bounds);
        n += bins[i - 1].count;
        let cost = b.half_area() * blocks(n) + right[i];
        if n > 0 && cost < best.map_or(f32::INFINITY, |(c, _)| c) {
            best = Some((cost, i));
        }
    }
    best
}

/// Cuts a range that is not a leaf in two parts, neither empty.
pub(crate) fn best_split(range: Range, depth: u32) -> (Range, Range) {
    let n = range.prims.len();
    if n <= LEAF_SIZE {
        // Only the two sorts keep it from being a leaf.
        let mid = partition(range.prims, |p| !p.other);
        return range.split_at(mid);
    }
    if depth > MAX_DEPTH {
        return range.split_at(n / 2);
    }
    let slicer = Slicer::new(range.centers2);
    let bins = if n > CHUNK { slicer.fill_parallel(range.prims) } else { slicer.fill(range.prims) };
    let cuts = (0..3).filter_map(|axis| best_cut(&bins[axis]).map(|(cost, i)| (cost, axis, i)));
    let Some((_, axis, cut)) = cuts.min_by(|a, b| a.0.total_cmp(&b.0)) else {
        return range.split_at(n / 2);
    };
    let mid = partition(range.prims, |p| slicer.bin(p.center2(), axis) < cut);
    if mid == 0 || mid == n {
        return range.split_at(n / 2);
    }
    range.split_at(mid)
}

/// Brings those with `first` to the front and counts them.
fn partition(prims: &mut [PrimRef], first: impl Fn(&PrimRef) -> bool) -> usize {
    let (mut i, mut j) = (0, prims.len());
    loop {
        while i < j && first(&prims[i]) {
            i += 1;
        }
        while i < j && !first(&prims[j - 1]) {
            j -= 1;
        }
        if i >= j {
            return i;
        }
        prims.swap(i, j - 1);
    }
}
