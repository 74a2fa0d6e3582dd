//! Four triangles of a leaf, tested together: [`TriBlock`].
//!
//! Watertight [Woop2013]: the ray is sheared to the z axis, and the signs of the three edge functions decide. Two
//! triangles that share an edge see the same products there, so no ray passes between them.

use sparrow_math::Vec3;

use super::lanes::F4;
use super::node::RayData;
use crate::ray::Ray;

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

/// Four triangles, side by side. Unused places hold NaN and are never hit.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(crate) struct TriBlock {
    /// `p[corner][axis]`
    p: [[F4; 3]; 3],
    id: [u32; 4],
}

/// Bound of the relative error of `n` roundings in a row. [PharrJakobHumphreys2023, section 6.8.1]
pub(crate) const fn gamma(n: u32) -> f32 {
    let e = n as f32 * (f32::EPSILON / 2.0);
    e / (1.0 - e)
}

/// Corners, brought to where the ray runs along z from the origin; z stays unscaled.
#[inline(always)]
fn sheared(p: &[F4; 3], r: &RayData) -> [F4; 3] {
    let [kx, ky, kz] = r.k;
    let z = p[kz] - r.o_k[2];
    [p[kx] - r.o_k[0] - r.s[0] * z, p[ky] - r.o_k[1] - r.s[1] * z, z]
}

impl TriBlock {
    pub(crate) fn empty() -> TriBlock {
        TriBlock { p: [[F4::splat(f32::NAN); 3]; 3], id: [u32::MAX; 4] }
    }
    pub(crate) fn set(&mut self, i: usize, id: u32, corners: &[[f32; 3]; 3]) {
        self.id[i] = id;
        for (to, from) in self.p.iter_mut().zip(corners) {
            for (to, from) in to.iter_mut().zip(from) {
                to.set(i, *from);
            }
        }
    }

    /// Offers every point of the ray before `t_max` to `found`, which answers with the new `t_max`.
    #[inline(always)]
    pub(crate) fn hit(&self, ray: &Ray, r: &RayData, t_max: f32, mut found: impl FnMut(RawHit) -> f32) {
        let [a, b, c] = [sheared(&self.p[0], r), sheared(&self.p[1], r), sheared(&self.p[2], r)];
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let zero = F4::splat(0.0);
        let inside = zero.le(u.min(v).min(w)) | u.max(v).max(w).le(zero);
        if inside == 0 {
            return;
        }
        let det = u + v + w;
        let t = (u * a[2] + v * b[2] + w * c[2]) * r.s[2] / det;
        let mut mask = inside & zero.lt(t) & t.lt(F4::splat(t_max));
        let mut t_max = t_max;
        while mask != 0 {
            let i = mask.trailing_zeros() as usize & 3;
            mask &= mask - 1;
            let one = |[x, y, z]: [F4; 3]| [x.to_array()[i], y.to_array()[i], z.to_array()[i]];
            let s = Sheared { p: [one(a), one(b), one(c)], e: one([u, v, w]), t: t.to_array()[i] };
            let Some((t, b1, b2)) = s.settle(|| self.exact_t(ray, i), r.sz) else { continue };
            if t < t_max {
                t_max = found(RawHit { t, id: self.id[i], u: b1, v: b2 });
            }
        }
    }

    /// The plane's ray parameter in double precision.
    #[cold]
    fn exact_t(&self, ray: &Ray, i: usize) -> f32 {
        let corner = |p: &[F4; 3]| Vec3::from(p.map(|x| x.to_array()[i])).to_f64();
        let a = corner(&self.p[0]);
        let n = (corner(&self.p[1]) - a).cross(corner(&self.p[2]) - a);
        ((a - ray.o.to_f64()).dot(n) / ray.d.to_f64().dot(n)) as f32
    }
}

/// One triangle that passed the test of four.
struct Sheared {
    /// Corners in sheared space.
    p: [[f32; 3]; 3],
    /// Edge functions.
    e: [f32; 3],
    t: f32,
}

impl Sheared {
    /// Decides what single precision left open; gives `t` and the weights of the second and third corner.
    #[inline(always)]
    fn settle(&self, exact_t: impl Fn() -> f32, sz: f32) -> Option<(f32, f32, f32)> {
        let [mut u, mut v, mut w] = self.e;
        if u == 0.0 || v == 0.0 || w == 0.0 {
            // The products are exact in double precision, so the sign of the difference is.
            let [a, b, c] = self.p;
            let edge = |p: [f32; 3], q: [f32; 3]| {
                f64::from(p[0]) * f64::from(q[1]) - f64::from(p[1]) * f64::from(q[0])
            };
            let (eu, ev, ew) = (edge(c, b), edge(a, c), edge(b, a));
            if (eu < 0.0 || ev < 0.0 || ew < 0.0) && (eu > 0.0 || ev > 0.0 || ew > 0.0) {
                return None;
            }
            (u, v, w) = (eu as f32, ev as f32, ew as f32);
        }
        let inv = 1.0 / (u + v + w);
        let t = if self.t > self.t_error(inv, sz) { self.t } else { exact_t() };
        (t > 0.0 && inv.is_finite()).then_some((t, v * inv, w * inv))
    }

    /// Bound of the error of `t`, after [PharrJakobHumphreys2023, section 6.8.7].
    #[inline(always)]
    fn t_error(&self, inv: f32, sz: f32) -> f32 {
        let [a, b, c] = self.p;
        let largest = |i: usize| a[i].abs().max(b[i].abs()).max(c[i].abs());
        let (x, y, depth) = (largest(0), largest(1), largest(2));
        let z = depth * sz.abs();
        let (dx, dy, dz) = (gamma(5) * (x + depth), gamma(5) * (y + depth), gamma(3) * z);
        let de = 2.0 * (gamma(2) * x * y + dy * x + dx * y);
        let e = self.e[0].abs().max(self.e[1].abs()).max(self.e[2].abs());
        3.0 * (gamma(3) * e * z + de * z + dz * e) * inv.abs()
    }
}
