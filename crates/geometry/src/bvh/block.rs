//! Eight triangles of a leaf, tested together: [`TriBlock`].
//!
//! Watertight [Woop2013]: the ray is sheared to the z axis, and the signs of the three edge functions decide. Two
//! triangles that share an edge see the same products there, so no ray passes between them.

#![allow(
    unsafe_code,
    reason = "says that the bytes of a type are numbers, so that it can lie in mapped pages"
)]

use bytemuck::{Pod, Zeroable};
use sparrow_math::Vec3;

use super::ray_data::RayData;
use super::traverse::Block;
use crate::lerp::Lerp;
use crate::ray::Ray;
use crate::simd::{Floats, Mask, Simd};

/// Triangles of a block.
pub(crate) const LEAF_SIZE: usize = 8;

/// One number for each triangle of a block.
pub(crate) type LeafFloats<S> = <S as Simd>::F8;

/// A point where a ray meets a primitive, as the tree knows it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RawHit {
    pub(crate) t: f32,
    /// Number of the primitive among those of the tree.
    pub(crate) id: u32,
    /// Weights of the second and third corner, or the parameters of a patch; not set for quadrics.
    pub(crate) u: f32,
    pub(crate) v: f32,
}

/// Eight triangles, side by side. Unused places hold NaN and are never hit.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct TriBlock {
    /// `p[corner][axis]`
    p: [[[f32; LEAF_SIZE]; 3]; 3],
    id: [u32; LEAF_SIZE],
}

// SAFETY: numbers without gaps between them: 320 bytes, a multiple of the alignment.
unsafe impl Pod for TriBlock {}
// SAFETY: as above.
unsafe impl Zeroable for TriBlock {}

/// Bound of the relative error of `n` roundings in a row. [PharrJakobHumphreys2023, section 6.8.1]
pub(crate) const fn gamma(n: u32) -> f32 {
    let e = n as f32 * (f32::EPSILON / 2.0);
    e / (1.0 - e)
}

/// Corners, brought to where the ray runs along z from the origin; z stays unscaled.
#[inline(always)]
fn sheared<S: Simd>(p: &[[f32; LEAF_SIZE]; 3], r: &RayData<S>) -> [LeafFloats<S>; 3] {
    let axis = |i: usize| LeafFloats::<S>::load(&p[r.k[i] % 3]) - r.o_k[i];
    let z = axis(2);
    [axis(0) - r.s[0] * z, axis(1) - r.s[1] * z, z]
}

/// Bound of the error of `t`, for corners `p` in sheared space and edge functions `e`. [PharrJakobHumphreys2023, section 6.8.7]
#[inline(always)]
pub(super) fn t_error<S: Simd>(
    p: &[[LeafFloats<S>; 3]; 3],
    e: &[LeafFloats<S>; 3],
    inv: LeafFloats<S>,
    sz: LeafFloats<S>,
) -> LeafFloats<S> {
    let of = |x: f32| LeafFloats::<S>::splat(x);
    let largest = |i: usize| p[0][i].abs().max(p[1][i].abs()).max(p[2][i].abs());
    let (x, y, depth) = (largest(0), largest(1), largest(2));
    let z = depth * sz.abs();
    let (dx, dy, dz) = (of(gamma(5)) * (x + depth), of(gamma(5)) * (y + depth), of(gamma(3)) * z);
    let de = of(2.0) * (of(gamma(2)) * x * y + dy * x + dx * y);
    let e = e[0].abs().max(e[1].abs()).max(e[2].abs());
    of(3.0) * (of(gamma(3)) * e * z + de * z + dz * e) * inv.abs()
}

impl TriBlock {
    pub(crate) fn empty() -> TriBlock {
        TriBlock { p: [[[f32::NAN; LEAF_SIZE]; 3]; 3], id: [u32::MAX; LEAF_SIZE] }
    }
    pub(crate) fn set(&mut self, i: usize, id: u32, corners: &[[f32; 3]; 3]) {
        self.id[i] = id;
        for (to, from) in self.p.iter_mut().zip(corners) {
            for (to, from) in to.iter_mut().zip(from) {
                to[i] = *from;
            }
        }
    }

    /// The triangles: numbers and corners.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = (u32, [[f32; 3]; 3])> {
        let used = |i: &usize| !self.p[0][0][*i].is_nan();
        (0..LEAF_SIZE).filter(used).map(|i| (self.id[i], self.p.map(|p| p.map(|axis| axis[i]))))
    }

    /// The triangles between these and those where motion ends.
    #[inline(always)]
    pub(super) fn between<S: Simd>(&self, end: &TriBlock, at: Lerp) -> TriBlock {
        let (s, t) = (LeafFloats::<S>::splat(at.start), LeafFloats::<S>::splat(at.end));
        let mut now = *self;
        for (now, end) in now.p.as_flattened_mut().iter_mut().zip(end.p.as_flattened()) {
            *now = (LeafFloats::<S>::load(now) * s + LeafFloats::<S>::load(end) * t).to_array();
        }
        now
    }

    /// Decides in double precision what single precision left open of triangle `i`, its corners `p` in sheared space.
    #[cold]
    #[inline(never)]
    fn settle(&self, ray: &Ray, i: usize, p: [[f32; 3]; 3]) -> Option<RawHit> {
        // The products are exact in double precision, so the sign of the difference is.
        let edge =
            |p: [f32; 3], q: [f32; 3]| f64::from(p[0]) * f64::from(q[1]) - f64::from(p[1]) * f64::from(q[0]);
        let (u, v, w) = (edge(p[2], p[1]), edge(p[0], p[2]), edge(p[1], p[0]));
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let inv = 1.0 / (u + v + w);
        let corner = |p: &[[f32; LEAF_SIZE]; 3]| Vec3::from(p.map(|x| x[i])).to_f64();
        let a = corner(&self.p[0]);
        let n = (corner(&self.p[1]) - a).cross(corner(&self.p[2]) - a);
        let t = ((a - ray.o.to_f64()).dot(n) / ray.d.to_f64().dot(n)) as f32;
        let hit = RawHit { t, id: self.id[i], u: (v * inv) as f32, v: (w * inv) as f32 };
        (t > 0.0 && inv.is_finite()).then_some(hit)
    }
}

impl Block for TriBlock {
    #[inline(always)]
    fn hit<S: Simd>(
        &self,
        ray: &Ray,
        r: &RayData<S>,
        mut t_max: f32,
        found: &mut impl FnMut(RawHit) -> f32,
    ) -> f32 {
        let p @ [a, b, c] = [sheared(&self.p[0], r), sheared(&self.p[1], r), sheared(&self.p[2], r)];
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let zero = LeafFloats::<S>::splat(0.0);
        let (least, greatest) = (u.min(v).min(w), u.max(v).max(w));
        let inside = zero.le(least) | greatest.le(zero);
        if !inside.any() {
            return t_max;
        }
        let inv = LeafFloats::<S>::splat(1.0) / (u + v + w);
        let t = (u * a[2] + v * b[2] + w * c[2]) * r.s[2] * inv;
        let mut mask = (inside & zero.lt(t) & t.lt(LeafFloats::<S>::splat(t_max))).bits();
        if mask == 0 {
            return t_max;
        }
        // No edge function is zero, and `t` is beyond its error.
        let settled = (zero.lt(least) | greatest.lt(zero)) & t_error::<S>(&p, &[u, v, w], inv, r.s[2]).lt(t);
        let settled = settled.bits();
        let (t, b1, b2) = (t.to_array(), (v * inv).to_array(), (w * inv).to_array());
        while mask != 0 {
            let i = mask.trailing_zeros() as usize & (LEAF_SIZE - 1);
            mask &= mask - 1;
            let mut hit = RawHit { t: t[i], id: self.id[i], u: b1[i], v: b2[i] };
            if settled >> i & 1 == 0 {
                let one = |[x, y, z]: [LeafFloats<S>; 3]| [x.to_array()[i], y.to_array()[i], z.to_array()[i]];
                let exact = self.settle(ray, i, [one(a), one(b), one(c)]);
                let Some(exact) = exact else { continue };
                hit = exact;
            }
            if hit.t < t_max {
                t_max = found(hit);
            }
        }
        t_max
    }
}
