//! Optimal weights: the mean of the balance heuristic with less noise, whatever the threads.

mod common;

use std::path::Path;

use common::{describe, picture_of};
use sparrow_render::film::Film;
use sparrow_scene::SamplerName;
use sparrow_stats::images_z_test;

/// Rough metal under a large lamp and a small one, where light and BSDF sampling each win somewhere; a diffuse floor.
fn scene(mis: &str, sampler: &str, seed: u32) -> String {
    format!(
        r#"Film "rgb" "integer xresolution" 32 "integer yresolution" 24
        Sampler "{sampler}" "integer pixelsamples" 512 "integer seed" {seed}
        Integrator "path" "integer maxdepth" 2 "string mis" "{mis}"
        LookAt 0 1.5 5  0 0.6 0  0 1 0
        Camera "perspective" "float fov" 45
        WorldBegin
        LightSource "infinite" "rgb L" [ 0.1 0.12 0.2 ]
        AttributeBegin
          AreaLightSource "diffuse" "rgb L" [ 5 4 3 ]
          Translate 1.5 2 -1
          Shape "sphere" "float radius" 0.8
        AttributeEnd
        AttributeBegin
          AreaLightSource "diffuse" "rgb L" [ 40 40 60 ]
          Translate -1.5 2 0.5
          Shape "sphere" "float radius" 0.1
        AttributeEnd
        Material "conductor" "float roughness" 0.25 "bool remaproughness" false
        Shape "bilinearmesh" "point3 P" [ -5 0 -5  5 0 -5  -5 0 5  5 0 5 ]
        Material "diffuse" "rgb reflectance" [ 0.7 0.5 0.3 ]
        AttributeBegin Translate -0.9 0.6 0 Shape "sphere" "float radius" 0.6 AttributeEnd"#
    )
}

fn film(mis: &str, sampler: &str, seed: u32) -> Film {
    picture_of(describe(&scene(mis, sampler, seed)), 2).0
}

/// Values and variances of all pixels and channels.
fn numbers(film: &Film) -> (Vec<f64>, Vec<f64>) {
    let places = (0..film.height()).flat_map(|y| (0..film.width()).map(move |x| (x, y)));
    let views: Vec<_> = places.map(|(x, y)| film.pixel(x, y)).collect();
    (views.iter().flat_map(|p| p.rgb).collect(), views.iter().flat_map(|p| p.variance).collect())
}

/// A lamp over a rough surface where the best weights have a fifth of the variance of balance (`scenes/mis`).
fn lamp(mis: &str, sampler: SamplerName, seed: u64) -> Film {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/mis/lamp-0.1.pbrt");
    let surface = r#""surface" "string type" "phong" "rgb diffuse" [ 0 0 0 ] "rgb specular" [ 1 1 1 ]
        "string form" "normalized" "float exponent" 1250"#;
    let mut desc =
        sparrow_scene::read_with_materials(&file, &[surface.to_owned()]).expect("a scene of our own");
    desc.integrator.mis = mis.parse().expect("the name of a heuristic");
    (desc.sampler.name, desc.seed) = (sampler, seed);
    picture_of(desc, 2).0
}

fn is_the_same_but_for_noise(what: &str, a: &Film, b: &Film) {
    let ((a, va), (b, vb)) = (numbers(a), numbers(b));
    let test = images_z_test(&a, &va, &b, &vb, 0.01);
    assert!(test.holds(), "{what}: {test:?}");
}

#[test]
fn the_mean_is_that_of_the_balance_heuristic() {
    for sampler in ["independent", "zsobol"] {
        let (a, b) = (film("optimal", sampler, 1), film("balance", sampler, 2));
        is_the_same_but_for_noise(sampler, &a, &b);
    }
    for sampler in [SamplerName::Independent, SamplerName::ZSobol] {
        let (a, b) = (lamp("optimal", sampler, 3), lamp("balance", sampler, 4));
        is_the_same_but_for_noise("lamp", &a, &b);
    }
}

#[test]
fn less_noise_than_by_any_heuristic() {
    let noise = |mis: &str| numbers(&lamp(mis, SamplerName::Independent, 5)).1.iter().sum::<f64>();
    let [optimal, balance, power] = ["optimal", "balance", "power"].map(noise);
    assert!(
        optimal < 0.3 * balance && optimal < 0.9 * power,
        "{optimal}, by balance {balance}, by power {power}"
    );
}

#[test]
fn a_crop_learns_what_the_whole_picture_learns() {
    let text = scene("optimal", "zsobol", 0);
    let whole = picture_of(describe(&text), 2).0;
    let mut desc = describe(&text);
    desc.film.pixel_bounds = [7, 30, 5, 23];
    let part = picture_of(desc, 1).0;
    for (x, y) in (0..18).flat_map(|y| (0..23).map(move |x| (x, y))) {
        assert!(part.pixel(x, y) == whole.pixel(x + 7, y + 5), "pixel {x} {y}");
    }
}

#[test]
fn threads_do_not_matter() {
    let of = |threads| picture_of(describe(&scene("optimal", "zsobol", 0)), threads).0;
    assert!(of(1) == of(3));
}
