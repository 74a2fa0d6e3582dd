//! Hits and misses against double precision, and at shared edges and corners of closed meshes. The large counts are run with
//! `cargo test --release -p sparrow-geometry -- --ignored`.

use sparrow_geometry::{Geometry, Ray, Shape};
use sparrow_math::{Vec3, vec3};

use super::rays::ball;
use super::{Rng, triangles};

type V = Vec3<f64>;

/// The nearest triangle that the ray meets; `None` where it comes within 1e-6 of an edge, in weights of the corners.
fn nearest(p: &[[V; 3]], ray: &Ray) -> Option<Option<(f64, u32)>> {
    let (o, d) = (ray.o.to_f64(), ray.d.to_f64());
    let mut best: Option<(f64, u32)> = None;
    for (i, [a, b, c]) in p.iter().enumerate() {
        let (e1, e2) = (*b - *a, *c - *a);
        let q = d.cross(e2);
        let det = e1.dot(q);
        let s = o - *a;
        let r = s.cross(e1);
        let (u, v, t) = (s.dot(q) / det, d.dot(r) / det, e2.dot(r) / det);
        let least = u.min(v).min(1.0 - u - v);
        if t > -1e-6 && least.abs() < 1e-6 {
            return None;
        }
        if least > 0.0 && t > 0.0 && best.is_none_or(|b| t < b.0) {
            best = Some((t, i as u32));
        }
    }
    Some(best)
}

fn compare(n_rays: u32) {
    let mut rng = Rng(41);
    for (n, size) in [(20, 1.0), (150, 0.4)] {
        let shape = triangles(&mut rng, n, size);
        let Shape::Triangles(mesh) = &shape.shape else { unreachable!() };
        let corner = |i: u32| Vec3::from(mesh.p[i as usize]).to_f64();
        let corners: Vec<[V; 3]> = mesh.indices.iter().map(|i| i.map(corner)).collect();
        let geometry = Geometry::build(vec![shape.clone()]);
        let (mut hits, mut off_edges) = (0, 0);
        for _ in 0..n_rays / 2 {
            let o = Vec3::from(rng.point()) * 2.5;
            let ray = Ray::new(o, (Vec3::from(rng.point()) - o) * rng.between(0.1, 5.0));
            let Some(exact) = nearest(&corners, &ray) else { continue };
            off_edges += 1;
            let found = geometry.intersect(&ray);
            assert_eq!(found.is_some(), exact.is_some(), "{ray:?}");
            assert_eq!(geometry.occluded(&ray), exact.is_some(), "{ray:?}");
            if let (Some(h), Some((t, _))) = (found, exact) {
                hits += 1;
                // In lengths: a few roundings of coordinates up to 5, more where the triangle is seen edge-on.
                let error = (f64::from(h.t) - t).abs() * ray.d.to_f64().length();
                let length = t * ray.d.to_f64().length();
                assert!(error < 1e-4 * length + 3e-6, "{ray:?}: {h:?}, not {t}");
            }
        }
        assert!(off_edges > n_rays / 2 * 9 / 10 && hits > n_rays / 20, "{hits} of {off_edges}");
    }
}

fn aim_at_edges(n_rays: u32) {
    let mut rng = Rng(42);
    for (center, radius) in [(0.0, 1.0), (100.0, 1.0), (-1000.0, 30.0), (1e4, 1e3)] {
        let center = vec3(center, -0.5 * center, 0.25 * center);
        let shape = ball(29, center, radius);
        let Shape::Triangles(mesh) = &shape.shape else { unreachable!() };
        let geometry = Geometry::build(vec![shape.clone()]);
        for i in 0..n_rays / 4 {
            let at = mesh.indices[(rng.next() * mesh.indices.len() as f32) as usize % mesh.indices.len()];
            let k = (rng.next() * 3.0) as usize % 3;
            let p = |j: usize| Vec3::from(mesh.p[at[j % 3] as usize]);
            let w = if i % 3 == 0 { 1.0 } else { rng.next() };
            let aim = p(k) * w + p(k + 1) * (1.0 - w);
            let o = center + Vec3::from(rng.point()) * (0.5 * radius);
            assert!(geometry.intersect(&Ray::new(o, aim - o)).is_some(), "{center:?} {o:?} {aim:?}");
        }
    }
}

#[test]
fn hits_and_misses_are_exact_off_edges() {
    compare(100_000);
}

#[test]
fn closed_meshes_have_no_holes() {
    aim_at_edges(400_000);
}

#[test]
#[ignore = "ten million rays"]
fn hits_and_misses_are_exact_off_edges_ten_million_times() {
    compare(10_000_000);
}

#[test]
#[ignore = "ten million rays"]
fn closed_meshes_have_no_holes_ten_million_times() {
    aim_at_edges(10_000_000);
}
