//! `sparrow info`: counts, and what was not understood.

use crate::scratch::Scratch;

#[test]
fn a_scene_is_counted() {
    let s = Scratch::new();
    let json = s.run("info room.pbrt --json").ok().json();
    let shapes = &json["shapes"];
    assert_eq!(
        (&shapes["triangles"], &shapes["spheres"], &shapes["total"]),
        (&2.into(), &2.into(), &3.into())
    );
    let lights = &json["lights"];
    assert_eq!((&lights["infinite"], &lights["emitting_shapes"]), (&1.into(), &1.into()));
    let materials = json["materials"].as_array().unwrap();
    let conductor = materials.iter().find(|m| m["type"] == "conductor").unwrap();
    assert_eq!((&conductor["model"], &conductor["shapes"]), (&"conductor".into(), &1.into()));
    assert_eq!(json["film"]["resolution"], serde_json::json!([64, 48]));
    assert_eq!(json["camera"]["position"], serde_json::json!([0.0, 1.0, -4.0]));
    assert_eq!(
        (&json["sampler"]["samples_per_pixel"], &json["sampler"]["name"]),
        (&4.into(), &"zsobol".into())
    );
    assert_eq!((&json["integrator"]["name"], &json["integrator"]["max_depth"]), (&"path".into(), &3.into()));
    assert_eq!(json["statements"]["Shape sphere"], 2);
    assert_eq!(json["files"], serde_json::json!(["room.pbrt"]));
    assert_eq!(json["warnings"], serde_json::json!([]));
    let text = s.run("info room.pbrt").ok().out;
    for part in [
        "2 triangles, 2 spheres",
        "64 x 48 pixels",
        "1 uniform infinite light, 1 emitting shape",
        "none: everything",
    ] {
        assert!(text.contains(part), "`{part}` is not in {text}");
    }
    assert_eq!(s.files(), ["room.pbrt"]);
}

#[test]
fn objects_are_counted_once_and_their_instances_apart() {
    let s = Scratch::new();
    let mesh = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]";
    let object = format!("ObjectBegin \"a\"\n{mesh}\nObjectEnd\n");
    s.put(
        "many.pbrt",
        &format!("WorldBegin\n{object}{}", "Translate 1 0 0 ObjectInstance \"a\"\n".repeat(3)),
    );
    let json = s.run("info many.pbrt --json").ok().json();
    let counts = ["triangles", "meshes", "distinct_meshes"].map(|k| json["shapes"][k].as_u64().unwrap());
    assert_eq!(counts, [1, 1, 1]);
    assert_eq!(json["instances"], serde_json::json!({ "total": 3, "prototypes": 1, "shapes": 1 }));
    assert_eq!(json["materials"][0]["shapes"], 1);
    assert!(s.run("info many.pbrt").ok().out.contains("3 of 1 object with 1 shape"));
}

#[test]
fn the_estimate_of_memory_is_near() {
    let s = Scratch::new();
    let side = 40;
    let points: Vec<String> =
        (0..=side).flat_map(|y| (0..=side).map(move |x| format!("{x} {y} 0"))).collect();
    let corner = |x: u32, y: u32| y * (side + 1) + x;
    let quads = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    let faces: Vec<String> = quads
        .map(|(x, y)| {
            let [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)];
            format!("{a} {b} {c} {a} {c} {d}")
        })
        .collect();
    let mesh = format!("\"point3 P\" [{}] \"integer indices\" [{}]", points.join(" "), faces.join(" "));
    let film = "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n";
    s.put("grid.pbrt", &format!("{film}WorldBegin\nShape \"trianglemesh\" {mesh}\n"));
    let guess = s.run("info grid.pbrt --json").ok().json()["geometry_bytes_estimate"].as_f64().unwrap();
    let run = s.run("render grid.pbrt --json --quiet").ok().json();
    let bytes = run["stats"]["acceleration_structure"]["bytes"].as_f64().unwrap();
    assert!((guess / bytes - 1.0).abs() < 0.4, "guessed {guess}, took {bytes}");
}

#[test]
fn what_is_not_understood_is_told_with_its_place() {
    let s = Scratch::new();
    s.put("film.pbrt", "Film \"gbuffer\" \"integer xresolution\" 8\nWorldBegin\n");
    let json = s.run("info film.pbrt --json").ok().json();
    assert_eq!((&json["warnings"][0]["line"], &json["warnings"][0]["column"]), (&1.into(), &6.into()));
    assert!(s.run("info film.pbrt").ok().out.contains("film.pbrt:1:6: "));
}
