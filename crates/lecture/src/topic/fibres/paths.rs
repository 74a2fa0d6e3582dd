//! Slide 20: the paths R, TT and TRT through a cylinder of glass, seen along its axis.

use sparrow_math::{Real, Vec3, vec3};
use sparrow_models::cylinder::attenuation::Inside;
use sparrow_models::cylinder::azimuthal::{exit_azimuth, wrapped};
use sparrow_models::cylinder::roots::{Root, of_r, of_trt, of_tt};
use sparrow_plot::draw::page::Entry;
use sparrow_plot::draw::svg::Pen;
use sparrow_plot::draw::table::Table;
use sparrow_plot::draw::theme::LIGHT;

use crate::sketch::{Sketch, turn};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

const ETA: f64 = 1.55;
const LOBES: [&str; 3] = ["R", "TT", "TRT"];

/// Lobe, exit azimuth in degrees, and the offsets that leave there: `roots.*.e1.55` of the reference sheet.
const KNOWN: [(usize, f64, &[f64]); 5] = [
    (0, 60.0, &[-0.5]),
    (1, 179.0, &[0.024_588_166_871_805_31]),
    (1, 150.0, &[0.627_955_258_917_809_3]),
    (2, 5.0, &[-0.990_003_081_357_845_3, 0.151_227_479_865_022_02, 0.962_621_535_381_626_3]),
    (2, 15.0, &[-0.999_251_577_122_31, 0.488_576_540_225_333_87, 0.881_396_717_586_291_9]),
];

/// A ray across the fibre at the offset `h`, inside.
fn inside(h: f64) -> Inside<f64> {
    Inside::new([0.0, 1.0], h, ETA)
}

/// The direction of an azimuth, in the plane across the fibre.
fn across(phi: f64) -> Vec3<f64> {
    let (s, c) = Real::sin_cos(phi);
    vec3(0.0, c, s)
}

/// Offsets that leave by a lobe at an azimuth in degrees.
fn roots(lobe: usize, phi: f64) -> Vec<f64> {
    let phi = phi.to_radians();
    let all: Vec<Root<f64>> = match lobe {
        0 => vec![of_r(phi)],
        1 => vec![of_tt(phi, ETA)],
        _ => of_trt(phi, ETA).to_vec(),
    };
    all.iter().filter(|r| r.density > 0.0).map(|r| r.h).collect()
}

/// Points of the path in the drawing: the light comes from the left, `corners[k]` is where it meets the surface for the k-th time.
struct Path {
    corners: Vec<Vec3<f64>>,
    exits: [Vec3<f64>; 3],
}

impl Path {
    fn new(h: f64) -> Path {
        let ray = inside(h);
        let gamma_o = Real::asin(h);
        let light = core::f64::consts::PI;
        // The normal that is met first, then each passage turns it by pi - 2 gamma_t against the sense of h.
        let first = light - gamma_o;
        let step = core::f64::consts::PI + 2.0 * ray.angle();
        let corners = (0..3).map(|k| across(first + f64::from(k) * step)).collect();
        let exits = [0, 1, 2].map(|p| across(light + exit_azimuth(p, gamma_o, ray.angle())));
        Path { corners, exits }
    }
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let (checks, mut table) =
        (checks(), Table::new(["h", "gamma_t_deg", "chord", "phi_r_deg", "phi_tt_deg", "phi_trt_deg"]));
    for k in -9..=9 {
        let h = f64::from(k) / 10.0;
        let ray = inside(h);
        let phi = [0, 1, 2].map(|p| wrapped(exit_azimuth(p, Real::asin(h), ray.angle())).to_degrees());
        table.numbers([h, ray.angle().to_degrees(), ray.length, phi[0], phi[1], phi[2]]);
    }
    let mut pictures = Vec::new();
    for (name, h) in [("one", 0.6), ("other", -0.3)] {
        let path = Path::new(h);
        let legend = LOBES.iter().enumerate().map(|(series, l)| Entry { label: (*l).to_owned(), series });
        let subtitle = format!("seen along the axis; h = {h}, η = {ETA}");
        let mut sketch = Sketch::new("Paths through a fibre", &subtitle, legend.collect(), [0.0, 0.0], 1.85);
        sketch.line(&turn(180, |c, s| vec3(0.0, c, s)), Pen::new(LIGHT.ink, 3.0));
        let first = path.corners[0];
        sketch.arrow(vec3(0.0, -2.5, first.z), first, LIGHT.ink, 2.4);
        for ends in path.corners.windows(2) {
            sketch.line(ends, Pen::new(LIGHT.soft, 2.4));
        }
        for (p, (corner, exit)) in path.corners.iter().zip(path.exits).enumerate() {
            let (colour, _) = LIGHT.series(p);
            sketch.line(&[*corner * 0.55, *corner * 1.35], Pen::new(LIGHT.grid, 1.5));
            sketch.arrow(*corner, *corner + exit * 1.2, colour, 3.0);
            sketch.label(*corner + exit * 1.28, LOBES[p]);
        }
        let alt = format!(
            "A ray enters a circle at the offset {h}; arrows show where it leaves after no, one and two passages."
        );
        pictures.push(Picture::svg(name, alt, sketch.finish()));
    }
    Ok(Figure {
        caption: "Light that meets the fibre is reflected (R), or refracted. What is inside leaves at the other side (TT), or is reflected there and leaves then (TRT). Every \
            passage has the same length. Seen along the axis a slanted ray does the same, with a larger index."
            .to_owned(),
        formulas: vec![
            Formula::new("Φ_p = 2 p γ_t - 2 γ_o + p π , sin γ_o = h , sin γ_t = frac{h}{η'}", "[Marschner2003, eq. 3]", "models/src/cylinder/azimuthal.rs: exit_azimuth"),
            Formula::new("η' = frac{sqrt{η^2 - sin^2 θ_d}}{cos θ_d}", "[Marschner2003, appendix B]", "models/src/cylinder/attenuation.rs: new"),
            Formula::new("ℓ = frac{2 cos γ_t}{cos θ_t}", "[Marschner2003, sec. 4]", "models/src/cylinder/attenuation.rs: new"),
        ],
        pictures,
        table: Some(table),
        checks,
        ..Figure::default()
    }
    .with("η", ETA))
}

fn checks() -> Vec<Check> {
    let mut checks = Vec::new();
    for (lobe, phi, want) in KNOWN {
        let got = roots(lobe, phi);
        let what = format!("offsets that leave by {} at {phi}°", LOBES[lobe]);
        checks.push(Check::near(format!("number of {what}"), got.len() as f64, want.len() as f64, 0.0));
        let off = want
            .iter()
            .map(|h| got.iter().map(|g| (g - h).abs()).fold(f64::INFINITY, f64::min))
            .fold(0.0, f64::max);
        checks.push(Check::at_most(format!("largest difference of {what}"), off, 1e-7));
    }
    // The drawing is geometry of its own: its chords and exits have to be those of the model.
    let (mut chord, mut bend) = (0.0_f64, 0.0_f64);
    for k in -19..=19 {
        let h = f64::from(k) / 20.0;
        let (path, ray) = (Path::new(h), inside(h));
        for ends in path.corners.windows(2) {
            chord = chord.max(((ends[1] - ends[0]).length() - ray.length).abs());
        }
        for (corner, exit) in path.corners.iter().zip(path.exits) {
            // Every ray leaves at the angle at which the first came.
            bend = bend.max((corner.dot(exit) - (1.0 - h * h).sqrt()).abs());
        }
    }
    checks.push(Check::at_most("largest difference of drawn chords from 2 cos γt", chord, 1e-12));
    checks.push(Check::at_most("largest difference of cosines of leaving and entering rays", bend, 1e-12));
    checks
}
