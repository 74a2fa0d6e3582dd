//! Scenes whose radiance is known.

mod common;

use common::{mean, picture};

/// The film of all tests; a colour of RGB (1, 1, 1) is seen as 1.
const FILM: &str = r#"Film "rgb" "integer xresolution" 16 "integer yresolution" 16
    PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
"#;

fn check(what: &str, text: &str, want: [f64; 3], tolerance: f64) {
    let (got, error) = mean(&picture(text));
    for c in 0..3 {
        let allowed = tolerance * want[c].abs() + 4.0 * error[c];
        assert!((got[c] - want[c]).abs() < allowed, "{what}: {got:?} +- {error:?}, known {want:?}");
    }
}

#[test]
fn inside_a_closed_diffuse_sphere_light_multiplies() {
    // Emission L and reflectance r everywhere: L (1 + r + r^2 + ...) = L / (1 - r) in every direction.
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
        let text = format!(
            r#"{FILM} Sampler "zsobol" "integer pixelsamples" 64
            Integrator "path" "integer maxdepth" 60 "string mis" "{mis}"
            WorldBegin
            AreaLightSource "diffuse" "rgb L" [ 1 1 1 ] "bool twosided" true
            Material "diffuse" "rgb reflectance" [ 0.5 0.5 0.5 ]
            Shape "sphere" "float radius" 2"#
        );
        check(mis, &text, [2.0; 3], 0.003);
    }
}

#[test]
fn white_furnace() {
    let under_sky = |material: &str, extra: &str| {
        format!(
            r#"{FILM} Sampler "zsobol" "integer pixelsamples" 256
            Integrator "path" "integer maxdepth" 100 {extra}
            LookAt 0 0 -3  0 0 0  0 1 0
            Camera "perspective" "float fov" 20
            WorldBegin
            LightSource "infinite" "rgb L" [ 1 1 1 ]
            Material {material}
            Shape "sphere" "float radius" 1"#
        )
    };
    for extra in ["", r#""bool miscompensation" false"#] {
        check(
            "white diffuse",
            &under_sky(r#""diffuse" "rgb reflectance" [ 1 1 1 ]"#, extra),
            [1.0; 3],
            0.003,
        );
    }
    // A fibre's own cosine counts, not that with the sphere's normal; light arrives from both sides.
    for extra in ["", r#""string mis" "light-only""#, r#""string mis" "bsdf-only""#] {
        let hair = r#""hair" "rgb sigma_a" [ 0 0 0 ] "float beta_m" 0.6 "float beta_n" 0.7"#;
        check("white hair", &under_sky(hair, extra), [1.0; 3], 0.003);
    }
    check("smooth glass", &under_sky(r#""dielectric" "float eta" 1.5"#, ""), [1.0; 3], 0.003);
    check("thin glass", &under_sky(r#""thindielectric" "float eta" 1.5"#, ""), [1.0; 3], 0.003);
    check(
        "diffuse transmission",
        &under_sky(
            r#""diffusetransmission" "rgb reflectance" [ .5 .5 .5 ] "rgb transmittance" [ .5 .5 .5 ]"#,
            "",
        ),
        [1.0; 3],
        0.003,
    );
    check("nothing there", &under_sky(r#""interface""#, ""), [1.0; 3], 1e-3);
}

/// A diffuse floor of reflectance 1/2 seen straight from above, with a light.
fn lit_floor(light: &str) -> String {
    format!(
        r#"{FILM} Sampler "zsobol" "integer pixelsamples" 256
        Integrator "path" "integer maxdepth" 1
        LookAt 0 0 1  0 0 0  0 1 0
        Camera "perspective" "float fov" 0.2
        WorldBegin
        {light}
        Material "diffuse" "rgb reflectance" [ 0.5 0.5 0.5 ]
        Shape "trianglemesh" "point3 P" [ -9 -9 0  9 -9 0  9 9 0  -9 9 0 ] "integer indices" [ 0 1 2 0 2 3 ]"#
    )
}

const HALF_OVER_PI: f64 = 0.5 / std::f64::consts::PI;

#[test]
fn point_distant_and_spot_lights_on_a_floor() {
    // E = I cos / d^2 = 3 * (2 / sqrt 5) / 5 at height 2, one unit aside.
    let e = 3.0 * 2.0 / 5.0f64.sqrt() / 5.0;
    let point = lit_floor(r#"LightSource "point" "rgb I" [ 3 3 3 ] "point3 from" [ 1 0 2 ]"#);
    // However lights and directions share the work, only light sampling finds a point.
    for mis in sparrow_mis::Mis::EXAMPLES.into_iter().filter(|mis| *mis != "bsdf-only") {
        let text = point.replace("\"path\"", &format!("\"path\" \"string mis\" \"{mis}\""));
        check(&format!("point, {mis}"), &text, [e * HALF_OVER_PI; 3], 0.004);
    }
    let spot = r#"LightSource "spot" "rgb I" [ 3 3 3 ] "point3 from" [ 1 0 2 ] "point3 to" [ 0 0 0 ] "float coneangle" 20"#;
    check("spot", &lit_floor(spot), [e * HALF_OVER_PI; 3], 0.004);
    let e = 4.0 * std::f64::consts::FRAC_1_SQRT_2;
    let distant = r#"LightSource "distant" "rgb L" [ 4 4 4 ] "point3 from" [ 0 1 1 ] "point3 to" [ 0 0 0 ]"#;
    check("distant", &lit_floor(distant), [e * HALF_OVER_PI; 3], 0.004);
}

#[test]
fn area_lights_on_a_floor_for_each_heuristic_and_shape() {
    // Straight below a disk of radius r at height h: E = pi L r^2 / (r^2 + h^2); the sphere's is pi L (r / d)^2.
    let disk = |mis: &str| {
        lit_floor(
            r#"AttributeBegin AreaLightSource "diffuse" "rgb L" [ 5 5 5 ] "bool twosided" true
            Shape "disk" "float height" 2 "float radius" 1.5 AttributeEnd"#,
        )
        .replace("\"integer maxdepth\" 1", &format!("\"integer maxdepth\" 1 \"string mis\" \"{mis}\""))
        .replace("LookAt 0 0 1", "LookAt 0 0 1.9")
    };
    let sphere = |mis: &str| {
        lit_floor(
            r#"AttributeBegin AreaLightSource "diffuse" "rgb L" [ 5 5 5 ]
            Translate 0 0 3 Shape "sphere" "float radius" 1 AttributeEnd"#,
        )
        .replace("\"integer maxdepth\" 1", &format!("\"integer maxdepth\" 1 \"string mis\" \"{mis}\""))
    };
    let square = |mis: &str| {
        lit_floor(
            r#"AttributeBegin AreaLightSource "diffuse" "rgb L" [ 5 5 5 ] "bool twosided" true
            Shape "bilinearmesh" "point3 P" [ -1 -1 2  1 -1 2  -1 1 2  1 1 2 ] AttributeEnd"#,
        )
        .replace("\"integer maxdepth\" 1", &format!("\"integer maxdepth\" 1 \"string mis\" \"{mis}\""))
    };
    let pi = std::f64::consts::PI;
    let e_disk = pi * 5.0 * 2.25 / (2.25 + 4.0);
    let e_sphere = pi * 5.0 / 9.0;
    // Form factor of a rectangle a x b seen from below its corner at height h, four times. [Howell, C-11]
    let (a, b) = (0.5f64, 0.5f64);
    let (sa, sb) = ((1.0 + a * a).sqrt(), (1.0 + b * b).sqrt());
    let quarter = (a / sa * libm_atan(b / sa) + b / sb * libm_atan(a / sb)) / (2.0 * pi);
    let e_square = pi * 5.0 * 4.0 * quarter;
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
        check(&format!("disk {mis}"), &disk(mis), [e_disk * HALF_OVER_PI; 3], 0.004);
        check(&format!("sphere {mis}"), &sphere(mis), [e_sphere * HALF_OVER_PI; 3], 0.004);
        check(&format!("square {mis}"), &square(mis), [e_square * HALF_OVER_PI; 3], 0.004);
    }
}

fn libm_atan(x: f64) -> f64 {
    sparrow_math::Real::atan2(x, 1.0)
}

#[test]
fn power_of_lights_is_what_they_send_out() {
    // A sphere light of 4 pi^2 r^2 L = power; inside a black box nothing else matters: seen directly it shows L.
    let text = format!(
        r#"{FILM} Sampler "zsobol" "integer pixelsamples" 16
        LookAt 0 0 -3  0 0 0  0 1 0
        Camera "perspective" "float fov" 5
        WorldBegin
        AreaLightSource "diffuse" "rgb L" [ 1 1 1 ] "float power" 39.4784176
        Shape "sphere" "float radius" 1"#
    );
    check("power", &text, [1.0; 3], 0.003);
}

#[test]
fn colours_come_back_as_they_were_given() {
    let text = format!(
        r#"{FILM} Sampler "zsobol" "integer pixelsamples" 1024
        Integrator "path" "integer maxdepth" 1
        LookAt 0 0 1  0 0 0  0 1 0
        Camera "perspective" "float fov" 20
        WorldBegin
        LightSource "infinite" "rgb L" [ 1 1 1 ]
        Material "diffuse" "rgb reflectance" [ 0.7 0.2 0.05 ]
        Shape "disk" "float radius" 9"#
    );
    check("red-brown", &text, [0.7, 0.2, 0.05], 0.005);
}

/// What glass of index 1.69 under a film of 1.3 reflects at normal incidence: two amplitudes and the phase between them.
fn filmed(thickness: f64, nm: f64) -> f64 {
    let r = 0.3 / 2.3;
    let (sin, cos) = sparrow_math::Real::sin_cos(4.0 * core::f64::consts::PI * 1.3 * thickness / nm);
    let (top, bottom) = ((r + r * cos, r * sin), (1.0 + r * r * cos, r * r * sin));
    (top.0 * top.0 + top.1 * top.1) / (bottom.0 * bottom.0 + bottom.1 * bottom.1)
}

#[test]
fn a_thin_film_has_the_colour_of_its_spectrum() {
    let under_sky = |material: &str| {
        format!(
            r#"{FILM} Sampler "zsobol" "integer pixelsamples" 256
            Integrator "path" "integer maxdepth" 2
            LookAt 0 0 1  0 0 0  0 1 0
            Camera "perspective" "float fov" 4
            WorldBegin
            LightSource "infinite" "rgb L" [ 1 1 1 ]
            Material {material}
            Shape "disk" "float radius" 9"#
        )
    };
    for thickness in [90.0, 600.0] {
        // The same spectrum as a table: a matt disk of that reflectance sends as much of the sky to the camera.
        let table: String = (0..=235)
            .map(|i| 360.0 + 2.0 * f64::from(i))
            .map(|nm| format!("{nm} {} ", filmed(thickness, nm)))
            .collect();
        let (known, _) =
            mean(&picture(&under_sky(&format!(r#""diffuse" "spectrum reflectance" [ {table} ]"#))));
        assert!((known[0] - known[2]).abs() > 0.2 * known[2], "the film is coloured: {known:?}");
        let film = format!(
            r#""thin_film" "float film_thickness" {thickness} "spectrum film_eta" [ 360 1.3 830 1.3 ]
            "spectrum eta" [ 360 1.69 830 1.69 ] "spectrum k" [ 360 0 830 0 ]"#
        );
        check("thin film", &under_sky(&film), known, 0.01);
    }
}
