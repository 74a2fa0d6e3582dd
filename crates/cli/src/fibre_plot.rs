//! The errors of fibre models as a picture: [`draw`].

use sparrow_plot::Figure;
use sparrow_plot::draw::axis::{Axis, Scale, Tick};
use sparrow_plot::draw::heat::{Grid, Heat, Panel};
use sparrow_plot::draw::page::Page;
use sparrow_plot::draw::table::{Field, Table};
use sparrow_plot::draw::theme::LIGHT;
use sparrow_verify::reference_fibre::ModelError;

/// Absorption of what is shown; the table holds the others too.
const SIGMA_A: f64 = 0.2;
const LOBES: [&str; 4] = ["R", "TT", "TRT", "more"];

/// A panel for every model: the share of each lobe that lies in the wrong place, over roughness and inclination.
pub(crate) fn draw(rows: &[ModelError], samples: u32) -> Figure {
    let shown: Vec<&ModelError> = rows.iter().filter(|r| (r.sigma_a - SIGMA_A).abs() < 1e-9).collect();
    let (mut models, mut places): (Vec<&str>, Vec<String>) = (Vec::new(), Vec::new());
    for r in &shown {
        let place = place(r);
        if !models.contains(&r.model) {
            models.push(r.model);
        }
        if !places.contains(&place) {
            places.push(place);
        }
    }
    let panel = |model: &&str| {
        let of: Vec<&&ModelError> = shown.iter().filter(|r| r.model == *model).collect();
        let row = |at: &String| of.iter().find(|r| place(r) == *at).map(|r| r.lobes);
        let values = places.iter().flat_map(|at| {
            row(at).map_or([f64::NAN; LOBES.len()], |lobes| lobes.map(|e| 100.0 * e.misplaced))
        });
        let grid = Grid { nx: LOBES.len(), ny: places.len(), values: values.collect() };
        Panel { title: (*model).to_owned(), grid }
    };
    let panels: Vec<Panel> = models.iter().map(panel).collect();
    let page = Page {
        size: [1500.0, 1280.0],
        theme: LIGHT,
        title: "Fibre models against a fibre".to_owned(),
        subtitle: format!(
            "share of each lobe in the wrong place, over roughness and inclination  ·  η = 1.55, σ_{{a}} = {SIGMA_A}, far field, {samples} rays a place"
        ),
        legend: Vec::new(),
        notes: vec![
            "Differences of light count as misplaced too. fur: against a fibre with a core.".to_owned(),
        ],
    };
    let heat = Heat {
        page,
        x: names("lobe", &LOBES.map(str::to_owned)),
        y: names("", &places),
        // What is more than all of a lobe gets the last colour.
        colour: Axis::fixed("misplaced  [%]", 0.0, 100.0, 6),
        panels,
    };
    Figure { svg: heat.svg(), table: table(rows) }
}

fn place(r: &ModelError) -> String {
    format!("{}, {}°", r.at.beta, r.at.theta_deg)
}

/// An axis of names, from the lowest or leftmost.
fn names(title: &str, labels: &[String]) -> Axis {
    let tick = |(k, label): (usize, &String)| Tick { at: k as f64 + 0.5, label: label.clone() };
    Axis {
        title: title.to_owned(),
        lo: 0.0,
        hi: labels.len().max(1) as f64,
        scale: Scale::Linear,
        ticks: labels.iter().enumerate().map(tick).collect(),
    }
}

/// Every number.
fn table(rows: &[ModelError]) -> Table {
    let mut table = Table::new([
        "model",
        "beta",
        "theta_deg",
        "sigma_a",
        "lobe",
        "fibre",
        "standard_error",
        "model_light",
        "misplaced",
        "by_chance",
    ]);
    for r in rows {
        for (lobe, e) in LOBES.into_iter().zip(&r.lobes) {
            let place = [r.at.beta, r.at.theta_deg, r.sigma_a].map(Field::Number);
            let light = [e.truth, e.truth_error, e.model, e.misplaced, e.chance].map(Field::Number);
            let name = |text: &str| core::iter::once(Field::Text(text.to_owned()));
            table.rows.push(name(r.model).chain(place).chain(name(lobe)).chain(light).collect());
        }
    }
    table
}
