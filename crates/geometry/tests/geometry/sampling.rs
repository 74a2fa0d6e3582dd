//! Densities of drawn directions.

use sparrow_geometry::{
    BilinearMesh, Geometry, PdfColumns, Ray, SampleColumns, Shape, ShapeInstance, ShapeSample, TriangleMesh,
    Viewpoint,
};
use sparrow_math::{Transform, Vec3, vec3};

use super::{Rng, at, placed, quadrics};

fn triangle(p: [[f32; 3]; 3]) -> ShapeInstance {
    placed(Shape::Triangles(TriangleMesh { p: p.to_vec(), indices: vec![[0, 1, 2]], ..Default::default() }))
}

fn patch(p: [[f32; 3]; 4]) -> ShapeInstance {
    placed(Shape::Patches(BilinearMesh { p: p.to_vec(), indices: vec![[0, 1, 2, 3]], ..Default::default() }))
}

/// Draws points as seen from `from` and asks: is the density the one `pdf_from` says, for what the ray meets too?
/// Returns the mean of `1 / pdf` over the samples that are not hidden by the shape itself.
fn check(g: &Geometry, from: Vec3<f32>, rng: &mut Rng, n: u32, what: &str) -> f64 {
    let mut sum = 0.0;
    for _ in 0..n {
        let Some(s) = g.sample_from(0, 0, from, rng.pair()) else { continue };
        assert!(s.pdf > 0.0 && s.pdf.is_finite() && (s.wi.length() - 1.0).abs() < 1e-5, "{what}: {s:?}");
        assert!((s.n.length() - 1.0).abs() < 1e-5, "{what}: {s:?}");
        let along = from + s.wi * s.distance - s.p;
        assert!(along.length() <= 1e-5 * (s.distance + s.p.length() + from.length()), "{what}: {s:?}");
        let again = g.pdf_from(0, 0, from, s.p, s.n);
        assert!((again / s.pdf - 1.0).abs() < 2e-4, "{what}: {} drawn, {again} said", s.pdf);
        let ray = Ray::new(from, s.wi);
        let Some(hit) = g.intersect(&ray) else { continue };
        if (hit.t / s.distance - 1.0).abs() < 1e-3 {
            sum += 1.0 / f64::from(s.pdf);
            let p = g.surface(&ray, &hit);
            assert!((p.p - s.p).length() < 2e-3 * s.distance, "{what}: {p:?} {s:?}");
            let side = p.ng.dot(s.n);
            assert!(side > 0.9, "{what}: normals {:?} and {:?}", p.ng, s.n);
            if p.ng.dot(s.wi).abs() > 0.05 {
                let met = g.pdf_from(0, 0, from, p.p, p.ng);
                assert!((met / s.pdf - 1.0).abs() < 0.02, "{what}: {} drawn, {met} met", s.pdf);
            }
        }
    }
    sum / f64::from(n)
}

/// The solid angle of everything, by rays in uniform directions within a cone about `axis`.
fn solid_angle(
    g: &Geometry,
    from: Vec3<f32>,
    axis: Vec3<f32>,
    one_minus_cos: f32,
    rng: &mut Rng,
    n: u32,
) -> f64 {
    let frame = sparrow_math::Frame::from_z(axis.normalized());
    let hits = (0..n).filter(|_| {
        let d = sparrow_math::warp::uniform_cone(rng.pair(), one_minus_cos);
        g.occluded(&Ray::new(from, frame.to_world(sparrow_math::LocalDir::new(d))))
    });
    2.0 * core::f64::consts::PI * f64::from(one_minus_cos) * hits.count() as f64 / f64::from(n)
}

fn shapes(rng: &mut Rng) -> Vec<ShapeInstance> {
    let mut all = vec![
        triangle([[-0.4, -0.3, 0.1], [0.5, -0.2, 0.0], [0.0, 0.6, -0.1]]),
        triangle([[-3.0, -2.0, 0.3], [3.0, -2.5, 0.1], [0.0, 4.0, 0.0]]),
        patch([[-0.5, -0.4, 0.0], [0.5, -0.4, 0.0], [-0.5, 0.4, 0.0], [0.5, 0.4, 0.0]]),
        patch([[-0.5, -0.4, 0.0], [0.5, -0.3, 0.1], [-0.3, 0.4, 0.0], [0.7, 0.5, 0.1]]),
        patch([[-0.5, -0.4, 0.3], [0.5, -0.4, -0.2], [-0.5, 0.4, 0.0], [0.5, 0.6, 0.4]]),
    ];
    all.extend(quadrics(rng, 1.5).into_iter().map(|mut s| {
        let m = s.to_world.rows();
        let back = Transform::translate(vec3(-m[0][3], -m[1][3], -m[2][3]));
        s.to_world = back.then_first(&s.to_world);
        s
    }));
    all
}

#[test]
fn drawn_and_said_densities_agree_and_integrate() {
    let mut rng = Rng(1);
    for (i, shape) in shapes(&mut rng).into_iter().enumerate() {
        let g = Geometry::build(vec![shape]);
        for (j, from) in [[0.3, 0.4, 2.0], [-1.5, 0.9, 1.2], [0.5, -3.0, -0.7]].into_iter().enumerate() {
            let from = Vec3::from(from);
            let what = format!("shape {i} from {j}");
            let mean = check(&g, from, &mut rng, 20_000, &what);
            let truth = solid_angle(&g, from, -from, 0.9, &mut rng, 250_000);
            assert!((mean - truth).abs() < 0.04 * truth + 0.004, "{what}: mean {mean}, solid angle {truth}");
        }
    }
}

/// Cones around balls: half of all directions nearly, a hundredth, a millionth of a millionth; and from inside.
#[test]
fn balls_near_and_far() {
    let mut rng = Rng(2);
    for scale in [1.0, 0.25] {
        let place = Transform::scale(vec3(scale, scale, -scale)).unwrap();
        let radius = 2.0 * scale as f32;
        let g = Geometry::build(vec![at(super::sphere(2.0), place)]);
        for ratio in [1.000_01, 1.1, 3.0, 1e3, 1e6] {
            let from = rng.direction() * (radius * ratio);
            let sin2 = 1.0 / f64::from(ratio).powi(2);
            let truth = 2.0 * core::f64::consts::PI * sin2 / (1.0 + (1.0 - sin2).sqrt());
            let mean = (0..200).map(|_| {
                let s = g.sample_from(0, 0, from, rng.pair()).unwrap();
                assert!(
                    s.wi.dot(s.n) * if place.swaps_handedness() { -1.0 } else { 1.0 } <= 1e-3,
                    "faces away"
                );
                1.0 / f64::from(s.pdf)
            });
            let mean = mean.sum::<f64>() / 200.0;
            assert!((mean / truth - 1.0).abs() < 2e-3, "{ratio}: {mean} for {truth}");
        }
        for inside in [0.0, 0.3, 0.999] {
            let from = rng.direction() * (radius * inside);
            let mean = check(&g, from, &mut rng, 500, "inside");
            assert!((mean / (4.0 * core::f64::consts::PI) - 1.0).abs() < 0.02, "{inside}: {mean}");
        }
    }
}

/// Uniform over the sphere means: equal parts of the unit square fill equal solid angles.
#[test]
fn triangles_and_rectangles_are_drawn_uniformly() {
    let mut rng = Rng(3);
    let lights = [
        triangle([[-0.6, -0.5, 1.0], [0.9, -0.4, 1.2], [0.1, 0.8, 0.9]]),
        patch([[-0.6, -0.5, 1.0], [0.9, -0.5, 1.0], [-0.6, 0.7, 1.0], [0.9, 0.7, 1.0]]),
    ];
    for light in lights {
        let g = Geometry::build(vec![light]);
        // A direction's mean over uniform samples against the mean over rays that happen to hit.
        let from = vec3(0.2, -0.3, 0.1);
        let (mut drawn, mut met, mut n_met) = (Vec3::splat(0.0), Vec3::splat(0.0), 0.0);
        let n = 40_000;
        for _ in 0..n {
            drawn += g.sample_from(0, 0, from, rng.pair()).unwrap().wi * (1.0 / n as f32);
        }
        while n_met < 40_000.0 {
            let d = rng.direction();
            if g.occluded(&Ray::new(from, d)) {
                met += d;
                n_met += 1.0;
            }
        }
        let off = (drawn - met * (1.0 / n_met)).length();
        assert!(off < 0.008, "{off}");
    }
}

/// Directions to large lights follow the cosine: densities are as said, integrate to one, and leave less variance.
#[test]
fn cosines_are_followed() {
    let mut rng = Rng(6);
    let lights = [
        triangle([[-2.6, -1.5, 1.0], [0.9, -1.4, 1.2], [0.1, 1.8, 0.9]]),
        triangle([[-30.0, -25.0, 0.3], [30.0, -24.0, 0.3], [0.0, 50.0, 0.3]]),
        patch([[-0.6, -0.5, 1.0], [0.9, -0.5, 1.0], [-0.6, 0.7, 1.0], [0.9, 0.7, 1.0]]),
        patch([[-5.0, -0.5, 0.4], [9.0, -0.5, 0.4], [-5.0, 3.7, 0.4], [9.0, 3.7, 0.4]]),
    ];
    for (i, light) in lights.into_iter().enumerate() {
        let g = Geometry::build(vec![light]);
        for n in [vec3(0.0, 0.0, 1.0), vec3(0.8, 0.6, 0.0), vec3(-0.6, 0.0, 0.8), vec3(0.0, 0.28, -0.96)] {
            let p = vec3(0.2, -0.3, 0.1);
            let from = Viewpoint { p, n: Some(n) };
            // Of the cosine and of one, over what is drawn; with the density said for what a ray meets.
            let (mut warped, mut plain, mut whole) = ([0.0; 2], [0.0; 2], 0.0);
            let samples = 40_000;
            for _ in 0..samples {
                let u = rng.pair();
                let s = g.sample_from(0, 0, from, u).unwrap();
                let said = g.pdf_from(0, 0, from, s.p, s.n);
                assert!((said / s.pdf - 1.0).abs() < 2e-3, "light {i}: {} drawn, {said} said", s.pdf);
                let even = g.sample_from(0, 0, p, u).unwrap();
                whole += f64::from(even.pdf / s.pdf) / f64::from(samples);
                for (sums, s) in [(&mut warped, &s), (&mut plain, &even)] {
                    let x = f64::from(s.wi.dot(n).abs() / s.pdf);
                    sums[0] += x / f64::from(samples);
                    sums[1] += x * x / f64::from(samples);
                }
            }
            // Three standard deviations of these means are below 2 %.
            assert!((whole - 1.0).abs() < 0.02, "light {i}, {n:?}: integrates to {whole}");
            assert!((warped[0] / plain[0] - 1.0).abs() < 0.02, "light {i}, {n:?}: {warped:?}, {plain:?}");
            let variance = |s: [f64; 2]| s[1] - s[0] * s[0];
            assert!(variance(warped) < 1.1 * variance(plain), "light {i}, {n:?}: {warped:?}, {plain:?}");
        }
    }
}

/// In the plane of a light, at its corners, on its surface: nothing, or numbers that make sense.
#[test]
fn awkward_observers() {
    let mut rng = Rng(4);
    for shape in shapes(&mut rng) {
        let g = Geometry::build(vec![shape]);
        let mut spots =
            vec![vec3(-0.4, -0.3, 0.1), vec3(5.0, -0.4, 0.0), Vec3::splat(0.0), vec3(1e20, 0.0, 0.0)];
        spots.extend((0..20).map(|_| g.sample_area(0, 0, rng.pair()).unwrap().p));
        for from in spots {
            for u in
                [[0.0, 0.0], [0.0, 0.999_999_9], [0.999_999_9, 0.0], [0.999_999_9, 0.999_999_9], rng.pair()]
            {
                if let Some(s) = g.sample_from(0, 0, from, u) {
                    assert!(
                        s.pdf >= 0.0 && s.pdf.is_finite() && s.wi.is_finite() && s.p.is_finite(),
                        "{s:?}"
                    );
                    let again = g.pdf_from(0, 0, from, s.p, s.n);
                    assert!(again >= 0.0 && again.is_finite(), "{again}");
                }
            }
        }
    }
}

/// The mean of one over the density per area is the area.
#[test]
fn areas() {
    let mut rng = Rng(5);
    for (i, shape) in shapes(&mut rng).into_iter().enumerate() {
        let g = Geometry::build(vec![shape]);
        let n = 4000;
        let mean = (0..n).map(|_| 1.0 / f64::from(g.sample_area(0, 0, rng.pair()).unwrap().pdf)).sum::<f64>()
            / f64::from(n);
        assert!(
            (mean / f64::from(g.area(0, 0)) - 1.0).abs() < 0.02,
            "shape {i}: {mean} for {}",
            g.area(0, 0)
        );
    }
    let g = Geometry::build(vec![
        placed(super::sphere(2.0)),
        patch([[0.0; 3], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [2.0, 3.0, 0.0]]),
    ]);
    assert!((g.area(0, 0) / (16.0 * core::f32::consts::PI) - 1.0).abs() < 1e-6);
    assert!((g.area(1, 0) - 6.0).abs() < 1e-5);
}

fn bits(s: &ShapeSample) -> Vec<u32> {
    let vectors = [s.p, s.p_error, s.n, s.wi].into_iter().flat_map(Vec3::to_array);
    vectors.chain([s.distance, s.pdf]).map(f32::to_bits).collect()
}

/// Lanes tell the densities that are told one by one: seen from points with normals, of points with normals.
fn assert_same_densities(g: &Geometry, from: [[&[f32]; 3]; 2], on: [[&[f32]; 3]; 2], n: usize) {
    let mut pdf = [0.0; 32];
    let mut columns = PdfColumns { from: from[0], n: from[1], p: on[0], pdf: &mut pdf };
    assert!(g.pdf_from_many(0, 0, &mut columns, n));
    let vector = |c: [&[f32]; 3], k: usize| vec3(c[0][k], c[1][k], c[2][k]);
    for (k, many) in pdf[..n].iter().enumerate() {
        let viewpoint = Viewpoint { p: vector(from[0], k), n: Some(vector(from[1], k)) };
        let one = g.pdf_from(0, 0, viewpoint, vector(on[0], k), vector(on[1], k));
        assert_eq!(many.to_bits(), one.to_bits(), "from {viewpoint:?}: {many}, {one}");
    }
}

/// Rectangles, with and without normals, and balls, seen from afar, from close by, from their plane and from inside: lanes draw
/// what is drawn one by one.
#[test]
fn lanes_draw_what_is_drawn_one_by_one() {
    const N: usize = 23;
    let mut rng = Rng(11);
    let flat = [[-0.5, -0.4, 0.0], [0.5, -0.4, 0.0], [-0.5, 0.4, 0.0], [0.5, 0.4, 0.0]];
    let shaded = BilinearMesh {
        p: flat.to_vec(),
        n: vec![[0.1, 0.0, -1.0]; 4],
        indices: vec![[0, 1, 2, 3]],
        ..Default::default()
    };
    let turned = Transform::scale(vec3(0.5, 0.5, -0.5)).unwrap();
    let shapes = [patch(flat), placed(Shape::Patches(shaded)), at(super::sphere(0.8), turned)];
    for (i, shape) in shapes.into_iter().enumerate() {
        let g = Geometry::build(vec![shape]);
        let mut n_drawn = 0;
        for round in 0..40 {
            let from: [Vec3<f32>; N] = core::array::from_fn(|k| match (k + round) % 5 {
                0 => rng.direction() * 100.0,
                1 => rng.direction() * 0.1,
                2 => vec3(3.0, 0.2, 0.0),
                _ => rng.direction() * 1.5,
            });
            let normals: [Vec3<f32>; N] = core::array::from_fn(|_| rng.direction());
            let u: [[f32; 2]; N] = core::array::from_fn(|_| rng.pair());
            // The lanes beyond the last viewpoint repeat it.
            let column =
                |v: &dyn Fn(usize) -> f32| -> Vec<f32> { (0..32).map(|k| v(k.min(N - 1))).collect() };
            let vectors = |v: &[Vec3<f32>; N]| [0, 1, 2].map(|c| column(&|k| v[k].to_array()[c]));
            let (at, n) = (vectors(&from), vectors(&normals));
            let pairs = [0, 1].map(|c| column(&|k| u[k][c]));
            let mut out = vec![[0.0; 32]; 11];
            let [px, py, pz, nx, ny, nz, wx, wy, wz, distance, pdf] = &mut out[..] else { unreachable!() };
            let mut columns = SampleColumns {
                from: at.each_ref().map(|c| &c[..]),
                n: n.each_ref().map(|c| &c[..]),
                u: pairs.each_ref().map(|c| &c[..]),
                p: [px, py, pz],
                on: [nx, ny, nz],
                wi: [wx, wy, wz],
                distance,
                pdf,
            };
            let p_error = g.sample_from_many(0, 0, &mut columns, N).expect("there are lanes");
            let vector = |c: &[&mut [f32]; 3], k: usize| vec3(c[0][k], c[1][k], c[2][k]);
            let drawn = [&columns.p, &columns.on].map(|v| v.each_ref().map(|c| &**c));
            assert_same_densities(&g, [&at, &n].map(|v| v.each_ref().map(|c| &c[..])), drawn, N);
            for k in 0..N {
                let one = g.sample_from(0, 0, Viewpoint { p: from[k], n: Some(normals[k]) }, u[k]);
                let pdf = columns.pdf[k];
                let many = (pdf > 0.0).then(|| ShapeSample {
                    p: vector(&columns.p, k),
                    p_error,
                    n: vector(&columns.on, k),
                    wi: vector(&columns.wi, k),
                    distance: columns.distance[k],
                    pdf,
                });
                assert_eq!(one.as_ref().map(bits), many.as_ref().map(bits), "shape {i} from {:?}", from[k]);
                n_drawn += usize::from(one.is_some());
            }
        }
        assert!(n_drawn > 30 * N, "shape {i}: {n_drawn}");
    }
}

/// Lanes that see a ball each draw what is drawn one by one.
#[test]
fn balls_in_lanes_are_drawn_as_one_by_one() {
    const N: usize = 32;
    let mut rng = Rng(12);
    let sizes = [0.01, 0.3, 1.0, 7.0];
    let ball = |i: usize| {
        let place = Transform::translate(vec3(i as f64, -2.0 * i as f64, 0.5));
        ShapeInstance { flip_normal: i % 3 == 1, ..at(super::sphere(sizes[i % 4]), place) }
    };
    let cut = Shape::Sphere { radius: 1.0, z_min: -0.5, z_max: 1.0, phi_max: 360.0 };
    let g = Geometry::build((0..8).map(ball).chain([placed(cut)]).collect());
    assert!((0..8).all(|shape| g.is_ball(shape)) && !g.is_ball(8) && !g.is_ball(9));
    let balls = g.balls((0..9).map(Some));
    for _ in 0..40 {
        let which: [u32; N] = core::array::from_fn(|_| (8.0 * rng.pair()[0]) as u32);
        let at: [Vec3<f32>; N] = core::array::from_fn(|k| rng.direction() * [0.2, 3.0, 200.0][k % 3]);
        let u: [[f32; 2]; N] = core::array::from_fn(|_| rng.pair());
        let from: [Vec<f32>; 3] = core::array::from_fn(|c| at.iter().map(|p| p.to_array()[c]).collect());
        let pairs: [Vec<f32>; 2] = core::array::from_fn(|c| u.iter().map(|u| u[c]).collect());
        let mut out = vec![[0.0; N]; 14];
        let [px, py, pz, nx, ny, nz, wx, wy, wz, distance, pdf, ex, ey, ez] = &mut out[..] else {
            unreachable!()
        };
        let mut columns = SampleColumns {
            from: from.each_ref().map(|c| &c[..]),
            n: from.each_ref().map(|c| &c[..]),
            u: pairs.each_ref().map(|c| &c[..]),
            p: [px, py, pz],
            on: [nx, ny, nz],
            wi: [wx, wy, wz],
            distance,
            pdf,
        };
        balls.sample_from_many(&which, &mut columns, [ex, ey, ez], N);
        for (k, shape) in which.into_iter().enumerate() {
            let one = g.sample_from(shape, 0, Viewpoint { p: at[k], n: None }, u[k]).expect("a ball is seen");
            let vector = |first: usize| vec3(out[first][k], out[first + 1][k], out[first + 2][k]);
            let many = ShapeSample {
                p: vector(0),
                n: vector(3),
                wi: vector(6),
                distance: out[9][k],
                pdf: out[10][k],
                p_error: vector(11),
            };
            assert_eq!(bits(&one), bits(&many), "ball {shape} from {:?}", at[k]);
        }
    }
}

#[test]
fn bent_patches_have_no_lanes() {
    let bent = patch([[-0.5, -0.4, 0.3], [0.5, -0.4, -0.2], [-0.5, 0.4, 0.0], [0.5, 0.6, 0.4]]);
    let g = Geometry::build(vec![bent]);
    let mut none = SampleColumns {
        from: [&[]; 3],
        n: [&[]; 3],
        u: [&[]; 2],
        p: [&mut [], &mut [], &mut []],
        on: [&mut [], &mut [], &mut []],
        wi: [&mut [], &mut [], &mut []],
        distance: &mut [],
        pdf: &mut [],
    };
    assert!(g.sample_from_many(0, 0, &mut none, 0).is_none());
}
