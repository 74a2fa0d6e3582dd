//! Slide 14: fibres that are tangent to the plane across the half vector reflect.

use sparrow_math::{LocalDir, Real, Vec3, vec3};
use sparrow_models::Fibre;
use sparrow_plot::draw::axis::Axis;
use sparrow_stats::Random;

use super::bundle::reflected;
use crate::ask::{fibre, lobes};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// Widths of the lobe along the fibre, in degrees.
const WIDTHS: [f64; 3] = [3.0, 6.0, 12.0];

/// Light and viewer in the world; the angle between them is 70 degrees, `h` points along z.
fn light_and_viewer() -> [Vec3<f64>; 2] {
    let (s, c) = Real::sin_cos(35.0_f64.to_radians());
    [vec3(s, 0.0, c), vec3(-s, 0.0, c)]
}

/// The R lobe of a fibre whose tangent makes `angle` degrees with the plane across the half vector, turned out of the plane of light
/// and viewer by `out` degrees.
fn seen(model: &Fibre<f64>, angle: f64, out: f64) -> f64 {
    let ((s, c), (t, d)) = (Real::sin_cos(angle.to_radians()), Real::sin_cos(out.to_radians()));
    let tangent = vec3(c * d, c * t, s);
    let side = vec3(0.0, 0.0, 1.0).cross(tangent).normalized();
    let normal = tangent.cross(side);
    let local = |w: Vec3<f64>| LocalDir::new(vec3(w.dot(tangent), w.dot(side), w.dot(normal)));
    let [light, viewer] = light_and_viewer();
    lobes(model, local(viewer), local(light))[0]
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let x = steps(-60.0, 60.0, 480);
    let (mut curves, mut checks) = (Vec::new(), Vec::new());
    for width in WIDTHS {
        let model = fibre(&format!("deon alpha=0 width_m={width} sigma_a=1"))?;
        let raw = Curve::of("", &x, |a| seen(&model, a, 60.0));
        let highest =
            raw.points.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap_or([f64::NAN; 2]);
        // One step of the grid; Fresnel's term and the cosines tilt wide lobes.
        let tolerance = 0.25 + 0.02 * width * width / 3.0;
        checks.push(Check::near(
            format!("tangent's angle at the brightest, width {width}°"),
            highest[0],
            0.0,
            tolerance,
        ));
        let points = raw.points.iter().map(|p| [p[0], p[1] / highest[1]]).collect();
        curves.push(Curve { label: format!("width {width}°"), points });
    }
    let mut random = Random::named(0, "half vector");
    let (mut off, mut gap) = (0.0_f64, 0.0_f64);
    for _ in 0..10_000 {
        let (i, h) = (random.direction(), random.within(-1.0, 1.0));
        let o = reflected(i, h)?;
        let sum = i.v() + o.v();
        if sum.length() < 1e-3 {
            continue;
        }
        let half = sum.normalized();
        off = off.max(half.x.abs());
        // And the half vector is the normal that reflected, so that it is lit and seen.
        let cos = (1.0 - h * h).sqrt() * (1.0 - i.x() * i.x()).sqrt();
        gap = gap.max((half.dot(i.v()) - cos).abs());
    }
    checks.push(Check::at_most("largest |t·h| of 10000 mirror reflections", off, 1e-12));
    checks.push(Check::at_most(
        "largest difference of i·h from i·n, with n the normal that was met",
        gap,
        1e-7,
    ));
    let chart = Chart {
        title: "Fibres across the half vector reflect".to_owned(),
        subtitle: "R lobe over its greatest value, light and viewer 70° apart, fixed".to_owned(),
        x: Axis::degrees("angle of the tangent with the plane across h  [deg]", -60.0, 60.0),
        y: Axis::fixed("R over its maximum", 0.0, 1.0, 5),
        curves,
        rules: Vec::new(),
    };
    Ok(Figure {
        caption: "The other way round: light goes from i to o if (i + o)·t = 0, that is, if the tangent lies in the plane across the half vector h. The normal that \
            does it is h itself. Rough fibres reflect as well if they are near to that plane, the nearer the smoother they are.\nThis is the sentence of the slide that \
            follows: fibres tangent to the plane defined by the halfway vector reflect light."
            .to_owned(),
        formulas: vec![Formula::new("t * h = 0 , h = frac{i + o}{|i + o|}", "[KajiyaKay1989]", "models/src/fibre/mirror_cylinder.rs: sample")],
        pictures: vec![Picture::svg("", "Three peaks around zero degrees: the narrower the lobe, the narrower the peak.", chart.svg())],
        table: Some(chart::table(&[&chart])),
        checks,
        ..Figure::default()
    }
    .with("model", "deon, α = 0, σa = 1 per radius")
    .with("turn of the tangent out of the plane of light and viewer", "60°"))
}
