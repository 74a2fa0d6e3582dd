//! Slides 11 and 12: the cone that reflected rays form, and its circle on the sphere of directions.

use sparrow_math::{LocalDir, Vec3, vec3};
use sparrow_models::Uniforms;
use sparrow_plot::draw::page::Entry;
use sparrow_plot::draw::svg::Pen;
use sparrow_plot::draw::table::Table;
use sparrow_plot::draw::theme::LIGHT;
use sparrow_stats::Random;

use super::bundle::reflected;
use crate::ask::{fibre, inclined, scattered};
use crate::sketch::{Sketch, turn};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// Whence the drawings are seen: the fibre points up.
const VIEW: [f64; 2] = [25.0, 12.0];
const AXIS: Vec3<f64> = Vec3 { x: 0.0, y: 0.0, z: 1.0 };

/// From the fibre's frame to the drawing's: the tangent points up.
fn up(w: LocalDir<f64>) -> Vec3<f64> {
    vec3(w.y(), w.z(), w.x())
}

/// Slide 11.
pub(super) fn rays(_: &Studio<'_>) -> Result<Figure, LectureError> {
    let light = inclined(35.0, 0.0);
    let mut sketch = Sketch::new(
        "The cone of reflected rays",
        "light at 35° above the plane across the fibre",
        Vec::new(),
        VIEW,
        1.35,
    );
    let (r, colours) = (0.16, LIGHT.palette);
    for z in [-1.25, 1.25] {
        sketch.line(&turn(90, |c, s| vec3(r * c, r * s, z)), Pen::new(LIGHT.soft, 1.5));
    }
    let side = vec3(-0.422_618, 0.906_308, 0.0) * r;
    for e in [side, -side] {
        sketch.line(&[e - AXIS * 1.25, e + AXIS * 1.25], Pen::new(LIGHT.soft, 1.5));
    }
    let mut table = Table::new(["h", "t", "across_y", "across_z"]);
    let mut rim = Vec::new();
    for k in -20..=20 {
        let h = f64::from(k) / 20.0;
        let out = reflected(light, h)?;
        table.numbers([h, out.x(), out.y(), out.z()]);
        rim.push(up(out) * 1.2);
        sketch.line(&[vec3(0.0, 0.0, 0.0), up(out) * 1.2], Pen::new(colours[0], 1.4));
    }
    sketch.line(&rim, Pen::new(colours[0], 2.6));
    sketch.arrow(up(light) * 1.3, up(light) * 0.16, colours[1], 3.0);
    sketch.label(up(light) * 1.3, "light i");
    sketch.label(AXIS * 1.22 + vec3(0.0, r, 0.0), "tangent t");
    sketch.label(rim[8], "reflected r");
    let mut random = Random::named(0, "cone");
    let (mut off, mut tilt) = (0.0_f64, 0.0_f64);
    for _ in 0..10_000 {
        let (from, h) = (random.direction(), random.within(-1.0, 1.0));
        let out = reflected(from, h)?;
        off = off.max((from.x() + out.x()).abs());
        tilt = tilt.max((out.v().length() - 1.0).abs());
    }
    Ok(Figure {
        caption: "A normal of a cylinder has no component along the tangent, so mirroring about it turns the light's component along the tangent \
            round and leaves its size: all reflected rays make one angle with the fibre. They form a cone with the mirror image of the light on it."
            .to_owned(),
        formulas: vec![Formula::new("r * t = - i * t , θ_r = - θ_i", "[Marschner2003, sec. 3]", "models/src/fibre/mirror_cylinder.rs: sample")],
        pictures: vec![Picture::svg("", "An upright fibre, one ray of light from above, and forty reflected rays that form a cone below.", sketch.finish())],
        table: Some(table),
        checks: vec![
            Check::at_most("largest |r·t + i·t| of 10000 random reflections", off, 1e-14),
            Check::at_most("largest departure of |r| from 1", tilt, 1e-14),
        ],
        ..Figure::default()
    }
    .with("θi", "35°"))
}

const INCLINATIONS: [f64; 3] = [10.0, 35.0, 60.0];

/// Slide 12.
pub(super) fn sphere(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let legend = INCLINATIONS
        .iter()
        .enumerate()
        .map(|(series, t)| Entry { label: format!("θ_{{i}} = {t}°"), series });
    let mut sketch = Sketch::new(
        "The cone on the sphere of directions",
        "the tangent points up; dots are the lights",
        legend.collect(),
        VIEW,
        1.12,
    );
    sketch.line(
        &turn(180, |c, s| {
            vec3(-0.422_618 * c, 0.906_308 * c, 0.0) + vec3(-0.188_43, -0.087_87, 0.978_15) * s
        }),
        Pen::new(LIGHT.soft, 1.5),
    );
    sketch.round(&turn(90, |c, s| vec3(c, s, 0.0)), LIGHT.soft, 1.0);
    let far = fibre("mirror_cylinder field=far")?;
    let mut random = Random::named(0, "sphere");
    let mut table = Table::new(["theta_i_deg", "t", "across_y", "across_z"]);
    let mut checks = Vec::new();
    for (series, theta) in INCLINATIONS.into_iter().enumerate() {
        let light = inclined(theta, 0.0);
        let (colour, _) = LIGHT.series(series);
        let mut off = 0.0_f64;
        for k in 0..studio.pick(2000, 20_000) {
            let u = Uniforms { lobe: 0.5, dir: [random.uniform(), random.uniform()] };
            let out = scattered(&far, light, u).wi;
            // The angle with the tangent downwards is that of the light with the tangent upwards.
            off = off.max((out.v().dot(vec3(-1.0, 0.0, 0.0)) - light.x()).abs());
            if k < 300 {
                table.numbers([theta, out.x(), out.y(), out.z()]);
            }
        }
        let (z, r) = (-light.x(), (1.0 - light.x() * light.x()).sqrt());
        sketch.round(&turn(120, |c, s| vec3(r * c, r * s, z)), colour, 3.0);
        sketch.dot(up(light), colour);
        checks.push(Check::at_most(
            format!("largest distance of reflections from the circle for θi = {theta}°, along the tangent"),
            off,
            1e-14,
        ));
    }
    sketch.arrow(vec3(0.0, 0.0, 0.0), AXIS, LIGHT.ink, 2.0);
    sketch.label(AXIS, "t");
    Ok(Figure {
        caption: "On the sphere of directions the cone is a circle around the tangent, as far below the equator as the light is above it. \
            Light across the fibre is spread over the equator, light along it stays near the tangent."
            .to_owned(),
        formulas: vec![Formula::new("angle(r, -t) = angle(i, t)", "[Marschner2003, sec. 3]", "models/src/fibre/mirror_cylinder.rs: sample")],
        pictures: vec![Picture::svg("", "A sphere with three circles below its equator, and a dot as far above it for each.", sketch.finish())],
        table: Some(table),
        checks,
        ..Figure::default()
    }
    .with("θi", "10°, 35°, 60°"))
}
