//! The same bits for any number of threads, any order of tiles and any split into passes.

mod common;

use common::{describe, picture_of};
use sparrow_render::film::Film;
use sparrow_scene::RouletteName;

const SCENE: &str = r#"
    Film "rgb" "integer xresolution" 50 "integer yresolution" 37
    Sampler "zsobol" "integer pixelsamples" 64
    Integrator "path" "integer maxdepth" 6
    LookAt 0 1 4  0 0.8 0  0 1 0
    Camera "perspective" "float fov" 40
    WorldBegin
    LightSource "infinite" "rgb L" [ 0.2 0.25 0.3 ]
    AttributeBegin
      AreaLightSource "diffuse" "rgb L" [ 8 7 6 ]
      Translate 1 2.5 1
      Shape "sphere" "float radius" 0.3
    AttributeEnd
    Material "diffuse" "rgb reflectance" [ 0.6 0.5 0.4 ]
    Shape "bilinearmesh" "point3 P" [ -5 0 -5  5 0 -5  -5 0 5  5 0 5 ]
    Material "conductor" "float roughness" 0.1
    AttributeBegin Translate -0.8 0.7 0 Shape "sphere" "float radius" 0.7 AttributeEnd
    Material "dielectric" "float roughness" 0.05
    AttributeBegin Translate 0.8 0.6 0.4 Shape "sphere" "float radius" 0.6 AttributeEnd
"#;

fn bits(film: &Film) -> Vec<[u64; 3]> {
    (0..film.height())
        .flat_map(|y| (0..film.width()).map(move |x| (x, y)))
        .map(|(x, y)| film.pixel(x, y).rgb.map(f64::to_bits))
        .collect()
}

#[test]
fn one_two_and_three_threads_give_the_same_bits() {
    let one = picture_of(describe(SCENE), 1).0;
    assert!(bits(&one).iter().flatten().any(|&b| b != 0), "the picture is black");
    for threads in [2, 3] {
        assert_eq!(bits(&one), bits(&picture_of(describe(SCENE), threads).0), "{threads} threads");
    }
}

#[test]
fn what_a_pilot_learns_depends_on_neither_threads_nor_crops() {
    let mut desc = describe(SCENE);
    desc.integrator.roulette = RouletteName::Efficiency;
    let mut cropped = desc.clone();
    cropped.film.pixel_bounds = [13, 41, 7, 30];
    let (one, three) = (picture_of(desc.clone(), 1).0, picture_of(desc, 3).0);
    assert_eq!(bits(&one), bits(&three));
    assert_ne!(bits(&one), bits(&picture_of(describe(SCENE), 1).0), "nothing was learned");
    let part = picture_of(cropped, 2).0;
    let same =
        |x, y| part.pixel(x, y).rgb.map(f64::to_bits) == one.pixel(x + 13, y + 7).rgb.map(f64::to_bits);
    assert!((0..part.height()).all(|y| (0..part.width()).all(|x| same(x, y))));
}

#[test]
fn crops_agree_with_the_whole_picture() {
    let whole = picture_of(describe(SCENE), 1).0;
    let mut desc = describe(SCENE);
    desc.film.pixel_bounds = [13, 41, 7, 30];
    let part = picture_of(desc, 2).0;
    for y in 0..part.height() {
        for x in 0..part.width() {
            let (a, b) = (part.pixel(x, y).rgb, whole.pixel(x + 13, y + 7).rgb);
            assert_eq!(a.map(f64::to_bits), b.map(f64::to_bits), "pixel {x} {y}");
        }
    }
}

#[test]
fn seeds_give_other_noise_and_the_same_picture() {
    let mut other = describe(SCENE);
    other.seed = 7;
    let (a, b) = (picture_of(describe(SCENE), 2).0, picture_of(other, 2).0);
    assert_ne!(bits(&a), bits(&b));
    let (ma, mb) = (common::mean(&a), common::mean(&b));
    for c in 0..3 {
        assert!((ma.0[c] - mb.0[c]).abs() < 4.0 * (ma.1[c] + mb.1[c]), "{ma:?} {mb:?}");
    }
}
