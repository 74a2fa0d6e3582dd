//! Curves against a slow twin in double precision: signs of dense samples, then halving.

use sparrow_geometry::{CurveBasis, CurveKind, CurveSet, Geometry, Ray, Shape};
use sparrow_math::{Vec3, vec3};

use crate::{Rng, placed};

type V = Vec3<f64>;

/// Cubic Bezier segments from the de Casteljau construction.
#[derive(Clone, Copy)]
pub(crate) struct Bezier {
    p: [V; 4],
    r: [f64; 4],
}

impl Bezier {
    pub(crate) fn at(&self, u: f64) -> (V, V, f64) {
        let mix = |a: V, b: V| a * (1.0 - u) + b * u;
        let [a, b, c, d] = self.p;
        let (ab, bc, cd) = (mix(a, b), mix(b, c), mix(c, d));
        let (l, r) = (mix(ab, bc), mix(bc, cd));
        let w = [(1.0 - u).powi(3), 3.0 * u * (1.0 - u).powi(2), 3.0 * u * u * (1.0 - u), u.powi(3)];
        let radius: f64 = w.iter().zip(self.r).map(|(w, r)| w * r).sum();
        (mix(l, r), (r - l) * 3.0, radius.max(0.0))
    }
    /// Parameters where `f` changes its sign.
    fn roots(&self, f: impl Fn(f64) -> f64) -> Vec<f64> {
        const N: usize = 160;
        let at = |i: usize| i as f64 / N as f64;
        let mut out = Vec::new();
        let mut before = f(0.0);
        for i in 1..=N {
            let here = f(at(i));
            if before.signum() != here.signum() {
                let (mut a, mut b) = (at(i - 1), at(i));
                for _ in 0..60 {
                    let m = 0.5 * (a + b);
                    if f(m).signum() == before.signum() { a = m } else { b = m }
                }
                out.push(0.5 * (a + b));
            }
            before = here;
        }
        out
    }

    /// The first point of the ray on the strip that faces it.
    fn strip(&self, o: V, d: V) -> Option<f64> {
        let off = |v: V| v - d * v.dot(d);
        let g = |u: f64| {
            let (p, dp, _) = self.at(u);
            off(p - o).dot(off(dp))
        };
        let mut best: Option<f64> = None;
        for u in self.roots(g) {
            let (p, _, r) = self.at(u);
            let t = (p - o).dot(d);
            if off(p - o).length() <= r && t > 0.0 && best.is_none_or(|b| t < b) {
                best = Some(t);
            }
        }
        best
    }

    /// How deep a point lies in the tube; negative outside.
    fn depth(&self, p: V) -> f64 {
        let foot = |u: f64| {
            let (c, dc, _) = self.at(u);
            (p - c).dot(dc)
        };
        let inside = |u: f64| {
            let (c, _, r) = self.at(u);
            r - (p - c).length()
        };
        self.roots(foot).into_iter().map(inside).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Where the ray first comes from outside into the tube, other than by its ends.
    fn tube(&self, o: V, d: V) -> Option<f64> {
        let off = |v: V| (v - d * v.dot(d)).length();
        let near: Vec<(f64, f64)> = (0..=100)
            .map(|i| self.at(f64::from(i) / 100.0))
            .filter(|(c, dc, r)| off(*c - o) <= 1.2 * r + 0.01 * dc.length())
            .map(|(c, _, r)| ((c - o).dot(d), r))
            .collect();
        let r = near.iter().map(|n| n.1).fold(0.0, f64::max);
        if r <= 0.0 {
            return None;
        }
        let lo = near.iter().map(|n| n.0).fold(f64::INFINITY, f64::min) - 2.0 * r;
        let hi = near.iter().map(|n| n.0).fold(f64::NEG_INFINITY, f64::max) + 2.0 * r;
        let step = r / 25.0;
        let depth = |t: f64| self.depth(o + d * t);
        let (mut t, mut before) = (lo, depth(lo));
        while t < hi {
            let here = depth(t + step);
            if before < 0.0 && here >= 0.0 {
                let (mut a, mut b) = (t, t + step);
                for _ in 0..50 {
                    let m = 0.5 * (a + b);
                    if depth(m) < 0.0 { a = m } else { b = m }
                }
                // By an end it falls from nowhere to well inside.
                if depth(b) < 1e-4 * r && b > 0.0 {
                    return Some(b);
                }
            }
            (t, before) = (t + step, here);
        }
        None
    }
}

fn set(kind: CurveKind, basis: CurveBasis, points: Vec<[f32; 4]>, per_strand: u32) -> CurveSet {
    let strands = (0..points.len() as u32 / per_strand).map(|i| i * per_strand).collect();
    CurveSet { points, strands, basis, kind, ..CurveSet::default() }
}

fn build(set: CurveSet) -> Geometry {
    Geometry::build(vec![placed(Shape::Curves(set))])
}

/// Of the segments below.
const SMALLEST: f64 = 0.003;

/// `n` curly segments with radii from 0.01 to 0.03 that shrink to a third at most, a unit long, in a box of size 2.
fn segments(rng: &mut Rng, n: usize) -> Vec<[f32; 4]> {
    let mut out = Vec::new();
    for _ in 0..n {
        let (mut p, step) = (Vec3::from(rng.point()), rng.direction() * 0.2);
        let r = rng.between(0.01, 0.03);
        let taper = rng.between(0.3, 1.0);
        for k in 0..4 {
            p += step + rng.direction() * 0.15;
            out.push([p.x, p.y, p.z, r * (1.0 - (1.0 - taper) * k as f32 / 3.0)]);
        }
    }
    out
}

fn beziers(points: &[[f32; 4]]) -> Vec<Bezier> {
    let one = |p: &[[f32; 4]]| Bezier {
        p: [0, 1, 2, 3].map(|i: usize| vec3(p[i][0], p[i][1], p[i][2]).to_f64()),
        r: [0, 1, 2, 3].map(|i: usize| f64::from(p[i][3])),
    };
    points.chunks_exact(4).map(one).collect()
}

/// Rays from outside that pass within two radii of some segment.
fn rays(rng: &mut Rng, curves: &[Bezier], n: usize, distance: f32) -> Vec<Ray> {
    (0..n)
        .map(|i| {
            let (p, _, r) = curves[i % curves.len()].at(f64::from(rng.next()));
            let target = (p + rng.direction().to_f64() * (2.0 * r * f64::from(rng.next()))).to_f32();
            let o = target + rng.direction() * distance;
            Ray::new(o, target - o)
        })
        .collect()
}

/// Single precision agrees with the twin on 99.9 % of rays: both miss, or both hit, and their points are less than a
/// thousandth of the smallest radius apart.
fn compare(kind: CurveKind, first: impl Fn(&Bezier, V, V) -> Option<f64>) {
    let mut rng = Rng(11);
    let points = segments(&mut rng, 24);
    let curves = beziers(&points);
    let geometry = build(set(kind, CurveBasis::Bezier, points, 4));
    let n = 20_000;
    let (mut differ, mut hits, mut worst) = (0, 0, 0.0_f64);
    for ray in rays(&mut rng, &curves, n, 4.0) {
        let (o, length) = (ray.o.to_f64(), ray.d.to_f64().length());
        let d = ray.d.to_f64() / length;
        let nearest = curves.iter().filter_map(|c| first(c, o, d)).fold(f64::INFINITY, f64::min);
        let found = geometry.intersect(&ray).map_or(f64::INFINITY, |h| f64::from(h.t) * length);
        hits += usize::from(nearest.is_finite());
        if nearest.is_finite() != found.is_finite() || (nearest - found).abs() > 1e-3 * SMALLEST {
            differ += 1;
            println!("{nearest} {found}");
        } else if nearest.is_finite() {
            worst = worst.max((nearest - found).abs());
        }
    }
    println!("{kind:?}: {hits} hits, {differ} of {n} rays differ, else the worst error is {worst:e}");
    assert!(hits > n / 3, "the rays are aimed badly");
    assert!(differ * 1000 <= n, "{differ} of {n} rays differ");
}

#[test]
fn strips_agree_with_their_twin() {
    compare(CurveKind::Flat, Bezier::strip);
}

#[test]
fn tubes_agree_with_their_twin() {
    compare(CurveKind::Round, Bezier::tube);
}
