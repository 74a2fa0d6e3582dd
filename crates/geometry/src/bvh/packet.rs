//! Eight rays at once through a tree of one node.
//!
//! Lanes are rays. Rounded numbers with margins tell which rays miss what; what the nearest is for each ray is then worked out as for
//! a single ray, to the bit. Where margins leave something open, rays are asked anew one by one.

use super::block::RawHit;
use super::face::{Face, RepeatedVector, Wall};
use super::few::{Ball, Few, Other};
use super::ray_data::{PAD, TINY_INV};
use super::settle::settle;
use super::traverse::Others;
use crate::ray::{Hit, Ray};
use crate::simd::{Floats, Mask, Simd};
use sparrow_math::Aabb;

/// Rays of a packet.
pub(crate) const RAYS: usize = 8;

/// Half a unit in the last place of one: what a rounding errs at most.
const ROUNDING: f32 = 0.5 * f32::EPSILON;

/// One truth value for each ray.
pub(super) type Which<S> = <<S as Simd>::F8 as Floats<8>>::Mask;

/// A vector for each ray.
pub(super) type Vectors<S> = [<S as Simd>::F8; 3];

#[inline(always)]
fn load<S: Simd>(v: &[[f32; RAYS]; 3]) -> Vectors<S> {
    [S::F8::load(&v[0]), S::F8::load(&v[1]), S::F8::load(&v[2])]
}
#[inline(always)]
fn splat<S: Simd>(v: [f32; 3]) -> Vectors<S> {
    [S::F8::splat(v[0]), S::F8::splat(v[1]), S::F8::splat(v[2])]
}
#[inline(always)]
fn minus<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> Vectors<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
#[inline(always)]
fn dot<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> S::F8 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
#[inline(always)]
fn cross<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> Vectors<S> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
#[inline(always)]
fn sum_abs<S: Simd>(v: Vectors<S>) -> S::F8 {
    v[0].abs() + v[1].abs() + v[2].abs()
}

/// Eight rays.
pub(super) struct Packet<S: Simd> {
    pub(super) o: Vectors<S>,
    pub(super) d: Vectors<S>,
    pub(super) t_max: S::F8,
    /// Reciprocals of the direction; zero where it is.
    pub(super) inv: Vectors<S>,
    /// What a rounding moves the parameters of points by, whose coordinate along an axis is known.
    late: Vectors<S>,
    /// The same times the length of the direction: what it moves the points by.
    aside: Vectors<S>,
    /// The square of the direction's length.
    d2: S::F8,
    /// A quarter of what products of the direction and unit vectors err by.
    turn: S::F8,
    /// What distances from the origin may err by in a rounding: nothing lies further from it.
    near: S::F8,
    /// The same times the length of the direction, which is rounded up.
    slack: S::F8,
    /// Neither origins nor directions are so large or small that margins are of no use, nor is the end before the start.
    sane: Which<S>,
}

impl<S: Simd> Packet<S> {
    #[inline(always)]
    fn new(rays: &[Ray; RAYS], radius: f32) -> Packet<S> {
        let [ox, oy, oz, dx, dy, dz, t_max, _] = S::columns(rays.each_ref().map(Ray::row));
        let (o, d) = ([ox, oy, oz], [dx, dy, dz]);
        let (far, length) = (sum_abs::<S>(o) + S::F8::splat(radius), sum_abs::<S>(d));
        let (small, large) = (S::F8::splat(1e-9), S::F8::splat(1e9));
        let size = far * length;
        let sane = small.lt(length) & length.lt(large) & far.lt(large);
        let near = far * S::F8::splat(ROUNDING);
        let inv = [inverse::<S>(dx), inverse::<S>(dy), inverse::<S>(dz)];
        let late = [near * inv[0].abs(), near * inv[1].abs(), near * inv[2].abs()];
        let aside = [late[0] * length, late[1] * length, late[2] * length];
        // Not so close to a plane of the axes that it can hardly be told where they meet.
        let sane = sane & aside[0].max(aside[1]).max(aside[2]).lt(near * S::F8::splat(1e12));
        Packet {
            o,
            d,
            t_max,
            inv,
            late,
            aside,
            d2: dot::<S>(d, d),
            turn: length * S::F8::splat(ROUNDING),
            near,
            slack: near * length,
            sane: sane & S::F8::splat(1e-12).lt(size) & S::F8::splat(0.0).le(t_max),
        }
    }

    /// Rays that meet a box between 0 and `t_max`, and where they enter it.
    #[inline(always)]
    fn meets(&self, b: &Aabb, t_max: S::F8) -> (Which<S>, S::F8) {
        let (mut t0, mut t1) = (S::F8::splat(0.0), t_max);
        for axis in 0..3 {
            let minus_inv = minus_inv::<S>(self.d[axis]);
            let (near, far) = (minus_inv * S::F8::splat(1.0 - PAD), minus_inv * S::F8::splat(1.0 + PAD));
            let (p, q) = (self.o[axis] - S::F8::splat(b.lo[axis]), self.o[axis] - S::F8::splat(b.hi[axis]));
            // The nearer face gives the smaller product: rounding keeps order.
            t0 = (p * near).min(q * near).max_nonneg(t0);
            t1 = (p * far).max(q * far).min_nonneg(t1);
        }
        (t0.le(t1), t0)
    }
}

/// Reciprocals; zero of zero.
#[inline(always)]
fn inverse<S: Simd>(d: S::F8) -> S::F8 {
    let zero = S::F8::splat(0.0);
    (S::F8::splat(1.0) / d).only_where(zero.lt(d.abs()), zero)
}
/// Reciprocals, negated.
#[inline(always)]
fn minus_inv<S: Simd>(d: S::F8) -> S::F8 {
    let (inv, stand_in) = (S::F8::splat(1.0) / d, S::F8::splat(TINY_INV).signed(d));
    S::F8::splat(-1.0) * stand_in.only_where(d.abs().lt(S::F8::splat(1e-30)), inv)
}

/// The plane of a parallelogram as rays see it.
struct Seen<S: Simd> {
    /// Its distance.
    height: S::F8,
    /// How fast the rays come nearer. All else is multiplied by this.
    slope: S::F8,
    /// Coordinates of where they meet it.
    x: S::F8,
    y: S::F8,
}

impl<S: Simd> Seen<S> {
    #[inline(always)]
    fn new(rays: &Packet<S>, moment: Vectors<S>, f: &Face) -> Seen<S> {
        let normal = load::<S>(&f.normal);
        Seen {
            height: S::F8::load(&f.level) - dot::<S>(normal, rays.o),
            slope: dot::<S>(normal, rays.d),
            x: line::<S>([moment, rays.d], &f.of_moment[0], &f.of_direction[0]),
            y: line::<S>([moment, rays.d], &f.of_moment[1], &f.of_direction[1]),
        }
    }
}

/// A coordinate of lines, given as moments and directions.
#[inline(always)]
fn line<S: Simd>(
    [m, d]: [Vectors<S>; 2],
    of_moment: &RepeatedVector,
    of_direction: &RepeatedVector,
) -> S::F8 {
    dot::<S>(load::<S>(of_moment), m) - dot::<S>(load::<S>(of_direction), d)
}

/// A dot product, and the sum of what it adds without signs.
#[inline(always)]
fn dot_and_terms<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> [S::F8; 2] {
    let terms = (a[0] * b[0]).abs() + (a[1] * b[1]).abs() + (a[2] * b[2]).abs();
    [dot::<S>(a, b), terms]
}

/// What eight rays meet so far.
pub(super) struct Nearest<S: Simd> {
    /// Between these bounds lies the nearest point, or where the ray ends; they are the same where it is known to the bit.
    pub(super) t: [S::F8; 2],
    /// The place in [`Few::rows`], as bits.
    pub(super) place: S::F8,
    /// Parameters of points that are not those of faces.
    pub(super) uv: [S::F8; 2],
    /// Rays that met something.
    pub(super) hit: Which<S>,
    /// Those of them whose nearest point is that of a face.
    pub(super) face: Which<S>,
    /// Rays to be asked anew.
    pub(super) anew: Which<S>,
    /// Rays that look on.
    open: Which<S>,
}

impl<S: Simd> Nearest<S> {
    /// Tests a wall. The sides that rays begin on are known to the bit.
    #[inline(always)]
    fn wall<const ANY: bool>(&mut self, rays: &Packet<S>, f: &Wall) {
        let (zero, one) = (S::F8::splat(0.0), S::F8::splat(1.0));
        let (axis, i, j) = (f.axes[0] as usize, f.axes[1] as usize, f.axes[2] as usize);
        let height = S::F8::load(&f.center[0]) - rays.o[axis];
        let (x0, y0) = (rays.o[i] - S::F8::load(&f.center[1]), rays.o[j] - S::F8::load(&f.center[2]));
        let t = height * rays.inv[axis];
        let x = (x0 + t * rays.d[i]) * S::F8::load(&f.scales[0]);
        let y = (y0 + t * rays.d[j]) * S::F8::load(&f.scales[1]);
        let off = x.abs().max(y.abs());
        let (margin, dt) =
            (rays.aside[axis] * S::F8::load(&f.margin), rays.late[axis] * S::F8::load(&f.depth));
        let met = off.le(one + margin) & zero.lt(t) & (t - dt).le(self.t[1]);
        if ANY {
            if met.any() {
                // Rays to a lamp end so close to it that only margins by its own distance tell.
                let far = sum_abs::<S>([height, x0, y0]) + S::F8::splat(f.across);
                let dt = far * rays.inv[axis].abs() * (S::F8::splat(ROUNDING) * S::F8::load(&f.depth));
                let met = met & (t - dt).le(self.t[1]);
                self.take::<ANY>(met, met & off.lt(one - margin) & dt.lt(t) & (t + dt).lt(self.t[0]));
            }
        } else {
            let taken = met & (t + dt).lt(self.t[0]);
            self.take::<ANY>(met, taken);
            self.face = self.face | taken;
            let place = S::F8::load(&f.places[1]).only_where(x.lt(y), S::F8::load(&f.places[0]));
            self.put(taken, [t - dt, t + dt], place);
        }
    }

    /// Tests half of a parallelogram where `HALF` says so, else all of it. The moments of the rays are the products of their directions and
    /// origins.
    #[inline(always)]
    fn face<const ANY: bool, const HALF: bool>(
        &mut self,
        (rays, moment): (&Packet<S>, Vectors<S>),
        face: &Face,
    ) {
        let (f, Seen { height, slope, x, y }) = (&face.extent, Seen::new(rays, moment, face));
        let (zero, steep, t) = (S::F8::splat(0.0), slope.abs(), height.signed(slope));
        let (dx, dy) = (rays.slack * S::F8::load(&f.margins[0]), rays.slack * S::F8::load(&f.margins[1]));
        let dt = rays.near * S::F8::load(&f.depth);
        let mut met = x.abs().le(steep + dx) & y.abs().le(steep + dy);
        met = met & (zero - dt).le(t) & t.le(self.t[1] * steep + dt) & self.open;
        if HALF {
            met = met & (x + y).signed(slope).le(dx + dy);
        }
        if !met.any() {
            return;
        }
        // A ray leaves its own surface closer than these margins can tell, or even in the plane, and ends that close before others.
        let to = minus::<S>(splat::<S>(f.center), rays.o);
        let [height, terms] = dot_and_terms::<S>(load::<S>(&face.normal), to);
        let aside = S::F8::splat(5.0 * ROUNDING) * terms + S::F8::splat(f.bent);
        let sided = aside.le(height.abs()) & (S::F8::splat(4.0) * rays.turn).lt(steep);
        let far = sum_abs::<S>(to) + S::F8::splat(f.across);
        let dt = far * S::F8::splat(ROUNDING) * S::F8::load(&f.depth) + S::F8::splat(2.0 * f.bent);
        let t = height.signed(slope);
        let met = met & !(sided & t.le(zero)) & (t - dt).le(self.t[1] * steep);
        if ANY {
            let mut sure = met & x.abs().lt(steep - dx) & y.abs().lt(steep - dy);
            sure = sure & dt.lt(t) & t.lt(self.t[0] * steep - dt);
            if HALF {
                sure = sure & (x + y).signed(slope).lt(zero - dx - dy);
            }
            self.take::<ANY>(met, sure);
        } else {
            let inv = S::F8::splat(1.0) / steep;
            let (t, dt) = (t * inv, dt * inv);
            let taken = met & sided & (t + dt).lt(self.t[0]);
            let second = (x - y).signed(slope).lt(zero);
            let place = number::<S>(f.place);
            let place = if HALF { place } else { number::<S>(f.place + 1).only_where(second, place) };
            self.take::<ANY>(met, taken);
            self.face = self.face | taken;
            self.put(taken, [t - dt, t + dt], place);
        }
    }

    /// Rays that are `sure` to meet something, of those that may.
    #[inline(always)]
    fn take<const ANY: bool>(&mut self, met: Which<S>, sure: Which<S>) {
        self.hit = self.hit | sure;
        self.anew = self.anew | met & !sure;
        if ANY {
            self.open = self.open & !sure;
        }
    }
    /// The nearest points of the rays `taken`.
    #[inline(always)]
    fn put(&mut self, taken: Which<S>, t: [S::F8; 2], place: S::F8) {
        self.t = [t[0].only_where(taken, self.t[0]), t[1].only_where(taken, self.t[1])];
        self.place = place.only_where(taken, self.place);
    }
    /// Offers exact points at `t` of a primitive that is not a triangle, where they are `met`; `known` says where a point that is the nearest is
    /// surely found by a single ray too.
    #[inline(always)]
    fn offer<const ANY: bool>(
        &mut self,
        place: u32,
        (met, known): (Which<S>, Which<S>),
        [t, u, v]: [S::F8; 3],
    ) {
        let near = met & self.open & S::F8::splat(0.0).lt(t) & t.le(self.t[1]);
        let taken = near & known & t.lt(self.t[0]);
        self.take::<ANY>(near, taken);
        self.face = self.face & !taken;
        self.put(taken, [t, t], number::<S>(place));
        self.uv = [u.only_where(taken, self.uv[0]), v.only_where(taken, self.uv[1])];
    }

    /// Tests a primitive that is not a triangle.
    #[inline(always)]
    fn other<const ANY: bool>(
        &mut self,
        rays: &Packet<S>,
        other: &Other,
        list: &[Ray; RAYS],
        others: &impl Others,
    ) {
        let (zero, Ball { center, radius, whole }) = (S::F8::splat(0.0), other.ball);
        let to = minus::<S>(splat::<S>(center), rays.o);
        // How far the ray's line passes from the centre, and the stretch of it within the ball; times the length of the direction.
        let off = cross::<S>(to, rays.d);
        let (off2, along) = (dot::<S>(off, off), dot::<S>(to, rays.d));
        let err = S::F8::splat(16.0) * rays.near;
        let (outer, inner) = (S::F8::splat(radius) + err, S::F8::splat(0.99999 * radius) - err);
        let half = (outer * outer * rays.d2 - off2).sqrt();
        let slack = S::F8::splat(16.0) * rays.slack;
        let ahead = (zero - slack).le(along + half) & (along - half).le(self.t[1] * rays.d2 + slack);
        let mut met = ahead & self.open;
        if !met.any() {
            return;
        }
        // Those that graze it may miss its box.
        let inside = off2.lt(inner * inner * rays.d2) & zero.lt(inner);
        if ANY && whole {
            // They come from outside, and are in its middle before they end.
            let sure = met & inside & slack.lt(along - half) & (along + slack).lt(self.t[0] * rays.d2);
            self.take::<ANY>(sure, sure);
            met = met & !sure;
            if !met.any() {
                return;
            }
        }
        let (o, d) = (rays.o.map(S::F8::to_array), rays.d.map(S::F8::to_array));
        if let Some([near, far]) = others.roots(other.id, &o, &d) {
            let (near, far) = (S::F8::load(&near), S::F8::load(&far));
            let t = near.only_where(zero.lt(near), far);
            self.offer::<ANY>(other.place, (met, inside), [t, zero, zero]);
        } else {
            self.one_by_one::<ANY>(other, met, (rays, list), others);
        }
    }

    /// Asks for the points of a primitive ray by ray.
    #[inline(always)]
    fn one_by_one<const ANY: bool>(
        &mut self,
        other: &Other,
        met: Which<S>,
        (rays, list): (&Packet<S>, &[Ray; RAYS]),
        others: &impl Others,
    ) {
        let (inside, t0) = rays.meets(&other.bounds, self.t[1]);
        let mut left = (met & inside).bits();
        let (limit, mut points) = (self.t[1].to_array(), [[f32::NAN; RAYS]; 3]);
        while left != 0 {
            let i = left.trailing_zeros() as usize & (RAYS - 1);
            left &= left - 1;
            // One that lies as far as the limit shows in this way.
            others.hit(other.id, &list[i], limit[i].next_up(), &mut |h: RawHit| {
                for (to, x) in points.iter_mut().zip([h.t, h.u, h.v]) {
                    to[i] = x;
                }
                h.t
            });
        }
        let [t, u, v] = load::<S>(&points);
        self.offer::<ANY>(other.place, (met, t0.le(t)), [t, u, v]);
    }
}

/// A number in each lane, as bits.
#[inline(always)]
fn number<S: Simd>(i: u32) -> S::F8 {
    S::F8::splat(f32::from_bits(i))
}

/// What eight rays meet.
#[derive(Default)]
pub(crate) struct Eight {
    /// Where along ray i and i + 4, the bits of the numbers of shape and primitive, and the first parameter of the primitive; also where
    /// nothing is met.
    pub(super) rows: [[f32; RAYS]; 4],
    /// The second parameters.
    pub(super) v: [f32; RAYS],
    /// One bit for each ray that met something.
    pub(super) hit: u32,
    /// One bit for each that has to be asked by itself instead.
    pub(super) anew: u32,
}

impl Eight {
    /// The rays that met something.
    #[inline(always)]
    pub(crate) fn met(&self) -> [bool; RAYS] {
        // A bit for a byte.
        let bits = (u64::from(self.hit) * 0x0101_0101_0101_0101) & 0x8040_2010_0804_0201;
        bits.to_le_bytes().map(|b| b != 0)
    }
    /// What ray i met, if it did.
    #[inline(always)]
    pub(crate) fn get(&self, i: usize) -> Option<Hit> {
        let (row, at) = (&self.rows[i % 4], i & 4);
        let [t, shape, prim, u] = [row[at], row[at + 1], row[at + 2], row[at + 3]];
        let hit =
            Hit { t, shape: shape.to_bits(), prim: prim.to_bits(), u, v: self.v[i % RAYS], instance: None };
        (self.hit >> i & 1 == 1).then_some(hit)
    }
}

/// The nearest points of eight rays, or with `ANY` no more than whether there are any.
#[inline(always)]
pub(super) fn hit<S: Simd, const ANY: bool>(few: &Few, list: &[Ray; RAYS], others: &impl Others) -> Eight {
    let rays = Packet::<S>::new(list, few.radius);
    let (zero, none) = (S::F8::splat(0.0), Which::<S>::none());
    // Infinity times a slope of zero would be no number.
    let end = rays.t_max.min(S::F8::splat(f32::MAX));
    let mut nearest = Nearest::<S> {
        t: [end, end],
        place: zero,
        uv: [zero, zero],
        hit: none,
        face: none,
        anew: none,
        open: rays.sane,
    };
    for f in &few.walls {
        nearest.wall::<ANY>(&rays, f);
    }
    if few.squares.len() + few.triangles.len() > 0 {
        let moment = cross::<S>(rays.d, rays.o);
        for f in &few.squares {
            nearest.face::<ANY, false>((&rays, moment), f);
        }
        for f in &few.triangles {
            nearest.face::<ANY, true>((&rays, moment), f);
        }
    }
    for other in &few.others {
        nearest.other::<ANY>(&rays, other, list, others);
    }
    nearest.anew = nearest.anew | !rays.sane;
    if ANY {
        let hit = (nearest.hit & rays.sane).bits();
        Eight { hit, anew: nearest.anew.bits() & !hit, ..Eight::default() }
    } else {
        settle(few, &rays, nearest)
    }
}
