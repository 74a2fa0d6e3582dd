//! Slide 18: both terms over the viewer's angle, with the slide's sign and the other one.

use sparrow_models::Fibre;
use sparrow_plot::draw::axis::Axis;
use sparrow_plot::draw::cartesian::Rule;

use crate::ask::{fibre, inclined, lobes};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

const LIGHTS: [f64; 3] = [30.0, 60.0, 90.0];
const EXPONENT: f64 = 20.0;

/// Inclination and azimuth of light and viewer in degrees; diffuse, specular with the slide's sign, specular with the other:
/// `kk.F1` to `kk.F5` of the reference sheet.
const KNOWN: [([f64; 4], [f64; 3]); 5] = [
    ([20.0, 0.0, -25.0, 40.0], [0.939_692_620_785_908_4, 0.000_976_562_499_999_998_3, 0.926_583_410_496_794]),
    ([-10.0, 0.0, 15.0, 170.0], [0.984_807_753_012_208, 0.139_802_272_100_980_06, 0.926_583_410_496_791_9]),
    (
        [45.0, 0.0, -30.0, 100.0],
        [core::f64::consts::FRAC_1_SQRT_2, 1.819_385_006_524_039e-12, 0.499_891_281_126_109_4],
    ),
    ([0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 1.0]),
    ([60.0, 30.0, -50.0, 200.0], [0.5, 0.0, 0.736_256_563_474_647_1]),
];

fn words(diffuse: f64, specular: f64, sign: &str) -> String {
    format!("kajiya_kay form=lecture sign={sign} diffuse={diffuse} specular={specular} exponent={EXPONENT}")
}

/// The three terms: diffuse, specular with the slide's sign, specular with the other.
fn terms() -> Result<[Fibre<f64>; 3], LectureError> {
    Ok([
        fibre(&words(1.0, 0.0, "physical"))?,
        fibre(&words(0.0, 1.0, "literal"))?,
        fibre(&words(0.0, 1.0, "physical"))?,
    ])
}

/// Of angles from the tangent, as the slide has them.
fn from_tangent(term: &Fibre<f64>, light: f64, eye: f64) -> f64 {
    lobes(term, inclined(90.0 - eye, 0.0), inclined(90.0 - light, 0.0))[0]
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let terms = terms()?;
    let x = steps(0.0, 180.0, 360);
    let mut checks = Vec::new();
    for (n, ([ti, pi, to, po], values)) in KNOWN.iter().enumerate() {
        let (i, o) = (inclined(*ti, *pi), inclined(*to, *po));
        let off =
            terms.iter().zip(values).map(|(t, want)| (lobes(t, o, i)[0] - want).abs()).fold(0.0, f64::max);
        checks.push(Check::at_most(
            format!("largest difference of the three terms from kk.F{}", n + 1),
            off,
            1e-9,
        ));
    }
    let (mut charts, mut pictures) = (Vec::new(), Vec::new());
    for light in LIGHTS {
        let curve = |name: &str, k: usize| Curve::of(name, &x, |eye| from_tangent(&terms[k], light, eye));
        let chart = Chart {
            title: format!("Kajiya-Kay, θ_{{L}} = {light}°"),
            subtitle: format!(
                "angles from the tangent; s = {EXPONENT}; the mirror cone is at {}°",
                180.0 - light
            ),
            x: Axis::fixed("θ_{E}  [deg]", 0.0, 180.0, 6),
            y: Axis::fixed("term", 0.0, 1.1, 5),
            curves: vec![
                curve("diffuse, sin θ_{L}", 0),
                curve("specular, as printed", 1),
                curve("specular, on the cone", 2),
            ],
            rules: vec![Rule { at: 180.0 - light, label: "cone".to_owned() }],
        };
        let fine = steps(0.0, 180.0, 18_000);
        for (k, want, name) in
            [(1, light, "as printed, beside the light"), (2, 180.0 - light, "on the mirror cone")]
        {
            let value = |eye: &f64| from_tangent(&terms[k], light, *eye);
            let at = fine.iter().copied().max_by(|a, b| value(a).total_cmp(&value(b))).unwrap_or(f64::NAN);
            checks.push(Check::near(format!("θE of the peak for θL = {light}°, {name}"), at, want, 0.011));
        }
        let alt = format!(
            "Diffuse term and both highlights over the viewer's angle for light at {light} degrees from the tangent."
        );
        pictures.push(Picture::svg(&format!("{light}"), alt, chart.svg()));
        charts.push(chart);
    }
    Ok(Figure {
        caption: "The diffuse term does not depend on the viewer. The specular term of the slide, cosˢ(θE − θL), is largest where the eye is beside the light if both \
            directions point away from the fibre; the cone of reflection is at θE = 180° − θL. The paper measures one of them from the reflected ray: with that sign \
            the highlight lies on the cone, and the renderer's default is so."
            .to_owned(),
        formulas: vec![
            Formula::new("Ψ_{text{diffuse}} = k_d sin θ_L = k_d sqrt{1 - (T * L)^2}", "[KajiyaKay1989]", "models/src/fibre/kajiya_kay.rs: f_cos_pdf"),
            Formula::new("Ψ_{text{specular}} = k_s cos^s (θ_E - θ_L) = k_s (cos θ_E cos θ_L + sin θ_E sin θ_L)^s", "[KajiyaKay1989]", "models/src/fibre/kajiya_kay.rs: f_cos_pdf"),
            Formula::new("Ψ_{text{cone}} = k_s (sin θ_E sin θ_L - cos θ_E cos θ_L)^s", "[KajiyaKay1989]", "models/src/fibre/kajiya_kay.rs: f_cos_pdf"),
        ],
        commands: vec!["sparrow plot kajiya_kay form=lecture sign=literal,physical wo=30 --kind longitudinal".to_owned()],
        pictures,
        table: Some(chart::table(&charts.iter().collect::<Vec<_>>())),
        checks,
        ..Figure::default()
    }
    .with("s", EXPONENT)
    .with("θL", "30°, 60°, 90°")
    .with("kd, ks", "1"))
}
