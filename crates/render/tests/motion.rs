//! What moves while the shutter is open, against the share of time that it covers a pixel.

mod common;

use common::picture;

/// Half the width of the sheet that moves across the picture, and how far its middle goes to both sides.
const HALF: f64 = 0.25;
const REACH: f64 = 0.5;
/// Pixels across the picture, which shows -1 to 1.
const WIDTH: u32 = 16;

/// A black sheet before a white sky. `camera` and `sheet` stand where the camera and the sheet are placed.
fn scene(camera: &str, sheet: &str) -> String {
    format!(
        r#"{camera}
        Camera "orthographic" "float screenwindow" [-1 1 -0.125 0.125]
        Film "rgb" "integer xresolution" {WIDTH} "integer yresolution" 2
        PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
        Sampler "independent" "integer pixelsamples" 4096
        WorldBegin
        LightSource "infinite" "rgb L" [1 1 1]
        Material "diffuse" "rgb reflectance" [0 0 0]
        {sheet}"#
    )
}

const SHEET: &str = r#"Shape "bilinearmesh" "point3 P" [-0.25 -1 1  0.25 -1 1  -0.25 1 1  0.25 1 1]"#;

/// Moves from `a` to `b` along x.
fn motion(a: f64, b: f64) -> String {
    format!(
        "ActiveTransform StartTime Translate {a} 0 0 ActiveTransform EndTime Translate {b} 0 0 ActiveTransform All "
    )
}

/// The share of the time from `from` to `to`, of a motion from 0 to 1, that the sheet covers the column of pixels `x`.
fn covered(x: u32, from: f64, to: f64) -> f64 {
    let n = 1000;
    let at = |k: u32| (f64::from(k) + 0.5) / f64::from(n);
    let share = |time: f64| {
        let center = REACH * (2.0 * time - 1.0);
        let pixel = 2.0 / f64::from(WIDTH);
        let left = -1.0 + pixel * f64::from(x);
        let overlap = (left + pixel).min(center + HALF) - left.max(center - HALF);
        overlap.max(0.0) / pixel
    };
    (0..n).map(|k| share(from + (to - from) * at(k))).sum::<f64>() / f64::from(n)
}

fn check(text: &str, from: f64, to: f64) {
    let film = picture(text);
    for x in 0..WIDTH {
        for y in 0..2 {
            let p = film.pixel(x, y);
            let want = 1.0 - covered(x, from, to);
            // Five standard errors of a count of 4096, and the one in 10^4 that sensor and sky are off white.
            let room = 5.0 * (want * (1.0 - want) / 4096.0).sqrt() + 2e-3;
            assert!((p.rgb[1] - want).abs() < room, "{text}\n{x} {y}: {} not {want}", p.rgb[1]);
        }
    }
}

#[test]
fn a_moving_shape_covers_what_it_passes() {
    check(&scene("", &format!("{}{SHEET}", motion(-REACH, REACH))), 0.0, 1.0);
}

#[test]
fn a_moving_instance_covers_what_it_passes() {
    let sheet =
        format!("ObjectBegin \"sheet\" {SHEET} ObjectEnd {} ObjectInstance \"sheet\"", motion(-REACH, REACH));
    check(&scene("", &sheet), 0.0, 1.0);
}

/// To a camera that goes to the left, everything goes to the right.
#[test]
fn a_moving_camera_sees_what_stands_move() {
    check(&scene(&motion(-REACH, REACH), SHEET), 0.0, 1.0);
}

/// The shutter is open from 1 to 2, and motion lasts from 0 to 4.
#[test]
fn the_shutter_sees_its_part_of_the_motion() {
    let text = scene("TransformTimes 0 4", &format!("{}{SHEET}", motion(-REACH, REACH)));
    let text =
        text.replace("\"orthographic\"", "\"orthographic\" \"float shutteropen\" 1 \"float shutterclose\" 2");
    check(&text, 0.25, 0.5);
}

/// Shadows move with what casts them: the sheet's own shadow rays have the time of their path.
#[test]
fn a_shape_and_its_lamp_in_one_object_look_alike_at_any_time() {
    // A black floor of the moving object shades the white wall that moves with it: no light at any time.
    let moving = r#"Material "diffuse" "rgb reflectance" [1 1 1]
        Shape "bilinearmesh" "point3 P" [-0.25 -1 2  0.25 -1 2  -0.25 1 2  0.25 1 2]
        Material "diffuse" "rgb reflectance" [0 0 0]
        Shape "bilinearmesh" "point3 P" [-9 -9 2.1  9 -9 2.1  -9 9 2.1  9 9 2.1]"#;
    let sheet = format!(
        "LightSource \"distant\" \"point3 from\" [0 0 9] \"point3 to\" [0 0 0] {}{moving}",
        motion(-REACH, REACH)
    );
    let film = picture(&scene("", &sheet).replace("LightSource \"infinite\" \"rgb L\" [1 1 1]", ""));
    let black = |x: u32| film.pixel(x, 0).rgb.iter().all(|c| c.abs() < 1e-9);
    assert!((0..WIDTH).all(black), "light from behind");
}
