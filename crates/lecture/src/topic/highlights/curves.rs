//! Slides 15 and 16: highlights on sphere, cylinder and disc, with the curve t·h = 0 drawn over the render.

use sparrow_math::{Real, Vec3, vec3};
use sparrow_plot::draw::table::Table;

use super::predict::{cylinder_tangent, disc_tangent, sphere_tangent};
use crate::measure::{Circle, Ridge, along, contour};
use crate::overlay::{Mark, over};
use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

/// The lamp as the scenes have it.
#[derive(Clone, Copy)]
enum Lamp {
    /// Far away, 50 degrees from the viewer.
    Far,
    /// A point.
    At(Vec3<f64>),
}

const NEARBY: Lamp = Lamp::At(Vec3 { x: 0.8, y: 0.35, z: 0.9 });
const VIEWER: Vec3<f64> = Vec3 { x: 0.0, y: 0.0, z: 1.0 };
/// From the viewer to h, where the lamp is far.
const THETA_H_DEG: f64 = 25.0;

/// A body with its fibres.
struct Body {
    scene: &'static str,
    label: &'static str,
    alt: &'static str,
    lamp: Lamp,
    /// The surface over a place of the picture's plane, x to the right and y upwards; none off the body.
    height: fn(f64, f64) -> Option<f64>,
    /// Tangent of the fibres at a point of the body, whose axis is z, and their turn in degrees from around it.
    tangent: fn(Vec3<f64>, f64) -> Vec3<f64>,
    turn_deg: f64,
}

/// Radius of the cylinders.
const R: f64 = 0.7;

fn ball(x: f64, y: f64) -> Option<f64> {
    let z2 = 1.0 - x * x - y * y;
    (z2 > 0.0).then(|| z2.sqrt())
}
fn cylinder(x: f64, y: f64) -> Option<f64> {
    (x.abs() < R && y.abs() < 1.0).then(|| (R * R - x * x).sqrt())
}
fn disc(x: f64, y: f64) -> Option<f64> {
    (x * x + y * y < 1.0).then_some(0.0)
}

/// That of a cylinder whose axis is y.
fn upright_tangent(p: Vec3<f64>, turn: f64) -> Vec3<f64> {
    let t = cylinder_tangent(vec3(p.z, p.x, p.y), turn);
    vec3(t.y, t.z, t.x)
}

const SPHERE: [Body; 2] = [
    Body {
        scene: "sphere-parallels",
        label: "sphere, fibres along parallels: the great circle through the pole and h",
        alt: "A ball seen from its pole with a bright straight line through the middle, under the predicted line.",
        lamp: Lamp::Far,
        height: ball,
        tangent: sphere_tangent,
        turn_deg: 0.0,
    },
    Body {
        scene: "sphere-meridians",
        label: "sphere, fibres along meridians: an oval through the pole and h",
        alt: "A ball seen from its pole with a bright ring that passes the middle, under the predicted ring.",
        lamp: Lamp::Far,
        height: ball,
        tangent: sphere_tangent,
        turn_deg: 90.0,
    },
];
const CYLINDER: [Body; 2] = [
    Body {
        scene: "cylinder-around",
        label: "cylinder, fibres around it: a straight line",
        alt: "An upright cylinder with one bright upright line, under the predicted line.",
        lamp: Lamp::Far,
        height: cylinder,
        tangent: upright_tangent,
        turn_deg: 0.0,
    },
    Body {
        scene: "cylinder-helix",
        label: "cylinder, fibres that climb at 45°: a straight line at the same place, as h is level",
        alt: "An upright cylinder with one bright upright line, under the predicted line.",
        lamp: Lamp::Far,
        height: cylinder,
        tangent: upright_tangent,
        turn_deg: 45.0,
    },
];
const DISC: [Body; 2] = [
    Body {
        scene: "disc-grooves",
        label: "disc, grooves around the middle: a straight line through it",
        alt: "A disc with a bright line through its middle, under the predicted line.",
        lamp: NEARBY,
        height: disc,
        tangent: disc_tangent,
        turn_deg: 0.0,
    },
    Body {
        scene: "disc-radial",
        label: "disc, grooves from the middle to the rim: a circle through the middle and below the lamp",
        alt: "A disc with a bright ring that passes its middle, under the predicted circle.",
        lamp: NEARBY,
        height: disc,
        tangent: disc_tangent,
        turn_deg: 90.0,
    },
];

impl Body {
    /// `t * h` at a place of the picture's plane.
    fn condition(&self, x: f64, y: f64) -> Option<f64> {
        let p = vec3(x, y, (self.height)(x, y)?);
        let l = match self.lamp {
            Lamp::Far => {
                let (s, c) = Real::sin_cos((2.0 * THETA_H_DEG).to_radians());
                vec3(s, 0.0, c)
            }
            Lamp::At(place) => (place - p).normalized(),
        };
        let t = (self.tangent)(p, self.turn_deg.to_radians());
        let value = t.dot((l + VIEWER).normalized());
        value.is_finite().then_some(value)
    }
}

/// Where the ray through a place on the picture runs, for viewers far away.
fn plane(photo: &Photo, [x, y]: [f64; 2]) -> [f64; 2] {
    let o = photo.camera.ray([x as f32, y as f32], [0.5; 2], 0.0).o;
    [f64::from(o.x), f64::from(o.y)]
}

/// A highlight that is darker than this share of the brightest is left out: there the light grazes.
const FAINT: f64 = 0.05;
/// Way on either side of the curve on which its ridge is looked for, in pixels.
const REACH: f64 = 5.0;
/// Most pixels that the ridge may lie off the curve, by the reference sheet.
const TOLERANCE: f64 = 1.0;

/// Pictures of the bodies with their curves, their ridges, and the check of each.
fn shoot(
    studio: &Studio<'_>,
    bodies: &[Body],
    figure: &mut Figure,
) -> Result<Vec<(Photo, Vec<Ridge>)>, LectureError> {
    let mut table = Table::new(["scene", "x_px", "y_px", "ridge_minus_curve_px"]);
    let mut found = Vec::new();
    for body in bodies {
        let scene = format!("lecture/{}.pbrt", body.scene);
        let side = studio.pick(160, 400);
        let photo = studio.render(&scene, [side; 2], studio.pick(8, 64))?;
        let curve = contour(photo.size, |p| {
            let [x, y] = plane(&photo, p);
            body.condition(x, y)
        });
        let mut ridges = along(&curve, photo.size, &|x, y| photo.grey(x, y), REACH);
        let most = ridges.iter().map(|r| r.height).fold(0.0, f64::max);
        ridges.retain(|r| r.height > FAINT * most);
        for r in &ridges {
            table.named(body.scene, [r.place[0], r.place[1], r.distance]);
        }
        let off = ridges.iter().map(|r| r.distance.abs()).fold(0.0, f64::max);
        figure.checks.push(Check::at_least(
            format!("places of {} where the ridge was found", body.scene),
            ridges.len() as f64,
            f64::from(side) / 8.0,
        ));
        figure.checks.push(Check::at_most(
            format!("largest distance of ridge and curve on {}, in pixels", body.scene),
            off,
            TOLERANCE,
        ));
        let svg = over(&photo.png(1.0)?, photo.size, 400.0 / f64::from(side), &[Mark::Curve(&curve)]);
        figure.pictures.push(Picture::svg(body.scene, body.alt, svg).labelled(body.label));
        figure.commands.push(format!("sparrow render scenes/{scene}"));
        found.push((photo, ridges));
    }
    figure.table = Some(table);
    Ok(found)
}

fn begun(caption: &str) -> Figure {
    Figure {
        caption: format!(
            "{caption}\nOrange: t·h = 0, computed from the body's shape alone. Change the first number of the light's Rotate in a scene and render it again."
        ),
        formulas: vec![Formula::new(
            "t(x) * h(x) = 0 , h = frac{l + v}{|l + v|}",
            "[LuKoenderinkKappers2000]",
            "lecture/src/topic/highlights/curves.rs: condition",
        )],
        ..Figure::default()
    }
}

/// Slide 15.
pub(super) fn sphere(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let mut figure = begun(
        "A ball seen from its pole, light and viewer far away. With fibres along the parallels the highlight is a straight line; along the \
         meridians it is an oval, which gnomonic projection from the pole turns into a circle with pole and h as ends of a diameter.",
    );
    let found = shoot(studio, &SPHERE, &mut figure)?;
    if let Some((photo, ridges)) = found.get(1) {
        // In gnomonic projection from the pole.
        let points: Vec<[f64; 2]> = ridges
            .iter()
            .map(|r| plane(photo, r.place))
            .filter_map(|[x, y]| ball(x, y).map(|z| [x / z, y / z]))
            .collect();
        let (s, c) = Real::sin_cos(THETA_H_DEG.to_radians());
        let radius = 0.5 * s / c;
        let fitted = Circle::fit(&points).unwrap_or(Circle { centre: [f64::NAN; 2], radius: f64::NAN });
        // A quarter of a pixel.
        let tolerance = 0.25 * 2.2 / photo.size[0] as f64;
        figure.checks.push(Check::near(
            "radius of the circle in gnomonic projection, tan(θh)/2",
            fitted.radius,
            radius,
            tolerance,
        ));
        figure.checks.push(Check::near(
            "its middle, on the way from the pole to h",
            fitted.centre[0],
            radius,
            tolerance,
        ));
        figure.checks.push(Check::near("its middle, across that way", fitted.centre[1], 0.0, tolerance));
    }
    Ok(figure.with("θh", "25°").with("width along the fibres", "0.02").with("width across", "0.9"))
}

/// Slides 15 and 16.
pub(super) fn on_cylinder(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let mut figure = begun(
        "An upright cylinder, light and viewer far away, h level. Fibres around it and fibres that climb give a straight line. Fibres \
         along the axis give all or nothing: all is bright while h is perpendicular to the axis, and ten degrees more in the light's height \
         leave nothing.",
    );
    shoot(studio, &CYLINDER, &mut figure)?;
    let size = [studio.pick(64, 400); 2];
    let mut means = Vec::new();
    for (name, label) in [
        ("cylinder-axial", "fibres along the axis: all"),
        ("cylinder-axial-lifted", "the light lifted by 10°: nothing"),
    ] {
        let scene = format!("lecture/{name}.pbrt");
        let photo = studio.render(&scene, size, studio.pick(8, 64))?;
        means.push(photo.brightness());
        figure.pictures.push(
            Picture::png(name, "A cylinder, evenly bright or evenly dark.", photo.png(0.4)?).labelled(label),
        );
        figure.commands.push(format!("sparrow render scenes/{scene}"));
    }
    figure.checks.push(Check::at_least(
        "fibres along the axis: mean brightness over that with the light lifted by 10°",
        means[0] / means[1],
        30.0,
    ));
    Ok(figure.with("θh", "25°").with("width along the fibres", "0.02").with("width across", "0.9"))
}

/// Slide 16.
pub(super) fn on_disc(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let mut figure = begun(
        "A disc with a lamp nearby, seen from afar. Grooves around the middle give a straight line through it; grooves from the middle to \
         the rim give the circle whose diameter goes from the middle to the point below the lamp.",
    );
    shoot(studio, &DISC, &mut figure)?;
    Ok(figure.with("lamp", "0.8, 0.35, 0.9").with("radius of the disc", "1"))
}
