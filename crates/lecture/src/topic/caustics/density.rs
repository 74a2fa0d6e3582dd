//! Slide 23: the density of TRT around the light, with and without smoothing, against traced rays.

use core::f64::consts::PI;

use sparrow_math::Real;
use sparrow_models::cylinder::attenuation::Inside;
use sparrow_models::cylinder::azimuthal::{exit_azimuth, wrapped};
use sparrow_models::cylinder::roots::of_trt;
use sparrow_models::{Fibre, fibre_cosine};
use sparrow_plot::draw::axis::Axis;
use sparrow_spectra::Spectrum;

use crate::ask::{fibre, inclined, lobes};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

const ETA: f64 = 1.55;
const SIGMA_A: f64 = 0.2;
/// Cells of a degree on either side of the light.
const CELLS: usize = 60;
/// Azimuth in degrees, density and smoothed density: `marschner.NTRT.*.thd0` of the reference sheet, for k_G = 2 and w_c = 15 degrees.
const KNOWN: [(f64, [f64; 2]); 5] = [
    (1.0, [0.028_443_235, 0.044_978_301]),
    (10.0, [0.032_456_401, 0.044_265_810]),
    (17.0, [0.062_455_988, 0.042_213_484]),
    (30.0, [0.0, 0.029_997_921]),
    (60.0, [0.0, 0.000_883_661]),
];

/// The mean of `A_2` over the width: `attenuation.mean.0`.
const MEAN: f64 = 0.027_170_383;

/// `A_2` of light across the fibre at the offset `h`.
fn share(h: f64) -> f64 {
    Inside::new([0.0, 1.0], h, ETA).attenuation(Spectrum::splat(SIGMA_A))[2].average()
}

/// The sum over the offsets that leave at `phi` degrees.
fn by_roots(phi: f64) -> f64 {
    of_trt(phi.to_radians(), ETA)
        .iter()
        .map(|r| if r.density > 0.0 { share(r.h) * r.density } else { 0.0 })
        .sum()
}

/// N of TRT with its caustics smoothed: the model's lobe over M, where light inside goes across the fibre.
fn smoothed(model: &Fibre<f64>, phi: f64) -> f64 {
    // theta_d = 0, and theta_h = 11.25 degrees is the middle of TRT.
    let (o, i) = (inclined(11.25, 0.0), inclined(11.25, phi));
    let m = 0.5 / (15.0_f64.to_radians() * (2.0 * PI).sqrt());
    lobes(model, o, i)[2] / (m * fibre_cosine(i))
}

/// Shares of `n` rays of even offsets in cells of a degree from -60, and the sum over all azimuths.
fn traced(n: u32) -> (Vec<f64>, f64) {
    let (mut cells, mut sum) = (vec![0.0; 2 * CELLS], 0.0);
    for k in 0..n {
        let h = (2.0 * f64::from(k) + 1.0) / f64::from(n) - 1.0;
        let ray = Inside::new([0.0, 1.0], h, ETA);
        let a = ray.attenuation(Spectrum::splat(SIGMA_A))[2].0[0] / f64::from(n);
        let phi = wrapped(exit_azimuth(2, Real::asin(h), ray.angle())).to_degrees();
        let cell = phi + CELLS as f64;
        if (0.0..2.0 * CELLS as f64).contains(&cell) {
            cells[cell as usize] += a;
        }
        sum += a;
    }
    (cells, sum)
}

/// Makes the figure.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let rays = studio.pick(1_000_000, 10_000_000);
    let (cells, sum) = traced(rays);
    let smooth = fibre("marschner sigma_a=0.2 glint=2 glint_width=15")?;
    let x = steps(-60.0, 60.0, 960);
    let edge = |k: usize| k as f64 - CELLS as f64;
    let bars = cells
        .iter()
        .enumerate()
        .flat_map(|(k, a)| [[edge(k), a / PI * 180.0], [edge(k + 1), a / PI * 180.0]]);
    let chart = Chart {
        title: "TRT around the light".to_owned(),
        subtitle: format!("light across the fibre, η = {ETA}, σa = {SIGMA_A}; {rays} traced rays"),
        x: Axis::fixed("azimuth from the light  [deg]", -60.0, 60.0, 6),
        y: Axis::fixed("N_{TRT}  [1/rad]", 0.0, 0.12, 6),
        curves: vec![
            Curve { label: "traced".to_owned(), points: bars.collect() },
            Curve::of("sum over roots", &x, by_roots),
            Curve::of("smoothed", &x, |phi| smoothed(&smooth, phi)),
        ],
        rules: Vec::new(),
    };
    let checks = checks(&cells, sum, &smooth);
    Ok(Figure {
        caption: "The sum over all offsets that leave in one direction is infinite at the caustic, like one over the root of the distance. Traced rays agree with it away from there. Real fibres \
            are not perfect cylinders: the model cuts the peak out and puts a Gaussian of about the same light in its place."
            .to_owned(),
        formulas: vec![
            Formula::new("N_p(φ) = sum_{r} A_p(h_r) {| 2 frac{dΦ_p}{dh}(h_r) |}^{-1}", "[Marschner2003, sec. 5.2]", "models/src/cylinder/roots.rs: of_trt"),
            Formula::new("Δh = min ( Δh_M , 2 sqrt{frac{2 w_c}{|Φ''_2(h_c)|}} )", "[Marschner2003, sec. 5.2.2]", "models/src/fibre/marschner.rs: caustic"),
        ],
        commands: vec!["sparrow plot marschner sigma_a=0.2 glint=2 wo=0 --kind caustic".to_owned()],
        pictures: vec![Picture::svg("", "A histogram of traced rays and the sum over roots, with peaks at 18.6 degrees on either side; the smoothed density has none.", chart.svg())],
        table: Some(chart::table(&[&chart])),
        checks,
        ..Figure::default()
    }
    .with("η", ETA)
    .with("σa", SIGMA_A)
    .with("rays", rays)
    .with("kG, wc", "2, 15°"))
}

fn checks(cells: &[f64], sum: f64, smooth: &Fibre<f64>) -> Vec<Check> {
    let mut checks = Vec::new();
    for (phi, [raw, smoothed_there]) in KNOWN {
        checks.push(Check::near(
            format!("N at {phi}°, sum over roots (marschner.NTRT.phi{phi}.thd0)"),
            by_roots(phi),
            raw,
            1e-6,
        ));
        checks.push(Check::near(
            format!("N at {phi}°, smoothed"),
            smoothed(smooth, phi),
            smoothed_there,
            1e-6,
        ));
    }
    // Cells that end before the caustic at 18.6 degrees and the edge at 19.3.
    let mean = |k: usize| {
        let x = |j: u32| k as f64 - CELLS as f64 + (f64::from(j) + 0.5) / 32.0;
        (0..32).map(|j| by_roots(x(j))).sum::<f64>() / 32.0 * (PI / 180.0)
    };
    let within = (CELLS - 16)..(CELLS + 16);
    let off = within.map(|k| (cells[k] / mean(k) - 1.0).abs()).fold(0.0, f64::max);
    checks.push(Check::at_most(
        "largest relative difference of traced rays from the sum over roots, up to 16°",
        off,
        0.01,
    ));
    checks.push(Check::near("light of all traced rays, the mean of A (attenuation.mean.0)", sum, MEAN, 1e-5));
    let outside: f64 = cells.iter().take(CELLS - 20).chain(&cells[CELLS + 20..]).sum();
    checks.push(Check::at_most("light beyond 20°", outside, 0.0));
    let fine = steps(-20.0, 20.0, 200_000);
    let integral: f64 =
        fine.windows(2).map(|e| by_roots(0.5 * (e[0] + e[1])) * (e[1] - e[0]).to_radians()).sum();
    // The integrand has the root of the distance from the caustic below: one cell of 0.0002 degrees is worth 0.3 %.
    checks.push(Check::near(
        "integral of the sum over roots, over the mean of A",
        integral / MEAN,
        1.0,
        0.005,
    ));
    checks
}
