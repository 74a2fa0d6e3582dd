//! Pictures: the same bits however they are made, at the place and with the facts that were asked for.

use serde_json::Value;
use sparrow_image::{Attribute, Chromaticities, Image, read_exr};

use crate::scratch::Scratch;

/// The bits of red, green and blue of every pixel.
fn bits(s: &Scratch, name: &str) -> Vec<[u32; 3]> {
    let image = Image::read(&s.path(name), None).unwrap();
    image.to_rgb().into_iter().map(|p| p.map(f32::to_bits)).collect()
}

#[test]
fn the_picture_does_not_depend_on_threads() {
    let s = Scratch::new();
    s.run("render room.pbrt -o one.exr --threads 1").ok();
    s.run("render room.pbrt -o two.png --threads 2 --quiet").ok();
    s.run("render room.pbrt -o other --seed 1 --quiet").ok();
    let all = ["one.exr", "one.png", "other.exr", "other.png", "room.pbrt", "two.exr", "two.png"];
    assert_eq!(s.files(), all);
    let one = bits(&s, "one.exr");
    assert_eq!(one.len(), 64 * 48);
    assert!(one == bits(&s, "two.exr"), "threads changed the picture");
    assert!(one != bits(&s, "other.exr"), "the seed did not change the picture");
    let mean = one.iter().map(|p| f32::from_bits(p[1])).sum::<f32>() / one.len() as f32;
    assert!((0.05..2.0).contains(&mean), "the mean is {mean}");
    let png = Image::read(&s.path("one.png"), None).unwrap();
    assert_eq!((png.width, png.height), (64, 48));
}

#[test]
fn a_crop_is_that_part_of_the_picture() {
    let s = Scratch::new();
    s.run("render room.pbrt -o full.exr --quiet").ok();
    s.run("render room.pbrt -o part.exr --quiet --crop 0.25,0.75,0.5,1").ok();
    let full = bits(&s, "full.exr");
    let part = bits(&s, "part.exr");
    let rows = (24..48).flat_map(|y| full[y * 64 + 16..y * 64 + 48].iter().copied());
    assert!(rows.eq(part), "the crop differs from the picture");
    let (image, header) = read_exr(&s.path("part.exr")).unwrap();
    assert_eq!((image.width, image.height, header.origin), (32, 24, [16, 24]));
    assert_eq!(header.display_size, [64, 48]);
}

#[test]
fn the_file_says_how_it_was_made() {
    let s = Scratch::new();
    s.run("render room.pbrt --quiet --variance --half --seed 12345678901 --mis balance").ok();
    assert_eq!(s.files(), ["named.exr", "named.png", "room.pbrt"], "the film gives the name");
    let (image, header) = read_exr(&s.path("named.exr")).unwrap();
    for name in ["R", "G", "B", "variance.R", "variance.G", "variance.B"] {
        assert!(image.channel_index(name).is_some(), "no channel {name} in {:?}", image.channels);
    }
    let variance = image.channel_index("variance.G").unwrap();
    let total: f32 =
        (0..48).flat_map(|y| (0..64).map(move |x| (x, y))).map(|(x, y)| image.value(x, y, variance)).sum();
    assert!(total > 0.0 && total.is_finite(), "the variances sum to {total}");
    assert_eq!(image.chromaticities, Some(Chromaticities::REC_709));
    let text = |name: &str| match header.attribute(name) {
        Some(Attribute::Text(t)) => t.clone(),
        other => panic!("{name} is {other:?}"),
    };
    assert!(text("software").starts_with("Sparrow "));
    assert!(text("command").contains("--seed 12345678901"));
    assert_eq!(text("seed"), "12345678901");
    assert_eq!([text("integrator"), text("mis"), text("sampler")], ["path", "balance", "zsobol"]);
    assert_eq!(header.attribute("samplesPerPixel"), Some(&Attribute::Int(4)));
    assert!(matches!(header.attribute("renderSeconds"), Some(Attribute::Double(v)) if *v > 0.0));
    // The camera stands at (0, 1, -4): the world's origin lies in front of it, the camera in its own.
    let m = header.world_to_camera.unwrap();
    let eye = m.map(|r| r[1] - 4.0 * r[2] + r[3]);
    assert!(eye[..3].iter().all(|v| v.abs() < 1e-5), "{eye:?}");
    let Some(Attribute::Matrix(back)) = header.attribute("cameraToWorld") else { panic!("no cameraToWorld") };
    let eye: Vec<String> = back.iter().map(|r| r[3].to_string()).collect();
    assert_eq!(eye, ["0", "1", "-4", "1"]);
    // It looks at (0, 0.8, 0), which is therefore in the middle of the picture.
    let n = header.world_to_ndc.unwrap().map(|r| 0.8 * r[1] + r[3]);
    assert!((n[0] / n[3] - 0.5).abs() < 1e-5 && (n[1] / n[3] - 0.5).abs() < 1e-5, "{n:?}");
}

#[test]
fn json_and_stats_hold_what_they_promise() {
    let s = Scratch::new();
    let ran = s.run("render room.pbrt --json --stats stats.json --threads 2 --max-depth 1").ok();
    let json = ran.json();
    assert_eq!((&json["status"], &json["exit_code"]), (&"done".into(), &0.into()));
    assert_eq!(json["outputs"], serde_json::json!(["named.exr", "named.png", "stats.json"]));
    let stats: Value = serde_json::from_slice(&std::fs::read(s.path("stats.json")).unwrap()).unwrap();
    assert_eq!(stats, json["stats"]);
    for key in ["wall_seconds", "render_seconds", "samples_per_second", "rays_per_second"] {
        assert!(stats[key].as_f64().unwrap() > 0.0, "{key}: {stats}");
    }
    let rays = ["camera", "scattered", "shadow", "total"].map(|k| stats["rays"][k].as_u64().unwrap());
    assert_eq!(rays[0], 64 * 48 * 4);
    assert_eq!(rays[0] + rays[1] + rays[2], rays[3]);
    assert_eq!((&stats["samples"], &stats["samples_per_pixel"]), (&(64 * 48 * 4).into(), &4.into()));
    assert_eq!((&stats["seed"], &stats["threads"], &stats["max_depth"]), (&0.into(), &2.into(), &1.into()));
    assert_eq!(stats["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(stats["resolution"], serde_json::json!([64, 48]));
    assert_eq!(stats["rejected_samples"], 0);
    let accelerator = &stats["acceleration_structure"];
    assert_eq!(accelerator["primitives"], 4);
    assert!(accelerator["bytes"].as_u64().unwrap() > 0 && accelerator["build_seconds"].is_number());
    let bytes = |name: &str| stats["memory"][name].as_u64().unwrap();
    let shapes: u64 = ["triangles", "patches", "curves", "quadrics", "instances"].map(bytes).iter().sum();
    assert_eq!(accelerator["bytes"].as_u64().unwrap(), shapes + bytes("hierarchy"));
    assert_eq!(stats["scene_bytes"].as_u64().unwrap(), shapes + bytes("hierarchy") + bytes("images"));
    assert_eq!(stats["film_bytes"].as_u64().unwrap(), bytes("film"));
    assert!(ran.err.contains("\nmemory: ") && ran.err.contains("hierarchy "), "{ran:?}");
    if cfg!(target_os = "linux") {
        assert!(stats["peak_memory_bytes"].as_u64().unwrap() > 1 << 20, "{stats}");
        assert!(stats["cpu_seconds"].as_f64().unwrap() > 0.0, "{stats}");
    }
}

#[test]
fn time_ends_a_render_without_a_number_of_samples() {
    let s = Scratch::new();
    let json = s.run("render room.pbrt --time 0.2 --json --quiet").ok().json();
    assert_eq!(json["status"], "time_limit");
    let stats = &json["stats"];
    assert!(stats["samples_per_pixel"].as_u64().unwrap() >= 1, "{stats}");
    assert!(stats["stopped"].as_bool().unwrap(), "{stats}");
    let wanted = stats["samples_per_pixel_wanted"].as_u64().unwrap();
    assert!(wanted >= 1 << 20, "{wanted}");
    assert_eq!(s.files(), ["named.exr", "named.png", "room.pbrt"]);
    // Every pixel of a scene under a sky has light, once it has a sample.
    assert!(bits(&s, "named.exr").iter().all(|p| f32::from_bits(p[2]) > 0.0));
}

#[test]
fn quiet_is_silent_and_warnings_come_once() {
    let s = Scratch::new();
    assert_eq!(s.run("render room.pbrt --quiet").ok().err, "");
    let film = "Film \"gbuffer\" \"integer xresolution\" 8 \"integer yresolution\" 8\n";
    s.put("warns.pbrt", &format!("{film}WorldBegin\nShape \"sphere\"\n"));
    let ran = s.run("render warns.pbrt --json").ok();
    let warnings: Vec<&str> = ran.err.lines().filter(|l| l.contains("warning:")).collect();
    assert_eq!(warnings.len(), 1, "{ran:?}");
    assert!(warnings[0].starts_with("warns.pbrt:1:6: warning: "), "{ran:?}");
    assert_eq!(ran.err.matches("the scene has no light").count(), 1, "{ran:?}");
    let json = ran.json();
    assert_eq!(json["warnings"][0]["line"], 1);
    assert_eq!(json["stats"]["warnings"], 1);
    assert_eq!(s.run("render warns.pbrt --quiet").ok().err, "");
}
