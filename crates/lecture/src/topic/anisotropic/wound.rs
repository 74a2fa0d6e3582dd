//! Slide 17: three models of the same body, a ball wound with thread.

use sparrow_math::Real;
use sparrow_plot::draw::table::Table;

use crate::measure::{peak, smoothed};
use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

const THREAD: &str = r#""rgb diffuse" [ 0.3 0.12 0.1 ] "rgb specular" [ 0.4 0.4 0.4 ]"#;

/// Scene, name, material and picture's name.
fn models() -> [(&'static str, &'static str, String, &'static str); 3] {
    let of = |kind: &str, own: &str| format!(r#""thread" "string type" "{kind}" {own} {THREAD}"#);
    [
        (
            "lecture/wound.pbrt",
            "Kajiya-Kay, on each thread",
            of("kajiya_kay", r#""float exponent" 60"#),
            "kajiya-kay",
        ),
        (
            "lecture/wound-surface.pbrt",
            "Poulin-Fournier",
            of("poulin_fournier", r#""float beta" 0.15"#),
            "poulin-fournier",
        ),
        (
            "lecture/wound-surface.pbrt",
            "Ward",
            of("ward", r#""float alpha_x" 0.15 "float alpha_y" 0.8"#),
            "ward",
        ),
    ]
}

/// Brightness along the equator of the ball, over x in its radius.
fn equator(photo: &Photo) -> Vec<[f64; 2]> {
    let [w, h] = photo.size;
    let mean = |x: usize| photo.mean(x..x + 1, h / 2 - h / 16..h / 2 + h / 16);
    (0..w).map(|x| [1.1 * (2.0 * (x as f64 + 0.5) / w as f64 - 1.0), mean(x)]).collect()
}

/// Slide 17.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let side = studio.pick(96, 320);
    // On the equator of fibres along parallels t·h = 0 where the normal is h without its upright part.
    let l = sparrow_math::vec3(1.0, 0.6, 1.2).normalized();
    let angle = Real::atan2(l.x, l.z + 1.0);
    let (predicted, _) = Real::sin_cos(angle);
    let mut table = Table::new(["model", "x", "brightness"]);
    let mut figure = Figure {
        caption: "A ball wound with thread, lit from the right. Kajiya and Kay's model is that of a fibre, so the thread is there, 80 turns of \
            it; the other two are models of a surface of many fibres, on a smooth ball. All put the highlight where t·h = 0, along a meridian. \
            They differ in width, in how it ends towards the poles, and in how the matt part falls off: a fibre's is lit wherever light meets \
            the thread, past the terminator of a smooth surface."
            .to_owned(),
        formulas: vec![
            Formula::new("k_s cos^s (θ_o + θ_i)", "[KajiyaKay1989]", "models/src/fibre/kajiya_kay.rs: f"),
            Formula::new("t * h = 0", "[PoulinFournier1990]", "models/src/surface/poulin_fournier.rs: f"),
        ],
        ..Figure::default()
    };
    for (scene, name, material, id) in models() {
        let photo = studio.render_with(scene, &material, [side; 2], studio.pick(16, 128))?;
        let profile = smoothed(&equator(&photo), side as usize / 48);
        for [x, v] in &profile {
            table.named(id, [*x, *v]);
        }
        let [at, _] = peak(&profile).unwrap_or([f64::NAN; 2]);
        figure.checks.push(Check::near(
            format!("{name}: place of the highlight on the equator, in radii"),
            at,
            predicted,
            0.02,
        ));
        let alt = format!("A ball with one bright meridian to the right of its middle, by {name}.");
        let mean = photo.brightness();
        figure.pictures.push(
            Picture::png(id, alt, photo.png(1.0)?).labelled(format!("{name}; mean brightness {mean:.3}")),
        );
        figure.commands.push(format!("sparrow render scenes/{scene} --material '{material}'"));
    }
    figure.table = Some(table);
    Ok(figure.with("kd", "0.3, 0.12, 0.1").with("ks", 0.4))
}
