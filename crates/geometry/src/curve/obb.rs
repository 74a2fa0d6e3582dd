//! Eight oriented boxes, tested together: [`ObbBlock`].
//!
//! A box is the preimage of `lo..hi` under a map of its own, whose rows are nearly orthonormal and lie on a grid of
//! 1/127; bounds are whole numbers in units of the block. 32 bytes a box.

#![allow(
    unsafe_code,
    reason = "says that the bytes of a type are numbers, so that it can lie in mapped pages; vector registers"
)]

use bytemuck::{Pod, Zeroable};
use sparrow_math::{Vec3, vec3};

use super::cubic::Cubic;
use crate::simd::{Floats, Mask, Portable, Simd, Unit};

/// Boxes of a block.
pub(super) const WIDTH: usize = 8;
/// A box without points.
const NOWHERE: [i16; 2] = [i16::MAX, i16::MIN];
/// What rounding may do to an origin, as a part of its distance from the block.
const PAD: f32 = 16.0 * f32::EPSILON;

/// Eight oriented boxes with the numbers of what they hold. Unused places are never hit.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct ObbBlock {
    /// `axes[row][column]`
    axes: [[[i8; WIDTH]; 3]; 3],
    /// `bounds[row]`: lower and upper faces.
    bounds: [[[i16; WIDTH]; 2]; 3],
    pub(super) id: [u32; WIDTH],
    /// Where each has its control points.
    pub(super) place: [u32; WIDTH],
    /// Where block space has its origin.
    origin: [f32; 3],
    /// Block space from world space: a factor.
    scale: f32,
    spare: [u32; 2],
}

// SAFETY: numbers without gaps between them: 256 bytes, a multiple of the alignment.
unsafe impl Pod for ObbBlock {}
// SAFETY: as above.
unsafe impl Zeroable for ObbBlock {}

/// Which boxes a ray meets, one bit each, and where it enters them; elsewhere that is not set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entries {
    pub(super) mask: u32,
    pub(super) t: [f32; WIDTH],
}

/// Rows that follow a segment: along its chord, towards its bend, and across.
fn axes_of(hull: &[[f32; 4]; 4]) -> [[i8; 3]; 3] {
    let p = hull.map(|b| vec3(b[0], b[1], b[2]).to_f64());
    let any = |v: Vec3<f64>| {
        let a = v.abs();
        if a.x <= a.y && a.x <= a.z {
            vec3(1.0, 0.0, 0.0)
        } else if a.y <= a.z {
            vec3(0.0, 1.0, 0.0)
        } else {
            vec3(0.0, 0.0, 1.0)
        }
    };
    let unit = |v: Vec3<f64>, or: Vec3<f64>| if v.length2() > 1e-60 { v.normalized() } else { or };
    let chord = p[3] - p[0];
    let along = unit(chord, unit(p[1] - p[0], vec3(1.0, 0.0, 0.0)));
    let off = |v: Vec3<f64>| v - along * v.dot(along);
    let (b1, b2) = (off(p[1] - p[0]), off(p[2] - p[0]));
    let bend = if b1.length2() > b2.length2() { b1 } else { b2 };
    let flat = bend.length2() <= 1e-12 * chord.length2();
    let bend = if flat { off(any(along)) } else { off(bend) }.normalized();
    let row = |v: Vec3<f64>| [v.x, v.y, v.z].map(|x| (127.0 * x).round() as i8);
    [row(along), row(bend), row(along.cross(bend))]
}

impl ObbBlock {
    /// Boxes around the first eight segments, each with its number.
    pub(super) fn around(segments: &[(u32, Cubic)]) -> ObbBlock {
        let segments = &segments[..segments.len().min(WIDTH)];
        let (mut lo, mut hi) = (Vec3::splat(f32::INFINITY), Vec3::splat(f32::NEG_INFINITY));
        for (_, c) in segments {
            let (a, reach) = (Vec3::from(c.anchor), Vec3::splat(c.reach()));
            (lo, hi) = (lo.min(a - reach), hi.max(a + reach));
        }
        let origin = lo * 0.5 + hi * 0.5;
        // Rows are at most 128 sqrt(3) long, so that no bound comes near the end of the range.
        let radius = (hi - lo).max_component().max(1e-30);
        let scale = 30_000.0 / (222.0 * radius);
        let mut block = ObbBlock {
            axes: [[[0; WIDTH]; 3]; 3],
            bounds: [NOWHERE.map(|b| [b; WIDTH]); 3],
            id: [u32::MAX; WIDTH],
            place: [0; WIDTH],
            origin: origin.to_array(),
            scale,
            spare: [0; 2],
        };
        for (i, (id, c)) in segments.iter().enumerate() {
            block.id[i] = *id;
            block.set(i, c);
        }
        block
    }

    fn set(&mut self, i: usize, c: &Cubic) {
        let hull = c.hull();
        let from_origin = Vec3::from(c.anchor).to_f64() - Vec3::from(self.origin).to_f64();
        for (k, row) in axes_of(&hull).into_iter().enumerate() {
            let r = vec3(f64::from(row[0]), f64::from(row[1]), f64::from(row[2]));
            let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
            for b in hull {
                let at = r.dot(from_origin + vec3(b[0], b[1], b[2]).to_f64());
                // The linear map takes a ball to an interval of half the row's length times its radius.
                let around = r.length() * f64::from(b[3].max(0.0));
                (lo, hi) = (lo.min(at - around), hi.max(at + around));
            }
            let scale = f64::from(self.scale);
            for (column, v) in row.into_iter().enumerate() {
                self.axes[k][column][i] = v;
            }
            self.bounds[k][0][i] = (lo * scale - 1.0).floor() as i16;
            self.bounds[k][1][i] = (hi * scale + 1.0).ceil() as i16;
        }
    }

    /// Origin and direction in block space, and the margin for their rounding errors.
    #[inline(always)]
    fn in_block(&self, o: Vec3<f32>, d: Vec3<f32>) -> (Vec3<f32>, Vec3<f32>, f32) {
        let o = o - Vec3::from(self.origin);
        // Rows are shorter than 222.
        let pad = 222.0
            * PAD
            * self.scale
            * (o.abs().max_component() + Vec3::from(self.origin).abs().max_component());
        (o * self.scale, d * self.scale, pad)
    }

    /// The boxes met between 0 and `t_max`.
    #[inline(always)]
    pub(super) fn hit(&self, unit: Unit, o: Vec3<f32>, d: Vec3<f32>, t_max: f32) -> Entries {
        let (o, d, pad) = self.in_block(o, d);
        match unit {
            Unit::Portable => self.hit_portable(o, d, pad, t_max),
            #[cfg(target_arch = "x86_64")]
            Unit::Avx2(_) => avx2::hit(self, o, d, pad, t_max),
        }
    }

    /// In registers that every target has.
    fn hit_portable(&self, o: Vec3<f32>, d: Vec3<f32>, pad: f32, t_max: f32) -> Entries {
        type F8 = <Portable as Simd>::F8;
        let splat = |v: f32| F8::splat(v);
        let (mut t0, mut t1) = (splat(0.0), splat(t_max));
        let mut there = <F8 as Floats<8>>::Mask::none();
        for (axes, bounds) in self.axes.iter().zip(&self.bounds) {
            let [x, y, z] = axes.map(|row| F8::load(&row.map(f32::from)));
            let dot = |v: Vec3<f32>| x * splat(v.x) + y * splat(v.y) + z * splat(v.z);
            let (o, d) = (dot(o), dot(d));
            let small = d.abs().lt(splat(TINY));
            let inv = splat(1.0) / if small.bits() == 0 { d } else { splat(TINY).only_where(small, d) };
            let [lo, hi] = bounds.map(|b| F8::load(&b.map(f32::from)));
            let (a, b) = ((lo - (o + splat(pad))) * inv, (hi - (o - splat(pad))) * inv);
            (t0, t1) = (t0.max(a.min(b)), t1.min(a.max(b)));
            there = lo.lt(hi);
        }
        Entries { mask: (t0.le(t1 * splat(SLACK)) & there).bits(), t: t0.to_array() }
    }

    /// One box after the other: the twin of the others.
    #[cfg(test)]
    fn hit_scalar(&self, o: Vec3<f32>, d: Vec3<f32>, pad: f32, t_max: f32) -> Entries {
        let mut found = Entries { mask: 0, t: [0.0; WIDTH] };
        for i in 0..WIDTH {
            let (mut t0, mut t1) = (0.0_f32, t_max);
            for (axes, bounds) in self.axes.iter().zip(&self.bounds) {
                let row = vec3(f32::from(axes[0][i]), f32::from(axes[1][i]), f32::from(axes[2][i]));
                let (o, d) = (row.dot(o), row.dot(d));
                let inv = 1.0 / if d.abs() < TINY { TINY } else { d };
                let a = (f32::from(bounds[0][i]) - (o + pad)) * inv;
                let b = (f32::from(bounds[1][i]) - (o - pad)) * inv;
                (t0, t1) = (t0.max(a.min(b)), t1.min(a.max(b)));
            }
            found.t[i] = t0;
            found.mask |= u32::from(t0 <= t1 * SLACK && self.bounds[0][0][i] < self.bounds[0][1][i]) << i;
        }
        found
    }
}

/// A finite stand-in for a direction of zero.
const TINY: f32 = 1e-18;
/// An exit is put off by what the quotients may err.
const SLACK: f32 = 1.0 + 4.0 * f32::EPSILON;

/// The test of eight in registers; tested against the scalar twin.
#[cfg(target_arch = "x86_64")]
mod avx2 {
    use core::arch::x86_64::{
        __m256, _CMP_LE_OQ, _CMP_LT_OQ, _mm_loadl_epi64, _mm_loadu_si128, _mm256_add_ps, _mm256_and_ps,
        _mm256_andnot_ps, _mm256_blendv_ps, _mm256_cmp_ps, _mm256_cvtepi8_epi32, _mm256_cvtepi16_epi32,
        _mm256_cvtepi32_ps, _mm256_div_ps, _mm256_max_ps, _mm256_min_ps, _mm256_movemask_ps, _mm256_mul_ps,
        _mm256_set1_ps, _mm256_storeu_ps, _mm256_sub_ps,
    };

    use sparrow_math::Vec3;

    use super::{Entries, ObbBlock, SLACK, TINY, WIDTH};

    /// As [`ObbBlock::hit_scalar`], on a processor with AVX2.
    #[inline(always)]
    pub(super) fn hit(block: &ObbBlock, o: Vec3<f32>, d: Vec3<f32>, pad: f32, t_max: f32) -> Entries {
        // SAFETY: the caller has found AVX2.
        unsafe { kernel(block, o, d, pad, t_max) }
    }

    #[target_feature(enable = "avx2")]
    #[inline]
    fn widen8(v: &[i8; WIDTH]) -> __m256 {
        // SAFETY: `v` holds the eight bytes that are read.
        let v = unsafe { _mm_loadl_epi64(v.as_ptr().cast()) };
        _mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(v))
    }
    #[target_feature(enable = "avx2")]
    #[inline]
    fn widen16(v: &[i16; WIDTH]) -> __m256 {
        // SAFETY: `v` holds the sixteen bytes that are read.
        let v = unsafe { _mm_loadu_si128(v.as_ptr().cast()) };
        _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(v))
    }

    #[target_feature(enable = "avx2")]
    #[inline]
    fn kernel(block: &ObbBlock, o: Vec3<f32>, d: Vec3<f32>, pad: f32, t_max: f32) -> Entries {
        let splat = |v: f32| _mm256_set1_ps(v);
        let (ox, oy, oz) = (splat(o.x), splat(o.y), splat(o.z));
        let (dx, dy, dz) = (splat(d.x), splat(d.y), splat(d.z));
        let (pad, sign, tiny, one) = (splat(pad), splat(-0.0), splat(TINY), splat(1.0));
        let (mut t0, mut t1) = (splat(0.0), splat(t_max));
        let mut there = 0;
        for (axes, bounds) in block.axes.iter().zip(&block.bounds) {
            let (x, y, z) = (widen8(&axes[0]), widen8(&axes[1]), widen8(&axes[2]));
            let dot = |a, b, c| {
                _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, a), _mm256_mul_ps(y, b)), _mm256_mul_ps(z, c))
            };
            let (o, d) = (dot(ox, oy, oz), dot(dx, dy, dz));
            let small = _mm256_cmp_ps::<_CMP_LT_OQ>(_mm256_andnot_ps(sign, d), tiny);
            let inv = _mm256_div_ps(one, _mm256_blendv_ps(d, tiny, small));
            let (lo, hi) = (widen16(&bounds[0]), widen16(&bounds[1]));
            let a = _mm256_mul_ps(_mm256_sub_ps(lo, _mm256_add_ps(o, pad)), inv);
            let b = _mm256_mul_ps(_mm256_sub_ps(hi, _mm256_sub_ps(o, pad)), inv);
            t0 = _mm256_max_ps(t0, _mm256_min_ps(a, b));
            t1 = _mm256_min_ps(t1, _mm256_max_ps(a, b));
            there = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(lo, hi));
        }
        let met = _mm256_cmp_ps::<_CMP_LE_OQ>(t0, _mm256_mul_ps(t1, splat(SLACK)));
        let mut t = [0.0; WIDTH];
        // SAFETY: `t` holds the eight numbers that are written.
        unsafe { _mm256_storeu_ps(t.as_mut_ptr(), _mm256_and_ps(t0, met)) };
        Entries { mask: (_mm256_movemask_ps(met) & there) as u32, t }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::CurveBasis;

    struct Rng(u64);
    impl Rng {
        fn next(&mut self) -> f32 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 40) as f32 / (1u32 << 24) as f32
        }
        fn point(&mut self) -> Vec3<f32> {
            vec3(self.next() - 0.5, self.next() - 0.5, self.next() - 0.5)
        }
    }

    fn segment(rng: &mut Rng, at: Vec3<f32>) -> Cubic {
        let mut p = [[0.0; 4]; 4];
        let (mut q, step) = (at + rng.point(), rng.point());
        for p in &mut p {
            q += step * 0.3 + rng.point() * 0.2;
            *p = [q.x, q.y, q.z, 0.02 * rng.next()];
        }
        Cubic::new(CurveBasis::BSpline, &p)
    }

    /// A ray that is aimed at a point of the tube meets its box, and enters it before.
    #[test]
    fn boxes_hold_their_segments() {
        let mut rng = Rng(1);
        for _ in 0..300 {
            let at = rng.point() * 100.0;
            let segments: Vec<(u32, Cubic)> = (0..5).map(|i| (i, segment(&mut rng, at))).collect();
            let block = ObbBlock::around(&segments);
            for (i, c) in &segments {
                let p = c.at(f64::from(rng.next()));
                let n = p.dp.cross(rng.point().to_f64()).normalized();
                let target = (p.p + n * p.r).to_f32();
                let d = rng.point();
                let o = target - d * (20.0 * rng.next());
                let found = block.hit(Unit::choose(), o, target - o, 1.001);
                assert!(found.mask >> i & 1 == 1, "box {i} is missed");
                assert!(found.t[*i as usize] <= 1.0);
                assert_eq!(found.mask & !0x1f, 0, "an unused box is hit");
            }
        }
    }

    /// The eight-wide test gives the bits of the scalar one.
    #[test]
    fn registers_equal_scalars() {
        let mut rng = Rng(2);
        for _ in 0..2000 {
            let segments: Vec<(u32, Cubic)> =
                (0..8).map(|i| (i, segment(&mut rng, Vec3::splat(0.0)))).collect();
            let block = ObbBlock::around(&segments);
            let (o, d) = (rng.point() * 3.0, rng.point());
            let slow = {
                let (o, d, pad) = block.in_block(o, d);
                block.hit_scalar(o, d, pad, 5.0)
            };
            for unit in [Unit::named("portable"), Unit::named("")] {
                let fast = block.hit(unit, o, d, 5.0);
                assert_eq!(fast.mask, slow.mask);
                for i in (0..WIDTH).filter(|i| slow.mask >> i & 1 == 1) {
                    assert_eq!(fast.t[i].to_bits(), slow.t[i].to_bits());
                }
            }
        }
    }
}
