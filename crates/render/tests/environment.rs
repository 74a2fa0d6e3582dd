//! Environment maps: every technique finds the same light, compensated or not, square or latitude-longitude.

mod common;

use std::io::Write;
use std::path::PathBuf;

use common::{describe, mean, picture_of};

/// A grey PFM picture; the first row of `value` is the top one.
fn write_pfm(name: &str, width: usize, height: usize, value: impl Fn(usize, usize) -> f32) -> PathBuf {
    let path = std::env::temp_dir().join(format!("sparrow-{}-{name}.pfm", std::process::id()));
    let mut bytes = format!("PF\n{width} {height}\n-1.0\n").into_bytes();
    for y in (0..height).rev() {
        for x in 0..width {
            for _ in 0..3 {
                bytes.extend(value(x, y).to_le_bytes());
            }
        }
    }
    std::fs::File::create(&path)
        .and_then(|mut f| f.write_all(&bytes))
        .expect("a file in the temporary folder");
    path
}

/// A floor of reflectance 1/2 that faces +z, under the map.
fn floor_under(map: &std::path::Path, extra: &str) -> String {
    format!(
        r#"Film "rgb" "integer xresolution" 16 "integer yresolution" 16
        PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
        Sampler "zsobol" "integer pixelsamples" 1024
        Integrator "path" "integer maxdepth" 1 {extra}
        LookAt 0 0 1  0 0 0  0 1 0
        Camera "perspective" "float fov" 1
        WorldBegin
        AttributeBegin Rotate 30 0 0 1
        LightSource "infinite" "string filename" "{}"
        AttributeEnd
        Material "diffuse" "rgb reflectance" [ 0.5 0.5 0.5 ]
        Shape "disk" "float radius" 9"#,
        map.display()
    )
}

/// Checks the mean of the picture for every technique; `known` is the radiance of the floor.
fn check(map: &std::path::Path, known: f64) {
    for mis in [
        "balance",
        "power",
        "cutoff:0.2",
        "maximum",
        "average",
        "optimal",
        "one-sample",
        "light-only",
        "bsdf-only",
    ] {
        for compensation in ["true", "false"] {
            let extra = format!(r#""string mis" "{mis}" "bool miscompensation" {compensation}"#);
            let (film, _) = picture_of(describe(&floor_under(map, &extra)), 1);
            let (got, error) = mean(&film);
            for c in 0..3 {
                let allowed = 0.004 * known + 4.0 * error[c];
                assert!(
                    (got[c] - known).abs() < allowed,
                    "{mis} {compensation}: {got:?} +- {error:?}, {known}"
                );
            }
        }
    }
}

#[test]
fn bright_pixel_in_a_square_map() {
    let n = 16;
    let value = |x: usize, y: usize| if (x, y) == (9, 6) { 40.0 } else { 0.5 };
    let path = write_pfm("square", n, n, value);
    // Sum of radiance, cosine and solid angle over the pixels, each at 16 x 16 points.
    let (mut e, sub) = (0.0, 16);
    for i in 0..n * sub * n * sub {
        let (x, y) = (i % (n * sub), i / (n * sub));
        let st = [(x as f32 + 0.5) / (n * sub) as f32, (y as f32 + 0.5) / (n * sub) as f32];
        let d = sparrow_math::warp::equal_area_square_to_sphere(st);
        e += f64::from(value(x / sub, y / sub)) * f64::from(d.z.max(0.0));
    }
    e *= 4.0 * std::f64::consts::PI / (n * sub * n * sub) as f64;
    check(&path, e * 0.5 / std::f64::consts::PI);
    let _ = std::fs::remove_file(path);
}

#[test]
fn even_latitude_longitude_map_is_even() {
    let path = write_pfm("latlong", 64, 32, |_, _| 0.7);
    check(&path, 0.35);
    let _ = std::fs::remove_file(path);
}

#[test]
fn upper_half_of_a_latitude_longitude_map_is_the_sky() {
    // Rows above the middle are the directions with z above zero: they alone light a floor that faces up.
    let path = write_pfm("sky", 128, 64, |_, y| if y < 32 { 2.0 } else { 0.0 });
    check(&path, 1.0);
    let _ = std::fs::remove_file(path);
}
