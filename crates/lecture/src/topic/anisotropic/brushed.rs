//! Slide 8: brushed metal on a ball, a cylinder and a disc, by three models.

use sparrow_plot::draw::table::Table;

use crate::measure::Moments;
use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

/// Widths along the brush and across it.
const ALPHA: [f64; 2] = [0.05, 0.4];
/// Middle and half side of each body's part of the picture, in units of its width, and the direction of the highlight in degrees, which
/// is across the brush there.
const BODIES: [(&str, f64, f64); 3] =
    [("ball", 1.0 / 6.0, 90.0), ("cylinder", 0.5, 90.0), ("disc", 5.0 / 6.0, LIGHT_DEG)];
/// Direction of the light around the line of sight: atan2(0.25, 0.35).
const LIGHT_DEG: f64 = 35.54;

/// Name and material of each model.
fn models() -> [(&'static str, String); 3] {
    let [x, y] = ALPHA;
    // The exponent of a lobe as wide as a slope width: 2 / alpha^2 - 2.
    let [nx, ny] = ALPHA.map(|a| 2.0 / (a * a) - 2.0);
    let matt = r#""rgb diffuse" [ 0 0 0 ] "rgb specular" [ 0.7 0.7 0.7 ]"#;
    [
        (
            "GGX",
            format!(
                r#""brushed" "string type" "conductor" "float uroughness" {x} "float vroughness" {y} "bool remaproughness" false "rgb reflectance" [ 0.7 0.7 0.7 ]"#
            ),
        ),
        ("Ward", format!(r#""brushed" "string type" "ward" "float alpha_x" {x} "float alpha_y" {y} {matt}"#)),
        (
            "Ashikhmin-Shirley",
            format!(
                r#""brushed" "string type" "ashikhmin_shirley" "float exponent_x" {nx} "float exponent_y" {ny} {matt}"#
            ),
        ),
    ]
}

/// Moments of the highlight in a third of the picture, of what is brighter than a tenth of its brightest pixel.
fn moments(photo: &Photo, middle: f64) -> Option<Moments> {
    let [w, h] = photo.size;
    let first = ((middle - 1.0 / 6.0) * w as f64).round() as usize;
    let pixels = (first..first + w / 3).flat_map(|x| (0..h).map(move |y| (x, y)));
    let most = pixels.clone().map(|(x, y)| photo.grey(x, y)).fold(0.0, f64::max);
    // Upwards is positive.
    Moments::of(pixels.map(|(x, y)| ([x as f64, -(y as f64)], (photo.grey(x, y) - 0.1 * most).max(0.0))))
}

/// Slide 8.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    const SCENE: &str = "lecture/brushed.pbrt";
    let side = studio.pick(96, 240);
    let mut table = Table::new(["model", "body", "aspect", "direction_deg", "across_brush_deg"]);
    let mut figure = Figure {
        caption: "Ball and cylinder are turned on a lathe about the upright axis, the disc about its middle, and brushed along the turning; \
            light and viewer are far away. The highlight is long across the brush: in the plane that holds the half vector and is \
            perpendicular to the brush many facets have a fitting slope, along the brush few.\nLength over width is the root of the ratio of \
            the second moments of what is brighter than a tenth of the maximum."
            .to_owned(),
        formulas: vec![
            Formula::new("D = frac{1}{π α_x α_y cos^4 θ (1 + tan^2 θ (frac{cos^2 φ}{α_x^2} + frac{sin^2 φ}{α_y^2}))^2}", "[Walter2007]", "models/src/ggx.rs: d"),
        ],
        ..Figure::default()
    };
    for (name, material) in models() {
        let photo = studio.render_with(SCENE, &material, [3 * side, side], studio.pick(8, 64))?;
        for (body, middle, across) in BODIES {
            let Moments { aspect, direction_deg } =
                moments(&photo, middle).unwrap_or(Moments { aspect: f64::NAN, direction_deg: f64::NAN });
            figure.checks.push(Check::at_least(
                format!("{name}, {body}: length of the highlight over its width"),
                aspect,
                2.0,
            ));
            // The highlight of a ball is curved, like the meridian it lies on.
            figure.checks.push(Check::near(
                format!("{name}, {body}: direction of its length, in degrees"),
                direction_deg,
                across,
                6.0,
            ));
            let words = [name, body].map(|w| sparrow_plot::draw::table::Field::Text(w.to_owned()));
            let numbers = [aspect, direction_deg, across].map(sparrow_plot::draw::table::Field::Number);
            table.rows.push(words.into_iter().chain(numbers).collect());
        }
        let alt =
            format!("A brushed ball, cylinder and disc by {name}; each highlight is long across the brush.");
        let id = name.to_lowercase();
        figure.pictures.push(Picture::png(&id, alt, photo.png(0.6)?).labelled(name));
        figure.commands.push(format!("sparrow render scenes/{SCENE} --material '{material}'"));
    }
    figure.table = Some(table);
    Ok(figure.with("α along the brush", ALPHA[0]).with("α across the brush", ALPHA[1]))
}
