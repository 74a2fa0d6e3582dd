//! Slides 24 and 25: tresses of three colours by four models under three lights.

use sparrow_plot::draw::table::Table;

use crate::sheet::side_by_side;
use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

const LIGHTS: [&str; 3] = ["front", "side", "back"];
/// Names of the scenes' materials, absorption per radius in red, green and blue by d'Eon's melanins, and the colours of a matt hair.
const COLOURS: [(&str, [f64; 3], [f64; 3]); 3] = [
    ("blonde", [0.1, 0.185, 0.416], [0.6, 0.45, 0.25]),
    ("brown", [0.545, 0.906, 1.781], [0.3, 0.18, 0.08]),
    ("black", [3.35, 5.58, 10.96], [0.03, 0.03, 0.03]),
];
/// Name, words of the model, and whether it absorbs; Kajiya and Kay's has colours instead.
const MODELS: [(&str, &str, bool); 4] = [
    ("Kajiya-Kay", r#""string type" "kajiya_kay" "rgb specular" [ 0.2 0.2 0.2 ] "float exponent" 60"#, false),
    ("Marschner", r#""string type" "marschner" "float alpha_r" -6 "float beta_r" 7"#, true),
    ("Chiang", r#""string type" "hair" "float beta_m" 0.1 "float beta_n" 0.25 "float alpha" 3"#, true),
    (
        "Huang",
        r#""string type" "microfacet_hair" "float tilt" 3 "float alpha_m" 0.15 "float alpha_n" 0.15"#,
        true,
    ),
];

fn materials(words: &str, absorbs: bool) -> Vec<String> {
    let of = |(name, sigma, matt): &(&str, [f64; 3], [f64; 3])| {
        let (param, [r, g, b]) = if absorbs { ("sigma_a", sigma) } else { ("diffuse", matt) };
        format!(r#""{name}" {words} "rgb {param}" [ {r} {g} {b} ]"#)
    };
    COLOURS.iter().map(of).collect()
}

/// Brightness of a tress, 0 to 2 from the left: without the clip at its upper end.
fn tress(photo: &Photo, k: usize) -> f64 {
    let [w, h] = photo.size;
    let middle = [0.22, 0.5, 0.78][k];
    photo.mean(((middle - 0.08) * w as f64) as usize..((middle + 0.08) * w as f64) as usize, h / 4..h * 3 / 4)
}

/// Brightness of the brightest column at the right rim of the left tress.
fn rim(photo: &Photo) -> f64 {
    let [w, h] = photo.size;
    let columns = w * 3 / 10..w * 2 / 5;
    columns.map(|x| photo.mean(x..x + 1, h / 4..h * 4 / 5)).fold(0.0, f64::max)
}

/// Slides 24 and 25.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let (side, spp) = (studio.pick(40, 240), studio.pick(4, 32));
    let mut table = Table::new(["model", "light", "blonde", "brown", "black"]);
    let (mut pictures, mut checks, mut commands) = (Vec::new(), Vec::new(), Vec::new());
    for (name, words, absorbs) in MODELS {
        let materials = materials(words, absorbs);
        let mut photos = Vec::new();
        for light in LIGHTS {
            let mut desc = studio.open_with(&format!("fibres/tress-{light}.pbrt"), &materials)?;
            // Blonde light goes through many hairs; a draft does without what comes after some.
            desc.integrator.max_depth = studio.pick(3, 32);
            photos.push(studio.take(desc, [side; 2], spp)?);
        }
        let values: Vec<[f64; 3]> = photos.iter().map(|p| [0, 1, 2].map(|k| tress(p, k))).collect();
        for (light, v) in LIGHTS.iter().zip(&values) {
            use sparrow_plot::draw::table::Field::{Number, Text};
            let texts = [name, light].map(|t| Text(t.to_owned()));
            table.rows.push(texts.into_iter().chain(v.map(Number)).collect());
        }
        checks.push(Check::at_most(
            format!("{name}: black over brown, light from the front"),
            values[0][2] / values[0][1],
            1.0,
        ));
        checks.push(Check::at_most(
            format!("{name}: brown over blonde, light from the front"),
            values[0][1] / values[0][0],
            1.0,
        ));
        let through = rim(&photos[2]) / values[0][0];
        let what = format!(
            "{name}: brightest column at the rim of the blonde tress with light from behind, over the tress with light from the front"
        );
        checks.push(if absorbs {
            Check::at_least(what, through, 1.0)
        } else {
            Check::at_most(what, through, 1.0)
        });
        let pairs: Vec<(&Photo, f32)> = photos.iter().map(|p| (p, 1.0)).collect();
        let alt = format!(
            "Three times three tresses by {name}: blonde, brown and black, lit from the front, the side and behind."
        );
        pictures.push(
            Picture::png(&name.to_lowercase(), alt, side_by_side(&pairs)?)
                .labelled(format!("{name}: light from the front, the side, behind")),
        );
        commands.push(format!("sparrow render scenes/fibres/tress-back.pbrt --material '{}'", materials[0]));
    }
    let figure = Figure {
        caption: "Tresses of the same 4000 strands: blonde, brown and black. Kajiya and Kay's is coloured like paint and dark against the light. In the others the highlight of the surface is \
            white at every colour, and what went through the hair is coloured: a second highlight below the first with light from the front, and a glowing tress with light from behind, \
            the more the less melanin there is."
            .to_owned(),
        formulas: vec![Formula::new("S = frac{1}{cos^2 θ_d} sum_p M_p (θ_h) N_p (φ)", "[Marschner2003, eq. 8]", "models/src/fibre/marschner.rs: scattered")],
        commands,
        pictures,
        table: Some(table),
        checks,
        ..Figure::default()
    };
    Ok(figure.with("strands", 4000))
}
