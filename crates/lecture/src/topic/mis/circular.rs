//! Slide 27: a circular light over a rough surface, by two techniques and their combination.

use sparrow_mis::{Heuristic, Mis};
use sparrow_plot::draw::table::Table;
use sparrow_scene::SceneDesc;

use crate::sheet::side_by_side;
use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

const WAYS: [(&str, Mis); 3] = [
    ("light sampling", Mis::LightOnly),
    ("BSDF sampling", Mis::BsdfOnly),
    ("both, balance heuristic", Mis::Both(Heuristic::Balance)),
];
/// Relative variances of one sample by light sampling, by BSDF sampling, and of one of each with balance: records `matrix.R*.a*` of the
/// reference sheet.
const RECORDS: [(&str, f64, [f64; 3]); 6] = [
    ("0.1", 0.02, [0.012_691_194, 2.089_659_7, 0.132_198_9]),
    ("0.1", 0.05, [3.257_025_4e-4, 15.420_658, 0.051_115_05]),
    ("0.3", 0.02, [0.868_990_9, 0.030_240_35, 0.090_034_74]),
    ("0.3", 0.05, [0.026_372_52, 1.310_944_6, 0.131_534_3]),
    ("0.9", 0.05, [1.611_427_2, 0.005_430_629, 0.109_266_2]),
    ("0.9", 0.1, [0.136_320_05, 0.362_150_1, 0.095_463_19]),
];

fn surface(alpha: f64) -> String {
    let exponent = (0.5 / (alpha * alpha)).round();
    format!(
        r#""surface" "string type" "phong" "rgb diffuse" [ 0 0 0 ] "rgb specular" [ 1 1 1 ] "string form" "normalized" "float exponent" {exponent}"#
    )
}

fn open(studio: &Studio<'_>, scene: &str, alpha: f64, mis: Mis) -> Result<SceneDesc, LectureError> {
    let mut desc = studio.open_with(scene, &[surface(alpha)])?;
    desc.integrator.mis = mis;
    Ok(desc)
}

/// Variance of one sample over the square of its mean.
fn relative_variance(photo: &Photo, spp: u32) -> f64 {
    let mean = photo.rgb.iter().map(|p| f64::from(p[1])).sum::<f64>();
    let n = photo.rgb.len() as f64;
    let variance = photo.variance.iter().map(|p| f64::from(p[1])).sum::<f64>() / n * f64::from(spp);
    variance / (mean / n).powi(2)
}

/// Slide 27.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    const SCENE: &str = "lecture/circular-light.pbrt";
    let side = studio.pick(96, 240);
    let mut pictures = Vec::new();
    for (alpha, name) in [(0.01, "smooth"), (0.05, "rough"), (0.2, "rougher")] {
        let take = |mis: Mis, spp: u32| studio.take(open(studio, SCENE, alpha, mis)?, [side; 2], spp);
        // Equal totals: four samples of one technique, two of both.
        let photos = [take(WAYS[0].1, 4)?, take(WAYS[1].1, 4)?, take(WAYS[2].1, 2)?];
        let most = photos[2].rgb.iter().map(|p| p[1]).fold(0.0, f32::max);
        let png = side_by_side(&photos.each_ref().map(|p| (p, 1.4 / most)))?;
        let alt = format!(
            "The round reflection of a light in a plate, three times: grainy or smooth by technique, at roughness {alpha}."
        );
        pictures.push(Picture::png(name, alt, png).labelled(format!(
            "roughness {alpha}: light sampling, BSDF sampling, both; four samples a pixel each"
        )));
    }
    // The colour of a path varies with its wavelengths; BSDF sampling of a large lamp in a smooth plate leaves nothing else.
    let spp = studio.pick(64, 256);
    let measure = |radius: &str, alpha: f64, mis: Mis| -> Result<f64, LectureError> {
        let photo =
            studio.take(open(studio, &format!("mis/lamp-{radius}.pbrt"), alpha, mis)?, [32; 2], spp)?;
        Ok(relative_variance(&photo, spp))
    };
    let colour = measure("0.9", 0.005, Mis::BsdfOnly)?;
    let mut table = Table::new(["lamp_radius", "alpha", "light_sampling", "bsdf_sampling", "balance"]);
    let mut checks = Vec::new();
    for (radius, alpha, known) in RECORDS {
        let mut row = Vec::new();
        for ((name, mis), known) in WAYS.iter().zip(known) {
            // Path and colour are independent: second moments multiply.
            let v = (1.0 + measure(radius, alpha, *mis)?) / (1.0 + colour) - 1.0;
            row.push(v);
            // Five standard errors, where a share of 1 / (1 + V) of the samples finds all, or one of V / (1 + V) finds nothing. Colours are those
            // of the picture they are divided by, so that their noise goes too, but for rounding.
            let n = f64::from(32 * 32 * spp);
            let tolerance =
                5.0 * known * (((1.0 + known) / n).sqrt() + ((1.0 + 1.0 / known) / n).sqrt()) + 1e-3;
            checks.push(Check::near(
                format!("V/I² by {name}, lamp {radius}, roughness {alpha}"),
                v,
                known,
                tolerance,
            ));
        }
        table.named(radius, [alpha].into_iter().chain(row));
    }
    let figure = Figure {
        caption: "The lecture's case: a rough plate reflects a ball of light. Light sampling takes directions within the lamp's cone and is good for a small lamp or a rough plate; BSDF sampling \
            takes directions of the lobe and is good for a large lamp or a smooth plate. Both together, weighted by their densities, are good for all.\n\
            The numbers are measured in scenes/mis, where the lobe is aimed at the lamp's middle and variances have closed forms; the noise of wavelengths is divided out."
            .to_owned(),
        formulas: vec![
            Formula::new("w_i = frac{p_i}{p_1 + p_2} , Y = w_1 frac{f(X_1)}{p_1 (X_1)} + w_2 frac{f(X_2)}{p_2 (X_2)}", "[VeachGuibas1995]", "mis/src/heuristic.rs: weight"),
        ],
        commands: vec![
            format!("sparrow render scenes/{SCENE} --mis light-only"),
            format!("sparrow render scenes/{SCENE} --mis bsdf-only --material '{}'", surface(0.02)),
            format!("sparrow render scenes/{SCENE} --mis balance"),
        ],
        pictures,
        table: Some(table),
        checks,
        ..Figure::default()
    };
    Ok(figure.with("height of the lamp", 4).with("its radius", 0.3))
}
