//! Nearest points, shadows and tightness.

use sparrow_geometry::{Geometry, Ray, Shape, ShapeInstance, TriangleMesh};
use sparrow_math::{Real, Vec3, vec3};

use super::{Rng, patches, placed, quadrics, triangles, twin};

/// Rays that both find, and how many only one finds or that differ in `t` by more than the tolerance.
fn compare(shapes: &[ShapeInstance], rng: &mut Rng, rays: u32, tolerance: f64) -> (u32, u32) {
    let geometry = Geometry::build(shapes.to_vec());
    let (mut hits, mut wrong) = (0, 0);
    for _ in 0..rays {
        let o = Vec3::from(rng.point()) * 2.5;
        let ray = Ray::new(o, (Vec3::from(rng.point()) - o) * rng.between(0.1, 5.0));
        let found = geometry.intersect(&ray);
        assert_eq!(found.is_some(), geometry.occluded(&ray), "{ray:?}");
        match (found, twin::nearest(shapes, &ray)) {
            (Some(h), Some((t, _, _))) => {
                hits += 1;
                wrong += u32::from((f64::from(h.t) - t).abs() > tolerance * t);
            }
            (None, None) => {}
            (Some(_), None) | (None, Some(_)) => wrong += 1,
        }
    }
    (hits, wrong)
}

#[test]
fn triangles_agree_with_twin() {
    let mut rng = Rng(1);
    for (n, size) in [(1, 0.9), (7, 0.9), (300, 0.3), (3000, 0.08)] {
        let shapes = [triangles(&mut rng, n, size)];
        let (hits, wrong) = compare(&shapes, &mut rng, 3000, 1e-5);
        // A ray on the very edge may go either way.
        assert!(hits > 40 && wrong <= 1, "{n} triangles: {wrong} of {hits} wrong");
    }
}

#[test]
fn patches_agree_with_twin() {
    let mut rng = Rng(2);
    let shapes = [patches(&mut rng, 24, 0.8)];
    // The twin's cells are chords: it errs by their sag, 1/48^2 of the twist, more where the ray is grazing.
    let (hits, wrong) = compare(&shapes, &mut rng, 500, 4e-3);
    assert!(hits > 150 && wrong <= hits / 50, "{wrong} of {hits} wrong");
    let flat = {
        let mut s = patches(&mut rng, 30, 0.8);
        if let Shape::Patches(m) = &mut s.shape {
            m.indices = m.indices.iter().enumerate().filter(|(i, _)| i % 3 != 0).map(|(_, a)| *a).collect();
        }
        [s]
    };
    let (hits, wrong) = compare(&flat, &mut rng, 500, 1e-5);
    assert!(hits > 150 && wrong <= 1, "flat: {wrong} of {hits} wrong");
}

#[test]
fn quadrics_agree_with_twin() {
    let mut rng = Rng(3);
    for _ in 0..4 {
        let shapes = quadrics(&mut rng, 1.0);
        let (hits, wrong) = compare(&shapes, &mut rng, 3000, 1e-5);
        assert!(hits > 500 && wrong <= 1, "{wrong} of {hits} wrong");
    }
}

#[test]
fn all_sorts_in_one_tree_agree_with_twin() {
    let mut rng = Rng(4);
    let mut shapes = quadrics(&mut rng, 0.5);
    shapes.push(triangles(&mut rng, 200, 0.2));
    shapes.extend(quadrics(&mut rng, 0.3));
    let geometry = Geometry::build(shapes.clone());
    let mut same = 0;
    for _ in 0..4000 {
        let o = Vec3::from(rng.point()) * 2.0;
        let ray = Ray::new(o, rng.direction());
        let found = geometry.intersect(&ray).map(|h| (h.shape, h.prim));
        same += u32::from(found == twin::nearest(&shapes, &ray).map(|(_, s, p)| (s, p)));
    }
    assert!(same >= 3999, "{same} of 4000");
}

/// A closed ball of triangles whose corners all lie on a coarse grid of angles.
pub(crate) fn ball(n: u32, center: Vec3<f32>, radius: f32) -> ShapeInstance {
    let mut mesh = TriangleMesh::default();
    for i in 0..=n {
        for j in 0..n {
            let (st, ct) = Real::sin_cos(core::f32::consts::PI * i as f32 / n as f32);
            let (sp, cp) = Real::sin_cos(core::f32::consts::TAU * j as f32 / n as f32);
            let st = if i == 0 || i == n { 0.0 } else { st };
            mesh.p.push((center + vec3(st * cp, st * sp, ct) * radius).to_array());
        }
    }
    for i in 0..n {
        for j in 0..n {
            let (a, b) = (i * n + j, i * n + (j + 1) % n);
            mesh.indices.push([a, a + n, b + n]);
            mesh.indices.push([a, b + n, b]);
        }
    }
    placed(Shape::Triangles(mesh))
}

/// From inside a closed mesh every ray meets something, however exactly it is aimed at corners and edges.
#[test]
fn no_light_leaks_through_edges() {
    let mut rng = Rng(5);
    for (center, radius) in [(0.0, 1.0), (100.0, 1.0), (-1000.0, 30.0), (0.0, 1e-3), (1e4, 1e3)] {
        let center = vec3(center, -0.5 * center, 0.25 * center);
        let shape = ball(17, center, radius);
        let Shape::Triangles(mesh) = &shape.shape else { unreachable!() };
        let geometry = Geometry::build(vec![shape.clone()]);
        let p = |i: u32| Vec3::from(mesh.p[i as usize]);
        for at in &mesh.indices {
            let o = center + Vec3::from(rng.point()) * (0.4 * radius);
            let mut aims = vec![p(at[0]), p(at[1]), p(at[2])];
            for _ in 0..4 {
                let w = rng.next();
                aims.extend([(0, 1), (1, 2), (2, 0)].map(|(i, j)| p(at[i]) * w + p(at[j]) * (1.0 - w)));
            }
            for aim in aims {
                let ray = Ray::new(o, aim - o);
                assert!(geometry.intersect(&ray).is_some(), "{center:?} {radius}: {ray:?}");
            }
            // Along the axes, too, where box faces and directions have zeros.
            for axis in 0..3 {
                let mut d = [0.0, -0.0, 0.0];
                d[axis] = if rng.next() < 0.5 { -1.0 } else { 1.0 };
                assert!(geometry.occluded(&Ray::new(center, d.into())));
            }
        }
    }
}

/// A grid of squares in a coordinate plane: rays that run in the plane of box faces, through corners.
#[test]
fn no_light_leaks_through_a_grid() {
    let n = 16;
    let mut mesh = TriangleMesh::default();
    for i in 0..=n {
        for j in 0..=n {
            mesh.p.push([i as f32, j as f32, 0.0]);
        }
    }
    for i in 0..n {
        for j in 0..n {
            let a = i * (n + 1) + j;
            mesh.indices.extend([[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]);
        }
    }
    let geometry = Geometry::build(vec![placed(Shape::Triangles(mesh))]);
    for i in 1..n {
        for j in 1..n {
            let corner = vec3(i as f32, j as f32, 0.0);
            for d in [vec3(0.0, 0.0, 1.0), vec3(0.5, 0.0, 1.0), vec3(-0.25, 0.5, 2.0), vec3(0.3, 0.3, 0.7)] {
                assert!(geometry.intersect(&Ray::new(corner - d, d)).is_some(), "{corner:?} {d:?}");
            }
        }
    }
}

/// The end of a ray does not belong to it, nor does its beginning.
#[test]
fn rays_are_open() {
    let shapes =
        vec![placed(Shape::Disk { height: 2.0, radius: 1.0, inner_radius: 0.0, phi_max: super::TAU })];
    let disk = Geometry::build(shapes);
    let mut rng = Rng(6);
    let p = vec![[-1.0, -1.0, 2.0], [1.0, -1.0, 2.0], [0.0, 1.0, 2.0]];
    let mesh = TriangleMesh { p, indices: vec![[0, 1, 2]], ..Default::default() };
    let triangle = Geometry::build(vec![placed(Shape::Triangles(mesh))]);
    for g in [&disk, &triangle] {
        for _ in 0..100 {
            let (x, y) = (rng.between(-0.2, 0.2), rng.between(-0.2, 0.2));
            let up = Ray { o: vec3(x, y, 1.0), d: vec3(0.0, 0.0, 0.5), t_max: 2.0, time: 0.0 };
            assert!(!g.occluded(&up));
            assert!(g.occluded(&Ray { t_max: 2.0_f32.next_up(), ..up }));
            assert!(!g.occluded(&Ray::new(vec3(x, y, 2.0), vec3(0.1, 0.0, 1.0))));
        }
    }
}

/// What is not accepted is not there: neither for the nearest point nor for shadows.
#[test]
fn rejected_hits_are_passed() {
    let mut rng = Rng(7);
    let shapes = vec![triangles(&mut rng, 400, 0.3), placed(super::sphere(0.5))];
    let (all, first) = (Geometry::build(shapes.clone()), Geometry::build(shapes[..1].to_vec()));
    let mut through = 0;
    for _ in 0..2000 {
        let ray = Ray::new(Vec3::from(rng.point()) * 2.0, rng.direction());
        let only_first = |h: &sparrow_geometry::Hit| h.shape == 0;
        assert_eq!(all.intersect_where(&ray, only_first), first.intersect(&ray));
        assert_eq!(all.occluded_where(&ray, only_first), first.occluded(&ray));
        // The far side of a sphere shows where the near side has a hole.
        let near = all.intersect_where(&ray, |h| h.shape == 1);
        let far = all.intersect_where(&ray, |h| h.shape == 1 && near.is_some_and(|n| h.t > n.t));
        through += u32::from(far.is_some());
    }
    assert!(through > 50, "{through}");
}
