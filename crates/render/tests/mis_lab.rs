//! The laboratory of multiple importance sampling: rendered variances against records that were computed apart, the plate scene
//! against its own, and the bar of its highlights.

#![allow(
    dead_code,
    unreachable_pub,
    reason = "the example `mis_lab` prints what is tested here; each uses its part"
)]

#[path = "../examples/mis_lab/matrix.rs"]
mod matrix;
#[path = "../examples/mis_lab/plates.rs"]
mod plates;

use std::path::PathBuf;

use serde_json::Value;
use sparrow_math::{Vec3, vec3};
use sparrow_mis::Mis;
use sparrow_render::{RayCounts, RenderPlan, Roulette, compile};
use sparrow_spectra::Wavelengths;

fn scenes() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

/// The records, as `crates/mis` has them.
fn records() -> Vec<Value> {
    serde_json::from_str(include_str!("../../mis/tests/reference/values_mis.json"))
        .expect("the records are JSON")
}

fn number(records: &[Value], id: &str, pointer: &str) -> f64 {
    let record = records.iter().find(|r| r["id"] == id).unwrap_or_else(|| unreachable!("no record {id}"));
    record.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| unreachable!("no {pointer} in {id}"))
}

/// Standard errors that a variance may be off. There are 96 of them, some of rare events, whose error is not normal.
const ERRORS: f64 = 5.0;
/// Relative variance below which single precision has its say.
const ROUNDING: f64 = 1e-9;
/// Relative variance that a slope learned from few pairs may leave.
const LEARNED: f64 = 1e-4;

#[test]
fn rendered_variances_of_lamps_over_rough_surfaces_are_the_records() {
    let records = records();
    for (radius, r) in matrix::RADII {
        for (alpha, a) in matrix::ALPHAS {
            let id = format!("matrix.R{r}.a{a}");
            for (name, mis) in matrix::COLUMNS {
                let got = matrix::measure(&scenes(), r, alpha, mis, 40_000).expect("a sound scene");
                let (want, floor) = match name {
                    "V_optimal" => (matrix::optimal_variance(radius, alpha), LEARNED),
                    "V1" | "V2" => (number(&records, &id, &format!("/value/{name}~1I^2")), ROUNDING),
                    _ => {
                        let pointer = format!("/value/{name}~1I^2 (1+1 samples)");
                        (number(&records, &id, &pointer), ROUNDING)
                    }
                };
                // The records are relative to the true I, the measured ones to the mean that was found.
                let allowed = ERRORS * got.error.max(want * rare(got.variance, 40_000)) + 1e-3 * want + floor;
                assert!((got.variance - want).abs() < allowed, "{id} {name}: {got:?}, want {want}");
            }
        }
    }
}

/// Relative error of a variance `v` that comes from events of probability `1 / (1 + v)`.
fn rare(v: f64, n: u32) -> f64 {
    ((1.0 + v) / f64::from(n)).sqrt()
}

#[test]
fn balance_has_no_highlight_much_worse_than_the_better_technique() {
    let of = |mis: Mis| plates::errors(&scenes(), [96, 64], mis, 64).expect("a sound scene");
    let [light, bsdf, balance] = [0, 1, 2].map(|i| of(plates::WAYS[i].1));
    let mut best = [0, 0];
    for plate in 0..4 {
        for lamp in 0..4 {
            let (l, b, both) = (light[plate][lamp], bsdf[plate][lamp], balance[plate][lamp]);
            let better = l.min(b);
            assert!(both < 3.0 * better, "plate {plate}, lamp {lamp}: {both}, alone {l} and {b}");
            best[usize::from(b < l)] += 1;
        }
    }
    // Else there is nothing to join.
    assert!(best.iter().all(|n| *n >= 4), "light and BSDF sampling win in {best:?} highlights");
}

/// The angle between two vectors, in degrees, precise for small ones.
fn degrees(a: Vec3<f64>, b: Vec3<f64>) -> f64 {
    sparrow_math::Real::atan2(a.cross(b).length2().sqrt(), a.dot(b)).to_degrees()
}

#[test]
fn the_plates_stand_where_the_records_have_them() {
    let records = records();
    let scene = compile(plates::description(&scenes(), [768, 512]).expect("a sound scene"))
        .expect("a sound scene")
        .scene;
    for plate in 0..4 {
        let id = format!("plates.{}", plate + 1);
        let holds = |got: f64, pointer: &str| {
            let want = number(&records, &id, pointer);
            assert!((got - want).abs() <= 1e-4 * want.abs().max(1.0), "{id} {pointer}: {got}, want {want}");
        };
        let edge = |i: usize| {
            let at = |c: usize| number(&records, &id, &format!("/inputs/edges_yz/{i}/{c}"));
            vec3(0.0, at(0), at(1))
        };
        let (a, b) = (edge(0), edge(1));
        let (centre, along) = ((a + b) * 0.5, b - a);
        let normal = vec3(0.0, -along.z, along.y).normalized();
        holds(centre.y, "/value/centre_yz/0");
        holds(centre.z, "/value/centre_yz/1");
        holds(normal.y, "/value/normal_yz/0");
        holds(normal.z, "/value/normal_yz/1");
        holds(along.length2().sqrt(), "/value/width");
        holds(degrees(normal, vec3(0.0, 1.0, 0.0)), "/value/tilt_deg_from_up");
        for (eye, name) in [(vec3(0.0, 2.0, 15.0), "eye(0,2,15)"), (vec3(0.0, 6.0, 27.5), "eye(0,6,27.5)")] {
            let value = |key: &str| format!("/value/{name}/{key}");
            let view = (eye - centre).normalized();
            let mirrored = normal * (2.0 * normal.dot(view)) - view;
            holds(degrees(mirrored, -centre), &value("angle_between_mirror_ray_and_light_line_deg"));
            holds(centre.length2().sqrt(), &value("light_distance"));
            holds(degrees(normal, view), &value("incidence_deg"));
        }
        // The scene has the plate there.
        let ray = scene.camera().ray([384.0, 256.0], [0.5; 2], 0.0);
        let to = centre.to_f32() - ray.o;
        let hit = scene.intersect(&sparrow_geometry::Ray::new(ray.o, to.normalized())).expect("a plate");
        assert!((hit.p - centre.to_f32()).length2() < 1e-8, "{id}: met at {:?}", hit.p);
        assert!(hit.ng.to_f64().dot(normal).abs() > 1.0 - 1e-6, "{id}: its normal is {:?}", hit.ng);
    }
}

#[test]
fn the_lamps_have_the_power_of_the_records() {
    let records = records();
    let desc = plates::description(&scenes(), [768, 512]).expect("a sound scene");
    let plan = RenderPlan::new(&desc).expect("the plan of a sound scene");
    let scene = compile(desc).expect("a sound scene").scene;
    let eye = scene.camera().ray([384.0, 256.0], [0.5; 2], 0.0).o;
    let mut radiance = Vec::new();
    for (i, x) in plates::LAMPS.into_iter().enumerate() {
        let at = |list: &str| number(&records, "plates.power", &format!("/inputs/{list}/{i}"));
        let (r, le) = (at("R"), at("Le"));
        let power = 4.0 * std::f64::consts::PI.powi(2) * r * r * le;
        let want = number(&records, "plates.power", &format!("/value/{i}"));
        assert!((power - want).abs() < 1e-3 * want, "lamp {i}: {power}, want {want}");
        // The scene's lamp has that radius, and a radiance in that ratio to the others'.
        let to = vec3(x, 0.0, 0.0) - eye;
        let ray = sparrow_geometry::Ray::new(eye, to.normalized());
        let hit = scene.intersect(&ray).expect("a lamp");
        let depth = to.length2().sqrt() - (hit.p - eye).length2().sqrt();
        assert!((f64::from(depth) - r).abs() < 1e-5, "lamp {i}: its radius is {depth}, not {r}");
        let mut lambda = Wavelengths::with_pdf([550.0; 4], [1.0; 4]);
        let (mut sampler, mut rays) = (plan.sampler.start([0, 0], 0), RayCounts::default());
        let l = plan.integrator.radiance(
            &scene,
            ray,
            &mut lambda,
            &mut sampler,
            &mut rays,
            &mut (),
            Roulette::THROUGHPUT,
        );
        radiance.push(f64::from(l.0[0]) / le);
    }
    assert!(radiance.iter().all(|l| (l / radiance[0] - 1.0).abs() < 1e-5), "{radiance:?}");
}
