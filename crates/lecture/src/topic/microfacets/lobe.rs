//! Slide 1: the lobe of `D = cos^s`, as printed and normalised.

use sparrow_plot::draw::axis::Axis;
use sparrow_plot::figure::albedo;

use crate::ask::{f_in_plane, pair, surface, value};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

const PSI: [f64; 3] = [0.0, 30.0, 60.0];
const EXPONENTS: [f64; 3] = [10.0, 50.0, 200.0];
const FORMS: [(&str, &str); 2] = [("unnormalized", "as printed"), ("normalized", "normalised")];

/// Directions of light and viewer, and both forms at an exponent of 20: `phong.n20.P1` to `P5` of the reference sheet.
const KNOWN: [([f64; 4], [f64; 2]); 5] = [
    ([30.0, 0.0, 45.0, 180.0], [0.343_791_946_097_222_8, 1.203_756_127_564_22]),
    ([60.0, 20.0, 40.0, 215.0], [0.382_987_100_877_533_94, 1.340_994_385_392_065_8]),
    ([75.0, 0.0, 80.0, 180.0], [5.457_610_895_664_93, 19.109_326_533_379_715]),
    ([50.0, 10.0, 50.0, 10.0], [8.773_137_786_346_898e-5, 3.071_834_139_272_22e-4]),
    ([20.0, 0.0, 70.0, 90.0], [0.006_700_297_307_803_345, 0.023_460_479_607_888_864]),
];

fn words(form: &str, s: f64) -> String {
    format!("torrance_sparrow exponent={s} distribution={form} masking=none fresnel=constant")
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let x = steps(-89.0, 89.0, 356);
    let (mut charts, mut figure) = (Vec::new(), Figure::default());
    for (form, says) in FORMS {
        for psi in PSI {
            let curve = |s: &f64| {
                let model = surface(&words(form, *s))?;
                Ok(Curve::of(format!("s = {s}"), &x, |theta| f_in_plane(&model, psi, theta)))
            };
            let chart = Chart {
                title: format!("cosˢ, {says}, light at {psi}°"),
                subtitle: "value in the plane of incidence; the mirror's side is at the right".to_owned(),
                x: Axis::degrees("θ_{o}  [deg]", -90.0, 90.0),
                y: Axis::log("f  [1/sr]", 1e-4, 200.0, 6),
                curves: EXPONENTS.iter().map(curve).collect::<Result<_, LectureError>>()?,
                rules: Vec::new(),
            };
            let alt = format!(
                "Lobes of cos to the power 10, 50 and 200, {says}, for light at {psi} degrees, over the viewer's angle."
            );
            figure.pictures.push(Picture::svg(&format!("{form}-{psi}"), alt, chart.svg()));
            charts.push(chart);
        }
    }
    figure.table = Some(chart::table(&charts.iter().collect::<Vec<_>>()));
    figure.caption = "The model of the slide, D/(4 cos θi cos θo) with D = cosˢ α. As printed its facets have the wrong area, by the factor \
        (s + 2)/2π that the lower row has. Without masking both grow without bound towards grazing angles, which is why S follows.\n\
        Incidences and exponents are our choice."
        .to_owned();
    figure.formulas = vec![
        Formula::new(
            "f_r = frac{D(α)}{4 cos θ_i cos θ_o} , D = cos^s α",
            "[Blinn1977]",
            "models/src/surface/torrance_sparrow.rs: eval",
        ),
        Formula::new(
            "∫ frac{s + 2}{2 π} cos^s α cos α dω = 1",
            "[Walter2007, sec. 3]",
            "models/src/surface/torrance_sparrow.rs: eval",
        ),
    ];
    figure.commands = vec![
        "sparrow plot torrance_sparrow exponent=10,50,200 masking=none fresnel=constant wo=30 --kind cartesian --log".to_owned(),
    ];
    figure.checks = checks()?;
    Ok(figure.with("s", "10, 50, 200").with("θi", "0°, 30°, 60°").with("F", 1).with("S", 1))
}

fn checks() -> Result<Vec<Check>, LectureError> {
    let models = [surface(&words(FORMS[0].0, 20.0))?, surface(&words(FORMS[1].0, 20.0))?];
    let mut checks = Vec::new();
    for (n, (directions, values)) in KNOWN.iter().enumerate() {
        let [i, o] = pair(*directions);
        for (k, (model, want)) in models.iter().zip(values).enumerate() {
            let got = value(model, o, i);
            checks.push(Check::near(
                format!("f at s = 20, {}, pair P{} (phong.n20.P{})", FORMS[k].1, n + 1, n + 1),
                got,
                *want,
                1e-9 * want.abs().max(1.0),
            ));
        }
    }
    let above = sparrow_math::LocalDir::from_angles(0.0, 0.0);
    let [printed, normalised] = [albedo(&models[0], above), albedo(&models[1], above)];
    // Each albedo is good to 1e-4.
    let factor = 22.0 / (2.0 * core::f64::consts::PI);
    checks.push(Check::near(
        "albedo, normalised over printed, at s = 20: (s + 2)/2π",
        normalised / printed,
        factor,
        5e-3,
    ));
    // Light from the zenith leaves by facets of less than 45 degrees, and D cos alpha is 1 over all of them.
    let within = 1.0 - 1.0 / 2048.0;
    checks.push(Check::near(
        "albedo under a light at the zenith: 1 − 2^(−(s + 2)/2)",
        normalised,
        within,
        5e-4,
    ));
    Ok(checks)
}
