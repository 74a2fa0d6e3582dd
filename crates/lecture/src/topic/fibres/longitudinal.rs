//! Slide 21: light along the fibre, lobe by lobe.

use sparrow_models::{Fibre, fibre_cosine};
use sparrow_plot::draw::axis::Axis;
use sparrow_plot::draw::cartesian::Rule;
use sparrow_plot::{Kind, Options};

use crate::ask::{fibre, inclined, lobes, plotted};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

const LIGHTS: [f64; 5] = [-30.0, -15.0, 0.0, 15.0, 30.0];
/// Shift of R in degrees, and those of TT and TRT that belong to it.
const ALPHA: [f64; 3] = [-7.5, 3.75, 11.25];
const LOBES: [&str; 3] = ["R", "TT", "TRT"];
/// Azimuths at which a lobe is bright.
const AZIMUTH: [f64; 3] = [60.0, 180.0, 10.0];

/// Directions of the reference sheet and S without caustics: `marschner.F1` to `F3`.
const KNOWN: [([f64; 4], f64); 3] = [
    ([20.0, 0.0, -25.0, 40.0], 0.032_295_322_295_617_94),
    ([-10.0, 0.0, 15.0, 170.0], 2.408_844_747_865_919_6),
    ([45.0, 0.0, -30.0, 100.0], 0.215_537_050_147_038_33),
];

/// Light of a lobe over the viewer's inclination, for light at `theta_i`.
fn lobe(model: &Fibre<f64>, p: usize, theta_i: f64, theta_o: f64) -> f64 {
    let (i, o) = (inclined(theta_i, 0.0), inclined(theta_o, AZIMUTH[p]));
    lobes(model, o, i)[p]
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let model = fibre("marschner sigma_a=0.2")?;
    let x = steps(-90.0, 90.0, 360);
    let mut charts = Vec::new();
    for (p, name) in LOBES.iter().enumerate() {
        let curve =
            |light: &f64| Curve::of(format!("θ_{{i}} = {light}°"), &x, |t| lobe(&model, p, *light, t));
        let curves: Vec<Curve> = LIGHTS.iter().map(curve).collect();
        let top = curves.iter().flat_map(|c| &c.points).map(|p| p[1]).fold(0.0, f64::max);
        charts.push(Chart {
            title: format!("{name} along the fibre"),
            subtitle: format!(
                "S cos θi at the azimuth {}°; rules at −θi + 2α, α = {}°",
                AZIMUTH[p], ALPHA[p]
            ),
            x: Axis::degrees("θ_{o}  [deg]", -90.0, 90.0),
            y: Axis::linear("S cos θ_{i}  [1/sr]", 0.0, top, 5),
            curves,
            rules: LIGHTS.iter().map(|l| Rule { at: 2.0 * ALPHA[p] - l, label: String::new() }).collect(),
        });
    }
    let (all, command) =
        plotted("marschner sigma_a=0.2 wo=20", &Options { kind: Kind::Longitudinal, ..Options::default() })?;
    let mut pictures: Vec<Picture> = charts
        .iter()
        .zip(LOBES)
        .map(|(c, name)| Picture::svg(&name.to_lowercase(), format!("{name} over the viewer's inclination, for five inclinations of the light: peaks opposite to the light, shifted by the scales."), c.svg()))
        .collect();
    pictures.push(Picture::svg(
        "all",
        "All lobes over the inclination of the light for a viewer at 20 degrees.",
        all.svg,
    ));
    Ok(Figure {
        caption: "A smooth fibre would send all light to θo = −θi. Its scales are tilted by some degrees, which shifts R towards the root by 2α, and TT and TRT the other way; roughness \
            makes peaks of them. As highlights of R and TRT lie side by side on a strand, hair has two: one of the colour of the light, and one of its own."
            .to_owned(),
        formulas: vec![
            Formula::new("M_p(θ_h) = g(β_p ; θ_h - α_p) , θ_h = frac{θ_i + θ_o}{2}", "[Marschner2003, sec. 4]", "models/src/fibre/marschner.rs: m"),
            Formula::new("S = sum_{p} frac{M_p(θ_h) N_p(η' ; φ)}{cos^2 θ_d}", "[Marschner2003, sec. 4]", "models/src/fibre/marschner.rs: scattered"),
        ],
        commands: vec![command],
        pictures,
        table: Some(chart::table(&charts.iter().collect::<Vec<_>>())),
        checks: checks()?,
        ..Figure::default()
    }
    .with("αR, αTT, αTRT", "−7.5°, 3.75°, 11.25°")
    .with("βR, βTT, βTRT", "7.5°, 3.75°, 15°")
    .with("σa", "0.2 per radius"))
}

fn checks() -> Result<Vec<Check>, LectureError> {
    let mut checks = Vec::new();
    // Narrow lobes, so that Fresnel's term and cosines hardly tilt them: TRT, 4° wide in θo, by a third of a degree.
    let narrow = fibre("marschner sigma_a=0.2 beta_r=1")?;
    let fine = steps(-85.0, 85.0, 17_000);
    for (p, name) in LOBES.iter().enumerate() {
        for light in [-30.0, 0.0, 30.0] {
            let value = |t: &f64| lobe(&narrow, p, light, *t);
            let at = fine.iter().copied().max_by(|a, b| value(a).total_cmp(&value(b))).unwrap_or(f64::NAN);
            checks.push(Check::near(
                format!("centre of {name} for θi = {light}°, at −θi + 2α"),
                at,
                2.0 * ALPHA[p] - light,
                0.35,
            ));
        }
    }
    // The sheet has M as printed, twice ours, and neither caustics nor their Gaussians.
    let plain = fibre("marschner sigma_a=0.2 glint=0")?;
    for (n, ([ti, pi, to, po], want)) in KNOWN.iter().enumerate() {
        let (o, i) = (inclined(*to, *po), inclined(*ti, *pi));
        let got = 2.0 * lobes(&plain, o, i).iter().sum::<f64>() / fibre_cosine(i);
        checks.push(Check::near(
            format!("2 S without caustics (marschner.F{})", n + 1),
            got,
            *want,
            1e-6 * want.max(1.0),
        ));
    }
    Ok(checks)
}
