//! `sparrow compare`: numbers, thresholds, pictures of differences, and what is said of bad files.

use sparrow_image::{OutputImage, write_exr, write_png};

use crate::scratch::Scratch;

const SIZE: [usize; 2] = [24, 16];

/// A picture whose every value is `v`.
fn even(v: f32) -> Vec<[f32; 3]> {
    vec![[v; 3]; SIZE[0] * SIZE[1]]
}

fn put(s: &Scratch, name: &str, rgb: &[[f32; 3]], variance: Option<f32>) {
    let mut image = OutputImage::new(SIZE[0], SIZE[1]);
    for (c, channel) in ["R", "G", "B"].into_iter().enumerate() {
        image = image.with_f32(channel, rgb.iter().map(|p| p[c]).collect());
    }
    if let Some(v) = variance {
        image = image.with_rgb("variance", &even(v));
    }
    write_exr(&s.path(name), &image).unwrap();
}

fn scratch() -> Scratch {
    let s = Scratch::new();
    put(&s, "half.exr", &even(0.5), None);
    put(&s, "more.exr", &even(0.6), None);
    s
}

#[test]
fn every_measure_is_told_to_people_and_machines() {
    let s = scratch();
    let text = s.run("compare more.exr half.exr").ok().out;
    for name in [
        "mse",
        "relmse",
        "relmse-trim0.1",
        "relmse-trim1",
        "block-relmse",
        "mean-ratio",
        "psnr",
        "ssim",
        "flip",
    ] {
        assert!(text.lines().any(|l| l.split(' ').next() == Some(name)), "{name} is not in {text}");
    }
    assert!(
        text.contains("no channels variance.R, variance.G, variance.B in more.exr and half.exr;"),
        "{text}"
    );
    let ran = s.run("compare more.exr half.exr --json").ok();
    let json = ran.json();
    assert_eq!((&json["status"], &json["width"], &json["height"]), (&"done".into(), &24.into(), &16.into()));
    let number = |name: &str| json["metrics"][name].as_f64().unwrap();
    // 0.1² and, relative, over 0.5² + 0.01.
    assert!((number("mse") - 0.01).abs() < 1e-7);
    assert!((number("relmse") - 0.01 / 0.26).abs() < 1e-6);
    assert!((number("relmse-trim0.1") - 0.01 / 0.26).abs() < 1e-6);
    assert!((json["metrics"]["mean-ratio"][1].as_f64().unwrap() - 1.2).abs() < 1e-6);
    assert!(json["metrics"]["z-test"].is_null());
    let same = s.run("compare half.exr half.exr --json").ok().json();
    assert_eq!(
        (&same["metrics"]["flip"], &same["metrics"]["psnr"]),
        (&0.0.into(), &().into()),
        "no noise at all"
    );
}

#[test]
fn only_what_is_asked_for_is_measured() {
    let s = scratch();
    let json = s.run("compare more.exr half.exr --metric mse --threshold ssim=0.5 --json").ok().json();
    let names: Vec<&String> = json["metrics"].as_object().unwrap().keys().collect();
    assert_eq!(names, ["mse", "ssim"]);
    assert_eq!(
        (&json["thresholds"][0]["metric"], &json["thresholds"][0]["exceeded"]),
        (&"ssim".into(), &false.into())
    );
}

#[test]
fn a_threshold_decides_the_exit_code() {
    let s = scratch();
    for (words, code) in
        [("mse=0.02", 0), ("mse=0.005", 1), ("psnr=10", 0), ("psnr=60", 1), ("mean-ratio=0.1", 1)]
    {
        let ran = s.run(&format!("compare more.exr half.exr --threshold {words}"));
        assert_eq!(ran.code, Some(code), "{words}: {ran:?}");
        assert_eq!(ran.out.contains("EXCEEDED"), code == 1, "{words}: {ran:?}");
    }
    let ran = s.run("compare more.exr half.exr --threshold mse=1 --threshold flip=0 --json");
    let json = ran.json();
    assert_eq!((ran.code, &json["status"], &json["exit_code"]), (Some(1), &"exceeded".into(), &1.into()));
    assert_eq!(
        (&json["thresholds"][0]["exceeded"], &json["thresholds"][1]["exceeded"]),
        (&false.into(), &true.into())
    );
}

#[test]
fn noise_is_told_from_bias_where_variances_are_known() {
    let s = Scratch::new();
    put(&s, "a.exr", &even(0.5), Some(1e-4));
    put(&s, "near.exr", &even(0.5001), Some(1e-4));
    put(&s, "far.exr", &even(0.53), Some(1e-4));
    put(&s, "unknown.exr", &even(0.5), Some(f32::INFINITY));
    assert_eq!(s.run("compare near.exr a.exr --threshold z-test=0.01").code, Some(0));
    // 0.03 is 2 sigma in each of 384 pixels: no pixel is odd, together they are 41 sigma off.
    let ran = s.run("compare far.exr a.exr --threshold z-test=0.01 --json");
    let test = &ran.json()["metrics"]["z-test"];
    assert_eq!((ran.code, &test["rejected"]), (Some(1), &0.into()), "{ran:?}");
    assert!((test["bias"][0].as_f64().unwrap() - 41.57).abs() < 0.05, "{test}");
    let ran = s.run("compare unknown.exr a.exr --metric z-test");
    assert!(
        ran.code == Some(1) && ran.err.contains("384 of 384 pixels are negative or not finite"),
        "{ran:?}"
    );
    put(&s, "none.exr", &even(0.5), None);
    let ran = s.run("compare a.exr none.exr --metric z-test");
    assert!(
        ran.code == Some(1) && ran.err.contains("variance.B in none.exr; `sparrow render --variance`"),
        "{ran:?}"
    );
}

#[test]
fn a_render_compares_with_its_png_and_its_variances_serve() {
    let s = Scratch::new();
    for seed in [1, 2] {
        s.run(&format!("render room.pbrt --seed {seed} --spp 64 --variance -o {seed}.exr --quiet")).ok();
    }
    let json = s.run("compare 1.exr 2.exr --json").ok().json();
    assert!(json["metrics"]["z-test"]["p"].is_f64(), "{json}");
    // The PNG is cut at white and rounded to 8 bits, and so is what is shown of the EXR.
    let json = s.run("compare 1.exr 1.png --metric psnr --metric flip --json").ok().json();
    assert!(json["metrics"]["psnr"].as_f64().unwrap() > 50.0, "{json}");
}

#[test]
fn differences_are_drawn() {
    let s = scratch();
    let mut rgb = even(0.5);
    rgb[5 * SIZE[0] + 7] = [1.0; 3];
    put(&s, "spot.exr", &rgb, None);
    let ran = s.run("compare spot.exr half.exr -o diff.png").ok();
    assert!(ran.out.contains("diff.png") && ran.out.contains("diff-relative.png"), "{ran:?}");
    let map = sparrow_image::Image::read(&s.path("diff-relative.png"), None).unwrap();
    assert_eq!([map.width, map.height], SIZE);
    assert!(map.rgb(7, 5)[1] > 0.5 && map.rgb(8, 5)[1] < 0.01, "yellow where the error is, violet elsewhere");
    for words in [
        "-o diff.exr",
        "-o folder/",
        "--metric rmse",
        "--threshold mse",
        "--threshold mes=1",
        "--threshold mse=x",
    ] {
        let ran = s.run(&format!("compare half.exr more.exr {words}"));
        assert!(ran.code == Some(2) && !ran.err.is_empty(), "`{words}`: {ran:?}");
    }
    let before = s.files();
    assert_eq!(s.run("compare half.exr more.exr -o missing/a.png").code, Some(1));
    write_png(&s.path("seen.png"), SIZE[0], SIZE[1], &even(0.5)).unwrap();
    let ran = s.run("compare seen.png half.exr -o seen.png");
    assert!(ran.code == Some(1) && ran.err.contains("this file is compared"), "{ran:?}");
    assert_eq!(s.files().len(), before.len() + 1);
}

#[test]
fn all_faults_of_both_files_are_told() {
    let s = scratch();
    let mut rgb = even(0.5);
    rgb[3 * SIZE[0] + 2][1] = f32::NAN;
    rgb[9 * SIZE[0]][0] = f32::INFINITY;
    put(&s, "nan.exr", &rgb, None);
    let normals = OutputImage::new(1, 1).with_f32("N.X", vec![0.0]).with_f32("N.Y", vec![1.0]);
    write_exr(&s.path("normals.exr"), &normals).unwrap();
    let ran = s.run("compare nan.exr normals.exr --json");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let told: Vec<&str> = ran.err.lines().collect();
    assert!(
        told[0].starts_with(
            "nan.exr: 2 of 384 pixels are not finite (NaN or infinite), the first in column 2, row 3"
        ),
        "{told:?}"
    );
    assert!(
        told[1].starts_with("normals.exr: there are no channels R, G, B and no Y, only N.X, N.Y"),
        "{told:?}"
    );
    assert_eq!(ran.json()["errors"].as_array().unwrap().len(), 2);
    s.put("text.png", "no picture");
    let ran = s.run("compare missing.exr text.png");
    assert!(ran.err.contains("missing.exr: ") && ran.err.contains("text.png: "), "{ran:?}");
    write_png(&s.path("small.png"), 2, 1, &[[0.5; 3]; 2]).unwrap();
    let ran = s.run("compare half.exr small.png");
    assert!(ran.err.contains("half.exr has 24 x 16 pixels, small.png has 2 x 1"), "{ran:?}");
    // What needs more pixels is left out, unless it is asked for.
    let text = s.run("compare small.png small.png").ok().out;
    assert!(text.contains("it needs pictures of at least 11 x 11 pixels"), "{text}");
    assert_eq!(s.run("compare small.png small.png --threshold ssim=0.5").code, Some(1));
}
