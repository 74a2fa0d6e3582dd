//! Slides 24 and 25, one hair: where its two highlights lie, and what comes through it.

use sparrow_math::Real;
use sparrow_plot::draw::table::Table;

use crate::measure::{peak, smoothed};
use crate::sheet::side_by_side;
use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

/// A model of hair with its expected second highlight.
struct Model {
    name: &'static str,
    /// Its material, without absorption.
    words: &'static str,
    /// `alpha_TRT - alpha_R` in degrees of the half angle, and how near to it the highlights come; none without TRT.
    shift: Option<[f64; 2]>,
    /// It has light that passes through.
    transmits: bool,
}

/// Shifts of Chiang et al. are 2 and -4 tilts of the sum of both inclinations, which is twice the half angle.
const MODELS: [Model; 4] = [
    Model {
        name: "Kajiya-Kay",
        words: r#""string type" "kajiya_kay" "float exponent" 60"#,
        shift: None,
        transmits: false,
    },
    Model {
        name: "Marschner",
        words: r#""string type" "marschner" "float alpha_r" -6 "float beta_r" 5"#,
        shift: Some([15.0, 1.5]),
        transmits: true,
    },
    Model {
        name: "Chiang",
        words: r#""string type" "hair" "float alpha" 3 "float beta_m" 0.15 "float beta_n" 0.3"#,
        shift: Some([9.0, 1.5]),
        transmits: true,
    },
    // Facets know no shift of TRT; refraction twice and reflection once at scales that lean by the tilt give about its triple.
    Model {
        name: "Huang",
        words: r#""string type" "microfacet_hair" "float tilt" 3 "float alpha_m" 0.12 "float alpha_n" 0.12"#,
        shift: Some([9.0, 3.0]),
        transmits: true,
    },
];

impl Model {
    fn material(&self, sigma_a: f64) -> String {
        match self.shift {
            Some(_) => format!(r#""hair" {} "rgb sigma_a" [ {sigma_a} {sigma_a} {sigma_a} ]"#, self.words),
            None => format!(r#""hair" {}"#, self.words),
        }
    }
}

/// Absorption that leaves R alone, and one that leaves most of TRT.
const SIGMA: [f64; 2] = [30.0, 0.05];

/// Brightness across the arch, over the inclination of the hair in degrees, from its tip to its root.
fn profile(photo: &Photo) -> Vec<[f64; 2]> {
    let [w, h] = photo.size;
    let y = |row: usize| 0.8 * (2.0 * (row as f64 + 0.5) / h as f64 - 1.0);
    (0..h).map(|row| [Real::asin(y(row)).to_degrees(), photo.mean(0..w, row..row + 1)]).collect()
}

/// Brightness of the middle of the arch.
fn middle(photo: &Photo) -> f64 {
    let [w, h] = photo.size;
    photo.mean(0..w, h * 19 / 40..h * 21 / 40)
}

/// Slides 24 and 25.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let (size, spp) = (studio.pick([10, 80], [32, 256]), studio.pick(24, 96));
    let mut table = Table::new(["model", "part", "theta_deg", "brightness"]);
    let (mut pictures, mut checks) = (Vec::new(), Vec::new());
    for model in &MODELS {
        let shoot = |scene: &str, sigma: f64| studio.render_with(scene, &model.material(sigma), size, spp);
        let [dark, clear] =
            [shoot("lecture/strand.pbrt", SIGMA[0])?, shoot("lecture/strand.pbrt", SIGMA[1])?];
        let behind = shoot("lecture/strand-behind.pbrt", SIGMA[1])?;
        let [r, all] = [&dark, &clear].map(|p| smoothed(&profile(p), 2));
        r.iter().for_each(|p| table.rows.push(row(model.name, "R", *p)));
        all.iter().for_each(|p| table.rows.push(row(model.name, "all", *p)));
        if let Some([expected, tolerance]) = model.shift {
            // What the absorption takes away went through the hair.
            let inner: Vec<[f64; 2]> = all.iter().zip(&r).map(|(a, b)| [a[0], a[1] - b[1]]).collect();
            let [[first, _], [second, _]] = [&r, &inner].map(|p| peak(p).unwrap_or([f64::NAN; 2]));
            checks.push(Check::near(
                format!("{}: distance of the second highlight from the first, in degrees", model.name),
                (second - first).abs(),
                expected,
                tolerance,
            ));
        }
        // There the hair is perpendicular to view and light in both pictures.
        let through = middle(&behind) / middle(&clear);
        let what = format!(
            "{}: middle of the clear hair with its lamp behind over that with its lamp in front",
            model.name
        );
        checks.push(if model.transmits {
            Check::at_least(what, through, 2.0)
        } else {
            Check::near(what, through, 1.0, 0.15)
        });
        let most = all.iter().map(|p| p[1]).fold(0.0, f64::max);
        let e = (0.3 / most) as f32;
        let png = side_by_side(&[(&dark, e), (&clear, e), (&behind, e)])?;
        let alt = format!("An upright hair by {}, black, clear, and with its lamp behind.", model.name);
        pictures.push(
            Picture::png(&model.name.to_lowercase(), alt, png)
                .labelled(format!("{}: black; clear; clear, lamp behind", model.name)),
        );
    }
    let figure = Figure {
        caption: "One hair, bent to an arch and lit from where it is seen, root at the bottom. In the black hair nothing but the reflection from the surface, R, is left; its scales lean, \
            which moves it to one side of the middle. Light that was within the hair, TRT, is moved to the other side. Kajiya and Kay's hair has one highlight, in the middle, and is \
            the same from all sides; all others let most light through."
            .to_owned(),
        formulas: vec![
            Formula::new("θ_h = α_R , θ_h = α_TRT = - frac{3}{2} α_R", "[Marschner2003, table 1]", "models/src/fibre/marschner.rs: m"),
            Formula::new("θ_o - 2 α , θ_o + 4 α", "[Chiang2016]", "models/src/fibre/hair.rs: tilted"),
        ],
        commands: MODELS.iter().map(|m| format!("sparrow render scenes/lecture/strand.pbrt --material '{}'", m.material(0.05))).collect(),
        pictures,
        table: Some(table),
        checks,
        ..Figure::default()
    };
    Ok(figure.with("absorption of black hair", SIGMA[0]).with("absorption of clear hair", SIGMA[1]))
}

fn row(model: &str, part: &str, [theta, v]: [f64; 2]) -> Vec<sparrow_plot::draw::table::Field> {
    use sparrow_plot::draw::table::Field::{Number, Text};
    vec![Text(model.to_owned()), Text(part.to_owned()), Number(theta), Number(v)]
}
