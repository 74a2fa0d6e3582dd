//! Slide 23: the exit of TRT over the offset, the fan of its rays, and the angle of the caustic over the index.

use sparrow_math::{Real, Vec3, vec3};
use sparrow_models::cylinder::attenuation::Inside;
use sparrow_models::cylinder::azimuthal::{exit_azimuth, wrapped};
use sparrow_models::cylinder::roots::{caustic, caustic_azimuth};
use sparrow_plot::draw::axis::Axis;
use sparrow_plot::draw::svg::Pen;
use sparrow_plot::draw::theme::LIGHT;

use crate::chart::{self, Chart, Curve, steps};
use crate::sketch::{Sketch, turn};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

const INDICES: [f64; 4] = [1.4, 1.55, 1.7, 1.95];
/// Index, then offset, azimuth in degrees and curvature at the caustic: `caustic.*` of the reference sheet.
const KNOWN: [(f64, [f64; 3]); 3] = [
    (1.55, [0.729_725_976_3, 18.615_751_7, -3.424_353_9]),
    (1.7, [0.608_276_253_0, 8.932_999_9, -1.824_657_2]),
    (1.95, [0.256_580_072_0, 0.509_042_0, -0.426_263_0]),
];

/// Azimuth of TRT in degrees, not wrapped round: zero for the ray through the axis.
fn exit(h: f64, eta: f64) -> f64 {
    let ray = Inside::new([0.0, 1.0], h, eta);
    (exit_azimuth(2, Real::asin(h), ray.angle())).to_degrees()
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let h = steps(-1.0, 1.0, 400);
    let map = Chart {
        title: "Exit of TRT over the offset".to_owned(),
        subtitle: "extremes are caustics; beyond η' = 2 there are none".to_owned(),
        x: Axis::fixed("h", -1.0, 1.0, 5),
        y: Axis::fixed("Φ_{TRT}  [deg]", -60.0, 60.0, 6),
        curves: INDICES.iter().map(|eta| Curve::of(format!("η' = {eta}"), &h, |h| exit(h, *eta))).collect(),
        rules: Vec::new(),
    };
    let eta = steps(1.3, 2.0, 140);
    let angle = Chart {
        title: "Angle of the caustic over the index".to_owned(),
        subtitle: "seen along the axis; a slanted ray sees a larger index".to_owned(),
        x: Axis::fixed("η'", 1.3, 2.0, 7),
        y: Axis::linear("φ_{c}  [deg]", 0.0, 50.0, 5),
        curves: vec![Curve::of("", &eta, |e| caustic_azimuth(e)[0].abs().to_degrees())],
        rules: Vec::new(),
    };
    let mut checks = Vec::new();
    for (eta, [want_h, want_phi, want_bend]) in KNOWN {
        let [phi, bend] = caustic_azimuth(eta);
        checks.push(Check::near(
            format!("offset of the caustic, η' = {eta} (caustic.{eta})"),
            caustic(eta),
            want_h,
            1e-5,
        ));
        checks.push(Check::near(
            format!("its azimuth in degrees, η' = {eta}"),
            phi.abs().to_degrees(),
            want_phi,
            1e-4,
        ));
        checks.push(Check::near(format!("curvature there, η' = {eta}"), bend, want_bend, 1e-4));
        // Found on the map itself.
        let most = steps(0.0, 1.0, 200_000)
            .iter()
            .map(|h| wrapped(exit(*h, eta).to_radians()).to_degrees())
            .fold(0.0, f64::max);
        checks.push(Check::near(format!("largest exit over h, η' = {eta}"), most, want_phi, 1e-4));
    }
    checks.push(Check::near(
        "azimuth of the caustic at η' = 2, in degrees",
        caustic_azimuth(2.0_f64)[0].to_degrees(),
        0.0,
        1e-9,
    ));
    Ok(Figure {
        caption: "The exit of TRT moves out with the offset, turns back at the caustic and passes the light again. At the turning point the light of many offsets leaves in one \
            direction, which makes the glints of hair. They move inwards as the index grows or the light is slanted, and merge at η' = 2."
            .to_owned(),
        formulas: vec![
            Formula::new("frac{dΦ_2}{dh} = frac{4}{sqrt{η'^2 - h^2}} - frac{2}{sqrt{1 - h^2}} = 0", "[Marschner2003, sec. 5.2.2]", "models/src/cylinder/roots.rs: caustic_azimuth"),
            Formula::new("h_c^2 = frac{4 - η'^2}{3}", "[Marschner2003, sec. 5.2.2]", "models/src/cylinder/roots.rs: caustic"),
        ],
        pictures: vec![
            Picture::svg("map", "Exit azimuth of TRT over the offset for four indices: curves with two extremes that flatten as the index grows.", map.svg()),
            Picture::svg("fan", "Parallel rays in a circle of glass, reflected once inside; those that leave crowd at two directions.", fan()),
            Picture::svg("angle", "The angle of the caustic falls from 42 degrees at an index of 1.3 to zero at 2.", angle.svg()),
        ],
        table: Some(chart::table(&[&map, &angle])),
        checks,
        ..Figure::default()
    }
    .with("η' of the fan", 1.55))
}

/// Rays of TRT in a circle of glass, from the left.
fn fan() -> String {
    let eta = 1.55;
    let mut sketch = Sketch::new(
        "The fan of TRT",
        "parallel light from the left, η' = 1.55; rays next to the caustic in colour",
        Vec::new(),
        [0.0, 0.0],
        1.6,
    )
    .moved(0.9);
    sketch.line(&turn(180, |c, s| vec3(0.0, c, s)), Pen::new(LIGHT.ink, 3.0));
    let across = |phi: f64| -> Vec3<f64> {
        let (s, c) = Real::sin_cos(phi);
        vec3(0.0, c, s)
    };
    let light = core::f64::consts::PI;
    for k in -24..=24 {
        let h = f64::from(k) / 25.0;
        let ray = Inside::new([0.0, 1.0], h, eta);
        let corner = |n: f64| across(light - Real::asin(h) + n * (light + 2.0 * ray.angle()));
        let near = (h.abs() - caustic(eta)).abs() < 0.14;
        let colour = if near { LIGHT.series(1).0 } else { LIGHT.series(0).0 };
        let width = if near { 1.8 } else { 0.9 };
        sketch.line(
            &[vec3(0.0, -2.6, corner(0.0).z), corner(0.0), corner(1.0), corner(2.0)],
            Pen::new(LIGHT.grid, 1.0),
        );
        sketch.arrow(
            corner(2.0),
            corner(2.0) + across(light + exit(h, eta).to_radians()) * 1.6,
            colour,
            width,
        );
    }
    sketch.finish()
}
