//! Two settings against each other, and renders to a stated noise.

use sparrow_image::Image;

use crate::scratch::Scratch;

fn race(s: &Scratch, a: &str, b: &str, more: &[&str]) -> crate::scratch::Ran {
    let mut command = s.command("race room.pbrt --seeds 4 --cpu-time 0.05");
    command.args(["--a", a, "--b", b]).args(more);
    crate::scratch::Ran::from(command.output().unwrap())
}

#[test]
fn more_samples_are_less_error_and_more_time() {
    let s = Scratch::new();
    let json = race(&s, "--spp 16", "--spp 4", &["--json", "--quiet"]).ok().json();
    let relmse =
        |i: usize| json["relmse"][i].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).sum::<f64>();
    assert!(relmse(0) < 0.5 * relmse(1), "{json}");
    assert_eq!(
        (&json["settings"][0]["samples_per_pixel"], &json["means_differ"]),
        (&16.0.into(), &false.into())
    );
    let (low, high) = (json["interval"][0].as_f64().unwrap(), json["interval"][1].as_f64().unwrap());
    let ratio = json["efficiency_ratio"].as_f64().unwrap();
    assert!(low < ratio && ratio < high && low > 0.0, "{json}");
    assert_eq!(s.files(), ["room.pbrt"], "a race writes nothing");
}

#[test]
fn a_setting_that_loses_light_is_found_out() {
    let s = Scratch::new();
    let ran = race(&s, "--max-depth 1", "", &["--both", "--spp 16", "--quiet"]).ok();
    assert!(
        ran.out.contains("warning: the means differ") && ran.out.contains("efficiency of A over B"),
        "{ran:?}"
    );
}

#[test]
fn wrong_settings_are_told_with_their_place() {
    let s = Scratch::new();
    for (a, more, says) in [
        ("--mis blance", &[][..], "--a, column 7: invalid value 'blance'"),
        ("--resolution 8x8", &[], "different size"),
        ("", &["--reference", "none.exr"], "none.exr"),
        ("", &["--reference", "room.pbrt"], "room.pbrt"),
        ("--noise 0", &[], "--a, column 9: invalid value '0'"),
    ] {
        let ran = race(&s, a, "", more);
        assert!(ran.code != Some(0) && ran.err.contains(says), "{a}: {ran:?}");
    }
    s.run("render room.pbrt --resolution 8x8 -o small.exr --quiet").ok();
    let ran = race(&s, "", "", &["--reference", "small.exr"]);
    assert!(ran.err.contains("small.exr has 8 x 8 pixels, the race 64 x 48; give --both"), "{ran:?}");
}

#[test]
fn a_stated_noise_is_reached_and_the_layers_tell_how() {
    let s = Scratch::new();
    let json =
        s.run("render room.pbrt --noise 0.015 -o a.exr --variance --json --quiet --threads 2").ok().json();
    assert_eq!(s.files(), ["a-samples.png", "a.exr", "a.png", "room.pbrt"]);
    let noise = &json["stats"]["noise"];
    let (estimate, spp) =
        (noise["estimate"].as_f64().unwrap(), noise["samples_per_pixel_mean"].as_f64().unwrap());
    assert!(estimate <= 0.015 && estimate > 0.012 && spp > 32.0, "{json}");
    let image = Image::read(&s.path("a.exr"), None).unwrap();
    let samples = image.channel_index("samples").unwrap();
    let places = || (0..48).flat_map(|y| (0..64).map(move |x| (x, y)));
    let counts: Vec<f32> = places().map(|(x, y)| image.value(x, y, samples)).collect();
    assert!((f64::from(counts.iter().sum::<f32>()) / (64.0 * 48.0) - spp).abs() < 1e-3, "{spp}");
    assert!(image.channel_index("variance.R").is_some());
    // Against many samples the error is what was estimated; the reference adds a hundredth to its square.
    s.run("render room.pbrt --spp 2048 --seed 9 -o long.exr --quiet").ok();
    let compared = s.run("compare a.exr long.exr --metric relmse-trim0.1 --json").ok().json();
    let error = compared["metrics"]["relmse-trim0.1"].as_f64().unwrap().sqrt();
    assert!((error / estimate - 1.0).abs() < 0.2, "{error} for {estimate}");
    // The same for any number of threads.
    s.run("render room.pbrt --noise 0.015 -o b.exr --quiet --threads 1").ok();
    let bits = |name: &str| Image::read(&s.path(name), None).unwrap().to_rgb();
    assert!(bits("a.exr") == bits("b.exr"), "threads changed the picture");
}

#[test]
fn noise_that_cannot_be_reached_is_told() {
    let s = Scratch::new();
    let ran = s.run("render room.pbrt --noise 0.001 --spp 32 --resolution 16x16").ok();
    assert!(ran.err.contains("every pixel has its 32 samples") && ran.err.contains("raise --spp"), "{ran:?}");
    s.put("same.pbrt", "Sampler \"sobol\" \"string randomization\" \"none\"\nWorldBegin\nShape \"sphere\"\n");
    let ran = s.run("render same.pbrt --noise 0.1 --resolution 16x16");
    assert!(ran.code == Some(1) && ran.err.contains("one set of points"), "{ran:?}");
}
