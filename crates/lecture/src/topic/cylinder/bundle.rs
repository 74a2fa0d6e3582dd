//! Slide 10: parallel rays that meet a mirror cylinder, seen along its axis.

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::Uniforms;
use sparrow_plot::draw::svg::Pen;
use sparrow_plot::draw::table::Table;
use sparrow_plot::draw::theme::LIGHT;

use crate::ask::{fibre, inclined, scattered};
use crate::sketch::{Sketch, turn};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// Azimuth of a normal in degrees, and where it sends a ray from the inclination 35 and the azimuth 20: `cylinder.cone` of the
/// reference sheet.
const KNOWN: [(f64, [f64; 3]); 4] = [
    (-40.0, [-0.573_576_436_351_046, -0.142_244_259_722_923_98, -0.806_707_284_111_598_8]),
    (0.0, [-0.573_576_436_351_046, 0.769_751_131_320_057_2, -0.280_166_499_593_235_5]),
    (20.0, [-0.573_576_436_351_046, 0.769_751_131_320_057_5, 0.280_166_499_593_235_6]),
    (60.0, [-0.573_576_436_351_046, -0.142_244_259_722_923_87, 0.806_707_284_111_598_8]),
];

/// Where a mirror cylinder sends light from `from` that meets it at the offset `h`.
pub(super) fn reflected(from: LocalDir<f64>, h: f64) -> Result<LocalDir<f64>, LectureError> {
    let u = Uniforms { lobe: 0.5, dir: [0.5, 0.5] };
    Ok(scattered(&fibre(&format!("mirror_cylinder h={h}"))?, from, u).wi)
}

/// Makes the figure.
pub(super) fn make(_: &Studio<'_>) -> Result<Figure, LectureError> {
    // Seen along x; the light comes from the left.
    let light = inclined(0.0, 180.0);
    let mut table = Table::new(["h", "normal_azimuth_deg", "exit_azimuth_deg"]);
    let title = "Rays across a mirror cylinder";
    let mut sketch = Sketch::new(
        title,
        "seen along the axis; h is the offset from it in radii",
        Vec::new(),
        [0.0, 0.0],
        2.2,
    )
    .moved(0.4);
    sketch.line(&turn(180, |c, s| vec3(0.0, c, s)), Pen::new(LIGHT.ink, 3.0));
    for k in -9..=9 {
        let h = f64::from(k) / 9.5;
        let out = reflected(light, h)?;
        // The offset counts against the sense of the azimuth.
        let normal = 180.0 - Real::asin(h).to_degrees();
        let (s, c) = Real::sin_cos(normal.to_radians());
        let p = vec3(0.0, c, s);
        let (colour, _) = LIGHT.series(if k == 0 { 1 } else { 0 });
        sketch.line(&[vec3(0.0, -2.9, p.z), p], Pen::new(LIGHT.soft, 1.3));
        sketch.arrow(p, p + out.v() * 1.45, colour, 1.9);
        let exit = Real::atan2(out.z(), out.y()).to_degrees();
        table.numbers([h, normal, exit]);
    }
    sketch.label(vec3(0.0, -2.5, 1.12), "light");
    sketch.label(vec3(0.0, 0.0, 0.0), "axis");
    let from = inclined(35.0, 20.0);
    let mut checks = Vec::new();
    for (normal, want) in KNOWN {
        let h = Real::sin((20.0 - normal).to_radians());
        let off = (reflected(from, h)?.v() - vec3(want[0], want[1], want[2])).length();
        checks.push(Check::at_most(
            format!("distance from the known reflection at the normal's azimuth {normal}° (cylinder.cone)"),
            off,
            1e-12,
        ));
    }
    Ok(Figure {
        caption: "A ray at the offset h from the axis meets a normal whose azimuth is asin h away from the light's, and turns by twice that. \
            Rays that were side by side fan out over all azimuths; along the axis each keeps its share, so that the fan is a cone."
            .to_owned(),
        formulas: vec![
            Formula::new("r = 2 (i * n) n - i , n * t = 0", "[Marschner2003, sec. 3]", "models/src/fibre/mirror_cylinder.rs: sample"),
            Formula::new("Φ_R = - 2 asin h", "[Marschner2003, eq. 3]", "models/src/cylinder/azimuthal.rs: exit_azimuth"),
        ],
        pictures: vec![Picture::svg("", "Nineteen parallel rays from the left meet a circle and are reflected into a fan.", sketch.finish())],
        table: Some(table),
        checks,
        ..Figure::default()
    }
    .with("θi", "0°")
    .with("rays", 19))
}
