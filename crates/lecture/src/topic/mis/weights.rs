//! Slide 28: densities and weights along a line through the highlight.

use sparrow_math::Real;
use sparrow_mis::Heuristic;
use sparrow_plot::draw::axis::Axis;
use sparrow_plot::draw::cartesian::Rule;
use sparrow_stats::Random;

use super::circular_light::{CELLS, Problem, weight};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// Which of the cells are shown: radius 0.1 and 0.9 over the width 0.05.
const SHOWN: [usize; 2] = [6, 14];
const HEURISTICS: [(&str, Heuristic); 5] = [
    ("balance", Heuristic::Balance),
    ("power", Heuristic::Power(2.0)),
    ("cutoff 0.1", Heuristic::Cutoff(0.1)),
    ("maximum", Heuristic::Maximum),
    ("average", Heuristic::Average),
];

/// One minus the cosine of an angle in degrees.
fn versine(degrees: f64) -> f64 {
    let s = Real::sin(0.5 * degrees.to_radians());
    2.0 * s * s
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let (mut charts, mut pictures) = (Vec::new(), Vec::new());
    for k in SHOWN {
        let cell = &CELLS[k];
        let problem = Problem::new(cell)?;
        let end = 2.0 * Real::asin((0.5 * problem.cap).sqrt()).to_degrees();
        let x = steps(-20.0, 20.0, 800);
        let rules = [-end, end].map(|at| Rule { at, label: "rim".to_owned() });
        let about =
            format!("light of radius {} at the distance 4, surface of width {}", cell.radius, cell.alpha);
        let axis = || Axis::fixed("angle from the mirror direction  [deg]", -20.0, 20.0, 8);
        let densities = Chart {
            title: format!("Densities, R = {}", cell.radius),
            subtitle: about.clone(),
            x: axis(),
            y: Axis::log("p  [1/sr]", 1e-2, 1e3, 5),
            curves: vec![
                Curve::of("p_{1}, light", &x, |a| problem.pdf(versine(a))[0]),
                Curve::of("p_{2}, lobe", &x, |a| problem.pdf(versine(a))[1]),
            ],
            rules: rules.to_vec(),
        };
        let of = |h: Heuristic, k: usize| move |p: [f64; 2]| weight(h, p, k);
        let curve = |name: &str, h: Heuristic, k: usize| {
            let w = of(h, k);
            Curve::of(name, &x, |a| w(problem.pdf(versine(a))))
        };
        let weights = Chart {
            title: format!("Weights, R = {}", cell.radius),
            subtitle: about,
            x: axis(),
            y: Axis::fixed("w", 0.0, 1.0, 5),
            curves: vec![
                curve("w_{1}, balance", Heuristic::Balance, 0),
                curve("w_{2}, balance", Heuristic::Balance, 1),
                curve("w_{1}, power", Heuristic::Power(2.0), 0),
                curve("w_{2}, power", Heuristic::Power(2.0), 1),
            ],
            rules: rules.to_vec(),
        };
        pictures.push(Picture::svg(
            &format!("densities-{}", cell.radius),
            format!(
                "Densities of both techniques across the highlight of a light of radius {}.",
                cell.radius
            ),
            densities.svg(),
        ));
        pictures.push(Picture::svg(&format!("weights-{}", cell.radius), format!("Weights of both techniques across the highlight of a light of radius {}; they add up to one.", cell.radius), weights.svg()));
        charts.extend([densities, weights]);
    }
    Ok(Figure {
        caption: "Where the light is dense, technique 1 gets the weight, where the lobe is dense, technique 2; outside of the light's rim only the lobe's samples arrive. At every place the weights \
            add up to one.\nThe slide concludes that p = w1 p1 + w2 p2 were the density drawn from. It is none: its integral exceeds one unless both techniques are the same, \
            as the last check shows for p1 = 1, p2 = 2x. What the estimate divides by is n1 p1 + n2 p2."
            .to_owned(),
        formulas: vec![
            Formula::new("w_i(x) = frac{p_i(x)}{p_1(x) + p_2(x)}", "[VeachGuibas1995]", "mis/src/heuristic.rs: weight"),
            Formula::new("w_i = frac{(n_i p_i)^2}{sum_{k} (n_k p_k)^2}", "[VeachGuibas1995]", "mis/src/heuristic.rs: weight"),
        ],
        pictures,
        table: Some(chart::table(&charts.iter().collect::<Vec<_>>())),
        checks: checks()?,
        ..Figure::default()
    }
    .with("R", "0.1, 0.9")
    .with("α", 0.05)
    .with("samples", "one of each technique"))
}

fn checks() -> Result<Vec<Check>, LectureError> {
    let mut checks = Vec::new();
    for (name, h) in HEURISTICS {
        let mut off = 0.0_f64;
        for k in SHOWN {
            let problem = Problem::new(&CELLS[k])?;
            for a in steps(-20.0, 20.0, 800) {
                let pdf = problem.pdf(versine(a));
                off = off.max((weight(h, pdf, 0) + weight(h, pdf, 1) - 1.0).abs());
            }
        }
        let mut random = Random::named(0, "weights");
        for _ in 0..1000 {
            let mut density = || Real::exp(random.within(-60.0, 60.0));
            let pdf = [density(), density()];
            off = off.max((weight(h, pdf, 0) + weight(h, pdf, 1) - 1.0).abs());
        }
        checks.push(Check::at_most(format!("largest |w1 + w2 − 1|, {name}"), off, 1e-14));
    }
    let n = 20_000;
    let place = |k: u32| (f64::from(k) + 0.5) / f64::from(n);
    let slide = |x: f64| {
        let pdf = [1.0, 2.0 * x];
        weight(Heuristic::Balance, pdf, 0) * pdf[0] + weight(Heuristic::Balance, pdf, 1) * pdf[1]
    };
    let integral: f64 = (0..n).map(|k| slide(place(k))).sum::<f64>() / f64::from(n);
    checks.push(Check::near(
        "∫ (w1 p1 + w2 p2) for p1 = 1, p2 = 2x: ln 3, not 1",
        integral,
        1.098_612_288_668_11,
        1e-6,
    ));
    Ok(checks)
}
