//! Lists of rays give what the rays give one by one, to the bit.

use sparrow_geometry::{
    BilinearMesh, CurveBasis, CurveKind, CurveSet, Geometry, Hit, Instance, Ray, Shape, ShapeInstance,
    TriangleMesh,
};
use sparrow_math::{Transform, Vec3, vec3};

use super::{Rng, at, patches, placed, quadrics, sphere, triangles};

/// A box without a front, a lamp, a block on the floor whose lowest face lies in it, and two balls.
fn room() -> Vec<ShapeInstance> {
    let mut mesh = BilinearMesh::default();
    let mut quad = |o: [f32; 3], e: [f32; 3], f: [f32; 3]| {
        let (o, e, f) = (Vec3::from(o), Vec3::from(e), Vec3::from(f));
        let n = mesh.p.len() as u32;
        mesh.p.extend([o, o + e, o + f, o + e + f].map(Vec3::to_array));
        mesh.indices.push([n, n + 1, n + 2, n + 3]);
    };
    let (x, y, z) = ([2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]);
    quad([-1.0, 0.0, -1.0], z, x);
    quad([-1.0, 2.0, -1.0], x, z);
    quad([-1.0, 0.0, -1.0], x, y);
    quad([-1.0, 0.0, -1.0], y, z);
    quad([1.0, 0.0, -1.0], z, y);
    quad([-0.3, 1.998, -0.3], [0.6, 0.0, 0.0], [0.0, 0.0, 0.6]);
    let (x, y, z) = ([0.5, 0.0, 0.125], [0.0, 0.75, 0.0], [-0.125, 0.0, 0.5]);
    quad([-0.75, 0.0, -0.5], x, z);
    quad([-0.75, 0.75, -0.5], x, z);
    quad([-0.75, 0.0, -0.5], x, y);
    quad([-0.75, 0.0, -0.5], y, z);
    let ball = |p: Vec3<f64>, r: f32| at(sphere(r), Transform::translate(p));
    let mut shapes = vec![placed(Shape::Patches(mesh))];
    shapes.push(ball(vec3(-0.42, 0.45, -0.25), 0.45));
    shapes.push(ball(vec3(0.45, 0.36, 0.3), 0.36));
    shapes
}

/// Rays of every sort: from far and near, along axes, through corners and edges, short, backwards, and not finite.
fn rays(rng: &mut Rng, n: usize) -> Vec<Ray> {
    let grid = |rng: &mut Rng| Vec3::from(rng.point().map(|x| (x * 4.0).round() * 0.25));
    let one = |i: usize| {
        let (mut o, mut p) = (Vec3::from(rng.point()) * 3.0, Vec3::from(rng.point()) + vec3(0.0, 1.0, 0.0));
        if i.is_multiple_of(3) {
            p = grid(rng);
        }
        if i.is_multiple_of(7) {
            o = grid(rng);
        }
        let mut ray = Ray::new(o, (p - o) * rng.between(0.1, 3.0));
        match i % 23 {
            0 => ray.d.x = 0.0,
            1 => (ray.d.y, ray.d.z) = (0.0, -0.0),
            2 => ray.t_max = rng.between(-0.5, 2.0),
            3 => ray.t_max = 1.0,
            4 if i.is_multiple_of(5) => ray.o.y = f32::NAN,
            5 if i.is_multiple_of(5) => ray.d = Vec3::splat(0.0),
            6 if i.is_multiple_of(5) => ray.t_max = f32::NAN,
            7 if i.is_multiple_of(5) => ray.d.z = f32::INFINITY,
            _ => {}
        }
        ray
    };
    (0..n).map(one).collect()
}

fn bits(h: Option<Hit>) -> Option<([u32; 5], Option<u32>)> {
    h.map(|h| ([h.t.to_bits(), h.shape, h.prim, h.u.to_bits(), h.v.to_bits()], h.instance))
}

/// All forms, in lists of many lengths.
fn compare(name: &str, g: &Geometry, rays: &[Ray]) {
    let mut hits = 0;
    let mut rest = rays;
    for n in (0..40).cycle() {
        let list;
        (list, rest) = rest.split_at(n.min(rest.len()));
        let (mut found, mut any) = (vec![None; n], vec![false; n]);
        g.intersect_many(list, &mut found);
        g.occluded_many(list, &mut any);
        let accept = |i: usize, h: &Hit| !(h.prim as usize + i).is_multiple_of(3);
        let (mut found_where, mut any_where) = (vec![None; n], vec![false; n]);
        g.intersect_many_where(list, &mut found_where, accept);
        g.occluded_many_where(list, &mut any_where, accept);
        for (i, ray) in list.iter().enumerate() {
            assert_eq!(bits(found[i]), bits(g.intersect(ray)), "{name}: {ray:?}");
            assert_eq!(any[i], g.occluded(ray), "{name}: {ray:?}");
            assert_eq!(
                bits(found_where[i]),
                bits(g.intersect_where(ray, |h| accept(i, h))),
                "{name}: {ray:?}"
            );
            assert_eq!(any_where[i], g.occluded_where(ray, |h| accept(i, h)), "{name}: {ray:?}");
            hits += usize::from(any[i]);
        }
        if rest.is_empty() {
            break;
        }
    }
    assert!(hits * 10 > rays.len() && hits < rays.len(), "{name}: {hits} of {} hit", rays.len());
}

#[test]
fn of_a_small_room() {
    let rays = rays(&mut Rng(31), 60_000);
    compare("room", &Geometry::build(room()), &rays);
}

/// Nothing lies along the axes, and all of it far from the origin.
#[test]
fn of_a_turned_room() {
    let turn = Transform::rotate(40.0, vec3(1.0, 2.0, -0.5)).unwrap();
    let mut rng = Rng(36);
    for away in [0.0, 3.0, 200.0] {
        let to_world = Transform::translate(vec3(away, -away, 0.5 * away)).then_first(&turn);
        let mut shapes = room();
        for s in &mut shapes {
            if let Shape::Patches(m) = &mut s.shape {
                let place = |p: [f32; 3]| to_world.point(Vec3::from(p).to_f64()).to_f32().to_array();
                m.p.iter_mut().for_each(|p| *p = place(*p));
            } else {
                s.to_world = to_world.then_first(&s.to_world);
            }
        }
        let turned = |ray: Ray| Ray {
            o: to_world.point(ray.o.to_f64()).to_f32(),
            d: to_world.vector(ray.d.to_f64()).to_f32(),
            ..ray
        };
        let rays: Vec<Ray> = rays(&mut rng, 20_000).into_iter().map(turned).collect();
        compare("turned", &Geometry::build(shapes), &rays);
    }
}

/// A few triangles, patches and quadrics, so that some trees have one node and others more.
#[test]
fn of_few_shapes() {
    let mut rng = Rng(32);
    for n in 1..12 {
        let mut shapes = vec![triangles(&mut rng, 3 * n, 0.9), patches(&mut rng, n / 2, 0.8)];
        shapes.extend(quadrics(&mut rng, 1.0).into_iter().take(n as usize % 5));
        let rays = rays(&mut rng, 5_000);
        compare("few", &Geometry::build(shapes), &rays);
    }
}

/// Squares of two triangles each, cut either way, their corners in any turn; every third is folded, so that rays meet both.
fn squares(rng: &mut Rng, n: u32) -> ShapeInstance {
    let mut mesh = TriangleMesh::default();
    for i in 0..n {
        let (p, e) = (Vec3::from(rng.point()), rng.direction() * 0.7);
        let f = e.cross(rng.direction());
        let mut corners = [p, p + e, p + e + f, p + f];
        if i.is_multiple_of(3) {
            corners[2] += e.cross(f) * 0.9 - (e + f) * 0.8;
        }
        mesh.p.extend(corners.map(Vec3::to_array));
        for mut corners in [[0, 1, 2], [0, 2, 3]] {
            corners.rotate_left((rng.next() * 3.0) as usize);
            mesh.indices.push(corners.map(|c| 4 * i + c));
        }
    }
    placed(Shape::Triangles(mesh))
}

/// Few enough for a tree of one node; some rays go through the sides that triangles share.
#[test]
fn of_squares_of_triangles() {
    let mut rng = Rng(35);
    for n in [1, 4, 12] {
        let shape = squares(&mut rng, n);
        let Shape::Triangles(mesh) = &shape.shape else { unreachable!() };
        let (ends, mut rays) = (mesh.p.clone(), rays(&mut rng, 10_000));
        for (i, ray) in rays.iter_mut().enumerate().filter(|(i, _)| i % 5 < 2) {
            let square = 4 * (i % n as usize);
            let [a, c] = [ends[square], ends[square + 2]].map(Vec3::from);
            let s = rng.next();
            *ray = Ray::new(ray.o, a * s + c * (1.0 - s) - ray.o);
        }
        compare("squares", &Geometry::build(vec![shape]), &rays);
    }
}

#[test]
fn of_many_shapes_curves_and_instances() {
    let mut rng = Rng(33);
    let rays = rays(&mut rng, 10_000);
    compare("soup", &Geometry::build(vec![triangles(&mut rng, 3_000, 0.2)]), &rays);
    let points = (0..40).map(|_| rng.point()).map(|[x, y, z]| [x, y, z, 0.1]).collect();
    let curves = CurveSet {
        points,
        strands: vec![0, 20],
        basis: CurveBasis::BSpline,
        kind: CurveKind::Round,
        ..CurveSet::default()
    };
    let mut shapes = room();
    shapes.push(placed(Shape::Curves(curves)));
    compare("curves", &Geometry::build(shapes), &rays);
    let to_world = [[0.5, 0.1, 0.0, 0.2], [0.0, 0.4, 0.0, 0.3], [0.0, 0.0, -0.6, 0.1]];
    let instances = vec![Instance { to_world, prototype: 0 }];
    compare("instances", &Geometry::build_instanced(room(), vec![room()], instances), &rays);
}

/// What is longer is left alone.
#[test]
fn of_other_lengths() {
    let g = Geometry::build(room());
    let rays = rays(&mut Rng(34), 20);
    let (mut found, mut any) = (vec![None; 25], vec![true; 25]);
    g.intersect_many(&rays, &mut found);
    g.occluded_many(&rays, &mut any);
    assert!(any[20..].iter().all(|&x| x) && any[..20].iter().any(|&x| !x));
    let mut short = vec![None; 11];
    g.intersect_many(&rays, &mut short);
    assert_eq!(short, found[..11]);
}
