//! Slide 17: three models of the same body, a ball wound with thread.

use sparrow_math::{LocalDir, Real};
use sparrow_models::Uniforms;
use sparrow_plot::draw::table::{Field, Table};
use sparrow_plot::figure::albedo;
use sparrow_stats::Random;

use crate::ask::{fibre, scattered, surface};
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

/// Angles from the normal of the surface and the thread, across it, in degrees.
const ANGLES: [f64; 4] = [0.0, 30.0, 60.0, 80.0];

/// Share of the light of one channel, kd 0.3 and ks 0.4, that comes back where the viewer stands at an angle in the plane of the fibre: of the surface
/// models over all directions above it, of the thread over all around it.
fn albedos() -> Result<[(&'static str, [f64; 4]); 3], LectureError> {
    let kay = fibre("kajiya_kay diffuse=0.3 specular=0.4 exponent=60")?;
    let rows = surface("poulin_fournier diffuse=0.3 specular=0.4 beta=0.15")?;
    let ward = surface("ward alpha_x=0.15 alpha_y=0.8 diffuse=0.3 specular=0.4")?;
    let mut random = Random::named(0, "albedo of a thread");
    // A direction in the plane of tangent and normal: inclined to the thread as to the surface.
    let seen = |deg: f64| LocalDir::from_angles(deg.to_radians(), 0.0);
    let mut thread = |deg: f64| {
        let n = 20_000;
        let weight = |_| {
            scattered(
                &kay,
                seen(deg),
                Uniforms { lobe: random.uniform(), dir: [random.uniform(), random.uniform()] },
            )
        };
        (0..n).map(weight).filter(|s| s.valid).map(|s| s.weight.average()).sum::<f64>() / f64::from(n)
    };
    Ok([
        ("kajiya-kay", ANGLES.map(&mut thread)),
        ("poulin-fournier", ANGLES.map(|deg| albedo(&rows, seen(deg)))),
        ("ward", ANGLES.map(|deg| albedo(&ward, seen(deg)))),
    ])
}

/// Slide 17.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let side = studio.pick(96, 320);
    // On the equator of fibres along parallels t·h = 0 where the normal is h without its upright part.
    let l = sparrow_math::vec3(1.0, 0.6, 1.2).normalized();
    let angle = Real::atan2(l.x, l.z + 1.0);
    let (predicted, _) = Real::sin_cos(angle);
    let mut table = Table::new(["model", "quantity", "at", "value"]);
    let mut figure = Figure {
        caption: "A ball wound with thread, lit from the right. Kajiya and Kay's model is that of a fibre, so the thread is there, 80 turns of \
            it; the other two are models of a surface of many fibres, on a smooth ball. All put the highlight where t·h = 0, along a meridian. \
            They differ in width, in how it ends towards the poles, and in how the matt part falls off: a fibre's is lit wherever light meets \
            the thread, past the terminator of a smooth surface."
            .to_owned(),
        formulas: vec![
            Formula::new("k_s cos^s (θ_o + θ_i)", "[KajiyaKay1989]", "models/src/fibre/kajiya_kay.rs: f_cos_pdf"),
            Formula::new("t * h = 0", "[PoulinFournier1990]", "models/src/surface/poulin_fournier.rs: eval"),
        ],
        ..Figure::default()
    };
    for (scene, name, material, id) in models() {
        let photo = studio.render_with(scene, &material, [side; 2], studio.pick(16, 128))?;
        let profile = smoothed(&equator(&photo), side as usize / 48);
        for [x, v] in &profile {
            table.rows.push(row(id, "brightness over x in radii", [*x, *v]));
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
    for (id, shares) in albedos()? {
        for at in ANGLES.into_iter().zip(shares) {
            table.rows.push(row(id, "albedo over degrees", at.into()));
        }
        let most = shares.into_iter().fold(0.0, f64::max);
        figure.checks.push(Check::at_most(
            format!("largest albedo of {id} at 0°, 30°, 60° and 80°"),
            most,
            0.7 + 5e-3,
        ));
        let text = shares.map(|a| format!("{a:.2}")).join(", ");
        figure.parameters.push((format!("albedo of {id} at 0°, 30°, 60°, 80°"), text));
    }
    figure.table = Some(table);
    Ok(figure.with("kd", "0.3, 0.12, 0.1").with("ks", 0.4))
}

fn row(model: &str, quantity: &str, numbers: [f64; 2]) -> Vec<Field> {
    [model, quantity]
        .map(|t| Field::Text(t.to_owned()))
        .into_iter()
        .chain(numbers.map(Field::Number))
        .collect()
}
