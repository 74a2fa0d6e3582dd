//! The light of each sampling technique apart: parts sum to the picture, and each is what the technique finds alone.

mod common;

use std::sync::atomic::AtomicBool;

use common::{describe, picture_of};
use sparrow_render::film::Film;
use sparrow_render::{RenderOptions, RenderPlan, Strategies, compile, render_strategies};

/// A lamp, a point, a sky, a rough metal ball and, where `glass` says so, one of smooth glass.
fn scene(mis: &str, glass: &str) -> String {
    format!(
        r#"Film "rgb" "integer xresolution" 24 "integer yresolution" 20
        Sampler "zsobol" "integer pixelsamples" 16
        Integrator "path" "integer maxdepth" 4 "string mis" "{mis}"
        LookAt 0 1 4  0 0.9 0  0 1 0
        Camera "perspective" "float fov" 50
        WorldBegin
        LightSource "infinite" "rgb L" [ 0.2 0.25 0.3 ]
        LightSource "point" "rgb I" [ 2 1 1 ] "point3 from" [ -2 3 1 ]
        AttributeBegin
          AreaLightSource "diffuse" "rgb L" [ 8 7 6 ]
          Translate 1 2 0.5
          Shape "sphere" "float radius" 0.3
        AttributeEnd
        Material "diffuse" "rgb reflectance" [ 0.6 0.5 0.4 ]
        Shape "bilinearmesh" "point3 P" [ -5 0 -5  5 0 -5  -5 0 5  5 0 5 ]
        Material "conductor" "float roughness" 0.1
        AttributeBegin Translate -0.8 0.7 0 Shape "sphere" "float radius" 0.7 AttributeEnd
        {glass}"#
    )
}

const GLASS: &str = r#"Material "dielectric"
    AttributeBegin Translate 0.9 0.6 0.4 Shape "sphere" "float radius" 0.6 AttributeEnd"#;

fn strategies_of(text: &str, threads: usize) -> (Film, Strategies) {
    let desc = describe(text);
    let plan = RenderPlan::new(&desc).expect("the plan of a sound scene");
    let compiled = compile(desc).expect("a sound scene");
    let options = RenderOptions { threads, variance: true, time_limit: None };
    let (film, parts, _) =
        render_strategies(&compiled.scene, &plan, &options, &AtomicBool::new(false), &|_| ())
            .expect("a render");
    (film, parts)
}

fn pixels(film: &Film) -> Vec<[f64; 3]> {
    let of_row = |y: u32| (0..film.width()).map(move |x| film.pixel(x, y).rgb);
    (0..film.height()).flat_map(of_row).collect()
}

/// Largest distance of `a + b + c` from `want`, in parts of the value and its surroundings' brightness.
fn distance(parts: &[&Film], want: &Film) -> f64 {
    let parts: Vec<_> = parts.iter().map(|f| pixels(f)).collect();
    let mut worst = 0.0f64;
    for (i, want) in pixels(want).iter().enumerate() {
        for c in 0..3 {
            let sum: f64 = parts.iter().map(|p| p[i][c]).sum();
            worst = worst.max((sum - want[c]).abs() / (want[c].abs() + 0.1));
        }
    }
    worst
}

/// Parts are rounded apart, each sample in single precision.
const ROUNDING: f64 = 3e-6;

#[test]
fn the_picture_keeps_its_bits_and_is_the_sum_of_its_parts() {
    for mis in ["balance", "power", "cutoff:0.3", "one-sample", "light-only", "bsdf-only"] {
        let text = scene(mis, GLASS);
        let (film, parts) = strategies_of(&text, 2);
        let plain = picture_of(describe(&text), 1).0;
        assert!(film == plain, "{mis}: looking on changed the picture");
        let far = distance(&[&parts.seen, &parts.light.weighted, &parts.bsdf.weighted], &film);
        assert!(far < ROUNDING, "{mis}: parts sum to something else, by {far}");
    }
}

#[test]
fn a_technique_unweighted_is_what_it_finds_alone() {
    // Without delta lobes: along those a render by light sampling alone has light that the BSDF found.
    let (_, parts) = strategies_of(&scene("balance", ""), 1);
    let alone = |mis: &str| picture_of(describe(&scene(mis, "")), 1).0;
    let bsdf = distance(&[&parts.seen, &parts.bsdf.unweighted], &alone("bsdf-only"));
    assert!(bsdf < ROUNDING, "BSDF sampling: {bsdf}");
    // MIS compensation leaves the sky to the BSDF, unless light sampling is alone.
    let text =
        scene("balance", "").replace("\"string mis\"", "\"bool miscompensation\" false \"string mis\"");
    let (_, parts) = strategies_of(&text, 1);
    // The point is found by light sampling alone, with weight 1.
    let light = distance(&[&parts.seen, &parts.light.unweighted], &alone("light-only"));
    assert!(light < ROUNDING, "light sampling: {light}");
}

#[test]
fn parts_do_not_depend_on_threads() {
    let one = strategies_of(&scene("power", GLASS), 1).1;
    let three = strategies_of(&scene("power", GLASS), 3).1;
    assert!(one.light.unweighted == three.light.unweighted && one.bsdf.weighted == three.bsdf.weighted);
    assert!(one.seen == three.seen);
}

#[test]
fn one_sample_alone_has_the_mean_of_both_turns() {
    let mean = |film: &Film| {
        let all = pixels(film);
        all.iter().map(|p| p[1]).sum::<f64>() / all.len() as f64
    };
    let (_, both) = strategies_of(&scene("balance", ""), 1);
    let (_, one) = strategies_of(&scene("one-sample", ""), 1);
    for (a, b) in [(&both.light, &one.light), (&both.bsdf, &one.bsdf)] {
        let ratio = mean(&b.unweighted) / mean(&a.unweighted);
        assert!((ratio - 1.0).abs() < 0.1, "half the turns, twice the value: {ratio}");
    }
}
