//! Slide 9: the highlight of a horse's coat.

use sparrow_math::{Vec3, vec3};
use sparrow_plot::draw::table::Table;
use sparrow_scene::curve_files;

use crate::measure::{contour, peak, smoothed};
use crate::overlay::{Mark, over};
use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

const SCENE: &str = "lecture/quarterhorse.pbrt";
/// Towards the lamp, as the scene has it.
const LAMP: Vec3<f64> = Vec3 { x: 0.5, y: 1.0, z: 1.8 };
/// Where the camera stands.
const EYE: Vec3<f64> = Vec3 { x: 1.2, y: 1.5, z: 6.0 };
/// Points that are looked at on each piece of a hair.
const STEPS: usize = 8;
/// Pixels on either side over which directions of hairs are averaged: a hair is thinner than that, and hairs of a coat lie nearly alike.
const AROUND: i32 = 2;

/// The hairs that are seen in each pixel: mean of `t * h`.
struct Coat {
    size: [usize; 2],
    seen: Vec<Option<f64>>,
}

impl Coat {
    /// Draws points of all hairs, the nearest in each pixel.
    fn new(studio: &Studio<'_>, photo: &Photo) -> Result<Coat, LectureError> {
        let path = studio.path("lecture/horse.hair");
        let file = curve_files::read(&path).map_err(|e| LectureError::Figure(e.to_string()))?;
        let point = |i: usize| {
            let [x, y, z, _] = file.points[i].map(f64::from);
            vec3(x, y, z)
        };
        let mut nearest = vec![(f64::INFINITY, 0.0); photo.size[0] * photo.size[1]];
        let ends = file.strands.iter().skip(1).map(|s| *s as usize).chain([file.points.len()]);
        for (first, end) in file.strands.iter().map(|s| *s as usize).zip(ends) {
            for i in first + 1..end {
                let (a, b) = (point(i - 1), point(i));
                for k in 0..STEPS {
                    let p = a + (b - a) * ((k as f64 + 0.5) / STEPS as f64);
                    let v = EYE - p;
                    let h = (v.normalized() + LAMP.normalized()).normalized();
                    let Some(at) = photo.place([p.x, p.y, p.z]).and_then(|q| pixel(photo.size, q)) else {
                        continue;
                    };
                    if v.length() < nearest[at].0 {
                        nearest[at] = (v.length(), (b - a).normalized().dot(h));
                    }
                }
            }
        }
        let seen = nearest.into_iter().map(|(d, th)| d.is_finite().then_some(th)).collect();
        Ok(Coat { size: photo.size, seen })
    }
    fn at(&self, x: i32, y: i32) -> Option<f64> {
        let [w, h] = self.size;
        let inside = x >= 0 && y >= 0 && (x as usize) < w && (y as usize) < h;
        if inside { self.seen[y as usize * w + x as usize] } else { None }
    }
    /// The mean of what is seen around a place; none where less than half of it is coat.
    fn around(&self, [x, y]: [f64; 2]) -> Option<f64> {
        let (x, y) = (x as i32, y as i32);
        let places = (-AROUND..=AROUND).flat_map(|i| (-AROUND..=AROUND).map(move |j| (x + i, y + j)));
        let values: Vec<f64> = places.filter_map(|(x, y)| self.at(x, y)).collect();
        let all = (2 * AROUND + 1).pow(2) as usize;
        (2 * values.len() > all).then(|| values.iter().sum::<f64>() / values.len() as f64)
    }
}

fn pixel([w, h]: [usize; 2], [x, y]: [f64; 2]) -> Option<usize> {
    (x >= 0.0 && y >= 0.0 && x < w as f64 && y < h as f64).then(|| y as usize * w + x as usize)
}

/// Half the width of a class of `t * h`.
const CLASS: f64 = 0.05;

/// Mean brightness over `t * h`.
fn profile(photo: &Photo, coat: &Coat) -> Vec<[f64; 2]> {
    let mut classes = vec![(0.0, 0.0); 41];
    for y in 0..photo.size[1] {
        for x in 0..photo.size[0] {
            let Some(th) = coat.at(x as i32, y as i32) else { continue };
            let class = (th / CLASS + 20.0).round();
            if (0.0..=40.0).contains(&class) {
                let (sum, n) = &mut classes[class as usize];
                *sum += photo.grey(x, y);
                *n += 1.0;
            }
        }
    }
    let of = |(k, (sum, n)): (usize, &(f64, f64))| (*n > 20.0).then(|| [CLASS * (k as f64 - 20.0), sum / n]);
    classes.iter().enumerate().filter_map(of).collect()
}

/// Slide 9.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let size = studio.pick([180, 150], [600, 500]);
    let photo = studio.render(SCENE, size, studio.pick(12, 96))?;
    let coat = Coat::new(studio, &photo)?;
    let brightness = smoothed(&profile(&photo, &coat), 1);
    let mut table = Table::new(["t.h", "brightness"]);
    brightness.iter().for_each(|p| table.numbers(*p));
    let [at, height] = peak(&brightness).unwrap_or([f64::NAN; 2]);
    let far: Vec<f64> = brightness.iter().filter(|p| (p[0] - at).abs() > 0.35).map(|p| p[1]).collect();
    let floor = far.iter().sum::<f64>() / far.len() as f64;
    let curve = contour(photo.size, |p| coat.around(p));
    let svg = over(&photo.png(1.0)?, photo.size, 600.0 / f64::from(size[0]), &[Mark::Curve(&curve)]);
    Ok(Figure {
        caption: "A horse whose coat lies from nose to tail and down the legs, with a lamp above the viewer. Its highlight is \
            no mirror image of the lamp but a band over flank, shoulder and haunch, where hairs are perpendicular to the half vector.\nOrange: \
            t·h = 0 for the hairs in front of each pixel, averaged over five by five pixels. Body and coat are made by formula."
            .to_owned(),
        formulas: vec![Formula::new("t * h = 0", "[LuKoenderinkKappers2000]", "lecture/src/topic/anisotropic/horse.rs: around")],
        commands: vec![
            format!("sparrow render scenes/{SCENE}"),
            format!(
                r#"sparrow render scenes/{SCENE} --material '"coat" "string type" "hair" "float eumelanin" 0.1 "float beta_m" 0.3 "float beta_n" 0.3 "float alpha" 0'"#
            ),
        ],
        pictures: vec![
            Picture::png("plain", "A brown horse seen from its side; its coat shines in a band over flank and shoulder.", photo.png(1.0)?),
            Picture::svg("curve", "The same horse with the curve on which its hairs are perpendicular to the half vector.", svg),
        ],
        table: Some(table),
        checks: vec![
            // Hairs that lie nearly alike shade each other, and the lobe is 0.15 wide.
            Check::near("t·h of hairs where they are brightest", at, 0.0, 0.1),
            Check::at_least("their brightness over that of hairs with |t·h| more than 0.35 away", height / floor, 1.5),
        ],
        ..Figure::default()
    }
    .with("hairs", 20_000)
    .with("βm", 0.15)
    .with("tilt", "0"))
}
