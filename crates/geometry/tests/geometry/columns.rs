//! Surface points in columns are those of the hits one by one, to the bit.

use sparrow_geometry::{
    CurveBasis, CurveKind, Geometry, GeometryParts, Hit, Instance, MovingInstance, Ray, Shape, ShapeInstance,
    SurfaceColumns, SurfaceParts, SurfacePoint,
};
use sparrow_math::{MAX_WIDTH, Motion, Transform, Vec3, vec3};

use super::deforming::{curves, mesh, patches, still};
use super::{Rng, at, quadrics, sphere, triangles};

const PARTS: [SurfaceParts; 4] = [
    SurfaceParts { uv: false, derivatives: false },
    SurfaceParts { uv: true, derivatives: false },
    SurfaceParts { uv: false, derivatives: true },
    SurfaceParts { uv: true, derivatives: true },
];

/// What no column is given.
const UNTOUCHED: f32 = 1234.5;

/// A mesh without some of what its corners may carry.
fn without(s: &ShapeInstance, part: usize) -> ShapeInstance {
    let Shape::Triangles(mut m) = s.shape.clone() else { unreachable!() };
    match part {
        0 => m.n = Vec::new(),
        1 => m.s = Vec::new(),
        2 => m.uv = Vec::new(),
        _ => (m.n, m.s) = (Vec::new(), Vec::new()),
    }
    ShapeInstance { shape: Shape::Triangles(m), flip_normal: part % 2 == 1, ..s.clone() }
}

/// Shapes of every sort: standing and deforming, whole balls far and near, moved, turned and mirrored.
fn shapes(rng: &mut Rng) -> Vec<ShapeInstance> {
    let (moving, folded) = (mesh(rng, 40), patches(rng, 12));
    let standing = still(&moving, 0.0);
    let mut all = vec![triangles(rng, 40, 0.3), super::patches(rng, 12, 0.4), still(&folded, 0.0), folded];
    all.extend((0..4).map(|part| without(&standing, part)));
    all.extend([standing, moving]);
    if let Shape::Patches(m) = &mut all[1].shape {
        m.uv = m.p.iter().map(|_| rng.pair()).collect();
    }
    all.push(super::patches(rng, 12, 0.4));
    for kind in [CurveKind::Flat, CurveKind::Cylinder, CurveKind::Ribbon, CurveKind::Round] {
        let strands = curves(rng, kind, CurveBasis::BSpline);
        all.extend([still(&strands, 0.0), strands]);
    }
    all.extend(quadrics(rng, 1.0));
    let turn = Transform::rotate(40.0, vec3(1.0, 2.0, -0.5)).unwrap();
    let mirror = Transform::scale(vec3(-1.0, 1.0, 1.0)).unwrap();
    all.push(at(sphere(0.4), Transform::translate(vec3(0.3, -0.2, 0.1)).then_first(&turn)));
    all.push(at(sphere(0.3), turn.then_first(&mirror)));
    all.push(at(sphere(0.2), Transform::translate(vec3(0.0, 0.0, 1.9))));
    all.push(at(sphere(2e-3), Transform::translate(vec3(900.0, 0.0, 0.0))));
    all
}

fn geometry(rng: &mut Rng) -> Geometry {
    let shapes = shapes(rng);
    let to_world = [[0.5, 0.1, 0.0, 0.2], [0.0, -0.4, 0.0, 0.3], [0.0, 0.1, 0.6, 0.1]];
    let ends = [vec3(-0.4, 0.1, 0.0), vec3(-0.2, -0.5, 0.3)].map(Transform::translate);
    Geometry::build_observed(
        GeometryParts {
            prototypes: vec![shapes.clone()],
            shapes,
            instances: vec![Instance { to_world, prototype: 0 }],
            moving: vec![MovingInstance { motion: Motion::new(&ends[0], &ends[1]).unwrap(), prototype: 0 }],
        },
        None,
    )
}

/// At the shapes, at the one that is far, and at the pole of a ball.
fn rays(rng: &mut Rng, n: usize) -> Vec<Ray> {
    let one = |i: usize| {
        let (o, p) = (Vec3::from(rng.point()) * 2.0, Vec3::from(rng.point()));
        let time = if i.is_multiple_of(2) { rng.next() } else { 0.0 };
        let d = match i % 9 {
            0 => vec3(900.0, 0.0, 0.0) + p * 2e-3 - o,
            1 if i.is_multiple_of(4) => return Ray::new(vec3(0.0, 0.0, 3.0), vec3(0.0, 0.0, -1.0)),
            _ => p - o,
        };
        Ray { time, ..Ray::new(o, d) }
    };
    (0..n).map(one).collect()
}

/// The numbers of a point in the order of the columns, those not asked for as they were.
fn numbers(s: &SurfacePoint, parts: SurfaceParts) -> [u32; 23] {
    let mut all = [UNTOUCHED; 23];
    let asked = |on: bool, v: Vec3<f32>| if on { v.to_array() } else { [UNTOUCHED; 3] };
    let vectors = [s.p, s.p_error, s.ng, s.ns, s.tangent].map(Vec3::to_array);
    all[..15].copy_from_slice(vectors.as_flattened());
    all[15..18].copy_from_slice(&asked(parts.derivatives, s.dpdu));
    all[18..21].copy_from_slice(&asked(parts.derivatives, s.dpdv));
    all[21..].copy_from_slice(&if parts.uv { s.uv } else { [UNTOUCHED; 2] });
    all.map(f32::to_bits)
}

/// Asks for the hits numbered `which`, and compares.
fn compare(g: &Geometry, rays: &[Ray], hits: &[Option<Hit>], which: &[u32], parts: SurfaceParts) {
    let len = which.len().next_multiple_of(MAX_WIDTH);
    let mut room = vec![UNTOUCHED; 23 * len];
    let mut columns = room.chunks_mut(len.max(1));
    let mut next = || columns.next().unwrap_or_default();
    let mut out = SurfaceColumns {
        p: [next(), next(), next()],
        p_error: [next(), next(), next()],
        ng: [next(), next(), next()],
        ns: [next(), next(), next()],
        tangent: [next(), next(), next()],
        dpdu: [next(), next(), next()],
        dpdv: [next(), next(), next()],
        uv: [next(), next()],
    };
    g.surface_many(rays, hits, which, parts, &mut out);
    for (k, &i) in which.iter().enumerate() {
        let (ray, hit) = (&rays[i as usize], hits[i as usize].unwrap());
        let s = g.surface(ray, &hit);
        let found: Vec<u32> = (0..23).map(|c| room[c * len + k].to_bits()).collect();
        assert_eq!(found, numbers(&s, parts), "{parts:?} {ray:?} {hit:?} {s:?}");
    }
}

#[test]
fn columns_hold_what_hits_give_one_by_one() {
    let mut rng = Rng(91);
    let g = geometry(&mut rng);
    let rays = rays(&mut rng, 12_000);
    let mut hits = vec![None; rays.len()];
    g.intersect_many(&rays, &mut hits);
    let met: Vec<u32> = (0..rays.len() as u32).filter(|&i| hits[i as usize].is_some()).collect();
    let shape = |i: u32| hits[i as usize].map_or(0, |h| h.shape);
    let mut by_shape = met.clone();
    by_shape.sort_by_key(|&i| shape(i));
    by_shape.dedup_by_key(|i| shape(*i));
    assert!(met.len() > 5000 && by_shape.len() * 20 > g.n_shapes() * 19, "{} {}", met.len(), by_shape.len());
    // As rays come, those of a shape together, and in short lists.
    let mut together = met.clone();
    together.sort_by_key(|&i| shape(i));
    for parts in PARTS {
        met.chunks(256).for_each(|which| compare(&g, &rays, &hits, which, parts));
        together.chunks(250).for_each(|which| compare(&g, &rays, &hits, which, parts));
        together.chunks(5).take(400).for_each(|which| compare(&g, &rays, &hits, which, parts));
    }
    compare(&g, &rays, &hits, &[], PARTS[3]);
}
