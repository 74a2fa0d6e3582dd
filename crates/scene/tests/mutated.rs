//! Damaged scene texts: the reader answers, and never panics or hangs.

use std::path::Path;

use proptest::prelude::*;
use sparrow_scene::{SceneDesc, SceneError, read_str};

/// A text that touches every part of the reader.
const SCENE: &str = r#"
Option "seed" 3 ColorSpace "srgb" LookAt 3 4 1.5 .5 .5 0 0 0 1
Camera "perspective" "float fov" 45 "float screenwindow" [ -1 1 -1 1 ]
Sampler "halton" "integer pixelsamples" 128 Integrator "volpath" "string mis" "power:2"
PixelFilter "mitchell" "float B" .3 Film "rgb" "string filename" "a\\b.exr" "integer xresolution" [400]
ActiveTransform EndTime Rotate 10 0 1 0 ActiveTransform All TransformTimes 0 1
WorldBegin # comment
LightSource "infinite" "rgb L" [ .4 .45 .5 ] LightSource "spot" "blackbody I" 3000 "point3 from" [ 0 0 4 ]
AttributeBegin Attribute "shape" "float alpha" 0.5 ReverseOrientation
AreaLightSource "diffuse" "spectrum L" [ 400 1 500 2.5e-1 ] "bool twosided" true
Translate 1 2 3 Shape "sphere" "float radius" 1 Shape "disk" "float innerradius" .1 AttributeEnd
Texture "checks" "spectrum" "checkerboard" "float uscale" [ 16 ] "rgb tex1" [ .1 .1 .1 ] "rgb tex2" [ .8 .8 .8 ]
Texture "f" "float" "scale" "float tex" 2 "texture scale" "g" MakeNamedMedium "m" "string type" "cloud"
MakeNamedMaterial "metal" "string type" "conductor" "spectrum eta" "metal-Ag-eta" "float roughness" .1
Material "mix" "string materials" [ "metal" "metal" ] "float amount" .5 NamedMaterial "metal"
ObjectBegin "o" Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 ] Shape "bilinearmesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]
ObjectEnd ObjectInstance "o" Include "none.pbrt" MediumInterface "m" ""
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [ -20 -20 0 20 -20 0 20 20 0 -20 20 0 ]
  "point2 uv" [ 0 0 1 0 1 1 0 1 ] "normal N" [ 0 0 1 0 0 1 0 0 1 0 0 1 ]
"#;

fn read(text: &str) -> Result<SceneDesc, SceneError> {
    read_str(text, "t", Path::new("nowhere"))
}

/// Whatever comes in, faults have places inside the text and say something.
fn answer_is_sound(text: &str) {
    let n_lines = text.lines().count() as u32 + 1;
    let Err(e) = read(text) else { return };
    assert!(!e.faults.is_empty());
    for f in &e.faults {
        assert!(f.at.line <= n_lines && f.message.len() > 10, "{f:?}");
    }
}

/// Replaces a piece of the scene by something else.
fn mutated(at: usize, len: usize, by: &str) -> String {
    let start = (0..=at.min(SCENE.len())).rev().find(|&i| SCENE.is_char_boundary(i)).unwrap_or(0);
    let end = (start + len).min(SCENE.len());
    format!("{}{by}{}", &SCENE[..start], &SCENE[end..])
}

#[test]
fn the_text_itself_has_two_faults() {
    let e = read(SCENE).map(|_| ()).unwrap_err();
    let messages: Vec<&str> = e.faults.iter().map(|f| f.message.as_str()).collect();
    assert!(messages[0].starts_with("there is no float texture \"g\""), "{e}");
    assert!(messages[1].starts_with("\"none.pbrt\" cannot be read"), "{e}");
    assert_eq!(messages.len(), 2, "{e}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_piece_cut_out(at in 0..SCENE.len(), len in 0_usize..40) {
        answer_is_sound(&mutated(at, len, ""));
    }

    #[test]
    fn a_text_cut_off(at in 0..SCENE.len()) {
        answer_is_sound(&mutated(at, SCENE.len(), ""));
    }

    #[test]
    fn something_put_in(at in 0..SCENE.len(), len in 0_usize..8, by in "[ \\[\\]\"#\\\\a-zA-Z0-9.+\\-\n\r\t\u{e9}]{0,12}") {
        answer_is_sound(&mutated(at, len, &by));
    }

    #[test]
    fn a_piece_moved(from in 0..SCENE.len(), len in 1_usize..60, to in 0..SCENE.len()) {
        let piece = &SCENE[from..(from + len).min(SCENE.len())];
        answer_is_sound(&mutated(to, 0, piece));
    }

    #[test]
    fn numbers_of_all_sizes(at in 0..SCENE.len(), v in any::<f64>(), i in any::<i64>()) {
        // Behind the next number's place, so that it stands where a number is expected.
        let digit = SCENE[at..].find(|c: char| c.is_ascii_digit()).map_or(at, |d| at + d);
        answer_is_sound(&mutated(digit, 1, &format!("{v:e}")));
        answer_is_sound(&mutated(digit, 1, &i.to_string()));
    }

    #[test]
    fn any_text(text in "\\PC{0,200}") {
        answer_is_sound(&text);
    }
}

#[test]
fn a_long_line_is_read() {
    // Ten megabytes without a line break, as some exporters write.
    let n = 400_000;
    let mut text = String::from("WorldBegin Shape \"trianglemesh\" \"point3 P\" [");
    for i in 0..n {
        text += &format!(" {i}.125 -{i}.5e-1 1.");
    }
    text += " ] \"integer indices\" [";
    for i in 0..n / 4 {
        text += &format!(" {i} {} {}", i + 1, i + 2);
    }
    text += " ] Shape \"shpere\"";
    assert!(text.len() > 10_000_000);
    let e = read(&text).map(|_| ()).unwrap_err();
    assert_eq!((e.faults.len(), e.faults[0].at.column as usize), (1, text.len() - 7));
}
