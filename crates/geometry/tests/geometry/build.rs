//! Trees over odd inputs, and over the same input.

use sparrow_geometry::{
    BilinearMesh, BuildProgress, CurveBasis, CurveSet, Geometry, GeometryParts, Hit, Ray, Shape,
    ShapeInstance, TriangleMesh,
};
use sparrow_math::{Transform, Vec3, vec3};

use super::{Rng, at, patches, placed, quadrics, triangles};

fn mesh(p: Vec<[f32; 3]>, indices: Vec<[u32; 3]>) -> ShapeInstance {
    placed(Shape::Triangles(TriangleMesh { p, indices, ..Default::default() }))
}

fn shoot(g: &Geometry) -> Vec<Option<Hit>> {
    let mut rng = Rng(99);
    let mut ray = || {
        let o = Vec3::from(rng.point()) * 3.0;
        Ray::new(o, Vec3::from(rng.point()) - o)
    };
    (0..500).map(|_| g.intersect(&ray())).collect()
}

#[test]
fn nothing_to_hit() {
    for shapes in [vec![], vec![mesh(vec![], vec![])], vec![mesh(vec![[0.0; 3]; 3], vec![[0, 1, 2]; 10])]] {
        let g = Geometry::build(shapes);
        assert!(shoot(&g).iter().all(Option::is_none));
        assert!(g.bounds().is_empty());
        assert_eq!((g.stats().primitives, g.stats().nodes), (0, 0));
        assert!(g.area(0, 0) <= 0.0);
        assert!(g.sample_from(0, 0, vec3(0.0, 0.0, 1.0), [0.5; 2]).is_none());
        assert!(g.sample_area(7, 3, [0.5; 2]).is_none());
    }
}

#[test]
fn odd_triangles_are_dropped_and_counted() {
    let p = vec![
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [f32::NAN, 0.0, 0.0],
        [0.0, f32::INFINITY, 0.0],
        [2.0, 0.0, 0.0],
        [3e38, 3e38, -3e38],
    ];
    let indices =
        vec![[0, 1, 3], [0, 1, 4], [0, 1, 5], [0, 0, 1], [0, 1, 99], [0, 1, 2], [u32::MAX, 1, 2], [0, 6, 6]];
    let g = Geometry::build(vec![mesh(p, indices)]);
    assert_eq!((g.stats().primitives, g.stats().dropped, g.n_prims(0)), (1, 7, 8));
    let hit = g.intersect(&Ray::new(vec3(0.2, 0.2, 1.0), vec3(0.0, 0.0, -1.0))).unwrap();
    assert_eq!((hit.shape, hit.prim, hit.t), (0, 5, 1.0));
    assert_eq!((g.area(0, 5), g.area(0, 2)), (0.5, 0.0));
}

#[test]
fn odd_patches_and_quadrics_are_dropped() {
    let p = vec![
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [0.0, f32::NAN, 0.0],
        [1.0, 1.0, 0.0],
    ];
    let flat =
        BilinearMesh { p, indices: vec![[0, 1, 2, 3], [0, 1, 4, 5], [0, 1, 2, 77]], ..Default::default() };
    let shapes = vec![
        placed(Shape::Patches(flat)),
        placed(super::sphere(0.0)),
        placed(super::sphere(f32::NAN)),
        placed(super::sphere(f32::INFINITY)),
        placed(Shape::Disk { height: 0.0, radius: 1.0, inner_radius: 1.0, phi_max: 1.0 }),
        placed(Shape::Cylinder { radius: 1.0, z_min: 1.0, z_max: 1.0, phi_max: 1.0 }),
        placed(Shape::Cylinder { radius: 1.0, z_min: 0.0, z_max: 1.0, phi_max: 0.0 }),
        at(super::sphere(1e38), Transform::translate(vec3(3e38, 0.0, 0.0))),
    ];
    let n = shapes.len();
    let g = Geometry::build(shapes);
    assert_eq!(g.n_shapes(), n);
    assert_eq!(g.stats().primitives, 0);
    assert_eq!(g.stats().dropped, n + 2);
    assert!(shoot(&g).iter().all(Option::is_none));
}

/// A thousand triangles in one place, and a thousand whose boxes nest: no cut is any good.
#[test]
fn boxes_that_cannot_be_told_apart() {
    let p = vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let g = Geometry::build(vec![mesh(p, vec![[0, 1, 2]; 1000])]);
    assert_eq!(g.stats().primitives, 1000);
    assert!(g.occluded(&Ray::new(vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -1.0))));
    let (mut p, mut indices) = (Vec::new(), Vec::new());
    for i in 0..1000_u32 {
        let s = (1.0_f64 + f64::from(i)).sqrt() as f32;
        p.extend([[-s, -s, 0.0], [s, -s, 0.0], [0.0, s, s]]);
        indices.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let g = Geometry::build(vec![mesh(p, indices)]);
    assert!(g.occluded(&Ray::new(vec3(0.0, 0.0, 9.0), vec3(0.0, 0.0, -1.0))));
}

/// Sizes over seventy powers of two make the tree as deep as it gets; rays still find the smallest.
#[test]
fn deep_trees_are_walked_to_the_end() {
    let (mut p, mut indices) = (Vec::new(), Vec::new());
    let mut s = 1e-12_f32;
    for i in 0..400_u32 {
        let x = 3.0 * s;
        p.extend([[x, -s, 0.0], [x, s, 0.0], [x, 0.0, s]]);
        indices.push([3 * i, 3 * i + 1, 3 * i + 2]);
        s *= 1.15;
    }
    let g = Geometry::build(vec![mesh(p, indices)]);
    assert_eq!(g.stats().primitives, 400);
    // It starts close by: from afar many of the triangles lie at the same distance, to the last bit.
    let hit = g.intersect(&Ray::new(vec3(0.0, 0.0, 1e-13), vec3(1.0, 0.0, 0.0))).unwrap();
    assert_eq!(hit.prim, 0);
}

#[test]
fn rays_without_meaning_find_nothing_and_end() {
    let mut rng = Rng(3);
    let g = Geometry::build(vec![
        triangles(&mut rng, 500, 0.3),
        patches(&mut rng, 9, 0.5),
        quadrics(&mut rng, 1.0).remove(0),
    ]);
    let (o, d) = (vec3(0.1, 0.2, 3.0), vec3(0.0, 0.0, -1.0));
    let bad = [f32::NAN, f32::INFINITY];
    for b in bad {
        assert!(g.intersect(&Ray::new(vec3(b, 0.0, 0.0), d)).is_none());
        assert!(g.intersect(&Ray::new(o, vec3(0.0, b, 0.0))).is_none());
    }
    assert!(g.intersect(&Ray::new(o, Vec3::splat(0.0))).is_none());
    for t_max in [0.0, -1.0, f32::NAN, f32::NEG_INFINITY] {
        assert!(!g.occluded(&Ray { o, d, t_max, time: 0.0 }));
    }
}

/// The same bits from one thread and from several.
#[test]
fn threads_do_not_matter() {
    let make = || {
        let mut rng = Rng(8);
        let mut shapes = vec![triangles(&mut rng, 40_000, 0.03), patches(&mut rng, 3000, 0.05)];
        shapes.extend(quadrics(&mut rng, 0.4));
        shapes
    };
    let built = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let g = pool.install(|| Geometry::build(make()));
        let shown = format!("{g:?}");
        // Only the clock may differ.
        let from = shown.find("build_seconds").unwrap();
        (shown[..from].to_owned(), shoot(&g))
    };
    let (one, two) = (built(1), built(2));
    assert_eq!(one.1, two.1);
    assert!(one.1.iter().flatten().count() > 50);
    assert!(one.0 == two.0, "the trees differ");
}

/// An observer hears of everything, of nothing twice, and changes nothing.
#[test]
fn builds_tell_how_far_they_are() {
    let make = || {
        let mut rng = Rng(9);
        let points: Vec<[f32; 4]> = (0..20_000)
            .map(|_| {
                let [x, y, z] = rng.point();
                [x, y, z, 0.001]
            })
            .collect();
        let strands = (0..1000).map(|i| i * 20).collect();
        let curves = CurveSet { points, strands, basis: CurveBasis::BSpline, ..CurveSet::default() };
        let shapes = vec![triangles(&mut rng, 40_000, 0.03), placed(Shape::Curves(curves))];
        GeometryParts { shapes, ..GeometryParts::default() }
    };
    let heard = std::sync::Mutex::new(Vec::new());
    let told = |p: BuildProgress| heard.lock().unwrap().push((p.placed, p.total));
    let g = Geometry::build_observed(make(), Some(&told));
    let mut heard = heard.into_inner().unwrap();
    let total = heard[0].1;
    assert_eq!(heard.last(), Some(&(total, total)));
    assert!(
        heard.len() > 10 && heard.iter().all(|&(placed, all)| placed <= all && all == total),
        "{heard:?}"
    );
    // Strands have fewer segments than points; the estimate is near.
    heard.pop();
    let most = heard.iter().map(|h| h.0).max().unwrap();
    assert!(most * 10 > total * 9, "{most} of {total}");
    let silent = Geometry::build_observed(make(), None);
    assert_eq!(shoot(&g), shoot(&silent));
    let bytes = g.stats().bytes;
    assert!(
        bytes.triangles >= 40_000 * 48 && bytes.curves >= 20_000 * 16 && bytes.hierarchy > 0,
        "{bytes:?}"
    );
    assert_eq!((bytes, bytes.patches + bytes.quadrics + bytes.instances), (silent.stats().bytes, 0));
}
