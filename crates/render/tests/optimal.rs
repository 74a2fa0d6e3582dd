//! Optimal weights: the mean of the balance heuristic with less noise, whatever the threads.

mod common;

use common::{describe, picture_of};
use sparrow_render::film::Film;
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

#[test]
fn the_mean_is_that_of_the_balance_heuristic() {
    for sampler in ["independent", "zsobol"] {
        let (a, va) = numbers(&film("optimal", sampler, 1));
        let (b, vb) = numbers(&film("balance", sampler, 2));
        let test = images_z_test(&a, &va, &b, &vb, 0.01);
        assert!(test.holds(), "{sampler}: {test:?}");
        // All together: a bias that no pixel shows alone.
        let sum = |v: &[f64]| v.iter().sum::<f64>();
        let z = (sum(&a) - sum(&b)) / (sum(&va) + sum(&vb)).sqrt();
        assert!(z.abs() < 3.5, "{sampler}: the whole pictures differ by {z} standard errors");
    }
}

#[test]
fn less_noise_than_by_the_balance_heuristic() {
    let noise = |mis: &str| numbers(&film(mis, "independent", 3)).1.iter().sum::<f64>();
    let (optimal, balance) = (noise("optimal"), noise("balance"));
    assert!(optimal < 0.9 * balance, "{optimal} of {balance}");
}

#[test]
fn threads_do_not_matter() {
    let of = |threads| picture_of(describe(&scene("optimal", "zsobol", 0)), threads).0;
    assert!(of(1) == of(3));
}
