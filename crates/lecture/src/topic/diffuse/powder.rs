//! Slide 7: a pressed powder, as a diffuse body under a rough dielectric surface, reflects more at high incidence.

use sparrow_math::LocalDir;
use sparrow_plot::draw::axis::Axis;
use sparrow_plot::figure::albedo;

use crate::ask::surface;
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

const ROUGHNESS: [f64; 3] = [0.1, 0.3, 0.5];

fn words(alpha: f64) -> String {
    format!("coated_diffuse alpha={alpha} eta=1.7 thickness=0 reflectance=0.95")
}

/// Makes the figure.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let x = steps(0.0, 88.0, studio.pick(22, 44));
    let (mut curves, mut checks) = (Vec::new(), Vec::new());
    for alpha in ROUGHNESS {
        let model = surface(&words(alpha))?;
        let energy = |t: f64| albedo(&model, LocalDir::from_angles(t.to_radians(), 0.0));
        let curve = Curve::of(format!("α = {alpha}"), &x, energy);
        let [low, high] = [energy(0.0), energy(85.0)];
        checks.push(Check::at_least(
            format!("reflectance at 85° over that at 0°, α = {alpha}"),
            high / low,
            1.005,
        ));
        let most = curve.points.iter().map(|p| p[1]).fold(0.0, f64::max);
        // The cubature is good to 1e-4.
        checks.push(Check::at_most(format!("largest reflectance, α = {alpha}"), most, 1.0 + 5e-4));
        curves.push(curve);
    }
    let flat = surface("lambert reflectance=0.95")?;
    curves.push(Curve::of("Lambert", &x, |t| albedo(&flat, LocalDir::from_angles(t.to_radians(), 0.0))));
    let chart = Chart {
        title: "A powder reflects more at high incidence".to_owned(),
        subtitle: "diffuse body of reflectance 0.95 under a rough surface of index 1.7".to_owned(),
        x: Axis::fixed("angle of incidence  [deg]", 0.0, 90.0, 6),
        y: Axis::fixed("reflectance", 0.7, 1.0, 6),
        curves,
        rules: Vec::new(),
    };
    Ok(Figure {
        caption: "Pressed magnesium oxide was taken for the ideal diffuse reflector, yet it reflects more at high angles of incidence: the grains' surfaces do, and what they \
            let in comes out diffuse. Index and reflectance of the body are our choice; nothing here is measured."
            .to_owned(),
        formulas: vec![Formula::new("E(θ_i) = ∫ f_r(i, o) cos θ_o dω_o", "[KelemenSzirmayKalos2001]", "models/src/surface/coated_diffuse.rs: f_cos_pdf")],
        commands: vec![format!("sparrow plot {} --kind albedo", words(0.1).replace("alpha=0.1", "alpha=0.1,0.3,0.5"))],
        pictures: vec![Picture::svg("", "Reflectance over incidence: three curves that rise towards grazing, and a flat one.", chart.svg())],
        table: Some(chart::table(&[&chart])),
        checks,
        ..Figure::default()
    }
    .with("index", "1.7")
    .with("reflectance of the body", 0.95))
}
