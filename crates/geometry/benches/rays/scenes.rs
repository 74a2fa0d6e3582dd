//! The scenes: made by formulas, so that anyone can measure them again.

use sparrow_geometry::{Geometry, Shape, ShapeInstance, TriangleMesh};
use sparrow_math::{Real, Transform, Vec3, vec3};

use crate::race::{Many, Single, Tracer, cpu_seconds};
use crate::rays::{RaySets, Rng, camera};

/// A scene and how it is looked at.
pub(crate) struct Scene {
    pub(crate) name: &'static str,
    mesh: fn() -> TriangleMesh,
    eye: Vec3<f32>,
    at: Vec3<f32>,
    light: Vec3<f32>,
}

pub(crate) const ALL: [Scene; 3] = [
    Scene {
        name: "mesh",
        mesh: bumpy,
        eye: vec3(4.0, 3.0, 4.0),
        at: vec3(0.0, 0.5, 0.0),
        light: vec3(3.0, 5.0, 1.0),
    },
    Scene {
        name: "soup",
        mesh: soup,
        eye: vec3(4.5, 3.0, 4.5),
        at: vec3(0.0, 1.0, 0.0),
        light: vec3(3.0, 5.0, 1.0),
    },
    Scene {
        name: "small",
        mesh: room,
        eye: vec3(0.0, 0.0, 0.9),
        at: vec3(0.0, -0.2, 0.0),
        light: vec3(0.0, 0.0, 0.0),
    },
];

impl Scene {
    /// Its triangles.
    pub(crate) fn mesh(&self) -> TriangleMesh {
        (self.mesh)()
    }
    /// Builds the tree and times all rays, beside the first `settings` of Embree.
    #[cfg_attr(
        not(feature = "embree"),
        allow(unused_mut, unused_variables, reason = "Embree is added where it is there")
    )]
    pub(crate) fn run(&self, rounds: usize, resolution: usize, settings: usize) {
        let mesh = self.mesh();
        println!("{}: {} triangles", self.name, mesh.indices.len());
        let instance = ShapeInstance {
            shape: Shape::Triangles(mesh.clone()),
            to_world: Transform::IDENTITY,
            flip_normal: false,
        };
        let start = cpu_seconds();
        let geometry = Geometry::build(vec![instance]);
        let (seconds, stats) = (cpu_seconds() - start, geometry.stats());
        let megabytes = 1e-6 * stats.bytes.total() as f64;
        println!("  built in {seconds:.3} s: {} nodes, {megabytes:.1} MB with the mesh", stats.nodes);
        let mut tracers: Vec<Box<dyn Tracer + '_>> =
            vec![Box::new(Single(&geometry)), Box::new(Many(&geometry))];
        #[cfg(feature = "embree")]
        for tracer in crate::embree::all(&mesh, settings) {
            tracers.push(Box::new(tracer));
        }
        let sets = RaySets::new(&geometry, camera(self.eye, self.at, 45.0, resolution), self.light);
        sets.race(&tracers, rounds);
        crate::surfaces::run("surface points of bounces", &geometry, &sets.bounce, rounds, |shape| shape);
    }
}

/// A number in [0, 1] for each point of the lattice.
fn lattice(x: i32, y: i32, z: i32) -> f32 {
    let mixed = (x as u32).wrapping_mul(0x8da6_b343)
        ^ (y as u32).wrapping_mul(0xd816_3841)
        ^ (z as u32).wrapping_mul(0xcb1a_b31f);
    Rng(u64::from(mixed)).next()
}

/// Smoothly interpolated values of the lattice.
fn noise(p: Vec3<f32>) -> f32 {
    let floor = p.to_array().map(f32::floor);
    let cell = floor.map(|f| f as i32);
    let smooth = |i: usize| {
        let t = p[i] - floor[i];
        t * t * (3.0 - 2.0 * t)
    };
    let w = [smooth(0), smooth(1), smooth(2)];
    let corner = |c: i32| {
        let at = [c & 1, c >> 1 & 1, c >> 2];
        let weight = |i: usize| if at[i] == 1 { w[i] } else { 1.0 - w[i] };
        let value = lattice(cell[0] + at[0], cell[1] + at[1], cell[2] + at[2]);
        weight(0) * weight(1) * weight(2) * value
    };
    (0..8).map(corner).sum()
}

/// Noise of halving size and height, summed.
fn turbulence(p: Vec3<f32>, octaves: i32) -> f32 {
    let octave = |i: i32| 0.5_f32.powi(i + 1) * noise(p * 2.03_f32.powi(i));
    (0..octaves).map(octave).sum()
}

/// Adds a grid of `n` times `n` squares, each cut in two; `at` gives its points for parameters in [0, 1].
fn add_grid(mesh: &mut TriangleMesh, n: u32, at: impl Fn(f32, f32) -> Vec3<f32>) {
    let (first, row) = (mesh.p.len() as u32, n + 1);
    for y in 0..=n {
        for x in 0..=n {
            mesh.p.push(at(x as f32 / n as f32, y as f32 / n as f32).to_array());
        }
    }
    for y in 0..n {
        for x in 0..n {
            let a = first + y * row + x;
            mesh.indices.extend([[a, a + 1, a + row], [a + 1, a + row + 1, a + row]]);
        }
    }
}

/// Adds the six faces of the cube [-1, 1]^3, each `n` times `n` squares; `at` moves their points.
fn add_cube(mesh: &mut TriangleMesh, n: u32, at: impl Fn(Vec3<f32>) -> Vec3<f32>) {
    for axis in 0..3 {
        for side in [1.0, -1.0] {
            add_grid(mesh, n, |x, y| {
                let mut p = [side; 3];
                p[(axis + 1) % 3] = 2.0 * x - 1.0;
                p[(axis + 2) % 3] = 2.0 * y - 1.0;
                at(p.into())
            });
        }
    }
}

/// A bumpy ball of `12 n^2` triangles around (0, 1, 0).
pub(crate) fn bumpy_ball(n: u32) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    add_cube(&mut mesh, n, |p| {
        let d = p.normalized();
        d * (1.0 + 0.35 * (turbulence(d * 5.0, 7) - 0.5)) + vec3(0.0, 1.0, 0.0)
    });
    mesh
}

/// A million triangles: a bumpy ball over a bumpy ground.
fn bumpy() -> TriangleMesh {
    let mut mesh = bumpy_ball(205);
    add_grid(&mut mesh, 500, |x, y| {
        let (x, z) = (10.0 * (x - 0.5), 10.0 * (y - 0.5));
        vec3(x, 0.9 * (turbulence(vec3(1.3 * x, 7.7, 1.3 * z), 8) - 0.5) - 0.2, z)
    });
    mesh
}

/// 300 000 loose triangles, most small, few large, many of them slivers.
fn soup() -> TriangleMesh {
    let (mut mesh, mut rng) = (TriangleMesh::default(), Rng(42));
    for i in 0..300_000_u32 {
        let c = vec3((rng.next() - 0.5) * 4.0, rng.next() * 2.0, (rng.next() - 0.5) * 4.0);
        let long = 0.003 * Real::exp(Real::ln(200.0_f32) * rng.next().powi(3));
        let short = long * Real::exp(Real::ln(0.05_f32) * rng.next());
        mesh.p.extend([c, c + rng.sphere() * long, c + rng.sphere() * short].map(Vec3::to_array));
        mesh.indices.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    mesh
}

/// A closed room with two boxes in it: 36 triangles.
fn room() -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    add_cube(&mut mesh, 1, |p| p);
    add_cube(&mut mesh, 1, |p| vec3(0.4, -0.7, 0.2) + p * 0.3);
    add_cube(&mut mesh, 1, |p| vec3(-0.4, -0.6, -0.3) + p * 0.4);
    mesh
}
