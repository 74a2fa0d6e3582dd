//! Slide 7: reflections that follow each other make a surface white and even.

use core::f64::consts::PI;

use sparrow_math::LocalDir;
use sparrow_models::{Bsdf, Surface, Uniforms};
use sparrow_plot::draw::axis::Axis;
use sparrow_stats::Random;

use crate::ask::{f_in_plane, surface};
use crate::chart::{self, Chart, Curve, steps};
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
const RINGS: usize = 8;

/// Albedo, and flatness: least over greatest share of the light in the rings. A Lambertian surface has the flatness 1.
fn spread(model: &Surface<f64>, samples: u32) -> [f64; 2] {
    let view = LocalDir::from_angles(PSI.to_radians(), 0.0);
    let mut random = Random::named(0, "spread");
    let mut rings = [0.0_f64; RINGS];
    for _ in 0..samples {
        let u = Uniforms { lobe: random.uniform(), dir: [random.uniform(), random.uniform()] };
        let s = model.sample(view, u);
        if s.valid && s.wi.z() > 0.0 {
            let ring = (s.wi.sin2_theta() * RINGS as f64) as usize;
            rings[ring.min(RINGS - 1)] += s.weight.average() / f64::from(samples);
        }
    }
    let (least, most) = rings.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), r| (a.min(*r), b.max(*r)));
    [rings.iter().sum(), least / most]
}

/// Makes the figure.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let models: Vec<Surface<f64>> = SURFACES.iter().map(|s| surface(s.1)).collect::<Result<_, _>>()?;
    let x = steps(-85.0, 85.0, 170);
    let curves = SURFACES.iter().zip(&models).map(|(s, m)| Curve::of(s.0, &x, |t| PI * f_in_plane(m, PSI, t)));
    let chart = Chart {
        title: "One reflection and many".to_owned(),
        subtitle: format!("π f for light at {PSI}°; a white Lambertian surface has 1"),
        x: Axis::degrees("θ_{o}  [deg]", -90.0, 90.0),
        y: Axis::fixed("π f", 0.0, 2.5, 5),
        curves: curves.collect(),
        rules: Vec::new(),
    };
    let samples = studio.pick(200_000, 2_000_000);
    let shares: Vec<[f64; 2]> = models.iter().map(|m| spread(m, samples)).collect();
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
        checks.push(Check::at_least(format!("flatness over that of mirrors, once: {}", SURFACES[k].0), shares[k][1] / shares[0][1], 1.5));
    }
    let told: Vec<String> = SURFACES.iter().zip(&shares).map(|(s, [a, f])| format!("{} {a:.3} and {f:.2}", s.0)).collect();
    Ok(Figure {
        caption: format!(
            "Mirrors that are met once lose light and glare forward. A walk from facet to facet returns all of it, and more evenly; facets that are matt themselves, or a body \
             under the surface, come near to Lambert's law. Albedo and flatness (least over greatest share of the light in eight rings around the normal, which Lambert's law fills equally): {}.",
            told.join("; ")
        ),
        formulas: vec![
            Formula::new("f = ∑_{k=1}^{∞} f_k", "[Heitz2016]", "models/src/microfacet/walk/mirrors.rs: walk"),
            Formula::new("f = frac{ρ}{π} A (1 + r frac{s}{t}) + f_{text{ms}}", "[Portsmouth2024]", "models/src/surface/eon.rs: eval"),
        ],
        commands: vec!["sparrow plot microfacet_reflection energy=single,walk fresnel=constant f0=1 alpha=1 wo=45 --kind cartesian".to_owned()],
        pictures: vec![Picture::svg("", "π f over the viewer's angle for six surfaces; those with many reflections lie nearer to 1.", chart.svg())],
        table: Some(chart::table(&[&chart])),
        checks,
        ..Figure::default()
    }
    .with("light", format!("{PSI}°"))
    .with("α", 1))
}
