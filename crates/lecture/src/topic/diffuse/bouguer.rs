//! Slide 7: mirrors that look matt under a lamp at the zenith, and nowhere else.

use core::f64::consts::PI;

use sparrow_plot::draw::axis::Axis;

use crate::ask::{f_in_plane, surface};
use crate::chart::{self, Chart, Curve, steps};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

const WORDS: &str = "bouguer reflectance=1 masking=none";
const PSI: [f64; 3] = [0.0, 45.0, 60.0];
/// Incidence, angle of the viewer on the mirror's side, `pi f`: `bouguer.cos2a` of the reference sheet.
const KNOWN: [([f64; 2], f64); 8] = [
    ([0.0, -10.0], 1.0),
    ([0.0, -60.0], 1.0),
    ([45.0, 45.0], 2.0),
    ([45.0, 0.0], 1.0),
    ([45.0, -45.0], 0.0),
    ([60.0, 60.0], 4.0),
    ([60.0, 30.0], 2.0),
    ([60.0, -30.0], 0.0),
];

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let model = surface(WORDS)?;
    let x = steps(-89.5, 89.5, 358);
    let chart = Chart {
        title: "Mirrors that look matt from one side".to_owned(),
        subtitle: "D = (4/π) cos 2α up to 45°, F = S = 1".to_owned(),
        x: Axis::degrees("θ_{o}  [deg]", -90.0, 90.0),
        y: Axis::fixed("π f", 0.0, 5.0, 5),
        curves: PSI
            .iter()
            .map(|psi| Curve::of(format!("light at {psi}°"), &x, |t| PI * f_in_plane(&model, *psi, t)))
            .collect(),
        rules: Vec::new(),
    };
    let check = |([psi, theta], want): &([f64; 2], f64)| {
        let got = PI * f_in_plane(&model, *psi, *theta);
        Check::near(format!("π f for light at {psi}°, viewer at {theta}° (bouguer.cos2a)"), got, *want, 1e-9)
    };
    Ok(Figure {
        caption: "Bouguer took a matt surface for many small mirrors. If the light stands at the zenith there is one distribution of mirrors that looks the same from \
            everywhere, (4/π) cos 2α. Under any other light the same mirrors shine: four times as bright as white at 60°, and black back towards the light."
            .to_owned(),
        formulas: vec![Formula::new("f = frac{D(α)}{4 cos θ_i cos θ_o} , D = frac{4}{π} cos 2 α , α ≤ 45°", "[Bouguer1760]", "models/src/surface/bouguer.rs: eval")],
        commands: vec![format!("sparrow plot {WORDS} wo=0 wo=45 wo=60 --kind cartesian")],
        pictures: vec![Picture::svg("", "π f over the viewer's angle: a flat line for light at the zenith, rising lines for light at 45 and 60 degrees.", chart.svg())],
        table: Some(chart::table(&[&chart])),
        checks: KNOWN.iter().map(check).collect(),
        ..Figure::default()
    })
}
