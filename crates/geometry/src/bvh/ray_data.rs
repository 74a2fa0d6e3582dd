//! [`RayData`]: a ray with what the tests need of it.

use super::block::LeafFloats;
use crate::ray::Ray;
use crate::simd::{Floats, Simd};

/// Eight units in the last place: more than the box test and the shear of the triangle test can err together, so that no ray
/// slips between two boxes that touch. [Ize2013; Woop2013, section 4]
pub(super) const PAD: f32 = 8.0 * f32::EPSILON;
/// A finite stand-in for 1/0: infinity times a distance of zero is not a number.
pub(super) const TINY_INV: f32 = 1e30;

/// A ray with what the tests need of it, worked out once. Registers hold the same number in every lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayData<S: Simd> {
    pub(crate) o: [S::F8; 3],
    /// 1 where the direction is negative: the upper face is the near one.
    pub(crate) neg: [usize; 3],
    /// Reciprocal direction, negated; drawn in for entries and stretched for exits by [`PAD`].
    pub(crate) minus_inv_near: [S::F8; 3],
    pub(crate) minus_inv_far: [S::F8; 3],
    /// The axes, permuted: the last is the one along which the direction is longest.
    pub(crate) k: [usize; 3],
    /// The origin, its axes permuted likewise.
    pub(crate) o_k: [LeafFloats<S>; 3],
    /// Shear and scale that bring the direction to (0, 0, 1). [Woop2013, section 3.2]
    pub(crate) s: [LeafFloats<S>; 3],
}

impl<S: Simd> RayData<S> {
    /// `None` for a ray that meets nothing: not finite, without direction, or one so short that its reciprocal is not finite.
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> Option<RayData<S>> {
        let (o, d) = (ray.o.to_array(), ray.d.to_array());
        let a = ray.d.abs();
        let kz = if a.x > a.y {
            if a.x > a.z { 0 } else { 2 }
        } else if a.y > a.z {
            1
        } else {
            2
        };
        // The axes in turn, the other way round where the direction is negative: the winding of triangles stays.
        const TURN: [[usize; 2]; 6] = [[1, 2], [2, 0], [0, 1], [2, 1], [0, 2], [1, 0]];
        let [kx, ky] = TURN[if d[kz] < 0.0 { kz + 3 } else { kz }];
        let sz = 1.0 / d[kz];
        if !(ray.o.is_finite() && ray.d.is_finite() && sz.is_finite()) {
            return None;
        }
        let inv = |d: f32| if d.abs() < 1e-30 { TINY_INV.copysign(d) } else { 1.0 / d };
        let inv = [inv(d[0]), inv(d[1]), inv(d[2])];
        let minus_inv = |scale: f32| {
            let of = |a: usize| S::F8::splat(-inv[a] * scale);
            [of(0), of(1), of(2)]
        };
        Some(RayData {
            o: [S::F8::splat(o[0]), S::F8::splat(o[1]), S::F8::splat(o[2])],
            neg: [usize::from(inv[0] < 0.0), usize::from(inv[1] < 0.0), usize::from(inv[2] < 0.0)],
            minus_inv_near: minus_inv(1.0 - PAD),
            minus_inv_far: minus_inv(1.0 + PAD),
            k: [kx, ky, kz],
            o_k: [
                LeafFloats::<S>::splat(o[kx]),
                LeafFloats::<S>::splat(o[ky]),
                LeafFloats::<S>::splat(o[kz]),
            ],
            s: [
                LeafFloats::<S>::splat(d[kx] * sz),
                LeafFloats::<S>::splat(d[ky] * sz),
                LeafFloats::<S>::splat(sz),
            ],
        })
    }
}
