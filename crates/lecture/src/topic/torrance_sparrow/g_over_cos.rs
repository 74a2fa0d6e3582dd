//! Slide 4, figure 7 of the paper: `G / cos theta` in the plane of incidence.

use sparrow_math::Real;
use sparrow_models::Surface;
use sparrow_plot::draw::axis::Axis;
use sparrow_plot::draw::cartesian::Rule;

use crate::ask::{f_in_plane, surface};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// With an exponent of zero and F = 1 this is `G / (4 cos psi cos theta)`.
const WORDS: &str = "torrance_sparrow exponent=0 distribution=unnormalized masking=v_cavity fresnel=constant";

/// Angles of the viewer in degrees at which [`KNOWN`] has numbers.
#[rustfmt::skip]
const THETA: [f64; 14] = [-80.0, -60.0, -40.0, -20.0, 0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 75.0, 80.0, 85.0, 88.0];
/// Incidence in degrees, and `G / cos theta`: `ts67.GoverCos.psi0` to `psi75` of the reference sheet.
#[rustfmt::skip]
#[expect(clippy::approx_constant, reason = "numbers of the reference sheet, to ten digits")]
const KNOWN: [(f64, [f64; 14]); 6] = [
    (0.0, [
        2.0, 2.0, 1.305_407_289_3, 1.064_177_772_5, 1.0, 1.035_276_180_4, 1.154_700_538_4,
        1.414_213_562_4, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0,
    ]),
    (15.0, [
        1.602_079_819_4, 1.717_438_935_2, 1.305_407_289_3, 1.064_177_772_5, 1.0, 1.035_276_180_4, 1.154_700_538_4,
        1.414_213_562_4, 2.0, 2.406_179_571_5, 2.449_489_742_8, 2.496_754_500_9, 2.548_748_706_2, 2.582_611_920_4,
    ]),
    (30.0, [
        1.265_743_149_4, 1.464_101_615_1, 1.305_407_289_3, 1.064_177_772_5, 1.0, 1.035_276_180_4, 1.154_700_538_4,
        1.414_213_562_4, 2.0, 2.923_804_400_2, 3.035_276_180_4, 3.160_198_814_3, 3.301_736_384_7, 3.396_330_289_9,
    ]),
    (45.0, [
        0.968_313_738_9, 1.228_028_814_8, 1.305_407_289_3, 1.064_177_772_5, 1.0, 1.035_276_180_4, 1.154_700_538_4,
        1.414_213_562_4, 2.0, 2.923_804_400_2, 3.863_703_305_2, 4.130_892_539_4, 4.447_004_334, 4.666_682_084,
    ]),
    (60.0, [
        0.694_592_710_7, 1.0, 0.852_044_095_5, 0.867_525_668_6, 1.0, 1.035_276_180_4, 1.154_700_538_4,
        1.414_213_562_4, 2.0, 2.923_804_400_2, 3.863_703_305_2, 5.758_770_483_1, 6.493_363_338_7, 7.040_379_003_8,
    ]),
    (75.0, [
        0.433_291_625_5, 0.399_601_69, 0.380_688_083_1, 0.419_560_729_5, 0.517_638_090_2, 0.656_338_798_4, 0.907_118_058_2,
        1.414_213_562_4, 2.0, 2.923_804_400_2, 3.863_703_305_2, 5.758_770_483_1, 11.473_713_245_7, 13.443_959_326_9,
    ]),
];

/// `G / cos theta`, angles in degrees.
fn g_over_cos(model: &Surface<f64>, psi: f64, theta: f64) -> f64 {
    4.0 * Real::cos(psi.to_radians()) * f_in_plane(model, psi, theta)
}

/// Where `G` begins to fall below one on the mirror's side, in degrees.
fn kink(model: &Surface<f64>, psi: f64) -> f64 {
    let open = |theta: f64| g_over_cos(model, psi, theta) * Real::cos(theta.to_radians()) > 1.0 - 1e-10;
    let (mut lo, mut hi) = (psi, 89.999);
    for _ in 0..60 {
        let middle = 0.5 * (lo + hi);
        if open(middle) { lo = middle } else { hi = middle }
    }
    lo
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let model = surface(WORDS)?;
    let x = steps(-89.8, 89.8, 898);
    let (mut checks, mut rules) = (Vec::new(), Vec::new());
    for (psi, values) in &KNOWN {
        let end = (180.0 + psi) / 3.0;
        checks.push(Check::near(
            format!("kink for ψ = {psi}°, at (180 + ψ)/3"),
            kink(&model, *psi),
            end,
            1e-3,
        ));
        rules.push(Rule { at: end, label: String::new() });
        let off = THETA.iter().zip(values).map(|(t, want)| (g_over_cos(&model, *psi, *t) - want).abs());
        let what = format!("largest difference from ts67.GoverCos.psi{psi}, 14 angles");
        checks.push(Check::at_most(what, off.fold(0.0, f64::max), 1e-9));
    }
    let chart = Chart {
        title: "G/cos θ in the plane of incidence".to_owned(),
        subtitle: "ψ is the angle of incidence; rules stand at (180° + ψ)/3, where masking begins".to_owned(),
        x: Axis::degrees("θ  [deg]", -90.0, 90.0),
        y: Axis::fixed("G / cos θ", 0.0, 8.0, 8),
        curves: KNOWN
            .iter()
            .map(|(psi, _)| Curve::of(format!("ψ = {psi}°"), &x, |t| g_over_cos(&model, *psi, t)))
            .collect(),
        rules,
    };
    Ok(Figure {
        caption: "As figure 7 of the paper. Up to (180° + ψ)/3 the facets hide nothing of each other, and the curve is 1/cos θ; beyond, neighbours mask \
            them. The curve for 75° leaves the picture and reaches 15.2.\nWhich incidences the paper drew is not known to us; these are our choice."
            .to_owned(),
        formulas: vec![
            Formula::new("frac{G}{cos θ} = min ( frac{1}{cos θ} , frac{2 cos α}{cos p} , frac{2 cos α cos ψ}{cos p cos θ} ) , α = frac{θ - ψ}{2} , p = frac{θ + ψ}{2}", "[TorranceSparrow1967]", "models/src/v_cavity.rs: g_over_4cos"),
            Formula::new("frac{G}{cos θ} = 2 frac{1 + tan(ψ/2) tan(θ/2)}{1 - tan(ψ/2) tan(θ/2)} , θ > frac{180° + ψ}{3}", "[Blinn1977]", "models/src/v_cavity.rs: g_over_4cos"),
        ],
        commands: vec![format!("sparrow plot {WORDS} wo=0 wo=45 wo=75 --kind cartesian")],
        pictures: vec![Picture::svg("", "Six curves over the viewer's angle from -90 to 90 degrees. Each follows 1/cos θ and bends at its own kink between 60 and 85 degrees.", chart.svg())],
        table: Some(chart::table(&[&chart])),
        checks,
        ..Figure::default()
    }
    .with("ψ", "0°, 15°, 30°, 45°, 60°, 75°"))
}
