//! What moves while the shutter is open, against the share of time that it covers a pixel, and against stills.

mod common;

use common::{describe, picture, picture_of};
use sparrow_scene::SceneDesc;

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

/// The sheet, each of its corners going its way by itself.
const DEFORMING: &str = r#"Shape "bilinearmesh" "point3 P" [-0.75 -1 1  -0.25 -1 1  -0.75 1 1  -0.25 1 1]
    "point3 P_end" [0.25 -1 1  0.75 -1 1  0.25 1 1  0.75 1 1]"#;

#[test]
fn vertices_that_move_cover_what_they_pass() {
    check(&scene("", DEFORMING), 0.0, 1.0);
    let triangles = DEFORMING.replace("bilinearmesh", "trianglemesh") + "\"integer indices\" [0 1 3  0 3 2]";
    check(&scene("", &triangles), 0.0, 1.0);
    // A strand as wide as the sheet, along the picture's height.
    let strand = r#"Shape "curve" "string basis" "linear" "string type" "flat" "float width" 0.5
        "point3 P" [-0.5 -1 1  -0.5 1 1] "point3 P_end" [0.5 -1 1  0.5 1 1]"#;
    check(&scene("", strand), 0.0, 1.0);
    let instance = format!("ObjectBegin \"sheet\" {DEFORMING} ObjectEnd ObjectInstance \"sheet\"");
    check(&scene("", &instance), 0.0, 1.0);
}

/// Half of the way by the vertices, half by the transform.
#[test]
fn vertices_and_shapes_move_together() {
    let sheet = r#"Shape "bilinearmesh" "point3 P" [-0.5 -1 1  0 -1 1  -0.5 1 1  0 1 1]
        "point3 P_end" [0 -1 1  0.5 -1 1  0 1 1  0.5 1 1]"#;
    check(&scene("", &format!("{}{sheet}", motion(-0.25, 0.25))), 0.0, 1.0);
}

/// What bends: a wall with its normals, and a strand with its widths.
const BENDING: [(&str, &[f64], &[f64]); 4] = [
    (
        "point3 P",
        &[-1., -1., 2., 1., -1., 2., -1., 1., 2., 1., 1., 2.],
        &[-1., -1., 2., 1., -1., 3., -1., 1., 1., 1., 1., 2.],
    ),
    (
        "normal N",
        &[0., 0., -1., 0., 0., -1., 0., 0., -1., 0., 0., -1.],
        &[0.3, 0., -1., 0., 0.4, -1., -0.3, 0., -1., 0., -0.2, -1.],
    ),
    (
        "point3 P",
        &[-0.8, -0.9, 0., -0.5, -0.4, 0., -0.6, 0.3, 0., -0.2, 0.9, 0.],
        &[0.5, -0.9, 0., 0.9, -0.4, 0.3, 0.1, 0.3, 0., 0.2, 0.9, 0.5],
    ),
    ("float width", &[0.4], &[0.7]),
];

/// A lit scene of what bends: in motion, or as it stands at a time.
fn bending(time: Option<f64>, samples: u32) -> String {
    let list = |v: &[f64]| v.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let [wall, normals, strand, width] = BENDING.map(|(name, start, end)| match time {
        None => format!("\"{name}\" [{}] \"{name}_end\" [{}]", list(start), list(end)),
        Some(t) => {
            let between: Vec<f64> = start.iter().zip(end).map(|(a, b)| a + (b - a) * t).collect();
            format!("\"{name}\" [{}]", list(&between))
        }
    });
    format!(
        r#"Camera "orthographic" "float screenwindow" [-1 1 -1 1]
        Film "rgb" "integer xresolution" 6 "integer yresolution" 6
        PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
        Sampler "independent" "integer pixelsamples" {samples}
        Integrator "path" "integer maxdepth" 2
        WorldBegin
        LightSource "distant" "point3 from" [1 1 -2] "point3 to" [0 0 0]
        Shape "trianglemesh" "integer indices" [0 1 3  0 3 2] {wall} {normals}
        Shape "curve" "string type" "round" {strand} {width}"#
    )
}

/// The picture of a motion is the mean of the stills of its time.
#[test]
fn motion_is_the_mean_of_its_stills() {
    const STILLS: u32 = 32;
    let moving = picture(&bending(None, STILLS * 256));
    // Each with numbers of its own: noise that all shared would not average out.
    let still = |k: u32| {
        let time = (f64::from(k) + 0.5) / f64::from(STILLS);
        picture_of(SceneDesc { seed: u64::from(k) + 1, ..describe(&bending(Some(time), 256)) }, 1).0
    };
    let stills: Vec<_> = (0..STILLS).map(still).collect();
    let mut changing = 0;
    for (x, y) in (0..36).map(|i| (i % 6, i / 6)) {
        let found = moving.pixel(x, y);
        for c in 0..3 {
            let n = f64::from(STILLS);
            let values: Vec<f64> = stills.iter().map(|s| s.pixel(x, y).rgb[c]).collect();
            let (mean, top) = (values.iter().sum::<f64>() / n, values.iter().copied().fold(0.0, f64::max));
            let variance = stills.iter().map(|s| s.pixel(x, y).variance[c]).sum::<f64>() / (n * n);
            // Five standard errors, and what the light between the middles of 32 times can differ from their mean.
            let room = 5.0 * (found.variance[c] + variance).sqrt() + 0.005 * top;
            let miss = (found.rgb[c] - mean).abs();
            assert!(miss < room, "pixel {x} {y}: {} not {mean}, within {room}", found.rgb[c]);
            changing += u32::from(values.iter().any(|v| (v - mean).abs() > 5.0 * room));
        }
    }
    assert!(changing > 30, "{changing}");
}

#[test]
fn threads_do_not_matter_to_what_deforms() {
    let taken = |threads: usize| picture_of(describe(&bending(None, 16)), threads).0;
    let (one, three) = (taken(1), taken(3));
    for (x, y) in (0..36).map(|i| (i % 6, i / 6)) {
        let bits = |film: &sparrow_render::film::Film| film.pixel(x, y).rgb.map(f64::to_bits);
        assert_eq!(bits(&one), bits(&three), "pixel {x} {y}");
    }
}
