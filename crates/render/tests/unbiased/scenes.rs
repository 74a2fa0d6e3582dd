//! Small scenes with every shape of light and every kind of scattering.

use std::f64::consts::{FRAC_1_PI, PI};

use sparrow_math::Real;

use crate::trial::Truth;

/// A scene and what is known of it.
pub(crate) struct Scene {
    pub(crate) name: &'static str,
    pub(crate) text: String,
    pub(crate) truth: Truth,
}

const FILM: &str = r#"Film "rgb" "integer xresolution" 16 "integer yresolution" 16
    PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
"#;

/// A floor of reflectance 1/2 in the plane z = 0, seen from above at one point, under a light.
fn spot(light: &str) -> String {
    format!(
        r#"{FILM} Integrator "path" "integer maxdepth" 1
        LookAt 0 0 0.5  0 0 0  0 1 0
        Camera "perspective" "float fov" 0.2
        WorldBegin
        AttributeBegin {light} AttributeEnd
        Material "diffuse" "rgb reflectance" [ 0.5 0.5 0.5 ]
        Shape "disk" "float radius" 9"#
    )
}

/// The floor with something on it, seen from the side, under lights.
fn room(depth: u32, material: &str, shape: &str, lights: &str) -> String {
    format!(
        r#"{FILM} Integrator "path" "integer maxdepth" {depth}
        LookAt 0 -4 1.6  0 0 0.6  0 0 1
        Camera "perspective" "float fov" 36
        WorldBegin
        AttributeBegin {lights} AttributeEnd
        Material "diffuse" "rgb reflectance" [ 0.6 0.5 0.3 ]
        Shape "disk" "float radius" 4
        Material {material}
        Translate 0 0 0.8
        {shape}"#
    )
}

const EMITS: &str = r#"AreaLightSource "diffuse" "rgb L" [ 5 5 5 ] "bool twosided" true"#;
const SPHERE: &str = r#"Shape "sphere" "float radius" 0.8"#;
/// A lamp above, a large one behind, and a sky.
const THREE_LIGHTS: &str = r#"LightSource "infinite" "rgb L" [ 0.2 0.25 0.3 ]
    AttributeBegin AreaLightSource "diffuse" "rgb L" [ 9 8 6 ] Translate -1.5 -1.5 2.6 Shape "sphere" "float radius" 0.6 AttributeEnd
    AttributeBegin AreaLightSource "diffuse" "rgb L" [ 2 3 4 ] "bool twosided" true
    Shape "trianglemesh" "point3 P" [ 2 -2 0.5  2 2 0.5  2 2 3  2 -2 3 ] "integer indices" [ 0 1 2 0 2 3 ] AttributeEnd"#;

/// The same ten times as far and as large, for strands: rays leave a strip a width beside it, so that what a lamp at a distance of a few
/// widths sends depends on the technique.
const FAR_LIGHTS: &str = r#"LightSource "infinite" "rgb L" [ 0.2 0.25 0.3 ]
    AttributeBegin AreaLightSource "diffuse" "rgb L" [ 9 8 6 ] Translate -15 -15 26 Shape "sphere" "float radius" 6 AttributeEnd
    AttributeBegin AreaLightSource "diffuse" "rgb L" [ 2 3 4 ] "bool twosided" true
    Shape "trianglemesh" "point3 P" [ 20 -20 5  20 20 5  20 20 30  20 -20 30 ] "integer indices" [ 0 1 2 0 2 3 ] AttributeEnd"#;

/// Radiance of the floor under irradiance `e`.
fn reflected(e: f64) -> Truth {
    Truth::Known(0.5 * FRAC_1_PI * e)
}

/// Irradiance under the middle of a square of radiance 5 and side 2 at height 2: four times its quarter. [Howell, C-11]
fn under_square() -> f64 {
    let (a, s) = (0.5f64, 1.25f64.sqrt());
    5.0 * PI * 4.0 * (2.0 * a / s * Real::atan2(a / s, 1.0)) / (2.0 * PI)
}

/// More lamps than are weighed one by one: a spiral of triangles that face all ways, and a sky.
///
/// No point and no spot: `bsdf-only` finds neither.
fn many_lights() -> String {
    let (mut points, mut indices) = (String::new(), String::new());
    for i in 0..90 {
        let t = f64::from(i);
        let (sin, cos) = Real::sin_cos(0.7 * t);
        let r = 0.9 + 0.02 * t;
        let (x, y, z) = (r * cos, r * sin, 0.15 + 0.025 * t);
        let (a, b) = (0.2 + 0.1 * (0.618 * t).fract(), 0.15 * Real::sin(2.3 * t));
        points += &format!("{x} {y} {z} {} {} {} {} {} {} ", x + a, y + b, z, x - b, y + a, z + 2.0 * b);
        indices += &format!("{} {} {} ", 3 * i, 3 * i + 1, 3 * i + 2);
    }
    format!(
        r#"LightSource "infinite" "rgb L" [ 0.1 0.12 0.15 ]
    AttributeBegin AreaLightSource "diffuse" "rgb L" [ 3 2.5 2 ]
    Shape "trianglemesh" "point3 P" [ {points} ] "integer indices" [ {indices} ] AttributeEnd"#
    )
}

/// All of them; `map` is a picture of an environment.
pub(crate) fn all(map: &std::path::Path) -> Vec<Scene> {
    let scene = |name, text, truth| Scene { name, text, truth };
    let map = format!(r#"Rotate 40 1 2 3 LightSource "infinite" "string filename" "{}""#, map.display());
    // Light that comes by another way than the portal is left to the BSDF.
    let through_portal = format!(r#"{map} "point3 portal" [ -2 -2 3  -2 2 3  2 2 3  2 -2 3 ]"#);
    let copper = r#""conductor" "float uroughness" 0.4 "float vroughness" 0.12"#;
    let glass = r#""dielectric" "float eta" 1.5 "float roughness" 0.25"#;
    let hair = r#""hair" "rgb sigma_a" [ 0.1 0.2 0.5 ] "float beta_m" 0.4 "float beta_n" 0.5"#;
    let strands = r#"Shape "curve" "string type" "cylinder" "float width" 0.5 "point3 P" [ -0.9 0 -0.7  -0.6 0 0.6  0 0 0.9  0.2 0 -0.3 ]
        Shape "curve" "string type" "cylinder" "float width" 0.5 "point3 P" [ 0.8 0 -0.7  0.6 -0.2 0  0.6 0.2 0.6  0.1 0 1.2 ]"#;
    vec![
        // The sphere's irradiance is pi L (r / d)^2, the disk's pi L r^2 / (r^2 + h^2).
        scene(
            "sphere",
            spot(&format!(r#"{EMITS} Translate 0 0 3 Shape "sphere" "float radius" 1.5"#)),
            reflected(5.0 * PI * 0.25),
        ),
        scene(
            "disk",
            spot(&format!(r#"{EMITS} Shape "disk" "float height" 2 "float radius" 1.5"#)),
            reflected(5.0 * PI * 2.25 / 6.25),
        ),
        scene(
            "triangles",
            spot(&format!(
                r#"{EMITS} Shape "trianglemesh" "point3 P" [ -1 -1 2  1 -1 2  1 1 2  -1 1 2 ] "integer indices" [ 0 1 2 0 2 3 ]"#
            )),
            reflected(under_square()),
        ),
        scene(
            "cylinder",
            spot(&format!(
                r#"{EMITS} Translate -1 0 1.8 Rotate 90 0 1 0 Shape "cylinder" "float radius" 0.7 "float zmin" 0 "float zmax" 2"#
            )),
            Truth::Long,
        ),
        scene(
            "bilinear patch",
            spot(&format!(
                r#"{EMITS} Shape "bilinearmesh" "point3 P" [ -1 -1 1.5  1 -1 2.5  -1 1 2.4  1 1 1.2 ]"#
            )),
            Truth::Long,
        ),
        // Emission L and reflectance r everywhere: L / (1 - r).
        scene(
            "closed sphere",
            format!(
                r#"{FILM} Integrator "path" "integer maxdepth" 60 WorldBegin
            AreaLightSource "diffuse" "rgb L" [ 1 1 1 ] "bool twosided" true
            Material "diffuse" "rgb reflectance" [ 0.5 0.5 0.5 ] Shape "sphere" "float radius" 2"#
            ),
            Truth::Known(2.0),
        ),
        scene(
            "environment map",
            room(2, r#""diffuse" "rgb reflectance" [ 0.7 0.7 0.7 ]"#, SPHERE, &map),
            Truth::Long,
        ),
        scene(
            "portal",
            room(2, r#""diffuse" "rgb reflectance" [ 0.7 0.7 0.7 ]"#, SPHERE, &through_portal),
            Truth::Long,
        ),
        scene("anisotropic metal", room(3, copper, SPHERE, THREE_LIGHTS), Truth::Long),
        scene("glass", room(5, glass, SPHERE, THREE_LIGHTS), Truth::Long),
        scene("many lights", room(2, copper, SPHERE, &many_lights()), Truth::Long),
        scene("hair", room(3, hair, strands, FAR_LIGHTS), Truth::Long),
    ]
}

/// The same scene with one lamp brighter by this factor: what a density too small by it does to light sampling.
pub(crate) fn planted(text: &str, lamp: &str, factor: f64) -> String {
    let scale = |word: &str| word.parse().map_or(word.to_owned(), |l: f64| (factor * l).to_string());
    let brighter = lamp.split(' ').map(scale).collect::<Vec<_>>().join(" ");
    assert!(text.contains(lamp), "the scene has no such lamp");
    text.replacen(lamp, &brighter, 1)
}
