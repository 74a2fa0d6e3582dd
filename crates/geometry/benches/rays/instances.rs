//! Ten million instances of one mesh: time and memory to build, and rays.

use sparrow_geometry::{Geometry, Instance, Ray, Shape, ShapeInstance, TriangleMesh};
use sparrow_math::{Frame, Transform, Vec3, vec3};

use crate::race::{Query, Single, Tracer, cpu_seconds, race};
use crate::rays::{RaySets, Rng, camera};

/// Turned, scaled and scattered in a flat box; about one for each unit of its volume.
fn scattered(n: usize) -> Vec<Instance> {
    let mut rng = Rng(12);
    let side = (n as f32 / 4.0).sqrt();
    let place = |_| {
        let f = Frame::from_z(rng.sphere());
        let size = 0.2 + 0.3 * rng.next();
        let p = vec3((rng.next() - 0.5) * side, 4.0 * rng.next(), (rng.next() - 0.5) * side);
        let row = |i: usize| [size * f.x[i], size * f.y[i], size * f.z[i], p[i]];
        Instance { to_world: [row(0), row(1), row(2)], prototype: 0 }
    };
    (0..n).map(place).collect()
}

/// Builds the tree over `n` instances of `mesh` and times rays.
pub(crate) fn run(mesh: TriangleMesh, n: usize, rounds: usize, resolution: usize) {
    println!("instances: {n} of {} triangles", mesh.indices.len());
    let shape = Shape::Triangles(mesh);
    let prototype = vec![ShapeInstance { shape, to_world: Transform::IDENTITY, flip_normal: false }];
    let instances = scattered(n);
    let start = cpu_seconds();
    let geometry = Geometry::build_instanced(vec![], vec![prototype], instances);
    let (seconds, stats) = (cpu_seconds() - start, geometry.stats());
    let bytes = stats.bytes.total() as f64;
    println!("  built in {seconds:.2} s: {:.0} MB, {:.0} bytes an instance", 1e-6 * bytes, bytes / n as f64);
    let peak = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = peak.lines().find(|l| l.starts_with("VmHWM")).unwrap_or_default().to_owned();
    println!("  most memory of the process: {}", peak.trim_start_matches("VmHWM:").trim());
    let tracers: Vec<Box<dyn Tracer + '_>> = vec![Box::new(Single(&geometry))];
    let center = Vec3::splat(0.0);
    let rays: Vec<Ray> = camera(vec3(0.0, 30.0, -60.0), center, 60.0, resolution);
    let sets = RaySets::new(&geometry, rays, vec3(0.0, 100.0, 0.0));
    race("camera", &tracers, &sets.camera, rounds, Query::Closest);
    race("bounce", &tracers, &sets.bounce, rounds, Query::Closest);
    race("shadow, any hit", &tracers, &sets.shadow, rounds, Query::Any);
}
