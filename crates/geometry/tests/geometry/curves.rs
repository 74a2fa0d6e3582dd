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
    /// Parameters where `f` changes its sign, and whether from below zero to above.
    fn roots(&self, f: impl Fn(f64) -> f64) -> Vec<(f64, bool)> {
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
                out.push((0.5 * (a + b), before < 0.0));
            }
            before = here;
        }
        out
    }

    /// The first point of the ray on the strip that faces it, where the curve comes nearest; and the radius there.
    fn strip(&self, o: V, d: V) -> Option<(f64, f64)> {
        let off = |v: V| v - d * v.dot(d);
        let g = |u: f64| {
            let (p, dp, _) = self.at(u);
            off(p - o).dot(off(dp))
        };
        let mut best: Option<(f64, f64)> = None;
        // Where it goes from below zero to above, the distance is least.
        for (u, _) in self.roots(g).into_iter().filter(|root| root.1) {
            let (p, _, r) = self.at(u);
            let t = (p - o).dot(d);
            if off(p - o).length() <= r && t > 0.0 && best.is_none_or(|b| t < b.0) {
                best = Some((t, r));
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
        self.roots(foot).into_iter().map(|root| inside(root.0)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Where the ray first comes from outside into the tube, other than by its ends; and the least radius near there.
    fn tube(&self, o: V, d: V) -> Option<(f64, f64)> {
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
                    return Some((b, near.iter().map(|n| n.1).fold(r, f64::min)));
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

/// Single precision agrees with the twin on 99.9 % of rays on hit or miss; and where both hit, their points are less than a
/// thousandth of the radius apart.
fn compare(kind: CurveKind, first: impl Fn(&Bezier, V, V) -> Option<(f64, f64)>) {
    let mut rng = Rng(11);
    let points = segments(&mut rng, 24);
    let curves = beziers(&points);
    let geometry = build(set(kind, CurveBasis::Bezier, points, 4));
    let n = 20_000;
    let (mut differ, mut far, mut hits, mut worst) = (0, 0, 0, 0.0_f64);
    for ray in rays(&mut rng, &curves, n, 4.0) {
        let (o, length) = (ray.o.to_f64(), ray.d.to_f64().length());
        let d = ray.d.to_f64() / length;
        let nearest = curves.iter().filter_map(|c| first(c, o, d)).min_by(|a, b| a.0.total_cmp(&b.0));
        let found = geometry.intersect(&ray).map(|h| f64::from(h.t) * length);
        match (nearest, found) {
            (Some((t, r)), Some(found)) => {
                hits += 1;
                let error = (found - t).abs() / r;
                far += usize::from(error > 1e-3);
                worst = worst.max(error);
            }
            (None, None) => {}
            (Some(_), None) | (None, Some(_)) => differ += 1,
        }
    }
    eprintln!(
        "{kind:?}: {hits} hits; of {n} rays {differ} differ in hit or miss, {far} in depth; at most by {worst:e} radii"
    );
    assert!(hits > n / 3, "the rays are aimed badly");
    assert!(differ * 1000 <= n && far == 0, "{differ} of {n} rays differ, {far} are far off");
}

#[test]
fn strips_agree_with_their_twin() {
    compare(CurveKind::Flat, Bezier::strip);
}

#[test]
fn tubes_agree_with_their_twin() {
    compare(CurveKind::Round, Bezier::tube);
}

/// A curly strand with radius 0.02, and the Bezier segments it is made of.
fn strand(basis: CurveBasis) -> (Vec<[f32; 4]>, Vec<Bezier>) {
    let mut points = Vec::new();
    for i in 0..13 {
        let a = i as f32;
        let wave = |k: f32| 0.15 * (a * k).rem_euclid(2.0);
        points.push([0.2 * a, wave(0.7), wave(1.1), 0.02]);
    }
    let at = |i: usize| vec3(points[i][0], points[i][1], points[i][2]).to_f64();
    let one = |i: usize| {
        let (a, b, c, d) = (at(i), at(i + 1), at(i + 2), at(i + 3));
        let p = match basis {
            CurveBasis::BSpline => {
                [(a + b * 4.0 + c) / 6.0, (b * 2.0 + c) / 3.0, (b + c * 2.0) / 3.0, (b + c * 4.0 + d) / 6.0]
            }
            CurveBasis::CatmullRom | CurveBasis::Linear | CurveBasis::Bezier => {
                [b, b + (c - a) / 6.0, c - (d - b) / 6.0, c]
            }
        };
        Bezier { p, r: [0.02; 4] }
    };
    let segments = (0..10).map(one).collect();
    (points, segments)
}

/// No ray passes between two segments of a strand, and none finds more than the surface that is there.
#[test]
fn joints_are_closed() {
    let mut rng = Rng(5);
    for (basis, kind) in [
        (CurveBasis::BSpline, CurveKind::Round),
        (CurveBasis::CatmullRom, CurveKind::Round),
        (CurveBasis::BSpline, CurveKind::Flat),
        (CurveBasis::CatmullRom, CurveKind::Cylinder),
    ] {
        let (points, segments) = strand(basis);
        for split_depth in [0, 2] {
            let curves = CurveSet { split_depth, ..set(kind, basis, points.clone(), 13) };
            let geometry = build(curves);
            for i in 0..20_000 {
                let near = f64::from(rng.next()) * [1e-3, 1e-6, 1e-9][i % 3];
                let (c, dc, r) = segments[1 + i % 9].at(near);
                let n = dc.cross(rng.direction().to_f64()).normalized();
                let across = dc.cross(n).normalized();
                let ray = if kind == CurveKind::Round {
                    let o =
                        c + n + across * (0.5 * f64::from(rng.next())) + dc * (f64::from(rng.next()) - 0.5);
                    Ray::new(o.to_f32(), (c + n * r - o).to_f32())
                } else {
                    Ray::new((c + n + across * (0.98 * r)).to_f32(), (-n).to_f32())
                };
                let t = geometry.intersect(&ray).map(|h| h.t);
                // Another bend of the strand may lie before it.
                assert!(t.is_some_and(|t| t < 1.0 + 1e-4), "{kind:?} {basis:?}: {t:?} at {near:e}");
            }
        }
    }
}

/// A tube from (-1, 0, 0) to (1, 0, 0) in `n` segments, of radius 0.1.
fn straight(kind: CurveKind, n: usize) -> Geometry {
    let points = (0..=n).map(|i| [2.0 * i as f32 / n as f32 - 1.0, 0.0, 0.0, 0.1]).collect();
    build(set(kind, CurveBasis::CatmullRom, points, n as u32 + 1))
}

/// Who starts inside a tube leaves it, also from segment to segment; who comes in by an end meets nothing.
#[test]
fn tubes_have_no_inside() {
    let geometry = straight(CurveKind::Round, 5);
    let mut rng = Rng(6);
    for _ in 0..20_000 {
        let inside = vec3(rng.between(-0.99, 0.99), rng.between(-0.06, 0.06), rng.between(-0.06, 0.06));
        let ray = Ray::new(inside, rng.direction());
        assert_eq!(geometry.intersect(&ray), None, "{ray:?}");
    }
    let end_on = Ray::new(vec3(-2.0, 0.03, 0.02), vec3(1.0, 0.0, 0.0));
    assert_eq!(geometry.intersect(&end_on), None);
}

/// Rays that leave a tube outwards do not meet it again, those that go in pass through; far from the origin too.
#[test]
fn rays_leave_fibres() {
    let mut rng = Rng(7);
    for far in [0.0, 30.0, 1000.0] {
        for kind in [CurveKind::Round, CurveKind::Cylinder, CurveKind::Flat] {
            let points = (0..6).map(|i| [0.4 * i as f32 - 1.0 + far, far, far, 0.1]).collect();
            let geometry = build(set(kind, CurveBasis::CatmullRom, points, 6));
            let mut n_hits = 0;
            for _ in 0..5_000 {
                let target = vec3(rng.between(-0.9, 0.9), rng.between(-0.08, 0.08), rng.between(-0.08, 0.08));
                let from = target + rng.direction() * 3.0;
                let ray = Ray::new(from + Vec3::splat(far), target - from);
                let Some(hit) = geometry.intersect(&ray) else { continue };
                n_hits += 1;
                let leaving = geometry.surface(&ray, &hit).spawn(rng.direction());
                assert_eq!(geometry.intersect(&leaving), None, "{kind:?} at {far}: {leaving:?}");
            }
            assert!(n_hits > 4_000, "{kind:?} at {far}: {n_hits} hits");
        }
    }
}

/// Offset, normal and coordinates where they can be told by hand: a fibre along x, seen from above.
#[test]
fn points_of_a_straight_fibre() {
    for kind in [CurveKind::Round, CurveKind::Cylinder, CurveKind::Flat] {
        let geometry = straight(kind, 4);
        for h in [-0.9_f32, -0.3, 0.0, 0.6] {
            // `h = T . (wo x N)` with T = x, wo = z and N = (0, -h, ...).
            let ray = Ray::new(vec3(0.3, -0.1 * h, 3.0), vec3(0.0, 0.0, -2.0));
            let s = geometry.surface(&ray, &geometry.intersect(&ray).unwrap());
            assert!((s.h() - h).abs() < 1e-5, "{kind:?}: h is {} instead of {h}", s.h());
            assert!((s.uv[0] - 0.65).abs() < 1e-5);
            assert!((s.dpdu - vec3(2.0, 0.0, 0.0)).length() < 1e-4 && s.tangent.x > 0.99);
            assert!((s.dpdv.length() - 0.2).abs() < 1e-5 && s.dpdv.y < 0.0);
            let (y, z) = match kind {
                CurveKind::Round => (-h, (1.0 - h * h).sqrt()),
                CurveKind::Cylinder => {
                    let a = core::f64::consts::FRAC_PI_2 * f64::from(h);
                    let (s, c) = sparrow_math::Real::sin_cos(a);
                    (-s as f32, c as f32)
                }
                CurveKind::Flat | CurveKind::Ribbon => (0.0, 1.0),
            };
            assert!((s.ng - vec3(0.0, y, z)).length() < 1e-5, "{kind:?}: {:?}", s.ng);
            let depth = if kind == CurveKind::Round { 0.1 * z } else { 0.0 };
            assert!((s.p - vec3(0.3, -0.1 * h, depth)).length() < 1e-6);
        }
    }
}

/// A ribbon is as wide as it looks: all of it face on, nothing edge on.
#[test]
fn ribbons_follow_their_normals() {
    let points =
        vec![[-1.0, 0.0, 0.0, 0.1], [-0.3, 0.0, 0.0, 0.1], [0.3, 0.0, 0.0, 0.1], [1.0, 0.0, 0.0, 0.1]];
    let normals = vec![[0.0, 0.0, 2.0], [0.0, 1.0, 0.0]];
    let geometry = build(CurveSet { normals, ..set(CurveKind::Ribbon, CurveBasis::Bezier, points, 4) });
    let width = |x: f32| {
        let met = |y: &i32| {
            let ray = Ray::new(vec3(x, 0.001 * *y as f32, 1.0), vec3(0.0, 0.0, -1.0));
            geometry.intersect(&ray).is_some()
        };
        0.001 * (-150..150).filter(met).count() as f32
    };
    let expected = |u: f64| 0.2 * sparrow_math::Real::cos(core::f64::consts::FRAC_PI_2 * u) as f32;
    for x in [-0.95_f32, -0.5, 0.0, 0.5, 0.95] {
        // Points of even spacing but for 1 in 7: u is found from x by halving.
        let (mut a, mut b) = (0.0_f64, 1.0);
        for _ in 0..40 {
            let u = 0.5 * (a + b);
            let (v, w) = (1.0 - u, u);
            let at = -v * v * v - 0.9 * v * v * w + 0.9 * v * w * w + w * w * w;
            if at < f64::from(x) { a = u } else { b = u }
        }
        assert!((width(x) - expected(a)).abs() < 0.003, "{} at {x}, not {}", width(x), expected(a));
    }
}

/// What cannot be hit is left out and counted; nothing panics, and the rest is there.
#[test]
fn hopeless_curves_are_left_out() {
    let nan = f32::NAN;
    let good = [[0.0, 0.0, 0.0, 0.1], [1.0, 0.0, 0.0, 0.1]];
    let cases: [(&[[f32; 4]], usize); 7] = [
        (&good, 0),
        (&[[0.0, 0.0, 0.0, 0.1]; 2], 1),
        (&[[0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]], 1),
        (&[[0.0, 0.0, 0.0, -1.0], [1.0, 0.0, 0.0, -1.0]], 1),
        (&[[0.0, nan, 0.0, 0.1], [1.0, 0.0, 0.0, 0.1]], 1),
        (&[[0.0, 0.0, 0.0, 0.1], [f32::INFINITY, 0.0, 0.0, 0.1]], 1),
        (&[[0.0, 0.0, 0.0, 0.1]], 0),
    ];
    let ray = Ray::new(vec3(0.5, 0.0, 5.0), vec3(0.0, 0.0, -1.0));
    for basis in [CurveBasis::Linear, CurveBasis::CatmullRom] {
        for (i, (points, dropped)) in cases.iter().enumerate() {
            let mut all = points.to_vec();
            all.extend(good);
            let strands = vec![0, points.len() as u32];
            let curves =
                CurveSet { points: all, strands, basis, kind: CurveKind::Round, ..CurveSet::default() };
            let geometry = build(curves);
            assert_eq!(geometry.stats().dropped, *dropped, "case {i}");
            assert!(geometry.intersect(&ray).is_some_and(|h| (h.t - 4.9).abs() < 1e-5));
        }
    }
    for strands in [vec![], vec![7], vec![1], vec![u32::MAX]] {
        let curves =
            CurveSet { points: good.to_vec(), strands, basis: CurveBasis::Linear, ..CurveSet::default() };
        assert_eq!(build(curves).intersect(&ray), None);
    }
}

/// The same bits for any number of threads.
#[test]
fn the_number_of_threads_changes_nothing() {
    let mut rng = Rng(8);
    let points = segments(&mut rng, 30_000);
    let curves = || set(CurveKind::Round, CurveBasis::Bezier, points.clone(), 4);
    let with = |n: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        pool.install(|| build(curves()))
    };
    let (a, b) = (with(1), with(4));
    for ray in rays(&mut rng, &beziers(&points[..400]), 2_000, 3.0) {
        assert_eq!(a.intersect(&ray), b.intersect(&ray));
    }
}

/// A straight tube's area, without ends; a strip's is its length times its width.
#[test]
fn areas() {
    let total = |kind: CurveKind| {
        let g = straight(kind, 5);
        (0..5).map(|i| g.area(0, i)).sum::<f32>()
    };
    assert!((total(CurveKind::Round) - 0.4 * core::f32::consts::PI).abs() < 1e-4);
    assert!((total(CurveKind::Flat) - 0.4).abs() < 1e-4);
}
