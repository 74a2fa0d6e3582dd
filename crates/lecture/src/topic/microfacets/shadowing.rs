//! Slide 2: Fresnel's term and what facets hide of each other.

use sparrow_math::LocalDir;
use sparrow_models::Surface;
use sparrow_plot::draw::axis::Axis;
use sparrow_plot::figure::albedo;
use sparrow_stats::Random;

use crate::ask::{f_in_plane, surface, value};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// What is called how, and the model: facets of an exponent of 50, and Gaussian ones of the same curvature.
const CHOICES: [(&str, &str); 4] = [
    ("S = 1", "torrance_sparrow exponent=50 masking=none"),
    ("V-grooves", "torrance_sparrow exponent=50 masking=v_cavity"),
    ("Smith, S(θi) S(θo)", "torrance_sparrow exponent=50 masking=smith"),
    (
        "Smith, correlated",
        "microfacet_reflection ndf=beckmann masking=smith alpha_x=0.19611613513818404 alpha_y=0.19611613513818404",
    ),
];
const ALUMINIUM: &str = "eta=0.77 k=6.08";

/// Each choice for aluminium, or for mirrors that reflect all.
fn models(white: bool) -> Result<Vec<Surface<f64>>, LectureError> {
    let of = |(_, words): &(&str, &str)| {
        let constant =
            if words.starts_with("torrance") { "fresnel=constant" } else { "fresnel=constant f0=1" };
        surface(&format!("{words} {}", if white { constant } else { ALUMINIUM }))
    };
    CHOICES.iter().map(of).collect()
}

/// Makes the figure.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let (metal, white) = (models(false)?, models(true)?);
    let x = steps(-89.5, 89.5, 358);
    let curves = |f: &dyn Fn(&Surface<f64>, f64) -> f64, models: &[Surface<f64>], x: &[f64]| -> Vec<Curve> {
        CHOICES.iter().zip(models).map(|((name, _), m)| Curve::of(*name, x, |t| f(m, t))).collect()
    };
    let lobe = Chart {
        title: "F S S D / (4 cos cos), light at 60°".to_owned(),
        subtitle: "aluminium, s = 50; the mirror direction is at 60°".to_owned(),
        x: Axis::degrees("θ_{o}  [deg]", -90.0, 90.0),
        y: Axis::log("f  [1/sr]", 1e-3, 200.0, 5),
        curves: curves(&|m, t| f_in_plane(m, 60.0, t), &metal, &x),
        rules: Vec::new(),
    };
    let views = steps(0.0, 88.0, studio.pick(22, 44));
    let energy = |m: &Surface<f64>, t: f64| albedo(m, LocalDir::from_angles(t.to_radians(), 0.0));
    let share = Chart {
        title: "Light that leaves, F = 1".to_owned(),
        subtitle: "what is missing to 1 met a second facet".to_owned(),
        x: Axis::fixed("θ_{o}  [deg]", 0.0, 90.0, 6),
        y: Axis::fixed("albedo", 0.8, 1.2, 5),
        curves: curves(&energy, &white, &views),
        rules: Vec::new(),
    };
    let mut checks = Vec::new();
    for (i, (name, _)) in CHOICES.iter().enumerate() {
        checks.push(Check::at_most(
            format!("f(o, i) against f(i, o), largest relative difference: {name}"),
            asymmetry(&metal[i]),
            1e-11,
        ));
    }
    for (i, (name, _)) in CHOICES.iter().enumerate().skip(1) {
        let most = share.curves[i].points.iter().map(|p| p[1]).fold(0.0, f64::max);
        // The cubature is good to 1e-4; Smith's fit for cos^50 gains less than that.
        checks.push(Check::at_most(format!("largest albedo for F = 1: {name}"), most, 1.0 + 5e-4));
    }
    Ok(Figure {
        caption: "Left: four choices of S. They differ at grazing angles alone. Right: without S more light leaves than arrived; with it some is \
            missing, which in truth meets a second facet.\nThe lecture's S(θi) S(θo) takes light and viewer as independent; a facet deep in the \
            surface is hidden from both, which the correlated form knows."
            .to_owned(),
        formulas: vec![
            Formula::new("f_r = frac{F(θ'_i) S(θ_i) S(θ_o) D(α)}{4 cos θ_i cos θ_o}", "[TorranceSparrow1967]", "models/src/surface/torrance_sparrow.rs: eval"),
            Formula::new("S_V S_V = min ( 1 , frac{2 (n*h) (n*i)}{i*h} , frac{2 (n*h) (n*o)}{o*h} )", "[Blinn1977]", "models/src/v_cavity.rs: g_over_4cos"),
            Formula::new("S(θ) ≈ frac{3.535 c + 2.181 c^2}{1 + 2.276 c + 2.577 c^2} , c = frac{sqrt{s/2 + 1}}{tan θ} < 1.6", "[Walter2007, eq. 27]", "models/src/surface/torrance_sparrow.rs: smith_over_cos"),
            Formula::new("G_2 = frac{1}{1 + Λ(i) + Λ(o)}", "[Heitz2014, eq. 99]", "models/src/microfacet/facets.rs: g2_over_4cos"),
        ],
        commands: vec![format!("sparrow plot torrance_sparrow masking=none,v_cavity,smith {ALUMINIUM} wo=60 --kind cartesian --log")],
        pictures: vec![
            Picture::svg("lobe", "Four lobes over the viewer's angle for light at 60 degrees: alike up to 70 degrees, apart towards grazing.", lobe.svg()),
            Picture::svg("albedo", "Albedo over the viewer's angle: above one without masking, below one with it.", share.svg()),
        ],
        table: Some(chart::table(&[&lobe, &share])),
        checks,
        ..Figure::default()
    }
    .with("s", 50)
    .with("index at left", "0.77 + 6.08 i, aluminium at 0.5 µm"))
}

/// Largest relative difference under exchange of light and viewer, over random pairs.
fn asymmetry(model: &Surface<f64>) -> f64 {
    let mut random = Random::named(0, "reciprocity");
    let mut upper = || {
        let d = random.direction();
        if d.z() < 0.0 { LocalDir::new(-d.v()) } else { d }
    };
    let mut largest = 0.0_f64;
    for _ in 0..1000 {
        let (i, o) = (upper(), upper());
        let [a, b] = [value(model, o, i), value(model, i, o)];
        largest = largest.max((a - b).abs() / a.max(b).max(1e-30));
    }
    largest
}
