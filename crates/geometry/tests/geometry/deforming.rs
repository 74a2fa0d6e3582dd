//! Shapes whose points move, against the same shapes that stand where the points are.

use sparrow_geometry::{
    BilinearMesh, CurveBasis, CurveKind, CurveSet, Geometry, Instance, Ray, Shape, ShapeInstance,
    TriangleMesh,
};
use sparrow_math::Vec3;

use super::rays::ball;
use super::{Rng, placed, triangles, twin};

/// Times at which shapes are looked at; the ends are exact.
const TIMES: [f32; 5] = [0.0, 0.2, 0.5, 0.83, 1.0];

/// Points at a time, rounded as the geometry rounds them; what has no end stands.
fn between<const N: usize>(start: &[[f32; N]], end: &[[f32; N]], time: f32) -> Vec<[f32; N]> {
    let mix = |(a, b): (&[f32; N], &[f32; N])| core::array::from_fn(|i| a[i] * (1.0 - time) + b[i] * time);
    if end.is_empty() { start.to_vec() } else { start.iter().zip(end).map(mix).collect() }
}

/// The shape as it stands at a time.
pub(crate) fn still(s: &ShapeInstance, time: f32) -> ShapeInstance {
    let shape = match s.shape.clone() {
        Shape::Triangles(m) => Shape::Triangles(TriangleMesh {
            p: between(&m.p, &m.p_end, time),
            n: between(&m.n, &m.n_end, time),
            p_end: Vec::new(),
            n_end: Vec::new(),
            ..m
        }),
        Shape::Patches(m) => Shape::Patches(BilinearMesh {
            p: between(&m.p, &m.p_end, time),
            n: between(&m.n, &m.n_end, time),
            p_end: Vec::new(),
            n_end: Vec::new(),
            ..m
        }),
        Shape::Curves(c) => Shape::Curves(CurveSet {
            points: between(&c.points, &c.points_end, time),
            normals: between(&c.normals, &c.normals_end, time),
            points_end: Vec::new(),
            normals_end: Vec::new(),
            ..c
        }),
        quadric @ (Shape::Sphere { .. } | Shape::Disk { .. } | Shape::Cylinder { .. }) => quadric,
    };
    ShapeInstance { shape, ..s.clone() }
}

/// Vertices go elsewhere, each by itself.
fn moved(rng: &mut Rng, p: &[[f32; 3]], by: f32) -> Vec<[f32; 3]> {
    p.iter().map(|&p| (Vec3::from(p) + Vec3::from(rng.point()) * by).to_array()).collect()
}

/// Loose triangles with normals, tangents and texture coordinates.
pub(crate) fn mesh(rng: &mut Rng, n: u32) -> ShapeInstance {
    let Shape::Triangles(mut m) = triangles(rng, n, 0.25).shape else { unreachable!() };
    m.p_end = moved(rng, &m.p, 0.4);
    m.n = m.p.iter().map(|_| rng.direction().to_array()).collect();
    m.n_end = moved(rng, &m.n, 0.6);
    m.s = m.p.iter().map(|_| rng.direction().to_array()).collect();
    m.uv = m.p.iter().map(|_| rng.pair()).collect();
    placed(Shape::Triangles(m))
}

pub(crate) fn patches(rng: &mut Rng, n: u32) -> ShapeInstance {
    let Shape::Patches(mut m) = super::patches(rng, n, 0.4).shape else { unreachable!() };
    m.p_end = moved(rng, &m.p, 0.3);
    m.n = m.p.iter().map(|_| rng.direction().to_array()).collect();
    m.n_end = moved(rng, &m.n, 0.6);
    placed(Shape::Patches(m))
}

/// Strands that wander, their points and radii at both ends.
pub(crate) fn curves(rng: &mut Rng, kind: CurveKind, basis: CurveBasis) -> ShapeInstance {
    const STRANDS: u32 = 12;
    const POINTS: u32 = 13;
    let (mut points, mut points_end) = (Vec::new(), Vec::new());
    for _ in 0..STRANDS {
        let (mut p, drift) = (Vec3::from(rng.point()), rng.direction() * 0.3);
        for _ in 0..POINTS {
            p += Vec3::from(rng.point()) * 0.12;
            let q = p + drift + Vec3::from(rng.point()) * 0.05;
            points.push([p.x, p.y, p.z, rng.between(0.01, 0.04)]);
            points_end.push([q.x, q.y, q.z, rng.between(0.01, 0.04)]);
        }
    }
    let segments = match basis {
        CurveBasis::Linear | CurveBasis::CatmullRom => POINTS - 1,
        CurveBasis::Bezier => (POINTS - 1) / 3,
        CurveBasis::BSpline => POINTS - 3,
    };
    let normals: Vec<[f32; 3]> = (0..STRANDS * (segments + 1)).map(|_| rng.direction().to_array()).collect();
    let normals_end = moved(rng, &normals, 0.3);
    let ribbon = kind == CurveKind::Ribbon;
    placed(Shape::Curves(CurveSet {
        points,
        points_end,
        strands: (0..STRANDS).map(|i| i * POINTS).collect(),
        basis,
        kind,
        normals: if ribbon { normals } else { Vec::new() },
        normals_end: if ribbon { normals_end } else { Vec::new() },
        split_depth: 1,
    }))
}

/// Rays of that time, most of them at the shapes.
fn rays(rng: &mut Rng, n: u32, time: f32) -> Vec<Ray> {
    let ray = |_| {
        let o = Vec3::from(rng.point()) * 2.0;
        Ray { time, ..Ray::new(o, Vec3::from(rng.point()) - o) }
    };
    (0..n).map(ray).collect()
}

/// Compares with what stands there; the trees differ, so of points equally far another may come first.
fn compare(what: &str, shapes: &[ShapeInstance], least_hits: u32) {
    let mut rng = Rng(71);
    let deforming = Geometry::build(shapes.to_vec());
    let (mut hits, mut ties) = (0, 0);
    for time in TIMES {
        let standing = Geometry::build(shapes.iter().map(|s| still(s, time)).collect());
        for ray in rays(&mut rng, 3000, time) {
            let (a, b) = (deforming.intersect(&ray), standing.intersect(&ray));
            assert_eq!(a.is_some(), b.is_some(), "{what} at {time}: {ray:?}");
            assert_eq!(a.is_some(), deforming.occluded(&ray), "{what} at {time}: {ray:?}");
            let (Some(a), Some(b)) = (a, b) else { continue };
            hits += 1;
            if (a.shape, a.prim) != (b.shape, b.prim) {
                ties += 1;
                continue;
            }
            assert_eq!(a, b, "{what} at {time}: {ray:?}");
            let (p, q) = (deforming.surface(&ray, &a), standing.surface(&ray, &b));
            assert_eq!(format!("{p:?}"), format!("{q:?}"), "{what} at {time}: {ray:?}");
            assert_eq!(deforming.normal_derivatives(&ray, &a), standing.normal_derivatives(&ray, &b));
        }
    }
    assert!(hits >= least_hits && ties * 1000 <= hits, "{what}: {ties} of {hits}");
}

#[test]
fn triangles_are_those_of_the_time() {
    let mut rng = Rng(61);
    compare("triangles", &[mesh(&mut rng, 300)], 3000);
    compare("one triangle", &[mesh(&mut rng, 1)], 5);
    compare("with others", &[triangles(&mut rng, 100, 0.2), mesh(&mut rng, 100), mesh(&mut rng, 20)], 3000);
}

#[test]
fn curves_are_those_of_the_time() {
    let mut rng = Rng(62);
    for kind in [CurveKind::Flat, CurveKind::Cylinder, CurveKind::Ribbon, CurveKind::Round] {
        for basis in [CurveBasis::Linear, CurveBasis::Bezier, CurveBasis::BSpline, CurveBasis::CatmullRom] {
            compare(&format!("{kind:?} {basis:?}"), &[curves(&mut rng, kind, basis)], 150);
        }
    }
}

/// Parallelograms that stand are two triangles; patches that move never are, so that depths may differ by rounding.
#[test]
fn patches_are_those_of_the_time() {
    let mut rng = Rng(63);
    let shapes = [patches(&mut rng, 30)];
    let deforming = Geometry::build(shapes.to_vec());
    let (mut hits, mut wrong) = (0, 0);
    for time in TIMES {
        let standing = Geometry::build(shapes.iter().map(|s| still(s, time)).collect());
        for ray in rays(&mut rng, 3000, time) {
            let (a, b) = (deforming.intersect(&ray), standing.intersect(&ray));
            assert_eq!(a.is_some(), deforming.occluded(&ray), "{ray:?}");
            let (Some(a), Some(b)) = (a, b) else {
                wrong += u32::from(a.is_some() != b.is_some());
                continue;
            };
            hits += 1;
            let (p, q) = (deforming.surface(&ray, &a), standing.surface(&ray, &b));
            let near = (p.p - q.p).length() < 1e-5 && (p.ns - q.ns).length() < 1e-3;
            wrong += u32::from(a.prim != b.prim || !near);
        }
    }
    assert!(hits > 1000 && wrong <= 3, "{wrong} of {hits}");
}

/// The slow twin, in double precision and by other formulas.
#[test]
fn triangles_agree_with_brute_force() {
    let mut rng = Rng(64);
    let shapes = [mesh(&mut rng, 150)];
    let deforming = Geometry::build(shapes.to_vec());
    let (mut hits, mut wrong) = (0, 0);
    for time in [0.1, 0.37, 0.5, 0.9] {
        let standing = shapes.each_ref().map(|s| still(s, time));
        for ray in rays(&mut rng, 2000, time) {
            let (a, b) = (deforming.intersect(&ray), twin::nearest(&standing, &ray));
            let (Some(a), Some((t, _, prim))) = (a, b) else {
                wrong += u32::from(a.is_some() != b.is_some());
                continue;
            };
            hits += 1;
            wrong += u32::from(a.prim != prim || (f64::from(a.t) - t).abs() > 1e-5 * t);
        }
    }
    // A ray near an edge may go either way.
    assert!(hits > 1000 && wrong <= 2, "{wrong} of {hits}");
}

/// A closed mesh that bulges and shifts: from inside every ray meets it, at any time, however exactly it is aimed at corners and edges.
#[test]
fn no_light_leaks_through_moving_edges() {
    let mut rng = Rng(65);
    for (center, radius) in [(0.0, 1.0), (100.0, 1.0), (1e4, 1e3)] {
        let center = Vec3 { x: center, y: -0.5 * center, z: 0.25 * center };
        let shape = ball(17, center, radius);
        let Shape::Triangles(mesh) = &shape.shape else { unreachable!() };
        let shift = Vec3::from(rng.point()) * (2.0 * radius);
        // Poles and the seam have several vertices in one place: they move alike.
        let goes_to = |p: &[f32; 3]| {
            let out = Vec3::from(*p) - center;
            let bulge = 1.0 + 0.4 * (2.0 * out.z / radius).abs().min(1.0);
            (center + out * bulge + shift).to_array()
        };
        let p_end: Vec<[f32; 3]> = mesh.p.iter().map(goes_to).collect();
        let deforming = TriangleMesh { p_end: p_end.clone(), ..mesh.clone() };
        let geometry = Geometry::build(vec![placed(Shape::Triangles(deforming))]);
        for time in [0.0, 0.25, 0.61, 1.0] {
            let p = between(&mesh.p, &p_end, time);
            let middle = center + shift * time;
            for at in &mesh.indices {
                let o = middle + Vec3::from(rng.point()) * (0.3 * radius);
                let corner = |i: u32| Vec3::from(p[i as usize]);
                let mut aims = at.map(corner).to_vec();
                for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                    let w = rng.next();
                    aims.push(corner(at[i]) * w + corner(at[j]) * (1.0 - w));
                }
                for aim in aims {
                    let ray = Ray { time, ..Ray::new(o, aim - o) };
                    assert!(geometry.intersect(&ray).is_some(), "{center:?} {time}: {ray:?}");
                }
            }
        }
    }
}

/// What leaves a moving ball outwards does not meet it again at that time.
#[test]
fn rays_leave_what_deforms() {
    let mut rng = Rng(66);
    for distance in [0.0, 1000.0] {
        let center = Vec3::splat(distance);
        let Shape::Triangles(mut mesh) = ball(9, center, 1.0).shape else { unreachable!() };
        mesh.p_end = mesh.p.iter().map(|&p| (Vec3::from(p) * 1.5).to_array()).collect();
        let g = Geometry::build(vec![placed(Shape::Triangles(mesh))]);
        for k in 0..2000 {
            let time = (k % 11) as f32 / 10.0;
            let middle = center * (1.0 + 0.5 * time);
            let o = middle + rng.direction() * 3.0;
            let ray = Ray { time, ..Ray::new(o, middle + Vec3::from(rng.point()) * 0.2 - o) };
            let s = g.surface(&ray, &g.intersect(&ray).unwrap());
            let out = if s.ng.dot(ray.d) > 0.0 { -s.ng } else { s.ng };
            assert_eq!(s.time.to_bits(), time.to_bits());
            assert!(!g.occluded(&s.spawn(out)) && g.occluded(&s.spawn(-out)), "{distance} {ray:?}");
        }
    }
}

/// An instance of what deforms deforms too.
#[test]
fn instances_deform() {
    let mut rng = Rng(67);
    let prototype = vec![mesh(&mut rng, 60), curves(&mut rng, CurveKind::Round, CurveBasis::BSpline)];
    // Exact: half as large, and elsewhere.
    let place = |x: f32| Instance {
        to_world: [[0.5, 0.0, 0.0, x], [0.0, 0.5, 0.0, 0.25], [0.0, 0.0, 0.5, -0.25]],
        prototype: 0,
    };
    let places = || vec![place(-0.5), place(0.75)];
    let deforming = Geometry::build_instanced(vec![], vec![prototype.clone()], places());
    let mut hits = 0;
    for time in TIMES {
        let standing = vec![prototype.iter().map(|s| still(s, time)).collect()];
        let standing = Geometry::build_instanced(vec![], standing, places());
        for ray in rays(&mut rng, 2000, time) {
            let (a, b) = (deforming.intersect(&ray), standing.intersect(&ray));
            assert_eq!(a, b, "{time}: {ray:?}");
            hits += u32::from(a.is_some());
        }
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn odd_motion_is_dropped_or_stands() {
    let p = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut p_end = p.clone();
    p_end[3] = [f32::NAN, 0.0, 0.0];
    let indices = vec![[0, 1, 2], [0, 1, 3], [0, 1, 77]];
    let of = |p_end: &[[f32; 3]]| {
        let mesh = TriangleMesh {
            p: p.clone(),
            p_end: p_end.to_vec(),
            indices: indices.clone(),
            n_end: vec![[0.0; 3]; 2],
            ..Default::default()
        };
        Geometry::build(vec![placed(Shape::Triangles(mesh))])
    };
    let nan = of(&p_end);
    assert_eq!((nan.stats().primitives, nan.stats().dropped, nan.n_prims(0)), (1, 2, 3));
    // Ends for some of the vertices only: nothing moves.
    let short = of(&p_end[..2]);
    assert_eq!((short.stats().primitives, short.stats().dropped), (2, 1));
    let ray =
        Ray { time: 0.5, ..Ray::new(Vec3 { x: 0.2, y: 0.2, z: 1.0 }, Vec3 { x: 0.0, y: 0.0, z: -1.0 }) };
    for g in [&nan, &short] {
        assert_eq!(g.intersect(&ray).map(|h| (h.prim, h.t)), Some((0, 1.0)));
    }
    // A time that is none counts as the nearer end.
    for time in [f32::NAN, f32::NEG_INFINITY, -1.0, 2.0, f32::INFINITY] {
        assert!(nan.intersect(&Ray { time, ..ray }).is_some(), "{time}");
    }
    assert!(nan.sample_from(0, 0, Vec3 { x: 0.0, y: 0.0, z: 1.0 }, [0.5; 2]).is_none());
    // A triangle that turns over has no area half-way, and is there before and after.
    let mut turned = p.clone();
    turned[2] = [0.0, -1.0, 0.0];
    let g = of(&turned);
    let at = |time: f32, y: f32| {
        let o = Vec3 { x: 0.1, y, z: 1.0 };
        g.intersect(&Ray { time, ..Ray::new(o, Vec3 { x: 0.0, y: 0.0, z: -1.0 }) }).is_some()
    };
    assert!(at(0.0, 0.2) && !at(0.5, 0.2) && at(1.0, -0.2) && !at(1.0, 0.2));
}

/// The same bits from one thread and from several, and from lists of rays.
#[test]
fn threads_and_lists_do_not_matter() {
    let make = || {
        let mut rng = Rng(68);
        vec![mesh(&mut rng, 20_000), curves(&mut rng, CurveKind::Round, CurveBasis::CatmullRom)]
    };
    let built = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let g = pool.install(|| Geometry::build(make()));
        let shown = format!("{g:?}");
        // Only the clock may differ.
        shown[..shown.find("build_seconds").unwrap()].to_owned()
    };
    assert!(built(1) == built(3), "the trees differ");
    let g = Geometry::build(make());
    let mut rng = Rng(69);
    let rays: Vec<Ray> = TIMES.iter().flat_map(|&time| rays(&mut rng, 300, time)).collect();
    let mut hits = vec![None; rays.len()];
    g.intersect_many(&rays, &mut hits);
    assert!(rays.iter().zip(&hits).all(|(ray, hit)| g.intersect(ray) == *hit));
    assert!(hits.iter().flatten().count() > 500);
}
