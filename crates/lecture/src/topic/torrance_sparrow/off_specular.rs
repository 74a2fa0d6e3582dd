//! Slides 5 and 6: reflectance over that in the mirror direction, and where it is largest.

use core::f64::consts::PI;

use sparrow_models::Surface;
use sparrow_plot::draw::axis::Axis;
use sparrow_plot::draw::page::Entry;
use sparrow_plot::draw::polar::{Lobe, Polar};

use crate::ask::{f_in_plane, surface};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

const PSI: [f64; 5] = [10.0, 30.0, 45.0, 60.0, 75.0];
/// Decay of the facets' distribution, in 1/degree.
const C: f64 = 0.05;

/// Place of the largest ratio in degrees, and the ratio, for each of [`PSI`].
type Peaks = [[f64; 2]; 5];
/// `ts67.offspecular.c0.05.conductor 0.77+6.08i` of the reference sheet, on its grid that ends at 89.9 degrees.
const ALUMINIUM: Peaks =
    [[13.3, 1.005_078_3], [42.9, 1.064_501_9], [75.0, 1.540_201_0], [80.0, 2.206_556_8], [89.9, 3.392_355_4]];
/// `ts67.offspecular.c0.05.dielectric n=1.7`.
const OXIDE: Peaks =
    [[13.4, 1.005_331_0], [70.0, 1.174_946_7], [75.0, 2.373_647_1], [89.9, 4.977_338_1], [89.9, 6.055_731_4]];

/// Shares of the constant term, over the value in the mirror direction at 10 degrees.
const CONSTANT: [f64; 4] = [0.0, 0.5, 1.0, 2.0];

/// Reflectance over that in the mirror direction.
fn ratio(model: &Surface<f64>, psi: f64, theta: f64) -> f64 {
    f_in_plane(model, psi, theta) / f_in_plane(model, psi, psi)
}

/// Where the ratio is largest, on the grid of the reference sheet, and how large.
fn peak(model: &Surface<f64>, psi: f64) -> [f64; 2] {
    let grid = steps(-89.9, 89.9, 17_980);
    let best = grid.iter().map(|t| (*t, f_in_plane(model, psi, *t))).max_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or([0.0; 2], |(t, f)| [t, f / f_in_plane(model, psi, psi)])
}

fn cartesian(title: &str, subtitle: &str, model: &Surface<f64>, highest: f64) -> Chart {
    let x = steps(-89.8, 89.8, 898);
    Chart {
        title: title.to_owned(),
        subtitle: subtitle.to_owned(),
        x: Axis::degrees("θ  [deg]", -90.0, 90.0),
        y: Axis::fixed("f(θ) / f(ψ)", 0.0, highest, 6),
        curves: PSI
            .iter()
            .map(|psi| Curve::of(format!("ψ = {psi}°"), &x, |t| ratio(model, *psi, t)))
            .collect(),
        rules: Vec::new(),
    }
}

fn polar(title: &str, model: &Surface<f64>, highest: f64) -> String {
    let x = steps(-89.8, 89.8, 898);
    let lobe = |(series, psi): (usize, &f64)| Lobe {
        series,
        points: x.iter().map(|t| [*t, ratio(model, *psi, *t)]).collect(),
        spikes: Vec::new(),
    };
    let legend = PSI.iter().enumerate().map(|(series, psi)| Entry { label: format!("ψ = {psi}°"), series });
    Polar {
        page: chart::page(title, "f(θ) / f(ψ), over the angle θ", legend.collect()),
        r: Axis::fixed("", 0.0, highest, 4),
        full: false,
        lobes: PSI.iter().enumerate().map(lobe).collect(),
        rays: Vec::new(),
    }
    .svg()
}

fn peaks(model: &Surface<f64>, known: &Peaks, id: &str) -> Vec<Check> {
    let mut checks = Vec::new();
    for (psi, [at, height]) in PSI.iter().zip(known) {
        let [got_at, got_height] = peak(model, *psi);
        // One step of the grid, and flat peaks.
        checks.push(Check::near(format!("place of the peak for ψ = {psi}° ({id})"), got_at, *at, 0.021));
        checks.push(Check::near(
            format!("height of the peak for ψ = {psi}° over the mirror direction"),
            got_height,
            *height,
            1e-5 * height,
        ));
    }
    checks
}

fn formulas() -> Vec<Formula> {
    vec![
        Formula::new(
            "f_r = k frac{F(ψ', n) G(ψ, θ) exp(-c^2 α^2)}{4 cos ψ cos θ} + frac{ρ_d}{π}",
            "[TorranceSparrow1967]",
            "models/src/surface/torrance_sparrow_1967.rs: eval",
        ),
        Formula::new(
            "α = frac{θ - ψ}{2} , ψ' = frac{θ + ψ}{2}",
            "[TorranceSparrow1967]",
            "models/src/opaque.rs: new",
        ),
    ]
}

const STYLE: &str = "Model in the style of the paper; no measured points are drawn, as we have none. That c = 0.05 per degree and ψ from 10° to 75° are the \
    paper's is remembered, not checked; the index is our choice.";

/// Slide 5.
pub(super) fn aluminium(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let words = format!("torrance_sparrow_1967 c_per_deg={C} eta=0.77 k=6.08");
    let model = surface(&words)?;
    let lines = cartesian("Aluminium", "reflectance over that in the mirror direction", &model, 3.6);
    Ok(Figure {
        caption: format!(
            "The greatest reflectance lies beyond the mirror direction and moves towards grazing as the incidence grows. From 45° on it \
             sits on the kink of G, at (180° + ψ)/3, or at grazing.\n{STYLE}"
        ),
        formulas: formulas(),
        commands: vec![format!("sparrow plot {words} wo=10 wo=30 wo=45 wo=60 wo=75 --kind cartesian")],
        pictures: vec![
            Picture::svg("cartesian", "Five curves that pass 1 at their own incidence and peak beyond it, at 3.4 for 75 degrees.", lines.svg()),
            Picture::svg("polar", "The same curves in polar coordinates.", polar("Aluminium", &model, 3.5)),
        ],
        table: Some(chart::table(&[&lines])),
        checks: peaks(&model, &ALUMINIUM, "ts67.offspecular.c0.05.conductor"),
        ..Figure::default()
    }
    .with("c", "0.05 per degree")
    .with("index", "0.77 + 6.08 i"))
}

/// Slide 6.
pub(super) fn magnesium_oxide(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let words = |diffuse: f64| format!("torrance_sparrow_1967 c_per_deg={C} eta=1.7 k=0 diffuse={diffuse}");
    let facets = surface(&words(0.0))?;
    let mirror = f_in_plane(&facets, 10.0, 10.0);
    let mut checks = peaks(&facets, &OXIDE, "ts67.offspecular.c0.05.dielectric");
    let (mut charts, mut pictures, mut before) = (Vec::new(), Vec::new(), [f64::INFINITY; 5]);
    for share in CONSTANT {
        let model = surface(&words(PI * share * mirror))?;
        let chart = cartesian(
            &format!("Magnesium oxide, g/f = {share}"),
            "g is the constant term, f the facets' value in the mirror direction at 10°",
            &model,
            6.5,
        );
        let alt = format!(
            "Reflectance over that in the mirror direction for five incidences, with a constant term of {share}."
        );
        pictures.push(Picture::svg(&format!("{share}"), alt, chart.svg()));
        charts.push(chart);
        for (psi, before) in PSI.iter().zip(&mut before) {
            let [_, height] = peak(&model, *psi);
            if share > 0.0 {
                checks.push(Check::at_most(
                    format!("peak for ψ = {psi}°, g/f = {share}, lower than with less"),
                    height,
                    *before,
                ));
            }
            if share > 0.0 && *psi >= 45.0 {
                checks.push(Check::at_least(
                    format!("peak for ψ = {psi}°, g/f = {share}, still above the mirror direction"),
                    height,
                    1.1,
                ));
            }
            *before = height;
        }
    }
    pictures.push(Picture::svg(
        "polar",
        "The curves without a constant term in polar coordinates.",
        polar("Magnesium oxide, g/f = 0", &facets, 6.0),
    ));
    let charts: Vec<&Chart> = charts.iter().collect();
    Ok(Figure {
        caption: format!(
            "The same for a ceramic: facets of index 1.7, and a constant term for light from within. The constant flattens the curves; \
             beyond ψ = 45° the off-specular peak survives it.\n{STYLE} The share of the constant term, which a fit would give, is shown at four values."
        ),
        formulas: formulas(),
        commands: vec![format!("sparrow plot {} wo=10 wo=45 wo=75 --kind cartesian", words(0.0))],
        pictures,
        table: Some(chart::table(&charts)),
        checks,
        ..Figure::default()
    }
    .with("c", "0.05 per degree")
    .with("index", "1.7")
    .with("g/f", "0, 0.5, 1, 2"))
}
