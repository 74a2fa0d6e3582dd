//! Slide 13: how light is spread around the cone.

use core::f64::consts::PI;

use sparrow_math::Real;
use sparrow_models::Uniforms;
use sparrow_models::cylinder::FibreDir;
use sparrow_models::cylinder::roots::of_r;
use sparrow_plot::draw::axis::Axis;
use sparrow_stats::{Cell, Random, chi_square};

use crate::ask::{fibre, inclined, scattered};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// `cylinder.NR` of the reference sheet: degrees, density in 1/rad.
const KNOWN: [(f64, f64); 4] =
    [(0.0, 0.25), (60.0, 0.216_506_350_946_109_68), (120.0, 0.125), (170.0, 0.021_788_935_686_914_535)];
const CELLS: usize = 72;

/// Share of the light between two azimuths, by the density's integral `sin(phi / 2) / 2`.
fn share(from: f64, to: f64) -> f64 {
    let upto = |phi: f64| 0.5 * Real::sin(0.5 * phi.to_radians());
    upto(to) - upto(from)
}

/// Makes the figure.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let rays = studio.pick(1_000_000, 10_000_000);
    let far = fibre("mirror_cylinder field=far")?;
    let light = inclined(25.0, 40.0);
    let from = FibreDir::new(light);
    let mut random = Random::named(0, "azimuths");
    let mut counts = [0.0_f64; CELLS];
    for _ in 0..rays {
        let u = Uniforms { lobe: 0.5, dir: [random.uniform(), random.uniform()] };
        let phi = from.azimuth_to(&FibreDir::new(scattered(&far, light, u).wi));
        let cell = ((phi + PI) / (2.0 * PI) * CELLS as f64) as usize;
        counts[cell.min(CELLS - 1)] += 1.0;
    }
    let width = 360.0 / CELLS as f64;
    let edge = |k: usize| k as f64 * width - 180.0;
    let expected = |k: usize| f64::from(rays) * share(edge(k), edge(k + 1));
    let cells: Vec<Cell> =
        (0..CELLS).map(|k| Cell { observed: counts[k], expected: expected(k), slack: 0.0 }).collect();
    let test = chi_square(&cells);
    let per_radian = |n: f64| n / (f64::from(rays) * width.to_radians());
    let x = steps(-180.0, 180.0, 360);
    let bars =
        (0..CELLS).flat_map(|k| [[edge(k), per_radian(counts[k])], [edge(k + 1), per_radian(counts[k])]]);
    let chart = Chart {
        title: "Light around the cone".to_owned(),
        subtitle: format!("{rays} traced rays in cells of {width}°, and the density"),
        x: Axis::degrees("azimuth from the light  [deg]", -180.0, 180.0),
        y: Axis::fixed("N_{R}  [1/rad]", 0.0, 0.3, 6),
        curves: vec![
            Curve { label: "traced".to_owned(), points: bars.collect() },
            Curve::of("cos(φ/2) / 4", &x, |phi| of_r(phi.to_radians()).density),
        ],
        rules: Vec::new(),
    };
    let mut checks =
        vec![Check::at_least(format!("chi-square over {CELLS} cells: probability p"), test.p, 1e-3)];
    for (phi, want) in KNOWN {
        checks.push(Check::near(
            format!("density at {phi}° (cylinder.NR)"),
            of_r(phi.to_radians()).density,
            want,
            1e-12,
        ));
    }
    let whole: f64 = steps(-179.5, 179.5, 359).iter().map(|p| of_r(p.to_radians()).density.to_owned()).sum();
    checks.push(Check::near("integral over all azimuths", whole.to_radians(), 1.0, 1e-4));
    Ok(Figure {
        caption: "Under parallel light the offsets h are uniform. What lies between h and h + dh turns by 2 dh/√(1 − h²), so that light is densest towards \
            the light and vanishes behind the fibre. The same holds for every inclination."
            .to_owned(),
        formulas: vec![Formula::new("N_R(φ) = frac{1}{4} cos frac{φ}{2}", "[Marschner2003, sec. 5.2]", "models/src/cylinder/roots.rs: of_r")],
        pictures: vec![Picture::svg("", "A histogram of azimuths over the density, a cosine of the half angle; they coincide.", chart.svg())],
        table: Some(chart::table(&[&chart])),
        checks,
        ..Figure::default()
    }
    .with("rays", rays)
    .with("θi", "25°")
    .with("seed", 0))
}
