//! A scene with instances is the same scene written out, and holds what is placed often only once.

#![allow(clippy::unwrap_used, reason = "writing to a string cannot fail, and a test panics when it does")]

mod common;

use std::fmt::Write;

use common::{describe, picture};
use sparrow_render::compile;
use sparrow_render::film::Film;

const HEAD: &str = r#"
    Film "rgb" "integer xresolution" 72 "integer yresolution" 54
    Sampler "zsobol" "integer pixelsamples" 16
    Integrator "path" "integer maxdepth" 5
    LookAt 0 2.5 7  0 0.6 0  0 1 0
    Camera "perspective" "float fov" 40
    WorldBegin
    LightSource "infinite" "rgb L" [ 0.3 0.35 0.4 ]
    AttributeBegin
      AreaLightSource "diffuse" "rgb L" [ 20 18 15 ]
      Translate 2 5 3
      Shape "sphere" "float radius" 0.5
    AttributeEnd
    Texture "holes" "float" "checkerboard" "float uscale" 6 "float vscale" 6 "float tex1" 0 "float tex2" 1
    Texture "squares" "spectrum" "checkerboard" "float uscale" 4 "float vscale" 4
      "rgb tex1" [ 0.7 0.2 0.1 ] "rgb tex2" [ 0.1 0.3 0.6 ]
    Material "diffuse" "rgb reflectance" [ 0.5 0.5 0.45 ]
    Shape "bilinearmesh" "point3 P" [ -9 0 -9  9 0 -9  -9 0 9  9 0 9 ]
"#;

/// What the object holds: every kind of shape, a texture, a cut-out, a material that rays pass, and transforms of its own.
const BODY: &str = r#"
    AttributeBegin
      Material "diffuse" "texture reflectance" "squares"
      Translate 0 0.5 0
      Shape "sphere" "float radius" 0.45 "float zmax" 0.3
    AttributeEnd
    AttributeBegin
      Material "conductor" "float uroughness" 0.3 "float vroughness" 0.1
      Translate 0.7 0 0 Rotate -90 1 0 0
      Shape "cylinder" "float radius" 0.2 "float zmin" 0 "float zmax" 0.8
    AttributeEnd
    AttributeBegin
      Material "diffuse" "rgb reflectance" [ 0.2 0.6 0.2 ]
      Translate -0.6 0 0.3
      Shape "trianglemesh" "point3 P" [ -0.3 0 0  0.3 0 0  0 0.9 -0.2  0 0 -0.5 ] "integer indices" [ 0 1 2  1 3 2  3 0 2 ]
      Shape "bilinearmesh" "point3 P" [ -0.3 1 0  0.3 1.1 0  -0.3 1.4 0.1  0.3 1.5 -0.2 ] "point2 uv" [ 0 0 1 0 0 1 1 1 ]
        "texture alpha" "holes"
    AttributeEnd
    AttributeBegin
      Material "diffuse" "rgb reflectance" [ 0.6 0.5 0.1 ]
      Shape "curve" "string type" "cylinder" "float width" 0.08 "point3 P" [ 0 0.9 0  0.1 1.4 0.1  0.5 1.5 0  0.6 1.1 0.2 ]
      Material "interface"
      Shape "sphere" "float radius" 0.9
    AttributeEnd
"#;

/// Turned, scaled and stretched; "b" stands in one place only.
const PLACES: [(&str, &str); 5] = [
    ("a", "Translate -2 0 0 Rotate 30 0 1 0"),
    ("a", "Translate 0.2 0 -1 Scale 1.3 1.3 1.3"),
    ("b", "Translate 1.8 0 0.5 Rotate -40 0 1 0"),
    ("a", "Translate -0.7 0 2 Scale 0.6 0.5 0.6"),
    ("a", "Translate 2.5 0 -2.5 Rotate 200 0 1 0"),
];

fn instanced(body: &str, places: &[(&str, &str)]) -> String {
    let mut text = HEAD.to_string();
    for name in ["a", "b", "never"] {
        write!(text, "ObjectBegin \"{name}\" {body} ObjectEnd ").unwrap();
    }
    for (name, place) in places {
        write!(text, "AttributeBegin {place} ObjectInstance \"{name}\" AttributeEnd ").unwrap();
    }
    text
}

fn written_out(body: &str, places: &[(&str, &str)]) -> String {
    let copies = places.iter().map(|(_, place)| format!("AttributeBegin {place} {body} AttributeEnd "));
    format!("{HEAD}{}", copies.collect::<String>())
}

fn pixels(film: &Film) -> Vec<[f64; 3]> {
    let xy = (0..film.height()).flat_map(|y| (0..film.width()).map(move |x| (x, y)));
    xy.map(|(x, y)| film.pixel(x, y).rgb).collect()
}

/// The same samples meet the same surfaces: pixels differ by rounding alone, but for those where a sample met an edge or the
/// rounding turned a path's choice, which must be few.
fn looks_the_same(body: &str, places: &[(&str, &str)]) {
    let (a, b) = (pixels(&picture(&instanced(body, places))), pixels(&picture(&written_out(body, places))));
    let differs = |a: &[f64; 3], b: &[f64; 3]| (0..3).any(|c| (a[c] - b[c]).abs() > 1e-3 * (a[c] + b[c]));
    let n = a.iter().zip(&b).filter(|(a, b)| differs(a, b)).count();
    assert!(n * 50 < a.len(), "{n} of {} pixels differ", a.len());
    let mean = |p: &[[f64; 3]]| p.iter().flatten().sum::<f64>() / (3 * p.len()) as f64;
    assert!((mean(&a) / mean(&b) - 1.0).abs() < 1e-3, "{} {}", mean(&a), mean(&b));
}

#[test]
fn instances_look_like_copies() {
    looks_the_same(BODY, &PLACES);
}

/// Meshes alone: a quadric that is mirrored as an instance keeps its outside, one that is mirrored as a shape turns it in, as in
/// pbrt-v4.
#[test]
fn mirrored_meshes_look_like_copies() {
    let glass = r#"
        Material "dielectric"
        Shape "trianglemesh" "point3 P" [ -0.6 0.1 -0.6  0.6 0.1 -0.6  0 0.1 0.7  0.2 1.2 0 ]
          "integer indices" [ 0 1 2  0 3 1  1 3 2  2 3 0 ]"#;
    let places = [("a", "Translate -1 0 0 Scale -1 1 1"), ("a", "Translate 1 0 0"), ("b", "Scale 1 1 -1")];
    looks_the_same(glass, &places);
}

#[test]
fn a_mirrored_sphere_looks_the_same_in_one_place_and_in_two() {
    let ball = "Material \"dielectric\" Translate 0 1 0 Shape \"sphere\"";
    let near = ("a", "Scale -1 1 1");
    let one = pixels(&picture(&instanced(ball, &[near])));
    let two = pixels(&picture(&instanced(ball, &[near, ("a", "Translate 0 -50 0")])));
    assert_eq!(one, two);
}

#[test]
fn only_what_stands_in_several_places_is_instanced() {
    let compiled = |text: &str| compile(describe(text)).unwrap();
    let (a, b) = (compiled(&instanced(BODY, &PLACES)), compiled(&written_out(BODY, &PLACES)));
    let n = |c: &sparrow_render::Compiled| c.scene.geometry().n_shapes();
    // Floor and lamp; then 5 shapes that are seen, of "a" once and of "b" once, against 5 copies.
    assert_eq!((n(&a), n(&b)), (2 + 2 * 5, 2 + 5 * 5));
    assert!(a.notes.is_empty(), "{:?}", a.notes);
}

/// A bumpy sheet of `2 n^2` triangles.
fn sheet(n: usize) -> String {
    let mut text = String::from("Shape \"trianglemesh\" \"point3 P\" [");
    for i in 0..(n + 1) * (n + 1) {
        let (x, y) = (i % (n + 1), i / (n + 1));
        write!(text, " {x} {} {y}", (x * 7 + y * 13) % 5).unwrap();
    }
    text += "] \"integer indices\" [";
    for (x, y) in (0..n).flat_map(|y| (0..n).map(move |x| (x, y))) {
        let (a, c) = (y * (n + 1) + x, (y + 1) * (n + 1) + x);
        write!(text, " {a} {} {c} {} {} {c}", a + 1, a + 1, c + 1).unwrap();
    }
    text + "]"
}

/// A thousand instances of 100,352 triangles take as much memory as the mesh, and at most 200 bytes each.
#[test]
fn a_mesh_is_held_once() {
    let mesh = sheet(224);
    let bytes = |text: &str| compile(describe(text)).unwrap().scene.bytes();
    let one = bytes(&format!("WorldBegin {mesh}"));
    let mut text = format!("WorldBegin ObjectBegin \"o\" {mesh} ObjectEnd ");
    for i in 0..1000 {
        write!(
            text,
            "AttributeBegin Translate {} 0 {} ObjectInstance \"o\" AttributeEnd ",
            i % 40 * 300,
            i / 40 * 300
        )
        .unwrap();
    }
    let many = bytes(&text);
    assert!(many < one + 200 * 1000, "{one} bytes for one, {many} for a thousand");
}
