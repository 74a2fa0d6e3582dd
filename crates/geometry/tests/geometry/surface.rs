//! What is said of a point: worked by hand after pbrt-v4's definitions.

use sparrow_geometry::{BilinearMesh, Geometry, Ray, Shape, ShapeInstance, SurfacePoint, TriangleMesh};
use sparrow_math::{Transform, Vec3, vec3};

use super::{Rng, TAU, at, patches, placed, quadrics, sphere, triangles};

fn meet(shape: ShapeInstance, o: [f32; 3], d: [f32; 3]) -> SurfacePoint {
    let g = Geometry::build(vec![shape]);
    let ray = Ray::new(o.into(), d.into());
    g.surface(&ray, &g.intersect(&ray).unwrap())
}

/// Derivatives of the normal where the ray meets the shape.
fn bend(shape: ShapeInstance, o: [f32; 3], d: [f32; 3]) -> (Vec3<f32>, Vec3<f32>) {
    let g = Geometry::build(vec![shape]);
    let ray = Ray::new(o.into(), d.into());
    g.normal_derivatives(&ray, &g.intersect(&ray).unwrap())
}

fn close(a: Vec3<f32>, b: [f32; 3]) -> bool {
    (a - Vec3::from(b)).length() < 1e-5
}

fn unit_triangle() -> TriangleMesh {
    let p = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    TriangleMesh { p, indices: vec![[0, 1, 2]], ..Default::default() }
}

#[test]
fn triangles_without_attributes() {
    let s = meet(placed(Shape::Triangles(unit_triangle())), [0.25, 0.5, 1.0], [0.0, 0.0, -2.0]);
    assert!(close(s.p, [0.25, 0.5, 0.0]) && close(s.ng, [0.0, 0.0, 1.0]) && close(s.ns, [0.0, 0.0, 1.0]));
    // Corners (0,0), (1,0), (1,1) of the texture: u = b1 + b2, v = b2.
    assert!((s.uv[0] - 0.75).abs() < 1e-6 && (s.uv[1] - 0.5).abs() < 1e-6);
    assert!(
        close(s.dpdu, [1.0, 0.0, 0.0])
            && close(s.dpdv, [-1.0, 1.0, 0.0])
            && close(s.tangent, [1.0, 0.0, 0.0])
    );
    let mut flipped = placed(Shape::Triangles(unit_triangle()));
    flipped.flip_normal = true;
    let s = meet(flipped, [0.25, 0.5, 1.0], [0.0, 0.0, -2.0]);
    assert!(close(s.ng, [0.0, 0.0, -1.0]) && close(s.ns, [0.0, 0.0, -1.0]));
}

#[test]
fn triangles_with_normals_tangents_and_textures() {
    let mut mesh = unit_triangle();
    mesh.n = vec![[0.0, 0.0, -1.0], [0.6, 0.0, -0.8], [0.0, 0.0, -2.0]];
    mesh.s = vec![[0.0, 1.0, 0.3]; 3];
    mesh.uv = vec![[0.0, 0.0], [0.0, 2.0], [4.0, 0.0]];
    let s = meet(placed(Shape::Triangles(mesh.clone())), [0.5, 0.0, 1.0], [0.0, 0.0, -1.0]);
    assert!(close(s.ng, [0.0, 0.0, -1.0]), "on the side of the shading normals");
    assert!(close(s.ns, vec3(0.3, 0.0, -0.9).normalized().to_array()));
    assert!(s.tangent.dot(s.ns).abs() < 1e-6 && s.tangent.dot(vec3(0.0, 1.0, 0.3)) > 0.0);
    assert!(close(s.dpdu, [0.0, 0.25, 0.0]) && close(s.dpdv, [0.5, 0.0, 0.0]));
    let (dndu, dndv) = bend(placed(Shape::Triangles(mesh)), [0.5, 0.0, 1.0], [0.0, 0.0, -1.0]);
    assert!(close(dndv, [0.3, 0.0, 0.1]) && close(dndu, [0.0, 0.0, -0.25]));
    assert!((s.uv[0]).abs() < 1e-6 && (s.uv[1] - 1.0).abs() < 1e-6);
}

#[test]
fn degenerate_textures_still_give_a_frame() {
    let mut mesh = unit_triangle();
    mesh.uv = vec![[0.3, 0.3]; 3];
    let s = meet(placed(Shape::Triangles(mesh)), [0.25, 0.5, 1.0], [0.0, 0.0, -2.0]);
    assert!((s.dpdu.cross(s.dpdv).length() - 1.0).abs() < 1e-5 && s.dpdu.dot(s.ng).abs() < 1e-6);
}

/// A curved patch and both halves of a flat one: `u` runs from p00 to p10, `v` from p00 to p01.
#[test]
fn patch_parameters() {
    let flat = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [2.0, 3.0, 0.0]];
    let mut curved = flat;
    curved[3][2] = 0.5;
    for p in [flat, curved] {
        let mesh = BilinearMesh { p: p.to_vec(), indices: vec![[0, 1, 2, 3]], ..Default::default() };
        for (u, v) in [(0.8, 0.1), (0.1, 0.7), (0.5, 0.5)] {
            let s = meet(placed(Shape::Patches(mesh.clone())), [2.0 * u, 3.0 * v, 2.0], [0.0, 0.0, -1.0]);
            assert!((s.uv[0] - u).abs() < 1e-5 && (s.uv[1] - v).abs() < 1e-5, "{:?}", s.uv);
            assert!(close(s.p, [2.0 * u, 3.0 * v, p[3][2] * u * v]));
            assert!(close(s.dpdu, [2.0, 0.0, p[3][2] * v]) && close(s.dpdv, [0.0, 3.0, p[3][2] * u]));
            assert!(s.ng.z > 0.9);
        }
        let (mut with_n, mut turned) = (mesh.clone(), placed(Shape::Patches(mesh.clone())));
        with_n.n = vec![[0.0, 0.1, -1.0]; 4];
        let s = meet(placed(Shape::Patches(with_n)), [1.0, 1.0, 2.0], [0.0, 0.0, -1.0]);
        assert!(s.ng.z < 0.0 && s.tangent.dot(s.ns).abs() < 1e-5 && s.tangent.x > 1.0);
        turned.flip_normal = true;
        assert!(meet(turned, [1.0, 1.0, 2.0], [0.0, 0.0, -1.0]).ng.z < 0.0);
        let mut with_uv = mesh;
        with_uv.uv = vec![[0.0, 0.0], [4.0, 0.0], [0.0, 6.0], [4.0, 6.0]];
        let s = meet(placed(Shape::Patches(with_uv)), [1.0, 1.5, 2.0], [0.0, 0.0, -1.0]);
        assert!((s.uv[0] - 2.0).abs() < 1e-4 && (s.uv[1] - 3.0).abs() < 1e-4);
        assert!((s.dpdu.x - 0.5).abs() < 1e-5 && (s.dpdv.y - 0.5).abs() < 1e-5);
    }
}

#[test]
fn quadric_parameters() {
    // Azimuth from x towards y; the sphere's v runs from the lower to the upper pole.
    let s = meet(placed(sphere(2.0)), [0.0, 5.0, 0.0], [0.0, -1.0, 0.0]);
    assert!(close(s.p, [0.0, 2.0, 0.0]) && close(s.ng, [0.0, 1.0, 0.0]));
    assert!((s.uv[0] - 0.25).abs() < 1e-6 && (s.uv[1] - 0.5).abs() < 1e-6);
    assert!(close(s.dpdu, [-2.0 * TAU, 0.0, 0.0]) && close(s.dpdv, [0.0, 0.0, TAU]));
    let (dndu, dndv) = bend(placed(sphere(2.0)), [0.0, 5.0, 0.0], [0.0, -1.0, 0.0]);
    assert!(close(dndu, [-TAU, 0.0, 0.0]) && close(dndv, [0.0, 0.0, 0.5 * TAU]));
    let s = meet(placed(sphere(2.0)), [1.0, 0.0, 5.0], [0.0, 0.0, -1.0]);
    assert!(s.uv[1] > 0.8);
    // The disk's v runs from the rim inwards.
    let disk = Shape::Disk { height: 1.0, radius: 2.0, inner_radius: 1.0, phi_max: TAU };
    let s = meet(placed(disk), [-1.25, 0.0, 5.0], [0.0, 0.0, -1.0]);
    assert!(close(s.ng, [0.0, 0.0, 1.0]) && (s.uv[0] - 0.5).abs() < 1e-6 && (s.uv[1] - 0.75).abs() < 1e-6);
    assert!(close(s.dpdu, [0.0, -1.25 * TAU, 0.0]) && close(s.dpdv, [1.0, 0.0, 0.0]));
    let tube = Shape::Cylinder { radius: 1.0, z_min: -1.0, z_max: 3.0, phi_max: TAU };
    let s = meet(placed(tube.clone()), [0.0, -5.0, 0.0], [0.0, 1.0, 0.0]);
    assert!(close(s.ng, [0.0, -1.0, 0.0]) && (s.uv[0] - 0.75).abs() < 1e-6 && (s.uv[1] - 0.25).abs() < 1e-6);
    assert!(close(s.dpdv, [0.0, 0.0, 4.0]) && close(s.dpdu, [TAU, 0.0, 0.0]));
    let (dndu, dndv) = bend(placed(tube.clone()), [0.0, -5.0, 0.0], [0.0, 1.0, 0.0]);
    assert!(close(dndu, [TAU, 0.0, 0.0]) && close(dndv, [0.0; 3]));
    // A mirror that is not undone by `flip_normal` keeps normals outside; with it they turn in, as in pbrt-v4.
    let mirror = Transform::scale(vec3(1.0, 1.0, -1.0)).unwrap();
    let s = meet(at(tube, mirror), [0.0, -5.0, 0.0], [0.0, 1.0, 0.0]);
    assert!(close(s.ng, [0.0, 1.0, 0.0]));
}

/// The stated error holds: the exact point of the ray on the surface lies within it, or on the surface beside.
#[test]
fn points_lie_on_their_surfaces() {
    let mut rng = Rng(1);
    let mut shapes = quadrics(&mut rng, 1.0);
    shapes.extend([triangles(&mut rng, 60, 0.5), patches(&mut rng, 12, 0.7)]);
    let g = Geometry::build(shapes);
    let mut hits = 0;
    for _ in 0..4000 {
        let o = Vec3::from(rng.point()) * 3.0;
        let ray = Ray::new(o, Vec3::from(rng.point()) - o);
        let Some(hit) = g.intersect(&ray) else { continue };
        let s = g.surface(&ray, &hit);
        hits += 1;
        // From the offset point on its side a ray along the normal meets the surface at once, from the other it does not.
        let (above, below) = (s.spawn(s.ng), s.spawn(-s.ng));
        assert!((above.o - s.p).dot(s.ng) > 0.0 && (below.o - s.p).dot(s.ng) < 0.0);
        assert!((above.o - s.p).length() < 2e-5, "{s:?}");
        let back = Ray { o: above.o, d: below.o - above.o, t_max: 1.0, time: 0.0 };
        assert!(g.occluded(&back), "the surface lies between: {s:?}");
        assert!((s.ns.length() - 1.0).abs() < 1e-5 && s.dpdu.is_finite());
        let (dndu, dndv) = g.normal_derivatives(&ray, &hit);
        assert!(dndu.is_finite() && dndv.is_finite());
        assert!(s.uv.iter().all(|u| (-1e-5..=1.000_01).contains(u)), "{:?}", s.uv);
    }
    assert!(hits > 1500);
}
