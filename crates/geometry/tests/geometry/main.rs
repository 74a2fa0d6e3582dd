//! Geometry against slow, plain twins of itself.
#![allow(clippy::unwrap_used, reason = "tests stop where something is missing")]

mod build;
mod columns;
mod curves;
mod deforming;
mod exact;
mod instances;
mod many;
mod rays;
mod sampling;
mod spawn;
mod surface;
mod twin;

use sparrow_geometry::{BilinearMesh, Shape, ShapeInstance, TriangleMesh};
use sparrow_math::{Transform, Vec3, vec3, warp};

pub(crate) const TAU: f32 = core::f32::consts::TAU;

/// Uniform numbers in [0, 1). [Steele2014]
pub(crate) struct Rng(pub(crate) u64);

impl Rng {
    pub(crate) fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u32 << 24) as f32
    }
    pub(crate) fn pair(&mut self) -> [f32; 2] {
        [self.next(), self.next()]
    }
    pub(crate) fn between(&mut self, lo: f32, hi: f32) -> f32 {
        lo + (hi - lo) * self.next()
    }
    pub(crate) fn point(&mut self) -> [f32; 3] {
        [self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0)]
    }
    pub(crate) fn direction(&mut self) -> Vec3<f32> {
        warp::uniform_sphere(self.pair())
    }
}

pub(crate) fn placed(shape: Shape) -> ShapeInstance {
    at(shape, Transform::IDENTITY)
}

pub(crate) fn at(shape: Shape, to_world: Transform) -> ShapeInstance {
    ShapeInstance { shape, flip_normal: to_world.swaps_handedness(), to_world }
}

/// `n` loose triangles with edges of about `size`.
pub(crate) fn triangles(rng: &mut Rng, n: u32, size: f32) -> ShapeInstance {
    let mut mesh = TriangleMesh::default();
    for i in 0..n {
        let c = rng.point();
        for _ in 0..3 {
            let d = rng.point();
            mesh.p.push([c[0] + size * d[0], c[1] + size * d[1], c[2] + size * d[2]]);
        }
        mesh.indices.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    placed(Shape::Triangles(mesh))
}

/// `n` loose patches: every third curved, a parallelogram, a rectangle.
pub(crate) fn patches(rng: &mut Rng, n: u32, size: f32) -> ShapeInstance {
    let mut mesh = BilinearMesh::default();
    for i in 0..n {
        let c = Vec3::from(rng.point());
        let (e, mut f) = (rng.direction() * size, rng.direction() * size);
        if i % 3 == 2 {
            f = e.cross(rng.direction());
        }
        let mut p = [c, c + e, c + f, c + e + f];
        if i % 3 == 0 {
            p[3] += rng.direction() * (0.7 * size);
        }
        mesh.p.extend(p.map(Vec3::to_array));
        mesh.indices.push([4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3]);
    }
    placed(Shape::Patches(mesh))
}

pub(crate) fn sphere(radius: f32) -> Shape {
    Shape::Sphere { radius, z_min: -radius, z_max: radius, phi_max: TAU }
}

/// One quadric of each sort, whole and cut, moved, turned, stretched and mirrored.
pub(crate) fn quadrics(rng: &mut Rng, scale: f32) -> Vec<ShapeInstance> {
    let r = scale * rng.between(0.2, 0.4);
    let shapes = [
        sphere(r),
        Shape::Sphere { radius: r, z_min: -0.4 * r, z_max: 0.7 * r, phi_max: 4.0 },
        Shape::Disk { height: 0.1 * r, radius: r, inner_radius: 0.0, phi_max: TAU },
        Shape::Disk { height: 0.0, radius: r, inner_radius: 0.4 * r, phi_max: 2.5 },
        Shape::Cylinder { radius: r, z_min: -r, z_max: 1.5 * r, phi_max: TAU },
        Shape::Cylinder { radius: r, z_min: -0.3 * r, z_max: r, phi_max: 3.5 },
    ];
    let mut out = Vec::new();
    for stretched in [false, true] {
        for shape in &shapes {
            let turn =
                Transform::rotate(f64::from(rng.between(0.0, 360.0)), rng.direction().to_f64()).unwrap();
            let stretch = if stretched { vec3(0.7, -1.2, 1.6) } else { vec3(1.3, 1.3, 1.3) };
            let place = Transform::translate(Vec3::from(rng.point()).to_f64());
            let t = place.then_first(&turn.then_first(&Transform::scale(stretch).unwrap()));
            out.push(at(shape.clone(), t));
        }
    }
    out
}
