//! Eight rays at once through a tree of one node.
//!
//! Lanes are rays, each with axes of its own. A lane computes what [`TriBlock`](super::block::TriBlock) does, to the bit,
//! but meets the leaves in another order. That matters where two points lie equally far, where a point is computed to lie
//! before its leaf's box, or where a triangle has to be settled in double precision: such rays are asked anew one by one.

use super::block::{RawHit, gamma};
use super::few::{Corners, Few, MAX_VERTICES, Other, Pair};
use super::ray_data::{PAD, TINY_INV};
use super::traverse::Others;
use crate::ray::Ray;
use crate::simd::{Floats, Mask, Simd};
use sparrow_math::Aabb;

/// Rays of a packet.
pub(crate) const RAYS: usize = 8;

/// One truth value for each ray.
type Which<S> = <<S as Simd>::F8 as Floats<8>>::Mask;

/// A corner in the sheared spaces of eight rays.
pub(super) type Sheared<S> = [<S as Simd>::F8; 3];

/// Room for the corners of a tree.
#[inline(always)]
pub(super) fn room<S: Simd>() -> [Sheared<S>; MAX_VERTICES] {
    [[S::F8::splat(0.0); 3]; MAX_VERTICES]
}

/// Eight rays, with what [`RayData`](super::ray_data::RayData) knows of one.
struct Packet<S: Simd> {
    o: [S::F8; 3],
    d: [S::F8; 3],
    minus_inv_near: [S::F8; 3],
    minus_inv_far: [S::F8; 3],
    k: [S::F8; 3],
    o_k: [S::F8; 3],
    s: [S::F8; 3],
    t_max: S::F8,
    /// Rays that can meet something.
    valid: Which<S>,
}

/// The axes of eight rays, permuted as for one ray.
struct Turns<S: Simd> {
    /// The first axis is y, is z; the second; the third.
    is: [[Which<S>; 2]; 3],
}

impl<S: Simd> Turns<S> {
    #[inline(always)]
    fn new(d: [S::F8; 3]) -> Turns<S> {
        let a = [d[0].abs(), d[1].abs(), d[2].abs()];
        let x = a[1].lt(a[0]) & a[2].lt(a[0]);
        let y = !a[1].lt(a[0]) & a[2].lt(a[1]);
        let z = !(x | y);
        let below = d[0].only_where(x, d[1].only_where(y, d[2])).lt(S::F8::splat(0.0));
        let above = !below;
        let first = [x & above | z & below, y & above | x & below];
        let second = [z & above | x & below, x & above | y & below];
        Turns { is: [first, second, [y, z]] }
    }
    /// Numbers of the axes, as bits.
    #[inline(always)]
    fn k(&self) -> [S::F8; 3] {
        self.of([
            S::F8::splat(f32::from_bits(0)),
            S::F8::splat(f32::from_bits(1)),
            S::F8::splat(f32::from_bits(2)),
        ])
    }
    #[inline(always)]
    fn of(&self, v: [S::F8; 3]) -> [S::F8; 3] {
        let [[ay, az], [by, bz], [cy, cz]] = self.is;
        let z = [v[2].only_where(az, v[0]), v[2].only_where(bz, v[0]), v[2].only_where(cz, v[0])];
        [v[1].only_where(ay, z[0]), v[1].only_where(by, z[1]), v[1].only_where(cy, z[2])]
    }
}

impl<S: Simd> Packet<S> {
    #[inline(always)]
    fn new(rays: &[Ray; RAYS]) -> Packet<S> {
        let row = |i: usize| rays[i].to_array();
        let rows = [row(0), row(1), row(2), row(3), row(4), row(5), row(6), row(7)];
        let [ox, oy, oz, dx, dy, dz, t_max, _] = S::columns(&rows);
        let (o, d) = ([ox, oy, oz], [dx, dy, dz]);
        let turns = Turns::<S>::new(d);
        let d_k = turns.of(d);
        let sz = S::F8::splat(1.0) / d_k[2];
        let minus_inv = [minus_inv::<S>(d[0]), minus_inv::<S>(d[1]), minus_inv::<S>(d[2])];
        let valid = finite::<S>(o[0]) & finite::<S>(o[1]) & finite::<S>(o[2]) & finite::<S>(sz);
        Packet {
            o,
            d,
            minus_inv_near: scaled::<S>(minus_inv, 1.0 - PAD),
            minus_inv_far: scaled::<S>(minus_inv, 1.0 + PAD),
            k: turns.k(),
            o_k: turns.of(o),
            s: [d_k[0] * sz, d_k[1] * sz, sz],
            t_max,
            valid: valid & finite::<S>(d[0]) & finite::<S>(d[1]) & finite::<S>(d[2]),
        }
    }

    /// Where the rays cross the faces of a box across an axis.
    #[inline(always)]
    fn interval(&self, b: &Aabb, axis: usize) -> (S::F8, S::F8) {
        let (p, q) = (self.o[axis] - S::F8::splat(b.lo[axis]), self.o[axis] - S::F8::splat(b.hi[axis]));
        // The nearer face gives the smaller product: rounding keeps order.
        let (near, far) = (self.minus_inv_near[axis], self.minus_inv_far[axis]);
        ((p * near).min(q * near), (p * far).max(q * far))
    }

    /// Rays that meet a box between 0 and `t_max`, and where they enter it.
    #[inline(always)]
    fn meets(&self, b: &Aabb, t_max: S::F8) -> (Which<S>, S::F8) {
        let [(x0, x1), (y0, y1), (z0, z1)] = [self.interval(b, 0), self.interval(b, 1), self.interval(b, 2)];
        let t0 = x0.max_nonneg(y0).max_nonneg(z0.max_nonneg(S::F8::splat(0.0)));
        let t1 = x1.min_nonneg(y1).min_nonneg(z1.min_nonneg(t_max));
        (t0.le(t1), t0)
    }

    /// Rays whose lines do not clearly miss a ball: by a hundredfold of what rounding can do here.
    #[inline(always)]
    fn reaches(&self, &(center, radius): &([f32; 3], f32)) -> Which<S> {
        let [x, y, z] = [center[0], center[1], center[2]];
        let (x, y, z) =
            (self.o[0] - S::F8::splat(x), self.o[1] - S::F8::splat(y), self.o[2] - S::F8::splat(z));
        let [dx, dy, dz] = self.d;
        let (p, q, r) = (y * dz - z * dy, z * dx - x * dz, x * dy - y * dx);
        let far = S::F8::splat(1e-5) * (x.abs() + y.abs() + z.abs());
        let around = 1e-5 * (center[0].abs() + center[1].abs() + center[2].abs());
        let reach = S::F8::splat(1.0001 * radius + around) + far;
        // What is not a number misses nothing.
        !((dx * dx + dy * dy + dz * dz) * reach * reach).lt(p * p + q * q + r * r)
    }

    /// Brings corners to where the rays run along z from the origin, and bounds the error of `t` of any triangle of theirs:
    /// by the first number, and the second times the reciprocal of the sum of edge functions.
    #[inline(always)]
    fn shear(&self, vertices: &[[f32; 4]], out: &mut [Sheared<S>; MAX_VERTICES]) -> [S::F8; 2] {
        let mut most = [S::F8::splat(0.0); 3];
        for (v, out) in vertices.iter().zip(out) {
            let z = S::F8::pick(v, self.k[2]) - self.o_k[2];
            let x = S::F8::pick(v, self.k[0]) - self.o_k[0] - self.s[0] * z;
            let y = S::F8::pick(v, self.k[1]) - self.o_k[1] - self.s[1] * z;
            most = [most[0].max(x.abs()), most[1].max(y.abs()), most[2].max(z.abs())];
            *out = [x, y, z];
        }
        let [x, y, depth] = most;
        let z = depth * self.s[2].abs();
        let (g2, g5) = (S::F8::splat(gamma(2)), S::F8::splat(gamma(5)));
        let (dx, dy) = (g5 * (x + depth), g5 * (y + depth));
        let de = S::F8::splat(2.0) * (g2 * x * y + dy * x + dx * y);
        // As in a block, where an edge function is not larger than the sum; and a thousandth for other roundings.
        [S::F8::splat(6.01 * gamma(3)) * z, S::F8::splat(3.01) * de * z]
    }
}

/// Rays whose number is finite.
#[inline(always)]
fn finite<S: Simd>(v: S::F8) -> Which<S> {
    v.abs().lt(S::F8::splat(f32::INFINITY))
}

#[inline(always)]
fn scaled<S: Simd>(v: [S::F8; 3], by: f32) -> [S::F8; 3] {
    [v[0] * S::F8::splat(by), v[1] * S::F8::splat(by), v[2] * S::F8::splat(by)]
}

/// Reciprocals, negated.
#[inline(always)]
fn minus_inv<S: Simd>(d: S::F8) -> S::F8 {
    let (inv, small) = (S::F8::splat(1.0) / d, d.abs().lt(S::F8::splat(1e-30)));
    S::F8::splat(-1.0) * if !small.any() { inv } else { stand_in::<S>(d).only_where(small, inv) }
}

/// The reciprocals that stand in for those of directions next to zero.
#[inline(always)]
fn stand_in<S: Simd>(d: S::F8) -> S::F8 {
    let mut d = d.to_array();
    for d in &mut d {
        *d = TINY_INV.copysign(*d);
    }
    S::F8::load(&d)
}

/// What eight rays meet so far.
struct Nearest<S: Simd> {
    t: S::F8,
    /// The place in [`Few::ids`], as bits.
    place: S::F8,
    u: S::F8,
    v: S::F8,
    /// Rays that met something.
    hit: Which<S>,
    /// Rays to be asked anew.
    anew: Which<S>,
    /// Rays that look on.
    open: Which<S>,
}

impl<S: Simd> Nearest<S> {
    /// Tests pair `i` for the rays `met`, which enter its leaf at `t0`.
    #[inline(always)]
    fn pair<const ANY: bool>(
        &mut self,
        (i, pair): (u32, &Pair),
        (met, t0): (Which<S>, S::F8),
        (corners, error, sz): (&[Sheared<S>; MAX_VERTICES], &[S::F8; 2], S::F8),
    ) {
        let of = |[a, b, c]: Corners| [a, b, c].map(|i| &corners[usize::from(i) % MAX_VERTICES]);
        let (first, met) = (Edges::<S>::new(of(pair.first)), met & self.open);
        let inside = first.inside();
        let Some(second) = pair.second.map(of).map(Edges::<S>::new) else {
            if (inside & met).any() {
                self.triangle::<ANY>(&first, inside & met, (number::<S>(2 * i), t0), (error, sz));
            }
            return;
        };
        let inside2 = second.inside();
        let met = (inside | inside2) & met;
        if !met.any() {
            return;
        }
        let second_alone = inside2 & !inside;
        let place = number::<S>(2 * i + 1).only_where(second_alone, number::<S>(2 * i));
        // Rays of both go through the side they share.
        let both = inside & inside2 & met;
        self.anew = self.anew | both;
        self.open = self.open & !both;
        let edges = second.only_where(second_alone, &first);
        self.triangle::<ANY>(&edges, met & !both, (place, t0), (error, sz));
    }

    /// Offers the points of the rays `met` on triangles, which have a place each.
    #[inline(always)]
    fn triangle<const ANY: bool>(
        &mut self,
        &Edges { e: [u, v, w], z }: &Edges<S>,
        met: Which<S>,
        (place, t0): (S::F8, S::F8),
        (error, sz): (&[S::F8; 2], S::F8),
    ) {
        let zero = S::F8::splat(0.0);
        let inv = S::F8::splat(1.0) / (u + v + w);
        let t = (u * z[0] + v * z[1] + w * z[2]) * sz * inv;
        let near = met & zero.lt(t) & t.le(self.t);
        if !near.any() {
            return;
        }
        let (least, greatest) = (u.min(v).min(w), u.max(v).max(w));
        let exact = (zero.lt(least) | greatest.lt(zero)) & (error[0] + error[1] * inv.abs()).lt(t);
        self.offer::<ANY>(near, near & exact & t0.le(t) & t.lt(self.t), [t, place, v * inv, w * inv]);
    }

    /// Takes points, at `t` and in `place`, where `taken` says so; asks anew where they are only `near`.
    #[inline(always)]
    fn offer<const ANY: bool>(&mut self, near: Which<S>, taken: Which<S>, [t, place, u, v]: [S::F8; 4]) {
        self.anew = self.anew | near & !taken;
        self.hit = self.hit | taken;
        self.open = self.open & !if ANY { near } else { self.anew };
        self.t = t.only_where(taken, self.t);
        self.place = place.only_where(taken, self.place);
        self.u = u.only_where(taken, self.u);
        self.v = v.only_where(taken, self.v);
    }

    /// Tests a ball for the rays `met`, which enter its box at `t0` and its surface at the first of `roots`.
    #[inline(always)]
    fn ball<const ANY: bool>(
        &mut self,
        place: u32,
        (met, t0): (Which<S>, S::F8),
        [near, far]: &[[f32; RAYS]; 2],
    ) {
        let (near, zero) = (S::F8::load(near), S::F8::splat(0.0));
        let t = near.only_where(zero.lt(near), S::F8::load(far));
        let near = met & self.open & zero.lt(t) & t.le(self.t);
        let taken = near & t0.le(t) & t.lt(self.t);
        self.offer::<ANY>(near, taken, [t, number::<S>(place), zero, zero]);
    }

    /// Asks for the points of another primitive ray by ray.
    #[inline(always)]
    fn others<const ANY: bool>(
        &mut self,
        (place, id): (u32, u32),
        (met, t0): (Which<S>, S::F8),
        rays: &[Ray; RAYS],
        others: &impl Others,
    ) {
        let (mut t, mut u, mut v) = (self.t.to_array(), self.u.to_array(), self.v.to_array());
        let (t0, before) = (t0.to_array(), self.t);
        let (mut met, mut anew) = ((met & self.open).bits(), [0.0; RAYS]);
        while met != 0 {
            let i = met.trailing_zeros() as usize & (RAYS - 1);
            met &= met - 1;
            // One that lies as far as the limit shows in this way.
            others.hit(id, &rays[i], t[i].next_up(), &mut |h: RawHit| {
                if h.t < t[i] && t0[i] <= h.t {
                    (t[i], u[i], v[i]) = (h.t, h.u, h.v);
                } else {
                    anew[i] = 1.0;
                }
                t[i]
            });
        }
        let (t, anew) = (S::F8::load(&t), S::F8::splat(0.0).lt(S::F8::load(&anew)));
        let taken = t.lt(before);
        self.offer::<ANY>(
            taken | anew,
            taken & !anew,
            [t, number::<S>(place), S::F8::load(&u), S::F8::load(&v)],
        );
    }
}

/// A number in each lane, as bits.
#[inline(always)]
fn number<S: Simd>(i: u32) -> S::F8 {
    S::F8::splat(f32::from_bits(i))
}

/// The edge functions of a triangle, and how far its corners are.
struct Edges<S: Simd> {
    e: [S::F8; 3],
    z: [S::F8; 3],
}

impl<S: Simd> Edges<S> {
    #[inline(always)]
    fn new([a, b, c]: [&Sheared<S>; 3]) -> Edges<S> {
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        Edges { e: [u, v, w], z: [a[2], b[2], c[2]] }
    }
    /// Rays with no edge functions of different signs.
    #[inline(always)]
    fn inside(&self) -> Which<S> {
        let ([u, v, w], zero) = (self.e, S::F8::splat(0.0));
        zero.le(u.min(v).min(w)) | u.max(v).max(w).le(zero)
    }
    #[inline(always)]
    fn only_where(&self, mask: Which<S>, o: &Edges<S>) -> Edges<S> {
        let choose = |a: &[S::F8; 3], b: &[S::F8; 3]| {
            [a[0].only_where(mask, b[0]), a[1].only_where(mask, b[1]), a[2].only_where(mask, b[2])]
        };
        Edges { e: choose(&self.e, &o.e), z: choose(&self.z, &o.z) }
    }
}

/// What eight rays meet.
pub(crate) struct Eight {
    t: [f32; RAYS],
    /// Numbers of primitives; also where nothing is met.
    id: [u32; RAYS],
    u: [f32; RAYS],
    v: [f32; RAYS],
    /// One bit for each ray that met something.
    hit: u32,
    /// One bit for each that has to be asked by itself instead.
    pub(super) anew: u32,
}

impl Eight {
    /// What a ray meets, and whether it does: else it is of no meaning, but for the number of some primitive.
    #[inline(always)]
    pub(crate) fn get(&self, i: usize) -> (RawHit, bool) {
        let i = i % RAYS;
        (RawHit { t: self.t[i], id: self.id[i], u: self.u[i], v: self.v[i] }, self.hit >> i & 1 == 1)
    }
}

/// The nearest points of eight rays, or with `ANY` any.
#[inline(always)]
pub(super) fn hit<S: Simd, const ANY: bool>(
    few: &Few,
    rays: &[Ray; RAYS],
    others: &impl Others,
    corners: &mut [Sheared<S>; MAX_VERTICES],
) -> Eight {
    let packet = Packet::<S>::new(rays);
    let error = packet.shear(&few.vertices, corners);
    let (zero, none) = (S::F8::splat(0.0), Which::<S>::none());
    let mut nearest = Nearest::<S> {
        t: packet.t_max,
        place: zero,
        u: zero,
        v: zero,
        hit: none,
        anew: none,
        open: packet.valid,
    };
    for (bounds, range) in &few.leaves {
        let (met, t0) = packet.meets(bounds, nearest.t);
        if !(met & nearest.open).any() {
            continue;
        }
        for (pair, i) in few.pairs[range.clone()].iter().zip(range.start as u32..) {
            nearest.pair::<ANY>((i, pair), (met, t0), (&*corners, &error, packet.s[2]));
        }
    }
    for (Other { bounds, id, ball }, place) in few.others.iter().zip(2 * few.pairs.len() as u32..) {
        let (met, t0) = packet.meets(bounds, nearest.t);
        let met = met & packet.reaches(ball);
        if !(met & nearest.open).any() {
            continue;
        }
        match others.roots(*id, &packet.o.map(S::F8::to_array), &packet.d.map(S::F8::to_array)) {
            Some(roots) => nearest.ball::<ANY>(place, (met, t0), &roots),
            None => nearest.others::<ANY>((place, *id), (met, t0), rays, others),
        }
    }
    let mut id = [0; RAYS];
    for (id, place) in id.iter_mut().zip(nearest.place.to_array()) {
        *id = few.ids[place.to_bits() as usize];
    }
    Eight {
        t: nearest.t.to_array(),
        id,
        u: nearest.u.to_array(),
        v: nearest.v.to_array(),
        hit: nearest.hit.bits(),
        anew: nearest.anew.bits(),
    }
}
