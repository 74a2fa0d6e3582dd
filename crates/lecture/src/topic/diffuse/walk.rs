//! Slide 7: reflections that follow each other make a surface white and even.

use sparrow_math::{LocalDir, Real};
use sparrow_models::{Surface, Uniforms};
use sparrow_plot::draw::axis::Axis;
use sparrow_stats::Random;

use crate::ask::{sample, surface};
use crate::chart::{self, Chart, Curve};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// Names, models and what of the light leaves, where it is known to be all.
const SURFACES: [(&str, &str, bool); 6] = [
    ("mirrors, once", "microfacet_reflection energy=single fresnel=constant f0=1 alpha_x=1 alpha_y=1", false),
    ("mirrors, a walk", "microfacet_reflection energy=walk fresnel=constant f0=1 alpha_x=1 alpha_y=1", true),
    ("V-grooves, once", "v_groove bounces=one fresnel=one alpha_x=1 alpha_y=1", false),
    ("V-grooves, all", "v_groove bounces=all fresnel=one alpha_x=1 alpha_y=1", false),
    ("white facets", "eon reflectance=1 roughness=1", true),
    ("white body under glass", "coated_diffuse alpha=0.5 thickness=0 reflectance=1", true),
];
/// The light's angle in degrees.
const PSI: f64 = 45.0;

/// Rings around the normal, of equal projected solid angle.
const RINGS: usize = 12;

/// `pi f`, averaged over each ring around the normal. A Lambertian surface that is white has 1 everywhere.
fn rings(model: &Surface<f64>, samples: u32) -> [f64; RINGS] {
    let view = LocalDir::from_angles(PSI.to_radians(), 0.0);
    let mut random = Random::named(0, "rings");
    let mut rings = [0.0_f64; RINGS];
    for _ in 0..samples {
        let u = Uniforms { lobe: random.uniform(), dir: [random.uniform(), random.uniform()] };
        let s = sample(model, view, u);
        if s.valid && s.wi.z() > 0.0 {
            let ring = (s.wi.sin2_theta() * RINGS as f64) as usize;
            rings[ring.min(RINGS - 1)] += s.weight.average() * RINGS as f64 / f64::from(samples);
        }
    }
    rings
}

/// Albedo, and flatness: least over greatest of the rings.
fn albedo_and_flatness(rings: &[f64; RINGS]) -> [f64; 2] {
    let (least, most) = rings.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), r| (a.min(*r), b.max(*r)));
    [rings.iter().sum::<f64>() / RINGS as f64, least / most]
}

/// Angle from the normal in degrees at the place `k` among the rings' borders.
fn angle(k: usize) -> f64 {
    Real::asin((k as f64 / RINGS as f64).sqrt()).to_degrees()
}

/// Makes the figure.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let models: Vec<Surface<f64>> = SURFACES.iter().map(|s| surface(s.1)).collect::<Result<_, _>>()?;
    let samples = studio.pick(200_000, 2_000_000);
    let rings: Vec<[f64; RINGS]> = models.iter().map(|m| rings(m, samples)).collect();
    let curve = |(s, rings): (&(&str, &str, bool), &[f64; RINGS])| Curve {
        label: s.0.to_owned(),
        points: (0..RINGS).flat_map(|k| [[angle(k), rings[k]], [angle(k + 1), rings[k]]]).collect(),
    };
    let chart = Chart {
        title: "One reflection and many".to_owned(),
        subtitle: format!(
            "π f, averaged around the normal, for light at {PSI}°; a white Lambertian surface has 1"
        ),
        x: Axis::fixed("θ_{o}  [deg]", 0.0, 90.0, 6),
        y: Axis::fixed("π f", 0.0, 2.0, 5),
        curves: SURFACES.iter().zip(&rings).map(curve).collect(),
        rules: Vec::new(),
    };
    let shares: Vec<[f64; 2]> = rings.iter().map(albedo_and_flatness).collect();
    let mut checks = Vec::new();
    for ((name, _, white), [share, _]) in SURFACES.iter().zip(&shares) {
        if *white {
            // Weights are near one; EON's reach some tens.
            checks.push(Check::near(format!("albedo: {name}"), *share, 1.0, 0.01));
        }
    }
    for (many, once) in [(1, 0), (3, 2)] {
        let what = format!("albedo gained by going on: {}", SURFACES[many].0);
        checks.push(Check::at_least(what, shares[many][0] - shares[once][0], 0.02));
    }
    checks.push(Check::at_least("flatness gained by a walk", shares[1][1] - shares[0][1], 0.01));
    for k in [4, 5] {
        checks.push(Check::at_least(
            format!("flatness over that of mirrors, once: {}", SURFACES[k].0),
            shares[k][1] / shares[0][1],
            1.5,
        ));
    }
    let told: Vec<String> =
        SURFACES.iter().zip(&shares).map(|(s, [a, f])| format!("{} {a:.3} and {f:.2}", s.0)).collect();
    Ok(Figure {
        caption: format!(
            "Mirrors that are met once lose light and glare forward. A walk from facet to facet returns all of it, and more evenly; facets that are matt themselves, or a body \
             under the surface, come near to Lambert's law. Albedo and flatness (least over greatest share of the light in twelve rings around the normal, which Lambert's law fills equally): {}.",
            told.join("; ")
        ),
        formulas: vec![
            Formula::new("f = sum_{k=1}^{∞} f_k", "[Heitz2016]", "models/src/microfacet/walk/mirrors.rs: walk"),
            Formula::new("f = frac{ρ}{π} A (1 + r frac{s}{t}) + f_{text{ms}}", "[Portsmouth2024]", "models/src/surface/eon.rs: eval"),
        ],
        commands: vec!["sparrow plot microfacet_reflection energy=single,walk fresnel=constant f0=1 alpha=1 wo=45 --kind cartesian".to_owned()],
        pictures: vec![Picture::svg("", "Steps of π f over the viewer's angle for six surfaces; those with many reflections lie nearer to 1.", chart.svg())],
        table: Some(chart::table(&[&chart])),
        checks,
        ..Figure::default()
    }
    .with("light", format!("{PSI}°"))
    .with("samples", samples)
    .with("α", 1))
}
