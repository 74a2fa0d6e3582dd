//! Slides 10 to 14 as a picture: the cone of a fibre as light on a screen.

use sparrow_math::{Real, Vec3, vec3};
use sparrow_plot::draw::table::Table;

use crate::measure::{peak, smoothed};
use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

const SCENE: &str = "lecture/cone.pbrt";
/// Middle of the fibre, which lies along z, in the dome of radius 1.
const FIBRE: Vec3<f64> = Vec3 { x: 0.0, y: 0.0, z: -0.06 };
/// Between the beam and the fibre, in degrees.
const BEAM_DEG: f64 = 45.0;
/// Classes of azimuth and of the angle with the fibre, in degrees.
const CLASS_DEG: [f64; 2] = [20.0, 1.5];

/// Direction from the fibre to the place of the screen that a pixel shows.
fn direction(photo: &Photo, x: usize, y: usize) -> Vec3<f64> {
    let ray = photo.camera.ray([x as f32 + 0.5, y as f32 + 0.5], [0.5; 2], 0.0);
    let (o, d) = (ray.o.to_f64(), ray.d.to_f64());
    let b = o.dot(d);
    let t = -b + (b * b + 1.0 - o.dot(o)).sqrt();
    (o + d * t - FIBRE).normalized()
}

/// Means over classes: the sum of values in each and their number.
struct Classes(Vec<(f64, f64)>, f64);

impl Classes {
    fn new(n: usize, width: f64) -> Classes {
        Classes(vec![(0.0, 0.0); n], width)
    }
    fn add(&mut self, x: f64, v: f64) {
        if let Some((sum, n)) = self.0.get_mut((x / self.1) as usize) {
            *sum += v;
            *n += 1.0;
        }
    }
    fn means(&self) -> Vec<[f64; 2]> {
        let of =
            |(k, (sum, n)): (usize, &(f64, f64))| (*n > 0.0).then(|| [(k as f64 + 0.5) * self.1, sum / n]);
        self.0.iter().enumerate().filter_map(of).collect()
    }
}

/// The picture of slides 10 to 14.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let side = studio.pick(72, 320);
    let photo = studio.render(SCENE, [side; 2], studio.pick(96, 256))?;
    let mut angles = Classes::new(50, CLASS_DEG[1]);
    let mut azimuths = Classes::new(9, CLASS_DEG[0]);
    for (x, y) in (0..photo.size[1]).flat_map(|y| (0..photo.size[0]).map(move |x| (x, y))) {
        let d = direction(&photo, x, y);
        let theta = Real::acos(-d.z).to_degrees();
        let phi = Real::atan2(d.y, d.x).to_degrees().abs();
        // The black trap and the fibre's shadow lie opposite of the lamp.
        if phi < 140.0 {
            angles.add(theta, photo.grey(x, y));
            if (theta - BEAM_DEG).abs() < 12.0 {
                azimuths.add(phi, photo.grey(x, y));
            }
        }
    }
    let profile = smoothed(&angles.means(), 1);
    let [at, height] = peak(&profile).unwrap_or([f64::NAN; 2]);
    let background =
        profile.iter().filter(|p| (p[0] - BEAM_DEG).abs() > 20.0).map(|p| p[1]).fold(0.0, f64::max);
    // 0.25 cos(phi / 2), scaled to the same sum.
    let around = azimuths.means();
    let law = |phi: f64| 0.25 * Real::cos(0.5 * phi.to_radians());
    let scale = around.iter().map(|p| p[1]).sum::<f64>() / around.iter().map(|p| law(p[0])).sum::<f64>();
    let off = around.iter().map(|[phi, v]| (v / (scale * law(*phi)) - 1.0).powi(2)).sum::<f64>()
        / around.len() as f64;
    let mut table = Table::new(["over", "angle_deg", "brightness"]);
    profile.iter().for_each(|p| table.named("angle with the fibre", *p));
    around.iter().for_each(|p| table.named("azimuth from the lamp", *p));
    // The axis of the fibre is the middle of the picture.
    debug_assert!(direction(&photo, photo.size[0] / 2, photo.size[1] / 2).dot(vec3(0.0, 0.0, -1.0)) > 0.99);
    let figure = Figure {
        caption: "A fibre along the line of sight, lit from the right by a narrow beam at 45°, and a dome around it as screen: all that a mirror cylinder reflects \
            lies on the cone around its tangent that the beam makes with it. The ring is brightest towards the lamp, where light is turned back, and fades \
            as cos(φ/2) to the other side, where a black trap takes what missed the fibre. The screen throws light back to where it came from, like a \
            projection screen, and the fibre is very slightly rough, so that the cone has some width."
            .to_owned(),
        formulas: vec![
            Formula::new("r * t = - i * t", "[Marschner2003, sec. 3]", "models/src/fibre/microfacet_hair.rs: f_cos_pdf"),
            Formula::new("N(φ) = frac{1}{4} cos frac{φ}{2}", "[Marschner2003, sec. 5]", "lecture/src/topic/cylinder/screen.rs: make"),
        ],
        commands: vec![
            format!("sparrow render scenes/{SCENE}"),
            format!(r#"sparrow render scenes/{SCENE} --material '"fibre" "string type" "hair" "float beta_m" 0.05 "float beta_n" 0.1 "float alpha" 0'"#),
        ],
        pictures: vec![Picture::png("", "A bright ring on black, brightest at its right and fading to the left.", photo.png(0.6)?)],
        table: Some(table),
        checks: vec![
            Check::near("angle between fibre and ring, in degrees", at, BEAM_DEG, CLASS_DEG[1]),
            Check::at_least("brightness of the ring over the brightest at 20° from it and more", height / background, 4.0),
            Check::at_most("root mean square of the ring's departure from cos(φ/2), relative, φ < 140°", off.sqrt(), 0.12),
        ],
        ..Figure::default()
    };
    Ok(figure
        .with("beam", "45°")
        .with("facets", "α = 0.04, F = 1")
        .with("fibre's radius", "0.015 of the dome's"))
}
