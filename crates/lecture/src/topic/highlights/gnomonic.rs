//! Slides 15 and 16: the curves on which highlights lie, and the circle that the gnomonic projection makes of one.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use sparrow_math::{LocalDir, Real, Vec3, vec3};
use sparrow_plot::draw::axis::Axis;
use sparrow_plot::draw::page::Entry;
use sparrow_plot::draw::svg::Pen;
use sparrow_plot::draw::theme::LIGHT;
use sparrow_stats::Random;

use super::predict::{cylinder, cylinder_tangent, disc, disc_tangent, gnomonic, sphere, sphere_tangent};
use crate::chart::{self, Chart, Curve};
use crate::sketch::{Sketch, turn};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// Polar angles of half vectors in degrees.
const HALF: [f64; 3] = [15.0, 25.0, 40.0];
/// Fibres' names, and their turn from parallels.
const TURNS: [(&str, f64); 3] = [("parallels", 0.0), ("helix, 45°", FRAC_PI_4), ("meridians", FRAC_PI_2)];
/// Polar angle in degrees and cosine of the azimuth for a half vector at 25 degrees: `highlight.sphere_meridians` of the reference sheet.
const KNOWN: [(f64, f64); 4] = [
    (5.0, 0.187_620_044_397_476_2),
    (10.0, 0.378_134_430_401_858_5),
    (20.0, 0.780_536_686_243_356_1),
    (25.0, 1.0),
];

fn half_vector(theta: f64, phi: f64) -> Vec3<f64> {
    LocalDir::from_angles(theta.to_radians(), phi.to_radians()).v()
}

/// Circle through points in the sense of least squares: centre and radius.
fn circle(points: &[[f64; 2]]) -> ([f64; 2], f64) {
    let n = points.len() as f64;
    let mean = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>() / n;
    let (mx, my) = (mean(&|p| p[0]), mean(&|p| p[1]));
    let (u, v) = (|p: &[f64; 2]| p[0] - mx, |p: &[f64; 2]| p[1] - my);
    let (uu, vv, uv) = (mean(&|p| u(p) * u(p)), mean(&|p| v(p) * v(p)), mean(&|p| u(p) * v(p)));
    let square = |p: &[f64; 2]| u(p) * u(p) + v(p) * v(p);
    let (a, b) = (0.5 * mean(&|p| u(p) * square(p)), 0.5 * mean(&|p| v(p) * square(p)));
    let det = uu * vv - uv * uv;
    let (cu, cv) = ((a * vv - b * uv) / det, (b * uu - a * uv) / det);
    ([cu + mx, cv + my], (cu * cu + cv * cv + uu + vv).sqrt())
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let projected = |theta: f64| -> Vec<[f64; 2]> {
        let upper = sphere(half_vector(theta, 0.0), FRAC_PI_2, 4000);
        upper
            .iter()
            .flatten()
            .filter(|p| Real::acos(p.z) <= theta.to_radians())
            .filter_map(|p| gnomonic(*p))
            .collect()
    };
    let mut checks = checks();
    let x_axis = |title: &str| Axis::fixed(title, -0.3, 1.1, 7);
    let mut curves = Vec::new();
    for theta in HALF {
        let mut points = projected(theta);
        let (centre, radius) = circle(&points);
        let want = 0.5 * Real::tan(theta.to_radians());
        checks.push(Check::near(
            format!("radius of the circle for θh = {theta}°, tan θh / 2"),
            radius,
            want,
            1e-9,
        ));
        let off = ((centre[0] - want) * (centre[0] - want) + centre[1] * centre[1]).sqrt();
        checks.push(Check::at_most(
            format!("distance of its centre from tan θh / 2, θh = {theta}°"),
            off,
            1e-9,
        ));
        points.sort_by(|a, b| {
            Real::atan2(a[1] - centre[1], a[0] - centre[0])
                .total_cmp(&Real::atan2(b[1] - centre[1], b[0] - centre[0]))
        });
        curves.push(Curve { label: format!("θ_{{h}} = {theta}°"), points });
    }
    let plane = Chart {
        title: "Meridians, projected from the centre".to_owned(),
        subtitle: "the pole is at the origin; pole and half vector are ends of a diameter".to_owned(),
        x: x_axis("x / z"),
        y: Axis::fixed("y / z", -0.45, 0.45, 5),
        curves,
        rules: Vec::new(),
    };
    let pictures = vec![
        Picture::svg(
            "sphere",
            "A sphere with three curves: a meridian, a spiral and a loop through the pole.",
            on_sphere(),
        ),
        Picture::svg(
            "gnomonic",
            "Three circles through the origin, whose diameters end at the half vectors.",
            plane.svg(),
        ),
    ];
    Ok(Figure {
        caption: "Fibres tangent to the plane across the half vector reflect. On a sphere with fibres along parallels that is the meridian through the half vector, on one with fibres along \
            meridians a loop through the pole, which the projection from the centre turns into a circle with pole and half vector at the ends of a diameter (Thales). On a cylinder the \
            highlight is a straight line whatever the slant of the fibres, on a record a ray through its centre.\nLight and viewer are far away; the curves are computed, and drawn over renders below."
            .to_owned(),
        formulas: vec![
            Formula::new("t(x) * h = 0", "[LuKoenderinkKappers2000]", "lecture/src/topic/highlights/predict.rs: sphere"),
            Formula::new("tan θ = tan θ_h cos (φ - φ_h)", "[LuKoenderinkKappers2000]", "lecture/src/topic/highlights/predict.rs: sphere"),
            Formula::new("sin (φ - φ_h) = tan ω frac{h_z}{sqrt{h_x^2 + h_y^2}}", "[LuKoenderinkKappers2000]", "lecture/src/topic/highlights/predict.rs: cylinder"),
        ],
        pictures,
        table: Some(chart::table(&[&plane])),
        checks,
        ..Figure::default()
    }
    .with("θh", "15°, 25°, 40°"))
}

fn on_sphere() -> String {
    let h = half_vector(40.0, 20.0);
    let legend =
        TURNS.iter().enumerate().map(|(series, (name, _))| Entry { label: (*name).to_owned(), series });
    let mut sketch = Sketch::new(
        "Highlights on a sphere",
        "dots: half vector h and pole",
        legend.collect(),
        [20.0, 50.0],
        1.1,
    );
    let rim = [vec3(-0.342_020, 0.939_693, 0.0), vec3(-0.719_846, -0.262_003, 0.642_788)];
    sketch.line(&turn(180, |c, s| rim[0] * c + rim[1] * s), Pen::new(LIGHT.ink, 2.5));
    for (series, (_, turn)) in TURNS.iter().enumerate() {
        let (colour, _) = LIGHT.series(series);
        for run in sphere(h, *turn, 1500) {
            // Runs may jump where they pass from one side to the other.
            for pair in run.windows(2).filter(|p| (p[1] - p[0]).length() < 0.2) {
                sketch.round(pair, colour, 3.0);
            }
        }
    }
    sketch.dot(h, LIGHT.ink);
    sketch.label(h, "h");
    sketch.dot(vec3(0.0, 0.0, 1.0), LIGHT.soft);
    sketch.label(vec3(0.0, 0.0, 1.0), "pole");
    sketch.finish()
}

fn checks() -> Vec<Check> {
    let mut checks = Vec::new();
    let h25 = half_vector(25.0, 0.0);
    for (theta, want) in KNOWN {
        // tan theta = tan theta_h cos phi, asked of the curve itself.
        let runs = sphere(h25, FRAC_PI_2, 36_000);
        let at = |p: &&Vec3<f64>| (Real::acos(p.z).to_degrees() - theta).abs();
        let nearest = runs.iter().flatten().filter(|p| p.z > 0.0).min_by(|a, b| at(a).total_cmp(&at(b)));
        let cos = nearest.map_or(f64::NAN, |p| p.x / (p.x * p.x + p.y * p.y).sqrt());
        checks.push(Check::near(
            format!("cos φ of the loop at θ = {theta}°, θh = 25° (highlight.sphere_meridians)"),
            cos,
            want,
            1e-6,
        ));
    }
    let mut random = Random::named(0, "highlights");
    let (mut on, mut n) = ([0.0_f64; 3], 0.0);
    for _ in 0..200 {
        let (h, turn) = (random.direction().v(), random.within(0.0, FRAC_PI_2));
        // At the poles there is no tangent.
        for p in sphere(h, turn, 90).iter().flatten().filter(|p| p.z.abs() < 0.999_999) {
            on[0] = on[0].max(sphere_tangent(*p, turn).dot(h).abs());
            n += 1.0;
        }
        let around = |phi: f64| {
            let (s, c) = Real::sin_cos(phi);
            vec3(c, s, 0.0)
        };
        for phi in cylinder(h, turn) {
            on[1] = on[1].max(cylinder_tangent(around(phi), turn).dot(h).abs());
        }
        for phi in disc(h, turn) {
            on[2] = on[2].max(disc_tangent(around(phi), turn).dot(h).abs());
        }
    }
    for (body, off) in ["sphere", "cylinder", "disc"].iter().zip(on) {
        checks.push(Check::at_most(
            format!("largest |t·h| on predicted curves, random half vectors and slants: {body}"),
            off,
            1e-12,
        ));
    }
    checks.push(Check::at_least("points of predicted curves on spheres that were asked", n, 1000.0));
    checks
}
