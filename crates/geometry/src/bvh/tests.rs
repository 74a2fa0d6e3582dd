//! The tree on every vector unit, and the units against single numbers.

use super::node::Kind;
use super::{Bvh, Others, PrimRef, RawHit};
use crate::progress::Progress;
use crate::ray::Ray;
use crate::simd::{Floats, Kernel, Mask, Simd, Unit};
use sparrow_math::{Aabb, Vec3, vec3};

/// Numbers in [0, 1). [Steele2014]
struct Rng(u64);

impl Rng {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u32 << 24) as f32
    }
    fn point(&mut self) -> Vec3<f32> {
        vec3(self.next(), self.next(), self.next()) * 2.0 - Vec3::splat(1.0)
    }
}

struct Nothing;

impl Others for Nothing {
    fn hit(&self, _: u32, _: &Ray, t_max: f32, _: &mut impl FnMut(RawHit) -> f32) -> f32 {
        t_max
    }
}

/// A fan of triangles around shared corners, so that many points are equally near.
fn tree(rng: &mut Rng, n: u32) -> Bvh {
    let p: Vec<Vec3<f32>> = (0..n / 2 + 3).map(|_| rng.point()).collect();
    let corners = |i: u32| {
        let p = |k: u32| p[((i / 2 + k) as usize) % p.len()].to_array();
        if i.is_multiple_of(2) { [p(0), p(1), p(2)] } else { [p(2), p(1), p(0)] }
    };
    let bounds = |i: u32| corners(i).into_iter().fold(Aabb::EMPTY, |b, p| b.grow(p.into()));
    let prims = (0..n).map(|i| PrimRef::new(i, bounds(i), Kind::Triangles)).collect();
    Bvh::build(prims, corners, &Progress::new(None, 0))
}

/// Every unit finds the same point, to the bit; the list of triangles has each twice, so that the order counts too.
#[test]
fn units_agree_to_the_bit() {
    let mut rng = Rng(1);
    for n in [1, 30, 3000] {
        let mut portable = tree(&mut rng, n);
        let mut best = portable.clone();
        (portable.unit, best.unit) = (Unit::named("portable"), Unit::named(""));
        let mut hits = 0;
        for i in 0..20_000 {
            let o = rng.point() * 1.5;
            let mut d = rng.point() - o;
            if i % 4 == 0 {
                d.x = 0.0;
            }
            let ray = Ray::new(o, d);
            let bits = |h: Option<RawHit>| h.map(|h| [h.t.to_bits(), h.id, h.u.to_bits(), h.v.to_bits()]);
            let a = bits(portable.hit::<false>(&ray, &Nothing, |_| true));
            assert_eq!(a, bits(best.hit::<false>(&ray, &Nothing, |_| true)), "{ray:?}");
            let any = bits(portable.hit::<true>(&ray, &Nothing, |_| true));
            assert_eq!(any, bits(best.hit::<true>(&ray, &Nothing, |_| true)), "{ray:?}");
            assert_eq!(a.is_some(), any.is_some(), "{ray:?}");
            hits += u32::from(a.is_some());
        }
        assert!(hits > 200, "{n}: {hits}");
    }
}

/// Every operation on eight numbers, as bits.
struct Operations([f32; 8], [f32; 8]);

impl Kernel for Operations {
    type Output = Vec<u32>;
    #[inline(always)]
    fn run<S: Simd>(self) -> Vec<u32> {
        let (a, b) = (S::F8::load(&self.0), S::F8::load(&self.1));
        let both = [a + b, a - b, a * b, a / b, a.min(b), a.max(b), a.abs(), S::F8::splat(self.0[3])];
        // These two promise their value only where nothing is negative.
        let some = [a.abs().min_nonneg(b.abs()), a.abs().max_nonneg(b.abs())];
        let none = <S::F8 as Floats<8>>::Mask::none();
        let (le, lt) = (a.le(b), a.lt(b));
        let chosen = [a.only_where(!lt, b), a.sqrt(), a.signed(b)];
        let rows = S::rows([a, b, a.abs(), b.abs()]).into_iter().flatten().map(f32::to_bits);
        let numbers = both.into_iter().chain(some).chain(chosen).flat_map(|x| x.to_array().map(f32::to_bits));
        let signs = [a.min_nonneg(b), a.max_nonneg(b)];
        let signs = signs.into_iter().flat_map(|x| x.to_array().map(|x| u32::from(x > 0.0)));
        numbers
            .chain(rows)
            .chain(signs)
            .chain([le, lt, b.le(a), a.le(a), none, le & !lt, lt | !le, !lt].map(Mask::bits))
            .collect()
    }
}

/// The same with single numbers.
fn one_by_one(a: [f32; 8], b: [f32; 8]) -> Vec<u32> {
    let each = |f: &dyn Fn(f32, f32) -> f32| [0, 1, 2, 3, 4, 5, 6, 7].map(|i| f(a[i], b[i]).to_bits());
    let bits = |f: &dyn Fn(f32, f32) -> bool| (0..8).map(|i| u32::from(f(a[i], b[i])) << i).sum::<u32>();
    let (min, max) = (|a: f32, b: f32| if a < b { a } else { b }, |a: f32, b: f32| if a > b { a } else { b });
    let mut out = Vec::new();
    out.extend(each(&|a, b| a + b));
    out.extend(each(&|a, b| a - b));
    out.extend(each(&|a, b| a * b));
    out.extend(each(&|a, b| a / b));
    out.extend(each(&min));
    out.extend(each(&max));
    out.extend(each(&|a, _| a.abs()));
    out.extend([a[3].to_bits(); 8]);
    out.extend(each(&|a, b| min(a.abs(), b.abs())));
    out.extend(each(&|a, b| max(a.abs(), b.abs())));
    let chosen = |i: usize| if a[i] < b[i] { b[i] } else { a[i] };
    out.extend([0, 1, 2, 3, 4, 5, 6, 7].map(|i| chosen(i).to_bits()));
    out.extend(each(&|a, _| a.sqrt()));
    out.extend(each(&|a, b| if b.is_sign_negative() { -a } else { a }));
    let row = |i: usize| [a[i], b[i], a[i].abs(), b[i].abs()].map(f32::to_bits);
    out.extend([0, 4, 1, 5, 2, 6, 3, 7].into_iter().flat_map(row));
    out.extend([0, 1, 2, 3, 4, 5, 6, 7].map(|i| u32::from(min(a[i], b[i]) > 0.0)));
    out.extend([0, 1, 2, 3, 4, 5, 6, 7].map(|i| u32::from(max(a[i], b[i]) > 0.0)));
    let (le, lt) = (bits(&|a, b| a <= b), bits(&|a, b| a < b));
    out.extend([le, lt, bits(&|a, b| b <= a), 0xff, 0, le & !lt, lt | !le & 0xff, !lt & 0xff]);
    out
}

#[test]
fn units_compute_as_single_numbers_do() {
    let mut rng = Rng(2);
    for _ in 0..2000 {
        let mut numbers = || {
            let mut a = [0.0; 8];
            for x in &mut a {
                *x = match (rng.next() * 12.0) as u32 {
                    0 => 0.0,
                    1 => f32::INFINITY,
                    2 => 1e-41,
                    3 => 1.0,
                    _ => (rng.next() - 0.5) * 8.0,
                };
            }
            a
        };
        let (a, b) = (numbers(), numbers());
        let clean = |bits: Vec<u32>| -> Vec<u32> {
            let one_nan = |x: u32| if f32::from_bits(x).is_nan() { f32::NAN.to_bits() } else { x };
            bits.into_iter().map(one_nan).collect()
        };
        let expected = clean(one_by_one(a, b));
        for unit in [Unit::named("portable"), Unit::named("")] {
            assert_eq!(clean(unit.run(Operations(a, b))), expected, "{unit:?} {a:?} {b:?}");
        }
    }
}
