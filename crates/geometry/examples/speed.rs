//! Nanoseconds a ray takes on one thread: diffuse bounces in a mesh of a million triangles, and in a box of fifteen.
#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use std::time::Instant;

use sparrow_geometry::{BilinearMesh, Geometry, Ray, Shape, ShapeInstance, TriangleMesh};
use sparrow_math::{Frame, LocalDir, Real, Transform, vec3, warp};

/// Uniform numbers in [0, 1). [Steele2014]
struct Rng(u64);

impl Rng {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u32 << 24) as f32
    }
    fn pair(&mut self) -> [f32; 2] {
        [self.next(), self.next()]
    }
}

fn placed(shape: Shape) -> ShapeInstance {
    ShapeInstance { shape, to_world: Transform::IDENTITY, flip_normal: false }
}

/// A dented ball of `2 n^2` triangles.
fn ball(n: u32) -> ShapeInstance {
    let mut mesh = TriangleMesh::default();
    for i in 0..=n {
        for j in 0..=n {
            let (st, ct) = Real::sin_cos(core::f32::consts::PI * i as f32 / n as f32);
            let (sp, cp) = Real::sin_cos(core::f32::consts::TAU * j as f32 / n as f32);
            let (dent, _) = Real::sin_cos(12.0 * (st * cp) + 9.0 * ct);
            let r = 1.0 + 0.12 * dent * Real::sin_cos(17.0_f32 * sp * st).0;
            mesh.p.push([r * st * cp, r * st * sp, r * ct]);
        }
    }
    for i in 0..n {
        for j in 0..n {
            let a = i * (n + 1) + j;
            mesh.indices.push([a, a + n + 1, a + n + 2]);
            mesh.indices.push([a, a + n + 2, a + 1]);
        }
    }
    placed(Shape::Triangles(mesh))
}

/// A closed room around [-2, 2]^3, of `n` patches a wall.
fn room() -> ShapeInstance {
    let (c, mut mesh) = ([-2.0, 2.0], BilinearMesh::default());
    for axis in 0..3 {
        for side in c {
            for [u, v] in [[c[0], c[0]], [c[1], c[0]], [c[0], c[1]], [c[1], c[1]]] {
                let mut p = [0.0; 3];
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, u, v);
                mesh.p.push(p);
            }
            let n = mesh.p.len() as u32;
            mesh.indices.push([n - 4, n - 3, n - 2, n - 1]);
        }
    }
    placed(Shape::Patches(mesh))
}

/// What is timed.
#[derive(Clone, Copy, PartialEq)]
enum Work {
    /// Nearest points, the surface there, and the next direction.
    Bounce,
    /// The same, and a shadow ray from each point.
    Shadow,
    /// Nearest points alone, of rays gathered beforehand.
    Closest,
    /// Shadow rays alone.
    Occluded,
}

/// Rays of diffuse paths of four segments.
fn paths(geometry: &Geometry, n: u32, rng: &mut Rng, shadow: bool, mut each: impl FnMut(Ray)) -> u32 {
    let mut shadowed = 0;
    for _ in 0..n {
        let mut ray = Ray::new(vec3(1.7, -1.6, 1.1), vec3(-1.0 + rng.next(), 1.0, -rng.next()));
        for _ in 0..4 {
            each(ray);
            let Some(hit) = geometry.intersect(&ray) else { break };
            let s = geometry.surface(&ray, &hit);
            let n = if s.ng.dot(ray.d) > 0.0 { -s.ng } else { s.ng };
            let w = Frame::from_z(n).to_world(LocalDir::new(warp::cosine_hemisphere(rng.pair())));
            if shadow {
                let to_lamp = s.spawn_to(vec3(0.0, 0.0, 1.9));
                each(to_lamp);
                shadowed += u32::from(geometry.occluded(&to_lamp));
            }
            ray = s.spawn(w);
        }
    }
    shadowed
}

/// Prints the nanoseconds a ray takes: the best of many short runs, as others may use the machine.
fn time(name: &str, geometry: &Geometry, work: Work, repeats: u32) {
    const PATHS: u32 = 4000;
    let (mut best, mut sum) = (f64::INFINITY, 0);
    for repeat in 0..repeats {
        let mut rng = Rng(u64::from(repeat));
        let mut rays = Vec::new();
        if matches!(work, Work::Closest | Work::Occluded) {
            paths(geometry, PATHS, &mut rng, work == Work::Occluded, |r| rays.push(r));
        }
        rays.retain(|r| (work == Work::Occluded) == r.t_max.is_finite());
        let mut n = rays.len() as u32;
        let start = Instant::now();
        match work {
            Work::Bounce => sum += paths(geometry, PATHS, &mut rng, false, |_| n += 1),
            Work::Shadow => sum += paths(geometry, PATHS, &mut rng, true, |_| n += 1),
            Work::Closest => sum += rays.iter().filter(|r| geometry.intersect(r).is_some()).count() as u32,
            Work::Occluded => sum += rays.iter().filter(|r| geometry.occluded(r)).count() as u32,
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(n));
    }
    println!("{name}: {best:.0} ns a ray (check {sum})");
}

fn all(name: &str, geometry: &Geometry, repeats: u32) {
    println!("{name}: {:?}", geometry.stats());
    time("  nearest point", geometry, Work::Closest, repeats);
    time("  shadow", geometry, Work::Occluded, repeats);
    time("  nearest point, surface, next direction", geometry, Work::Bounce, repeats);
    time("  the same and shadow rays", geometry, Work::Shadow, repeats);
}

fn main() {
    let number = |i: usize, or: u32| std::env::args().nth(i).and_then(|a| a.parse().ok()).unwrap_or(or);
    let (n, repeats) = (number(1, 740), number(2, 30));
    all("ball in a room", &Geometry::build(vec![ball(n), room()]), repeats);
    let sphere = |x: f64, y: f64, r: f32| ShapeInstance {
        shape: Shape::Sphere { radius: r, z_min: -r, z_max: r, phi_max: core::f32::consts::TAU },
        to_world: Transform::translate(vec3(x, y, -1.0)),
        flip_normal: false,
    };
    let mut few = vec![room(), sphere(-0.8, 0.5, 0.7), sphere(0.8, 0.2, 0.5)];
    few.push(ball(1));
    few.push(ball(2));
    all("room", &Geometry::build(vec![room()]), repeats);
    all("room with spheres", &Geometry::build(few), repeats);
}
