//! Slide 27: what each technique costs under lights of four sizes over surfaces of four widths.

use sparrow_mis::{Drawn, multi_sample};
use sparrow_plot::draw::axis::{Axis, Scale, Tick};
use sparrow_plot::draw::heat::{Grid, Heat, Panel};
use sparrow_plot::draw::table::{Field, Table};
use sparrow_stats::{Mean, Random};

use super::circular_light::{CELLS, Cell, Problem, STRATEGIES};
use crate::chart::page;
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// Makes the figure.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let runs = studio.pick(20_000, 500_000);
    let mut table = Table::new(["strategy", "radius", "alpha", "integral", "relative_variance"]);
    let (mut values, mut checks) = (vec![Vec::new(); STRATEGIES.len()], Vec::new());
    let mut worst = 0.0_f64;
    for cell in &CELLS {
        let problem = Problem::new(cell)?;
        let (whole, got) = problem.variances();
        let mut off = 0.0_f64;
        for (k, (name, heuristic)) in STRATEGIES.iter().enumerate() {
            let numbers = [cell.radius, cell.alpha, whole, got[k]].map(Field::Number);
            table.rows.push(core::iter::once(Field::Text((*name).to_owned())).chain(numbers).collect());
            values[k].push(got[k]);
            off = off.max((got[k] - cell.known[k]).abs() / cell.known[k].max(1e-4));
            if let Some(h) = heuristic {
                worst = worst.max(departure(&problem, *h, whole, runs));
            }
        }
        let what =
            format!("largest difference of the five variances from matrix.R{}.a{}", cell.radius, cell.alpha);
        checks.push(Check::at_most(what, off, 2e-5));
    }
    // The largest of 48 normal numbers passes 4.5 once in 3000 times.
    checks.push(Check::at_most(
        format!("largest departure of {runs} drawn estimates from the integral, in standard errors"),
        worst,
        4.5,
    ));
    Ok(Figure {
        caption: "Each field is a light over a surface; dark is good. Drawing from the light fails for large lights over smooth surfaces, drawing from the lobe for small lights over \
            rough ones. Their weighted sum is nowhere bad. The power heuristic is better in the corners, where one technique is nearly perfect, and little worse between; maximum has no safe middle."
            .to_owned(),
        formulas: vec![
            Formula::new("F = sum_{k} frac{1}{n_k} sum_{j} w_k(X_{kj}) frac{f(X_{kj})}{p_k(X_{kj})}", "[VeachGuibas1995]", "mis/src/estimator.rs: multi_sample"),
            Formula::new("V = sum_{k} frac{1}{n_k} [ ∫ frac{w_k^2 f^2}{p_k} - (∫ w_k f)^2 ]", "[Veach1997, sec. 9.2]", "lecture/src/topic/mis/circular_light.rs: variances"),
        ],
        pictures: STRATEGIES
            .iter()
            .zip(&values)
            .map(|((name, _), v)| {
                let alt = format!("A field of four by four: variance by {name}, over roughness and radius of the light.");
                Picture::svg(&name.replace(' ', "-"), alt, heat(name, v))
            })
            .collect(),
        table: Some(table),
        checks,
        ..Figure::default()
    }
    .with("R", "0.0333, 0.1, 0.3, 0.9")
    .with("d", 4)
    .with("α", "0.005, 0.02, 0.05, 0.1")
    .with("samples", "one of each technique"))
}

/// How far the mean of drawn estimates lies from the integral, in standard errors.
fn departure(problem: &Problem, h: sparrow_mis::Heuristic, whole: f64, runs: u32) -> f64 {
    let mut random = Random::named(u64::from(runs), "circular light");
    let mut mean = Mean::default();
    for _ in 0..runs {
        let one = |by: usize, random: &mut Random| {
            let t = problem.draw(by, random);
            multi_sample(h, &[1.0, 1.0], Drawn { by, f: problem.f(t), pdf: &problem.pdf(t) })
        };
        mean.add(one(0, &mut random) + one(1, &mut random));
    }
    // Where both techniques are perfect there is rounding alone.
    (mean.value() - whole).abs() / mean.standard_error().max(1e-9 * whole)
}

/// The relative variance of one strategy over roughness and radius.
fn heat(name: &str, values: &[f64]) -> String {
    let names = |title: &str, of: &dyn Fn(&Cell) -> String, step: usize| {
        let tick = |k: usize| Tick { at: k as f64 + 0.5, label: of(&CELLS[k * step]) };
        Axis {
            title: title.to_owned(),
            lo: 0.0,
            hi: 4.0,
            scale: Scale::Linear,
            ticks: (0..4).map(tick).collect(),
        }
    };
    // What is below the scale, zero among it, has the darkest colour.
    let grid = Grid { nx: 4, ny: 4, values: values.iter().map(|v| v.max(1e-6)).collect() };
    Heat {
        page: page(&format!("Variance: {name}"), "over the square of the integral; dark is good", Vec::new()),
        x: names("roughness α", &|c| c.alpha.to_string(), 1),
        y: names("radius of the light", &|c| format!("{:.2}", c.radius), 4),
        colour: Axis::log_fixed("relative variance", 1e-6, 1e3, 6),
        panels: vec![Panel { title: String::new(), grid }],
    }
    .svg()
}
