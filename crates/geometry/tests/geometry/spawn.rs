//! Rays that leave a surface do not meet it again, and shadow rays do not meet their target.

use sparrow_geometry::{Geometry, Ray, Shape, ShapeInstance};
use sparrow_math::{Transform, Vec3, vec3};

use super::rays::ball;
use super::{Rng, at};

/// Points met from outside: rays that go on away from the surface must not meet the shape it belongs to.
fn leaves(shape: ShapeInstance, center: Vec3<f32>, radius: f32, rng: &mut Rng, what: &str) {
    let g = Geometry::build(vec![shape]);
    let mut left = 0;
    for _ in 0..600 {
        let o = center + rng.direction() * (3.0 * radius);
        let ray = Ray::new(o, center + rng.direction() * (0.9 * radius) - o);
        let Some(hit) = g.intersect(&ray) else { continue };
        let s = g.surface(&ray, &hit);
        assert!(
            s.p.is_finite() && s.p_error.is_finite() && (s.ng.length() - 1.0).abs() < 1e-5,
            "{what}: {s:?}"
        );
        let out = if s.ng.dot(ray.d) > 0.0 { -s.ng } else { s.ng };
        for _ in 0..8 {
            let d = rng.direction();
            let d = if d.dot(out) < 0.0 { -d } else { d };
            // Directions in the surface itself belong to neither side.
            if d.dot(out) > 1e-3 {
                let back = g.intersect(&s.spawn(d));
                assert!(back.is_none(), "{what}: {s:?} {d:?} {back:?}");
                left += 1;
            }
        }
    }
    assert!(left > 1000, "{what}: {left}");
}

#[test]
fn convex_shapes_do_not_shadow_themselves() {
    let mut rng = Rng(1);
    for radius in [1e-3, 0.1, 1.0, 30.0, 1e3] {
        for far in [0.0, 1.0, 100.0, 1e4] {
            // Where the numbers are coarser than the shape there is nothing to test.
            if far * f32::EPSILON > 0.02 * radius {
                continue;
            }
            let center = vec3(far, -0.7 * far, 0.3 * far);
            let place = Transform::translate(center.to_f64());
            let what = format!("radius {radius} at {far}");
            leaves(ball(11, center, radius), center, radius, &mut rng, &what);
            leaves(at(super::sphere(radius), place), center, radius, &mut rng, &what);
            let turned = place.then_first(&Transform::rotate(40.0, vec3(1.0, 2.0, 3.0)).unwrap());
            let disk = Shape::Disk { height: 0.0, radius, inner_radius: 0.0, phi_max: super::TAU };
            leaves(at(disk, turned), center, radius, &mut rng, &what);
        }
    }
}

/// Inside a sphere every ray meets it again, on the other side.
#[test]
fn spheres_hold_their_rays() {
    let mut rng = Rng(2);
    for (radius, far) in [(1e-3, 0.0), (1.0, 0.0), (1.0, 100.0), (1e3, 1e4)] {
        let center = vec3(far, far, -far);
        let g = Geometry::build(vec![at(super::sphere(radius), Transform::translate(center.to_f64()))]);
        let mut ray = Ray::new(center, rng.direction());
        for _ in 0..2000 {
            let hit = g.intersect(&ray).unwrap();
            let s = g.surface(&ray, &hit);
            let d = rng.direction();
            let d = if d.dot(s.ng) > 0.0 { -d } else { d };
            let next = s.spawn(d);
            let across = -2.0 * radius * d.dot(s.ng);
            if across > 0.05 * radius {
                let t = g.intersect(&next).unwrap().t;
                assert!((t / across - 1.0).abs() < 0.05, "{radius} at {far}: {t} for {across}");
            }
            ray = if across > 0.05 * radius { next } else { Ray::new(center, rng.direction()) };
        }
    }
}

/// Between two points of two walls nothing stands; a shadow ray does not find the light itself.
#[test]
fn shadow_rays_end_before_the_light() {
    let mut rng = Rng(3);
    for far in [0.0, 10.0, 1e3] {
        let c = vec3(far, far, far);
        let mut shapes = vec![super::patches(&mut rng, 1, 1.0), super::triangles(&mut rng, 1, 1.0)];
        shapes.extend(super::quadrics(&mut rng, 1.0));
        for s in &mut shapes {
            match &mut s.shape {
                Shape::Patches(m) => m.p.iter_mut().for_each(|p| *p = (Vec3::from(*p) + c).to_array()),
                Shape::Triangles(m) => m.p.iter_mut().for_each(|p| *p = (Vec3::from(*p) + c).to_array()),
                Shape::Curves(_) => {}
                Shape::Sphere { .. } | Shape::Disk { .. } | Shape::Cylinder { .. } => {
                    s.to_world = Transform::translate(c.to_f64()).then_first(&s.to_world);
                }
            }
        }
        for shape in shapes {
            let g = Geometry::build(vec![shape.clone()]);
            let floor = at(
                Shape::Disk { height: -4.0, radius: 50.0, inner_radius: 0.0, phi_max: super::TAU },
                Transform::translate(c.to_f64()),
            );
            let floor = Geometry::build(vec![floor]);
            for _ in 0..300 {
                let down = Ray::new(
                    c + vec3(rng.between(-9.0, 9.0), rng.between(-9.0, 9.0), 0.0),
                    vec3(0.0, 0.0, -1.0),
                );
                let s = floor.surface(&down, &floor.intersect(&down).unwrap());
                let Some(sample) = g.sample_area(0, 0, rng.pair()) else { continue };
                let ray = s.spawn_to_sample(&sample);
                // A curved light seen edge-on does stand before its own points.
                if ray.d.normalized().dot(sample.n).abs() < 0.05 {
                    continue;
                }
                // The near side of a round light may hide its far side; the sampled point itself must not.
                let close = g.intersect(&ray).is_some_and(|h| h.t > 0.999);
                assert!(!close && !floor.occluded(&ray), "{:?} {ray:?}", shape.shape);
            }
        }
    }
}

/// Large tilted triangles: grazing rays that leave do not come back, and what lies close above is not overlooked.
#[test]
fn large_triangles_grazed() {
    let mut rng = Rng(4);
    for _ in 0..300 {
        let g = Geometry::build(vec![super::triangles(&mut rng, 1, 1000.0)]);
        let Some(aim) = g.sample_area(0, 0, rng.pair()) else { continue };
        let o = aim.p + rng.direction() * 10.0;
        let ray = Ray::new(o, aim.p - o);
        let Some(hit) = g.intersect(&ray) else { continue };
        let s = g.surface(&ray, &hit);
        for _ in 0..200 {
            let along = rng.direction();
            let along = (along - s.ng * s.ng.dot(along)).normalized();
            let away = along + s.ng * rng.between(1e-5, 1e-3);
            assert!(!g.occluded(&s.spawn(away)), "{s:?} {away:?}");
            // Higher than the coordinates are coarse, and far below the bound of the error of t at this size.
            let height = 1e-3;
            let above = Ray::new(s.p + s.ng * height, along - s.ng);
            assert!(g.occluded(&above), "{s:?} {above:?}");
        }
    }
}
