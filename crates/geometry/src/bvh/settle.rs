//! The nearest points of eight rays, worked out as for single rays: [`settle`].

use super::block::t_error;
use super::few::{Few, MAX_PLACES};
use super::packet::{Eight, Nearest, Packet, RAYS, Vectors, Which};
use crate::simd::{Floats, Mask, Simd};

/// The axes of eight rays, the longest of the direction last. Single rays turn the others so that the winding of triangles stays; not
/// doing so changes signs of edge functions, and nothing else.
struct Turns<S: Simd> {
    /// The longest is the first, is the second.
    first: Which<S>,
    second: Which<S>,
}

impl<S: Simd> Turns<S> {
    #[inline(always)]
    fn new(d: Vectors<S>) -> Turns<S> {
        let a = [d[0].abs(), d[1].abs(), d[2].abs()];
        let first = a[1].lt(a[0]) & a[2].lt(a[0]);
        Turns { first, second: a[0].le(a[1]) & a[2].lt(a[1]) }
    }
    #[inline(always)]
    fn of(&self, v: Vectors<S>) -> Vectors<S> {
        let longest = v[0].only_where(self.first, v[1].only_where(self.second, v[2]));
        [v[2].only_where(self.first, v[0]), v[2].only_where(self.second, v[1]), longest]
    }
}

/// Brings corners, one for each ray, to where the rays run along z from the origin.
struct Shear<S: Simd> {
    turns: Turns<S>,
    o: Vectors<S>,
    s: Vectors<S>,
}

impl<S: Simd> Shear<S> {
    #[inline(always)]
    fn new(rays: &Packet<S>) -> Shear<S> {
        let turns = Turns::<S>::new(rays.d);
        let d = turns.of(rays.d);
        let sz = S::F8::splat(1.0) / d[2];
        Shear { o: rays.o, s: [d[0] * sz, d[1] * sz, sz], turns }
    }
    #[inline(always)]
    fn of(&self, p: Vectors<S>) -> Vectors<S> {
        let [x, y, z] = self.turns.of([p[0] - self.o[0], p[1] - self.o[1], p[2] - self.o[2]]);
        [x - self.s[0] * z, y - self.s[1] * z, z]
    }
}

/// Tests one triangle for each ray as [`TriBlock`](super::block::TriBlock) does: where the ray meets it, and which rays surely do so before they end.
#[inline(always)]
fn triangle<S: Simd>(rays: &Packet<S>, corners: [Vectors<S>; 3]) -> ([S::F8; 3], Which<S>) {
    let (shear, zero) = (Shear::<S>::new(rays), S::F8::splat(0.0));
    let p @ [a, b, c] = [shear.of(corners[0]), shear.of(corners[1]), shear.of(corners[2])];
    let u = c[0] * b[1] - c[1] * b[0];
    let v = a[0] * c[1] - a[1] * c[0];
    let w = b[0] * a[1] - b[1] * a[0];
    let (least, greatest) = (u.min(v).min(w), u.max(v).max(w));
    let inv = S::F8::splat(1.0) / (u + v + w);
    let t = (u * a[2] + v * b[2] + w * c[2]) * shear.s[2] * inv;
    // The bound is rounded otherwise than for single rays, where axes are.
    let error = t_error::<S>(&p, &[u, v, w], inv, shear.s[2]) * S::F8::splat(1.00001);
    let sure = error.lt(t) & t.lt(rays.t_max);
    ([t, v * inv, w * inv], (zero.lt(least) | greatest.lt(zero)) & sure)
}

/// Half of the numbers of the primitives in these places.
#[inline(always)]
fn columns<S: Simd>(few: &Few, places: &[u32; RAYS], half: usize) -> [S::F8; 8] {
    S::columns(places.map(|place| &few.rows[place as usize % MAX_PLACES][half]))
}

/// What the rays meet, given what is the nearest for each.
#[inline(always)]
pub(super) fn settle<S: Simd>(few: &Few, rays: &Packet<S>, nearest: Nearest<S>) -> Eight {
    let (hit, anew) = (nearest.hit.bits(), nearest.anew.bits());
    if hit & !anew == 0 {
        return Eight { anew, ..Eight::default() };
    }
    let places = nearest.place.to_array().map(f32::to_bits);
    let [ax, ay, az, bx, by, bz, cx, cy] = columns::<S>(few, &places, 0);
    let [cz, shape, prim, first, second, ..] = columns::<S>(few, &places, 1);
    let ([t, u, v], sure) = triangle::<S>(rays, [[ax, ay, az], [bx, by, bz], [cx, cy, cz]]);
    let face = nearest.face;
    let [t, u, v] = [
        t.only_where(face, nearest.t[0]),
        u.only_where(face, nearest.uv[0]),
        v.only_where(face, nearest.uv[1]),
    ];
    // Parameters of a parallelogram from those of its halves; of nothing else does a part differ from the whole.
    let (zero, one) = (S::F8::splat(0.0), S::F8::splat(1.0));
    let (first, second, sum) = (zero.lt(first), zero.lt(second), (u + v).min(one));
    let [u, v] = [
        sum.only_where(first, u.min(one).only_where(second, u)),
        v.min(one).only_where(first, sum.only_where(second, v)),
    ];
    Eight {
        rows: S::rows([t, shape, prim, u]),
        v: v.to_array(),
        hit,
        anew: (nearest.anew | face & !sure).bits(),
    }
}
