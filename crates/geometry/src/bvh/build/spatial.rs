//! Cuts through primitives: where their boxes overlap much, one that is cut in two is in both parts, with less of a box in each.
//! [Stich2009]

use wide::f32x4;

use super::super::block::LEAF_SIZE;
use super::super::node::Kind;
use super::binary::{Binary, Kinds, Side};
use super::bins::{Cut, Extent, Range, blocks};
use super::prim::{Box4, PrimRef};

/// Most bins an axis has.
const BINS: usize = 16;
/// Cuts through primitives are tried where the parts of the best other cut overlap by more than this part of the surface of
/// everything.
const MIN_OVERLAP: f32 = 1e-5;
/// Below this size a subtree is built by one thread.
const PARALLEL: usize = 2048;

/// What cutting primitives takes.
pub(super) struct Spatial<'a, C> {
    /// The corners of a triangle.
    pub(super) corners: &'a C,
    /// Half of the surface of everything.
    pub(super) area: f32,
}

/// References to primitives, and how many more they may become.
pub(super) struct References {
    pub(super) prims: Vec<PrimRef>,
    pub(super) spare: usize,
}

/// References that begin and end in a slice, and the box of what lies in it.
#[derive(Clone, Copy)]
struct Bin {
    bounds: Box4,
    enter: u32,
    leave: u32,
}

/// A plane across an axis.
#[derive(Clone, Copy)]
struct Plane {
    cost: f32,
    axis: usize,
    at: f32,
}

/// The box cut off beyond two planes across `axis`.
fn slab(b: Box4, axis: usize, from: f32, to: f32) -> Box4 {
    let (mut lo, mut hi) = (b.lo.to_array(), b.hi.to_array());
    lo[axis] = lo[axis].max(from);
    hi[axis] = hi[axis].min(to);
    Box4 { lo: f32x4::new(lo), hi: f32x4::new(hi) }
}

/// The part of the box `b` of a triangle that this fills between two planes across `axis`.
fn clip(b: Box4, corners: [f32x4; 3], axis: usize, from: f32, to: f32) -> Box4 {
    let b = slab(b, axis, from, to);
    let mut filled = Box4::EMPTY;
    for i in 0..3 {
        let (p, q) = (corners[i], corners[(i + 1) % 3]);
        let (a, c) = (p.to_array()[axis], q.to_array()[axis]);
        if from <= a && a <= to {
            filled = filled.grow(p);
        }
        for plane in [from, to] {
            if (a < plane) != (c < plane) {
                filled = filled.grow(p + (q - p) * f32x4::splat((plane - a) / (c - a)));
            }
        }
    }
    // By more than the crossings' rounding; the planes themselves bound exactly.
    let pad = filled.lo.abs().fast_max(filled.hi.abs()) * f32x4::splat(4.0 * f32::EPSILON);
    b.intersection(Box4 { lo: filled.lo - pad, hi: filled.hi + pad })
}

impl<C: Fn(u32) -> [[f32; 3]; 3] + Sync> Spatial<'_, C> {
    /// The corners of a triangle; none for other primitives, which are not cut.
    fn corners(&self, p: &PrimRef) -> Option<[f32x4; 3]> {
        let triangle = p.kind() == Kind::Triangles;
        triangle.then(|| (self.corners)(p.id()).map(|[x, y, z]| f32x4::new([x, y, z, 0.0])))
    }

    /// The cheapest plane across one axis.
    fn along(&self, prims: &[PrimRef], bounds: Box4, axis: usize) -> Option<Plane> {
        let (lo, hi) = (bounds.lo.to_array()[axis], bounds.hi.to_array()[axis]);
        let n = BINS.min(4 + prims.len() / 8);
        let width = (hi - lo) / n as f32;
        if !(width > 0.0 && width.is_finite()) {
            return None;
        }
        let at = |i: usize| if i == n { hi } else { lo + width * i as f32 };
        let slice = |x: f32| (((x - lo) / width) as usize).min(n - 1);
        let mut bins = [Bin { bounds: Box4::EMPTY, enter: 0, leave: 0 }; BINS];
        for p in prims {
            let b = p.bounds();
            let (first, last) = (slice(b.lo.to_array()[axis]), slice(b.hi.to_array()[axis]));
            let last = if p.kind() == Kind::Triangles { last } else { first };
            bins[first].enter += 1;
            bins[last].leave += 1;
            let whole = if first == last { None } else { self.corners(p) };
            let Some(corners) = whole else {
                // It counts where it begins; what is not a triangle is never cut.
                bins[first].bounds = bins[first].bounds.union(b);
                continue;
            };
            for (i, bin) in bins.iter_mut().enumerate().take(last + 1).skip(first) {
                bin.bounds = bin.bounds.union(clip(b, corners, axis, at(i), at(i + 1)));
            }
        }
        let mut right = [(Box4::EMPTY, 0); BINS];
        let mut sum = (Box4::EMPTY, 0);
        for i in (1..n).rev() {
            sum = (sum.0.union(bins[i].bounds), sum.1 + bins[i].leave);
            right[i] = sum;
        }
        let mut best: Option<Plane> = None;
        sum = (Box4::EMPTY, 0);
        for i in 1..n {
            sum = (sum.0.union(bins[i - 1].bounds), sum.1 + bins[i - 1].enter);
            let cost = sum.0.half_area() * blocks(sum.1) + right[i].0.half_area() * blocks(right[i].1);
            if sum.1 > 0 && right[i].1 > 0 && cost < best.map_or(f32::INFINITY, |b| b.cost) {
                best = Some(Plane { cost, axis, at: at(i) });
            }
        }
        best
    }

    /// References on both sides of a plane. One that crosses it goes to both, or wholly to one where that costs less.
    fn divide(&self, prims: &[PrimRef], plane: Plane) -> [(Vec<PrimRef>, Extent); 2] {
        let empty = || (Vec::with_capacity(prims.len() / 2), Extent::EMPTY);
        let mut sides = [empty(), empty()];
        let put = |side: &mut (Vec<PrimRef>, Extent), p: PrimRef| {
            side.1.add(&p);
            side.0.push(p);
        };
        let mut crossing = Vec::new();
        for p in prims {
            let (lo, hi) = (p.bounds().lo.to_array()[plane.axis], p.bounds().hi.to_array()[plane.axis]);
            if hi <= plane.at {
                put(&mut sides[0], *p);
            } else if lo >= plane.at {
                put(&mut sides[1], *p);
            } else {
                crossing.push(p);
            }
        }
        let n = crossing.len();
        let (left, right) = ((sides[0].0.len() + n) as f32, (sides[1].0.len() + n) as f32);
        for p in crossing {
            let part = |corners, from, to| p.clipped(clip(p.bounds(), corners, plane.axis, from, to));
            let parts = self.corners(p).map(|corners| {
                [part(corners, f32::NEG_INFINITY, plane.at), part(corners, plane.at, f32::INFINITY)]
            });
            let area = |side: usize, b: Box4| sides[side].1.bounds.union(b).half_area();
            let all_left = area(0, p.bounds()) * left + area(1, Box4::EMPTY) * (right - 1.0);
            let all_right = area(0, Box4::EMPTY) * (left - 1.0) + area(1, p.bounds()) * right;
            let both = |[a, b]: &[PrimRef; 2]| {
                let empty = a.bounds().to_aabb().is_empty() || b.bounds().to_aabb().is_empty();
                if empty { f32::INFINITY } else { area(0, a.bounds()) * left + area(1, b.bounds()) * right }
            };
            let one = all_left.min(all_right);
            if let Some([a, b]) = parts.filter(|parts| both(parts) < one) {
                put(&mut sides[0], a);
                put(&mut sides[1], b);
            } else {
                put(&mut sides[usize::from(all_right < all_left)], *p);
            }
        }
        sides
    }

    /// The two parts of a plane that beats `cut`; none where there is none, or it needs more references than are spare.
    fn better(&self, r: &References, extent: &Extent, cut: Cut) -> Option<[(Vec<PrimRef>, Extent); 2]> {
        if !(cut.overlap.half_area() > MIN_OVERLAP * self.area) || r.spare == 0 {
            return None;
        }
        let planes = (0..3).filter_map(|axis| self.along(&r.prims, extent.bounds, axis));
        let plane = planes.min_by(|a, b| a.cost.total_cmp(&b.cost)).filter(|p| p.cost < cut.cost)?;
        let sides = self.divide(&r.prims, plane);
        let (n, total) = (r.prims.len(), sides[0].0.len() + sides[1].0.len());
        (sides.iter().all(|s| !s.0.is_empty() && s.0.len() < n) && total - n <= r.spare).then_some(sides)
    }

    /// Adds the tree over references.
    pub(super) fn add(&self, tree: &mut Binary, mut r: References, extent: Extent, depth: u32) {
        let n = r.prims.len();
        let parallel = n > PARALLEL;
        if n > LEAF_SIZE
            && let Some(cut) = Cut::best(&r.prims, &extent, depth)
            && let Some([left, right]) = self.better(&r, &extent, cut)
        {
            let total = left.0.len() + right.0.len();
            let spare = r.spare - (total - n);
            drop(r);
            // Each part gets its share by its size.
            let spare_left = (spare as u64 * left.0.len() as u64 / total as u64) as usize;
            let part = |(prims, extent), spare| (References { prims, spare }, extent);
            let parts = (part(left, spare_left), part(right, spare - spare_left));
            return tree.inner(extent.bounds, parallel, parts, |tree, side| match side {
                Side::Left((r, e)) | Side::Right((r, e)) => self.add(tree, r, e, depth + 1),
            });
        }
        if Kinds::of_few(&r.prims).fit(n) || r.spare == 0 {
            return tree.add(Range { prims: &mut r.prims, extent }, depth);
        }
        let (left, right) = Range { prims: &mut r.prims, extent }.split_best(depth);
        let spare_left = (r.spare as u64 * left.prims.len() as u64 / n as u64) as usize;
        let part = |p: Range, spare| (References { prims: p.prims.to_vec(), spare }, p.extent);
        let parts = (part(left, spare_left), part(right, r.spare - spare_left));
        drop(r);
        tree.inner(extent.bounds, parallel, parts, |tree, side| match side {
            Side::Left((r, e)) | Side::Right((r, e)) => self.add(tree, r, e, depth + 1),
        });
    }
}
