//! Slide 3, figure 6 of the paper: Fresnel reflectance of a metal and a dielectric.

use sparrow_math::Real;
use sparrow_models::fresnel::{conductor, conductor_polarized, dielectric};
use sparrow_plot::draw::axis::Axis;

use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// Indices at 0.5 µm: aluminium, magnesium oxide, common glass.
const METAL: [f64; 2] = [0.77, 6.08];
const OXIDE: f64 = 1.7;
const GLASS: f64 = 1.5;

/// Degrees, then F: `fresnel.conductor.Al-500nm-approx`, `fresnel.dielectric.eta1.7000`, `fresnel.dielectric.eta1.5000`.
const KNOWN_METAL: [(f64, f64); 4] = [
    (0.0, 0.923_190_679_139_037_3),
    (45.0, 0.919_591_262_998_505_9),
    (75.0, 0.885_414_101_878_402_1),
    (85.0, 0.900_472_728_793_003),
];
const KNOWN_OXIDE: [(f64, f64); 4] = [
    (0.0, 0.067_215_363_511_659_8),
    (30.0, 0.069_023_467_824_763_18),
    (60.0, 0.120_335_068_575_350_41),
    (80.0, 0.411_714_650_241_277_57),
];
const KNOWN_GLASS: [(f64, f64); 4] = [
    (0.0, 0.04),
    (30.0, 0.041_522_625_975_821_52),
    (60.0, 0.089_186_712_802_212_74),
    (80.0, 0.387_704_354_691_472_5),
];

fn cos(degrees: f64) -> f64 {
    Real::cos(degrees.to_radians())
}
fn metal(degrees: f64) -> f64 {
    conductor(cos(degrees), METAL[0], METAL[1])
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let x = steps(0.0, 90.0, 360);
    let split = |a: f64| conductor_polarized(cos(a), METAL[0], METAL[1]);
    let chart = Chart {
        title: "Fresnel reflectance".to_owned(),
        subtitle: "at 0.5 µm, unpolarised unless said otherwise".to_owned(),
        x: Axis::fixed("angle of incidence  [deg]", 0.0, 90.0, 9),
        y: Axis::fixed("F", 0.0, 1.0, 5),
        curves: vec![
            Curve::of("0.77 + 6.08 i", &x, metal),
            Curve::of("1.7", &x, |a| dielectric(cos(a), OXIDE).0),
            Curve::of("1.5", &x, |a| dielectric(cos(a), GLASS).0),
            Curve::of("metal, s", &x, |a| split(a).0),
            Curve::of("metal, p", &x, |a| split(a).1),
        ],
        rules: Vec::new(),
    };
    let known = |name: &str, table: &[(f64, f64)], f: &dyn Fn(f64) -> f64| -> Vec<Check> {
        table
            .iter()
            .map(|(a, want)| Check::near(format!("F of {name} at {a}°"), f(*a), *want, 1e-9))
            .collect()
    };
    let mut checks = known("0.77 + 6.08 i", &KNOWN_METAL, &metal);
    checks.extend(known("1.7", &KNOWN_OXIDE, &|a| dielectric(cos(a), OXIDE).0));
    checks.extend(known("1.5", &KNOWN_GLASS, &|a| dielectric(cos(a), GLASS).0));
    let fine = steps(60.0, 89.9, 2990);
    let least = |f: &dyn Fn(f64) -> f64| {
        fine.iter().map(|a| (*a, f(*a))).min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0.0, 0.0))
    };
    let (at, _) = least(&metal);
    checks.push(Check::near("angle of the least F of the metal, between 75° and 85°", at, 80.0, 5.0));
    let (at, p) = least(&|a| split(a).1);
    checks.push(Check::near(
        "angle of the least F of the metal, p-polarised (pseudo-Brewster)",
        at,
        80.503_548_76,
        0.02,
    ));
    checks.push(Check::near("the least F of the metal, p-polarised", p, 0.771_848_399_8, 1e-4));
    // A cosine of zero.
    for (name, f) in [("metal", conductor(0.0, METAL[0], METAL[1])), ("1.7", dielectric(0.0, OXIDE).0)] {
        checks.push(Check::near(format!("F at 90°: {name}"), f, 1.0, 1e-12));
    }
    Ok(Figure {
        caption: "As figure 6 of the paper, with a metal and two dielectrics. Aluminium has its least reflectance near 80°, \
            a dip that Schlick's approximation cannot make.\nThe indices that the paper drew are not known to us: 0.77 + 6.08 i for \
            aluminium and 1.7 for magnesium oxide are our choice."
            .to_owned(),
        formulas: vec![
            Formula::new("F = frac{r_s^2 + r_p^2}{2} , r_p = frac{η cos θ_i - cos θ_t}{η cos θ_i + cos θ_t} , r_s = frac{cos θ_i - η cos θ_t}{cos θ_i + η cos θ_t}", "[Hecht, eq. 4.34, 4.40]", "models/src/fresnel.rs: dielectric"),
            Formula::new("F = frac{{|r_s|}^2 + {|r_p|}^2}{2} , η = n + i k", "[BornWolf, sec. 14.2]", "models/src/fresnel.rs: conductor"),
        ],
        pictures: vec![Picture::svg("", "Reflectance over the angle of incidence: a metal near 0.92 with a dip at 80 degrees, dielectrics that rise from 0.07 and 0.04 to 1.", chart.svg())],
        table: Some(chart::table(&[&chart])),
        checks,
        ..Figure::default()
    })
}
