//! The Cornell box of the scene `cornell-aniso`: five walls and a lamp as bilinear patches, and two balls.

use core::f32::consts::TAU;

use sparrow_geometry::{BilinearMesh, Geometry, Ray, Shape, ShapeInstance};
use sparrow_math::{Transform, Vec3, vec3};

use crate::race::{Many, Query, Single, Tracer, race};
use crate::rays::{RaySets, Rng, camera, points};
use crate::surfaces;

/// Corners in the order p00, p10, p01, p11.
const QUADS: [[[f32; 3]; 4]; 6] = [
    [[-1., 0., -1.], [-1., 0., 1.], [1., 0., -1.], [1., 0., 1.]],
    [[-1., 2., -1.], [1., 2., -1.], [-1., 2., 1.], [1., 2., 1.]],
    [[-1., 0., -1.], [1., 0., -1.], [-1., 2., -1.], [1., 2., -1.]],
    [[-1., 0., -1.], [-1., 2., -1.], [-1., 0., 1.], [-1., 2., 1.]],
    [[1., 0., -1.], [1., 0., 1.], [1., 2., -1.], [1., 2., 1.]],
    [[-0.3, 1.998, -0.3], [0.3, 1.998, -0.3], [-0.3, 1.998, 0.3], [0.3, 1.998, 0.3]],
];

fn shapes() -> Vec<ShapeInstance> {
    let quad = |p: &[[f32; 3]; 4]| {
        let mesh = BilinearMesh { p: p.to_vec(), indices: vec![[0, 1, 2, 3]], ..BilinearMesh::default() };
        ShapeInstance { shape: Shape::Patches(mesh), to_world: Transform::IDENTITY, flip_normal: false }
    };
    let ball = |center: Vec3<f64>, radius: f32| {
        let shape = Shape::Sphere { radius, z_min: -radius, z_max: radius, phi_max: TAU };
        ShapeInstance { shape, to_world: Transform::translate(center), flip_normal: false }
    };
    let balls = [ball(vec3(-0.42, 0.45, -0.25), 0.45), ball(vec3(0.45, 0.36, 0.3), 0.36)];
    QUADS.iter().map(quad).chain(balls).collect()
}

/// Times rays one by one and in lists.
pub(crate) fn run(rounds: usize, resolution: usize) {
    let geometry = Geometry::build(shapes());
    println!("cornell: {} primitives, {} nodes", geometry.stats().primitives, geometry.stats().nodes);
    let tracers: Vec<Box<dyn Tracer + '_>> = vec![Box::new(Many(&geometry)), Box::new(Single(&geometry))];
    let camera = camera(vec3(0.0, 1.0, 5.2), vec3(0.0, 1.0, 0.0), 26.0, resolution);
    let sets = RaySets::new(&geometry, camera, vec3(0.0, 1.0, 0.0));
    let (first, second) = (to_lamp(&geometry, &sets.camera, 5), to_lamp(&geometry, &sets.bounce, 6));
    race("camera", &tracers, &sets.camera, rounds, Query::Closest);
    race("shadow of the camera's points", &tracers, &first, rounds, Query::Any);
    race("bounce", &tracers, &sets.bounce, rounds, Query::Closest);
    race("shadow of the bounces' points", &tracers, &second, rounds, Query::Any);
    race("bounces 2 and 3, shuffled", &tracers, &sets.shuffled, rounds, Query::Closest);
    // The first three walls are of one material.
    let material = |shape: u32| shape.max(2);
    surfaces::run("surface points of the camera's rays", &geometry, &sets.camera, rounds, material);
    surfaces::run("surface points of bounces", &geometry, &sets.shuffled, rounds, material);
}

/// Towards points of the lamp, from where the rays end.
fn to_lamp(geometry: &Geometry, rays: &[Ray], seed: u64) -> Vec<Ray> {
    let mut rng = Rng(seed);
    let mut lamp = || geometry.sample_area(5, 0, [rng.next(), rng.next()]).unwrap();
    points(geometry, rays).into_iter().map(|(s, _)| s.spawn_to_sample(&lamp())).collect()
}
