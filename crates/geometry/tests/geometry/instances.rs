//! Instances against the same shapes copied out.

use sparrow_geometry::{
    CurveBasis, CurveKind, CurveSet, Geometry, Instance, MovingInstance, Ray, Shape, ShapeInstance,
    TriangleMesh,
};
use sparrow_math::{Motion, Transform, Vec3, vec3};

use super::rays::ball;
use super::{Rng, at, placed, sphere, triangles};

/// A turned, sheared or mirrored, moved space.
fn space(rng: &mut Rng, i: u32) -> Transform {
    let turn = Transform::rotate(f64::from(rng.between(0.0, 360.0)), rng.direction().to_f64()).unwrap();
    let mut s = vec3(0.3, 0.3, 0.3);
    if i.is_multiple_of(2) {
        s = vec3(f64::from(rng.between(0.1, 0.4)), f64::from(rng.between(0.1, 0.4)), 0.2);
    }
    if i.is_multiple_of(3) {
        s.x = -s.x;
    }
    let stretch = Transform::scale(s).unwrap();
    let skewed = turn.then_first(&stretch).then_first(&Transform::rotate(33.0, vec3(1.0, 2.0, 0.5)).unwrap());
    Transform::translate(Vec3::from(rng.point()).to_f64()).then_first(&skewed)
}

fn instance(prototype: u32, t: &Transform) -> Instance {
    let rows = t.rows();
    Instance { to_world: [rows[0], rows[1], rows[2]].map(|r| r.map(|x| x as f32)), prototype }
}

fn copied(s: &ShapeInstance, t: &Transform) -> ShapeInstance {
    let Shape::Triangles(m) = &s.shape else { return at(s.shape.clone(), t.then_first(&s.to_world)) };
    let p = m.p.iter().map(|&p| t.point(Vec3::from(p).to_f64()).to_f32().to_array()).collect();
    placed(Shape::Triangles(TriangleMesh { p, indices: m.indices.clone(), ..Default::default() }))
}

/// A world of its own shapes and instances of two prototypes, and the same copied out; and which instance each copy is.
fn worlds(rng: &mut Rng) -> (Geometry, Geometry, Vec<(u32, Option<u32>)>) {
    let world = vec![triangles(rng, 100, 0.2)];
    let prototypes =
        vec![vec![triangles(rng, 40, 0.6), placed(sphere(0.4))], vec![ball(6, vec3(0.2, 0.0, 0.1), 0.8)]];
    let (mut instances, mut copies) = (Vec::new(), world.clone());
    let mut origin = vec![(0, None)];
    for i in 0..60 {
        let (t, prototype) = (space(rng, i), i % 2);
        instances.push(instance(prototype, &t));
        let first = if prototype == 0 { 1 } else { 3 };
        for (j, s) in prototypes[prototype as usize].iter().enumerate() {
            copies.push(copied(s, &t));
            origin.push((first + j as u32, Some(i)));
        }
    }
    (Geometry::build_instanced(world, prototypes, instances), Geometry::build(copies), origin)
}

#[test]
fn instances_agree_with_copies() {
    let mut rng = Rng(31);
    let (instanced, copies, origin) = worlds(&mut rng);
    assert_eq!(instanced.n_shapes(), 4);
    let (mut hits, mut wrong) = (0, 0);
    for _ in 0..20_000 {
        let o = Vec3::from(rng.point()) * 2.5;
        let ray = Ray::new(o, Vec3::from(rng.point()) - o);
        let (a, b) = (instanced.intersect(&ray), copies.intersect(&ray));
        assert_eq!(a.is_some(), instanced.occluded(&ray), "{ray:?}");
        let (Some(a), Some(b)) = (a, b) else {
            wrong += u32::from(a.is_some() != b.is_some());
            continue;
        };
        hits += 1;
        let same = (a.shape, a.instance) == origin[b.shape as usize] && a.prim == b.prim;
        wrong += u32::from(!same || (a.t - b.t).abs() > 1e-4 * b.t);
        if !same {
            continue;
        }
        let (s, r) = (instanced.surface(&ray, &a), copies.surface(&ray, &b));
        assert!((s.p - ray.at(a.t)).length() < 1e-4, "{s:?}");
        assert!((s.p - r.p).length() < 1e-4 && s.ng.cross(r.ng).length() < 1e-3, "{s:?} {r:?}");
        assert!((s.ng.length() - 1.0).abs() < 1e-5 && (s.ns.length() - 1.0).abs() < 1e-5);
        let tangents = (s.dpdu - r.dpdu).length() + (s.dpdv - r.dpdv).length();
        assert!(tangents < 1e-2 * (r.dpdu.length() + r.dpdv.length()), "{s:?} {r:?}");
    }
    // A ray near an edge or silhouette may go either way.
    assert!(hits > 5000 && wrong <= 5, "{wrong} of {hits} wrong");
}

/// A ray that leaves a closed convex instance outwards does not meet it again, however far from its own origin it stands.
#[test]
fn rays_leave_instances() {
    let mut rng = Rng(32);
    for distance in [0.0, 10.0, 1000.0] {
        let t =
            Transform::translate(vec3(distance, -distance, 0.5 * distance)).then_first(&space(&mut rng, 0));
        let prototypes = vec![vec![ball(8, vec3(0.0, 0.0, 0.0), 1.0)]];
        let g = Geometry::build_instanced(vec![], prototypes, vec![instance(0, &t)]);
        let center = t.point(vec3(0.0, 0.0, 0.0)).to_f32();
        let mut met = 0;
        for _ in 0..2000 {
            let o = center + rng.direction() * 2.0;
            let ray = Ray::new(o, center + Vec3::from(rng.point()) * 0.1 - o);
            let Some(hit) = g.intersect(&ray) else { continue };
            met += 1;
            let s = g.surface(&ray, &hit);
            let out = if s.ng.dot(ray.d) > 0.0 { -s.ng } else { s.ng };
            assert!(!g.occluded(&s.spawn(out)), "{distance} {ray:?}");
            assert!(g.occluded(&s.spawn(-out)), "{distance} {ray:?}");
        }
        assert!(met > 1500, "{met}");
    }
}

#[test]
fn what_is_not_accepted_is_not_there() {
    let mut rng = Rng(33);
    let (g, ..) = worlds(&mut rng);
    let mut through = 0;
    for _ in 0..3000 {
        let ray = Ray::new(Vec3::from(rng.point()) * 2.0, rng.direction());
        let Some(first) = g.intersect(&ray) else { continue };
        let other = |h: &sparrow_geometry::Hit| h.instance != first.instance;
        let next = g.intersect_where(&ray, other);
        assert_eq!(g.occluded_where(&ray, other), next.is_some());
        if let Some(next) = next {
            assert!(next.t >= first.t && next.instance != first.instance);
            through += 1;
        }
    }
    assert!(through > 300, "{through}");
}

#[test]
fn odd_instances_are_dropped() {
    let mut rng = Rng(34);
    let flat = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]];
    let nan = [[f32::NAN, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let far = [[1.0, 0.0, 0.0, 3e38], [0.0, 1e38, 0.0, 3e38], [0.0, 0.0, 1.0, 0.0]];
    let one = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let of = |to_world, prototype| Instance { to_world, prototype };
    let instances = vec![of(flat, 0), of(nan, 0), of(far, 0), of(one, 1), of(one, 2), of(one, 0)];
    let g = Geometry::build_instanced(vec![], vec![vec![triangles(&mut rng, 50, 0.5)], vec![]], instances);
    assert_eq!((g.stats().dropped, g.stats().primitives), (5, 51));
    let found = (0..300).filter_map(|_| {
        let o = Vec3::from(rng.point()) * 2.0;
        g.intersect(&Ray::new(o, Vec3::from(rng.point()) - o))
    });
    let found: Vec<_> = found.collect();
    assert!(found.len() > 100 && found.iter().all(|h| h.instance == Some(5)));
}

/// At any time a moving instance is met as one that stands where it is then.
#[test]
fn moving_instances_agree_with_standing_ones() {
    let mut rng = Rng(34);
    let prototypes = || {
        let mut rng = Rng(35);
        vec![vec![triangles(&mut rng, 40, 0.6), placed(sphere(0.4))]]
    };
    let mut motions: Vec<Motion> = (0..8)
        .map(|k| Motion::new(&space(&mut rng, 3 * (k % 2)), &space(&mut rng, 3 * (k % 2) + 6)).unwrap())
        .collect();
    // Two that only shift.
    motions.extend((0..2).map(|k| {
        let start = space(&mut rng, 3 * k);
        let by = Transform::translate(Vec3::from(rng.point()).to_f64());
        Motion::new(&start, &by.then_first(&start)).unwrap()
    }));
    let moving = motions.iter().map(|&motion| MovingInstance { motion, prototype: 0 }).collect();
    let moving = Geometry::build_moving(vec![], prototypes(), vec![], moving);
    let (mut hits, mut wrong) = (0, 0);
    for step in 0..=20 {
        let time = step as f32 / 20.0;
        let standing = |m: &Motion| Instance {
            to_world: m.at(f64::from(time)).map(|r| r.map(|x| x as f32)),
            prototype: 0,
        };
        let standing =
            Geometry::build_instanced(vec![], prototypes(), motions.iter().map(standing).collect());
        for _ in 0..1000 {
            let o = Vec3::from(rng.point()) * 2.5;
            let ray = Ray { time, ..Ray::new(o, Vec3::from(rng.point()) - o) };
            let (a, b) = (moving.intersect(&ray), standing.intersect(&ray));
            assert_eq!(a.is_some(), moving.occluded(&ray), "{ray:?}");
            let (Some(a), Some(b)) = (a, b) else {
                wrong += u32::from(a.is_some() != b.is_some());
                continue;
            };
            hits += 1;
            if (a.instance, a.prim) != (b.instance, b.prim) {
                wrong += 1;
                continue;
            }
            let (s, r) = (moving.surface(&ray, &a), standing.surface(&ray, &b));
            assert!((s.p - r.p).length() < 1e-4 && s.ng.cross(r.ng).length() < 1e-3, "{s:?} {r:?}");
            let times = [s.time, s.spawn(ray.d).time, s.spawn_to(ray.o).time];
            assert_eq!(times.map(f32::to_bits), [time.to_bits(); 3]);
        }
    }
    // A ray near an edge or silhouette may go either way.
    assert!(hits > 2000 && wrong <= 5, "{wrong} of {hits} wrong");
}

/// Curves in an instance are met as curves that stand there themselves, also where the instance moves by a shift.
#[test]
fn instanced_curves_agree_with_copies() {
    let mut rng = Rng(36);
    let points: Vec<[f32; 4]> = (0..60)
        .map(|_| {
            let [x, y, z] = rng.point();
            [x, y, z, 0.02 + 0.03 * rng.next()]
        })
        .collect();
    // Turned by a quarter and scaled evenly, both exact, so that tubes stay round and corners are rounded once.
    let turned =
        |[x, y, z, r]: [f32; 4], shift: f32| [-0.5 * y + shift, 0.5 * x + 0.25, 0.5 * z - 0.125, 0.5 * r];
    let rows = |shift: f32| [[0.0, -0.5, 0.0, shift], [0.5, 0.0, 0.0, 0.25], [0.0, 0.0, 0.5, -0.125]];
    for kind in [CurveKind::Round, CurveKind::Flat, CurveKind::Cylinder] {
        let curves = |points| {
            let strands = vec![0, 20, 40];
            placed(Shape::Curves(CurveSet {
                points,
                strands,
                kind,
                basis: CurveBasis::BSpline,
                ..CurveSet::default()
            }))
        };
        let (start, end) = (0.75, -0.25);
        let place = |shift: f32| {
            let [x, y, z] = rows(shift).map(|r| r.map(f64::from));
            Transform::from_rows([x, y, z, [0.0, 0.0, 0.0, 1.0]]).unwrap()
        };
        let motion = Motion::new(&place(start), &place(end)).unwrap();
        let moving = vec![MovingInstance { motion, prototype: 0 }];
        let moving = Geometry::build_moving(vec![], vec![vec![curves(points.clone())]], vec![], moving);
        for time in [0.0, 0.25, 1.0] {
            let shift = start + (end - start) * time;
            let copies = curves(points.iter().map(|&p| turned(p, shift)).collect());
            let copies = Geometry::build(vec![copies]);
            let instance = Instance { to_world: rows(shift), prototype: 0 };
            let standing =
                Geometry::build_instanced(vec![], vec![vec![curves(points.clone())]], vec![instance]);
            let (mut hits, mut wrong) = (0, 0);
            for _ in 0..4000 {
                let o = Vec3::from(rng.point()) * 2.5;
                let ray = Ray { time, ..Ray::new(o, Vec3::from(rng.point()) * 0.6 - o) };
                let expected = copies.intersect(&ray);
                for g in [&standing, &moving] {
                    let found = g.intersect(&ray);
                    assert_eq!(found.is_some(), g.occluded(&ray));
                    let (Some(a), Some(b)) = (found, expected) else {
                        wrong += u32::from(found.is_some() != expected.is_some());
                        continue;
                    };
                    hits += 1;
                    let (s, r) = (g.surface(&ray, &a), copies.surface(&ray, &b));
                    let same =
                        a.prim == b.prim && (s.p - r.p).length() < 1e-4 && (s.h() - r.h()).abs() < 1e-2;
                    wrong += u32::from(!same || (a.instance, b.instance) != (Some(0), None));
                }
            }
            // Silhouettes may go either way.
            assert!(hits > 300 && wrong * 200 <= hits, "{kind:?}: {wrong} of {hits} wrong");
        }
    }
}
