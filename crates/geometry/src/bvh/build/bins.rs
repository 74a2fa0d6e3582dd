//! Where to cut a range of primitives in two: the surface area heuristic over bins of their centres.

use rayon::prelude::*;
use wide::{f32x4, i32x4};

use super::super::block::LEAF_SIZE;
use super::prim::{Box4, PrimRef};

/// Most bins an axis has.
const BINS: usize = 16;
/// From this size on a range is put into bins by several threads, in chunks of this size.
const CHUNK: usize = 1 << 15;
/// Below this depth ranges are halved, so that no input makes the tree deeper than its traversal allows.
const MAX_DEPTH: u32 = 64;

/// Boxes around primitives and around twice their centres.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    pub(super) bounds: Box4,
    centers2: Box4,
}

impl Extent {
    pub(super) const EMPTY: Extent = Extent { bounds: Box4::EMPTY, centers2: Box4::EMPTY };

    #[inline(always)]
    pub(super) fn add(&mut self, p: &PrimRef) {
        self.bounds = self.bounds.union(p.bounds());
        self.centers2 = self.centers2.grow(p.center2());
    }
    fn union(self, o: Extent) -> Extent {
        Extent { bounds: self.bounds.union(o.bounds), centers2: self.centers2.union(o.centers2) }
    }
    pub(super) fn of(prims: &[PrimRef]) -> Extent {
        let measure = |chunk: &[PrimRef]| {
            let mut e = Extent::EMPTY;
            chunk.iter().for_each(|p| e.add(p));
            e
        };
        let parts: Vec<Extent> = prims.par_chunks(CHUNK).map(measure).collect();
        parts.into_iter().fold(Extent::EMPTY, Extent::union)
    }
}

/// Primitives that lie side by side in the list, and what is known about them.
pub(super) struct Range<'a> {
    pub(super) prims: &'a mut [PrimRef],
    pub(super) extent: Extent,
}

/// Primitives whose centres lie in one slice of the range.
#[derive(Clone, Copy)]
struct Bin {
    bounds: Box4,
    count: u32,
}

type Bins = [[Bin; 3]; BINS];

const NO_BINS: Bins = [[Bin { bounds: Box4::EMPTY, count: 0 }; 3]; BINS];

/// Maps centres to bins.
#[derive(Clone, Copy)]
struct Slicer {
    lo: f32x4,
    scale: f32x4,
    n: usize,
}

impl Slicer {
    /// Few bins for few primitives: more would find nothing better.
    fn new(centers2: Box4, count: usize) -> Slicer {
        let n = BINS.min(4 + count / 8);
        // An axis without extent gets one bin, which offers no cut.
        let scale = |e: f32| if e > 0.0 && e.is_finite() { n as f32 * (1.0 - 1e-5) / e } else { 0.0 };
        let [x, y, z, _] = (centers2.hi - centers2.lo).to_array();
        let [a, b, c, _] = centers2.lo.to_array();
        Slicer { lo: f32x4::new([a, b, c, 0.0]), scale: f32x4::new([scale(x), scale(y), scale(z), 0.0]), n }
    }
    /// The bins of a primitive along the three axes; what is not a number goes to some bin.
    #[inline(always)]
    fn bins(&self, p: &PrimRef) -> [usize; 3] {
        let at = ((p.center2() - self.lo) * self.scale).fast_trunc_int();
        let [x, y, z, _] = at.max(i32x4::splat(0)).min(i32x4::splat(self.n as i32 - 1)).to_array();
        [x as usize, y as usize, z as usize]
    }
    fn fill(&self, prims: &[PrimRef]) -> Bins {
        let mut bins = NO_BINS;
        for p in prims {
            let b = p.bounds();
            for (axis, i) in self.bins(p).into_iter().enumerate() {
                let bin = &mut bins[i % BINS][axis];
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

/// Blocks that `n` primitives fill.
pub(super) fn blocks(n: u32) -> f32 {
    (n as usize).div_ceil(LEAF_SIZE) as f32
}

/// A cut: what it costs, its axis, and the number of bins before it.
#[derive(Clone, Copy)]
pub(super) struct Cut {
    pub(super) cost: f32,
    axis: usize,
    bin: usize,
    /// What lies in both of the parts' boxes.
    pub(super) overlap: Box4,
    slicer: Slicer,
}

impl Cut {
    /// The cheapest cut of a range by centres; none where they all lie in one place, or the range is so deep in the tree that
    /// it has to be halved.
    pub(super) fn best(prims: &[PrimRef], extent: &Extent, depth: u32) -> Option<Cut> {
        if depth > MAX_DEPTH {
            return None;
        }
        let slicer = Slicer::new(extent.centers2, prims.len());
        let bins = if prims.len() > CHUNK { slicer.fill_parallel(prims) } else { slicer.fill(prims) };
        let cuts = (0..3).filter_map(|axis| Cut::along(axis, &bins, slicer));
        cuts.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }
    fn along(axis: usize, bins: &Bins, slicer: Slicer) -> Option<Cut> {
        let none = Bin { bounds: Box4::EMPTY, count: 0 };
        let add = |a: Bin, b: &Bin| Bin { bounds: a.bounds.union(b.bounds), count: a.count + b.count };
        let cost = |b: &Bin| b.bounds.half_area() * blocks(b.count);
        let mut right = [none; BINS];
        let mut sum = none;
        for i in (1..slicer.n).rev() {
            sum = add(sum, &bins[i][axis]);
            right[i] = sum;
        }
        let (mut best, mut sum): (Option<Cut>, _) = (None, none);
        for i in 1..slicer.n {
            sum = add(sum, &bins[i - 1][axis]);
            let cost = cost(&sum) + cost(&right[i]);
            if sum.count > 0 && right[i].count > 0 && cost < best.map_or(f32::INFINITY, |b| b.cost) {
                let overlap = sum.bounds.intersection(right[i].bounds);
                best = Some(Cut { cost, axis, bin: i, overlap, slicer });
            }
        }
        best
    }
    #[inline(always)]
    pub(super) fn is_before(&self, p: &PrimRef) -> bool {
        self.slicer.bins(p)[self.axis % 3] < self.bin
    }
}

impl<'a> Range<'a> {
    /// Cuts the range in two parts, neither empty, by `cut` if that leaves none empty, else in halves.
    pub(super) fn split(self, cut: Option<Cut>) -> (Range<'a>, Range<'a>) {
        let (mut left, mut right) = (Extent::EMPTY, Extent::EMPTY);
        if let Some(cut) = cut {
            let mid = partition(self.prims, &mut left, &mut right, |p| cut.is_before(p));
            if mid > 0 && mid < self.prims.len() {
                let (a, b) = self.prims.split_at_mut(mid);
                return (Range { prims: a, extent: left }, Range { prims: b, extent: right });
            }
        }
        let (a, b) = self.prims.split_at_mut(self.prims.len() / 2);
        let (left, right) = (Extent::of(a), Extent::of(b));
        (Range { prims: a, extent: left }, Range { prims: b, extent: right })
    }
    /// Cuts a range that is no leaf: few primitives between their kinds, more where it costs least.
    pub(super) fn split_best(self, depth: u32) -> (Range<'a>, Range<'a>) {
        let first = self.prims[0].kind();
        if self.prims.len() <= LEAF_SIZE && self.prims.iter().any(|p| p.kind() != first) {
            return self.split_kinds();
        }
        let cut = Cut::best(self.prims, &self.extent, depth);
        self.split(cut)
    }
    fn split_kinds(self) -> (Range<'a>, Range<'a>) {
        let (mut left, mut right) = (Extent::EMPTY, Extent::EMPTY);
        let first = self.prims[0].kind();
        let mid = partition(self.prims, &mut left, &mut right, |p| p.kind() == first);
        let (a, b) = self.prims.split_at_mut(mid);
        (Range { prims: a, extent: left }, Range { prims: b, extent: right })
    }
}

/// Brings those with `first` to the front, counts them, and measures both parts.
fn partition(
    prims: &mut [PrimRef],
    left: &mut Extent,
    right: &mut Extent,
    first: impl Fn(&PrimRef) -> bool,
) -> usize {
    let (mut i, mut j) = (0, prims.len());
    loop {
        while i < j && first(&prims[i]) {
            left.add(&prims[i]);
            i += 1;
        }
        while i < j && !first(&prims[j - 1]) {
            right.add(&prims[j - 1]);
            j -= 1;
        }
        if i >= j {
            return i;
        }
        prims.swap(i, j - 1);
    }
}
