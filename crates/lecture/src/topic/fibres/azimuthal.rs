//! Slide 22: light around the fibre, lobe by lobe.

use sparrow_math::Real;
use sparrow_models::cylinder::azimuthal::WrappedGauss;
use sparrow_models::cylinder::far_field::FarField;
use sparrow_plot::draw::axis::Axis;
use sparrow_plot::{Kind, Options};
use sparrow_spectra::Spectrum;

use crate::ask::plotted;
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

const INCLINATIONS: [f64; 3] = [0.0, 30.0, 45.0];
const LOBES: [&str; 3] = ["R", "TT", "TRT"];
/// Standard deviations in degrees.
const WIDTHS: [f64; 3] = [10.0, 10.0, 20.0];
/// Segments across the fibre for curves, and for numbers to be compared; the model has 16.
const SEGMENTS: [usize; 2] = [256, 8192];

/// Azimuth in degrees, and `N_p` for light across the fibre: `deon.N.*` of the reference sheet.
const KNOWN: [(f64, [f64; 3]); 4] = [
    (0.0, [0.011_586_709_426_132_465, 0.0, 0.025_483_999_219_151_753]),
    (60.0, [0.010_449_518_407_424_812, 1.309_095_784_458_311e-5, 0.001_028_854_096_072_534_3]),
    (150.0, [0.016_167_106_031_866_486, 0.269_413_686_708_025_35, 0.0]),
    (180.0, [0.010_028_045_463_791_93, 0.407_362_250_262_219_2, 0.0]),
];

/// `N_p` of R, TT, TRT at the azimuth `phi` in degrees, for light inside at the inclination `theta`.
fn lobes(theta: f64, phi: f64, segments: usize) -> [f64; 3] {
    let (sin, cos) = Real::sin_cos(theta.to_radians());
    let fibre = FarField { theta: [sin, cos], eta: 1.55, sigma_a: Spectrum::splat(0.2) };
    let widths = WIDTHS.map(|w| WrappedGauss::new(w.to_radians()));
    let n = fibre.around(phi.to_radians(), &widths, segments).n;
    [n[0].average(), n[1].average(), n[2].average()]
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let x = steps(-180.0, 180.0, 360);
    let mut charts = Vec::new();
    for theta in INCLINATIONS {
        let curve = |(p, name): (usize, &&str)| Curve::of(*name, &x, |phi| lobes(theta, phi, SEGMENTS[0])[p]);
        charts.push(Chart {
            title: format!("Around the fibre, θ_{{d}} = {theta}°"),
            subtitle: "N_{p}, blurred by 10°, 10° and 20°; light and viewer are on one side at 0°".to_owned(),
            x: Axis::degrees("azimuth  [deg]", -180.0, 180.0),
            y: Axis::log("N_{p}  [1/rad]", 1e-4, 1.0, 5),
            curves: LOBES.iter().enumerate().map(curve).collect(),
            rules: Vec::new(),
        });
    }
    let (all, command) =
        plotted("marschner sigma_a=0.2 wo=0", &Options { kind: Kind::Azimuthal, ..Options::default() })?;
    let mut checks = Vec::new();
    for (phi, want) in KNOWN {
        let got = lobes(0.0, phi, SEGMENTS[1]);
        for (p, name) in LOBES.iter().enumerate() {
            // Beyond seven standard deviations ours is nothing.
            checks.push(Check::near(
                format!("N of {name} at {phi}° (deon.N.{phi})"),
                got[p],
                want[p],
                2e-4 * want[p] + 1e-8,
            ));
        }
    }
    for theta in INCLINATIONS {
        let total: f64 = steps(-179.5, 179.5, 359)
            .iter()
            .map(|phi| lobes(theta, *phi, SEGMENTS[0]).iter().sum::<f64>())
            .sum();
        let (sin, cos) = Real::sin_cos(f64::to_radians(theta));
        let shares =
            FarField { theta: [sin, cos], eta: 1.55, sigma_a: Spectrum::splat(0.2) }.shares(SEGMENTS[0]);
        let mean: f64 = shares[..3].iter().map(|a| a.average()).sum();
        checks.push(Check::near(
            format!("integral of N over the azimuth over the mean of A, θd = {theta}°"),
            total.to_radians() / mean,
            1.0,
            1e-4,
        ));
    }
    let mut pictures: Vec<Picture> = charts
        .iter()
        .zip(INCLINATIONS)
        .map(|(c, theta)| Picture::svg(&format!("{theta}"), format!("R, TT and TRT around the fibre at the inclination {theta}: TT forward, TRT towards the light, R broad."), c.svg()))
        .collect();
    pictures.push(Picture::svg("smooth", "The same of a smooth fibre, with the caustics of TRT.", all.svg));
    Ok(Figure {
        caption: "R is spread over all azimuths. TT is strong and goes forward: hair before the sun has a bright rim. TRT comes back, with peaks at either side of the light that are \
            its caustics; the last picture shows them without blur."
            .to_owned(),
        formulas: vec![
            Formula::new("N_p(φ) = frac{1}{2} ∫_{-1}^{1} A_p(h) D_p(φ - Φ_p(h)) dh", "[dEon2011, eq. 10]", "models/src/cylinder/far_field.rs: around"),
            Formula::new("A_0 = F , A_p = (1 - F)^2 F^{p-1} T^p , T = exp(-σ_a ℓ)", "[Chiang2016, eq. 12, 13]", "models/src/cylinder/attenuation.rs: attenuation"),
        ],
        commands: vec![command],
        pictures,
        table: Some(chart::table(&charts.iter().collect::<Vec<_>>())),
        checks,
        ..Figure::default()
    }
    .with("η", 1.55)
    .with("σa", "0.2 per radius"))
}
