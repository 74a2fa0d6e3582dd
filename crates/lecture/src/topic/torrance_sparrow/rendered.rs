//! Slides 5 and 6 as pictures: plates and balls of aluminium and magnesium oxide at several incidences.

use core::f64::consts::PI;

use sparrow_math::Real;
use sparrow_plot::draw::table::Table;

use crate::ask::{f_in_plane, surface};
use crate::measure::{peak, smoothed};
use crate::sheet::side_by_side;
use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

/// Incidences that there are scenes for, in degrees.
const PSI: [u32; 5] = [10, 30, 45, 60, 75];
/// Place of the largest ratio f(θ)/f(ψ) in degrees, and the ratio, of each incidence:
/// `ts67.offspecular.c0.05.conductor 0.77+6.08i` of the reference sheet.
const ALUMINIUM: [[f64; 2]; 5] =
    [[13.3, 1.005_078_3], [42.9, 1.064_501_9], [75.0, 1.540_201_0], [80.0, 2.206_556_8], [89.9, 3.392_355_4]];
/// `ts67.offspecular.c0.05.dielectric n=1.7`.
const OXIDE: [[f64; 2]; 5] =
    [[13.4, 1.005_331_0], [70.0, 1.174_946_7], [75.0, 2.373_647_1], [89.9, 4.977_338_1], [89.9, 6.055_731_4]];
/// Constant terms over the facets' value in the mirror direction at 10 degrees.
const CONSTANT: [f64; 4] = [0.0, 0.5, 1.0, 2.0];

/// A material of the scenes, and of `sparrow plot`.
struct Material {
    eta: f64,
    k: f64,
    diffuse: f64,
}

impl Material {
    fn words(&self) -> String {
        let Material { eta, k, diffuse } = self;
        format!("torrance_sparrow_1967 c_per_deg=0.05 eta={eta} k={k} diffuse={diffuse}")
    }
    fn scene(&self) -> String {
        let [eta, k, diffuse] = [self.eta, self.k, self.diffuse].map(|v| format!("[ {v} {v} {v} ]"));
        format!(
            r#""rough" "string type" "torrance_sparrow_1967" "float c_per_deg" 0.05 "rgb eta" {eta} "rgb k" {k} "rgb diffuse" {diffuse}"#
        )
    }
}

/// Viewing angle in degrees and brightness, row by row from the bottom: along the middle columns of a strip.
fn strip(photo: &Photo) -> Vec<[f64; 2]> {
    let [w, h] = photo.size;
    let theta = |y: usize| {
        let d = photo.camera.ray([0.5 * w as f32, y as f32 + 0.5], [0.5; 2], 0.0).d;
        Real::acos(f64::from(-d.y)).to_degrees()
    };
    (0..h).rev().map(|y| [theta(y), photo.mean(w * 3 / 8..w * 5 / 8, y..y + 1)]).collect()
}

/// The value at `x` of points in the order of their abscissae.
fn between(points: &[[f64; 2]], x: f64) -> f64 {
    let i = points.partition_point(|p| p[0] < x).clamp(1, points.len() - 1);
    let ([x0, y0], [x1, y1]) = (points[i - 1], points[i]);
    y0 + (y1 - y0) * (x - x0) / (x1 - x0)
}

/// A plate at all incidences: strips over their brightness in the mirror direction, and the largest ratio of each with its place.
struct Plates {
    photos: Vec<(Photo, f32)>,
    peaks: Vec<[f64; 2]>,
    /// Largest root mean square of a strip's relative departure from the model.
    departure: f64,
}

impl Plates {
    fn shoot(
        studio: &Studio<'_>,
        material: &Material,
        table: &mut Table,
        name: &str,
    ) -> Result<Plates, LectureError> {
        let model = surface(&material.words())?;
        let (mut photos, mut peaks, mut departure) = (Vec::new(), Vec::new(), 0.0_f64);
        for psi in PSI {
            let height = studio.pick(160, 400);
            let scene = format!("lecture/plate-{psi}.pbrt");
            let photo =
                studio.render_with(&scene, &material.scene(), [height / 5, height], studio.pick(12, 64))?;
            // Three rows together, for the noise of colours.
            let rows = smoothed(&strip(&photo), 1);
            let mirror = between(&rows, f64::from(psi));
            let ratios: Vec<[f64; 2]> = rows.iter().map(|[t, v]| [*t, v / mirror]).collect();
            for [t, r] in &ratios {
                table.named(name, [f64::from(psi), *t, *r]);
            }
            let truth = |t: f64| {
                f_in_plane(&model, f64::from(psi), t) / f_in_plane(&model, f64::from(psi), f64::from(psi))
            };
            // Below, the middle columns leave the plane of incidence; above, rows span too much.
            let seen = ratios.iter().filter(|[t, _]| (15.0..85.0).contains(t));
            let squares: Vec<f64> = seen.map(|[t, r]| (r / truth(*t) - 1.0).powi(2)).collect();
            departure = departure.max((squares.iter().sum::<f64>() / squares.len() as f64).sqrt());
            let last = ratios.last().copied().unwrap_or([f64::NAN; 2]);
            peaks.push(peak(&ratios).unwrap_or(last));
            photos.push((photo, (0.2 / mirror) as f32));
        }
        Ok(Plates { photos, peaks, departure })
    }
    fn png(&self) -> Result<Vec<u8>, LectureError> {
        side_by_side(&self.photos.iter().map(|(p, e)| (p, *e)).collect::<Vec<_>>())
    }
    /// Against the peaks of the reference sheet.
    fn checks(&self, known: &[[f64; 2]; 5]) -> Vec<Check> {
        let what =
            "largest root mean square, over the strips, of the relative departure from the model, 15° to 85°";
        let mut checks = vec![Check::at_most(what, self.departure, 0.03)];
        for ((psi, [at, height]), [known_at, known_height]) in PSI.iter().zip(&self.peaks).zip(known) {
            let what = format!("place of the peak for ψ = {psi}°, in degrees");
            checks.push(if *known_at > 89.0 {
                // The last row sees the plate half a row below the horizon.
                Check::at_least(what, *at, 88.5)
            } else {
                // Peaks within 7 % of the mirror direction are flat: noise of half a percent moves them.
                Check::near(what, *at, *known_at, if *known_height < 1.07 { 5.0 } else { 1.5 })
            });
            // At the horizon a row spans half a degree, in which the curves rise by a tenth.
            let tolerance = if *known_at > 89.0 { 0.15 } else { 0.04 };
            checks.push(Check::near(
                format!("its height for ψ = {psi}°"),
                *height,
                *known_height,
                tolerance * known_height,
            ));
        }
        checks
    }
}

/// Balls at all incidences side by side, and where along their middle they are brightest, against the model.
fn balls(studio: &Studio<'_>, material: &Material, checks: &mut Vec<Check>) -> Result<Picture, LectureError> {
    let model = surface(&material.words())?;
    let mut photos = Vec::new();
    for psi in PSI {
        let side = studio.pick(72, 320);
        let scene = format!("lecture/ball-{psi}.pbrt");
        let photo = studio.render_with(&scene, &material.scene(), [side; 2], studio.pick(8, 64))?;
        let n = side as usize;
        let x_of = |x: usize| 1.05 * (2.0 * (x as f64 + 0.5) / f64::from(side) - 1.0);
        let rows = n / 2 - n / 24..n / 2 + n / 24;
        let middle: Vec<[f64; 2]> = (0..n).map(|x| [x_of(x), photo.mean(x..x + 1, rows.clone())]).collect();
        let middle = smoothed(&middle, 1);
        let [at, _] = peak(&middle).unwrap_or([f64::NAN; 2]);
        // A normal n degrees from the viewer meets the light, 2 psi from the viewer, at 2 psi - n.
        let psi = f64::from(psi);
        let value = |n: f64| f_in_plane(&model, 2.0 * psi - n, n) * Real::cos((2.0 * psi - n).to_radians());
        let lit = |k: i32| 2.0 * psi - 90.0 + f64::from(k) * 0.05;
        let predicted = (1..3600)
            .map(lit)
            .take_while(|n| *n < 90.0)
            .max_by(|a, b| value(*a).total_cmp(&value(*b)))
            .unwrap_or(f64::NAN);
        let (sin, _) = Real::sin_cos(predicted.to_radians());
        checks.push(Check::near(
            format!("ball at ψ = {psi}°: its brightest place in radii, off the mirror's"),
            at,
            sin,
            0.06,
        ));
        let most = middle.iter().map(|p| p[1]).fold(0.0, f64::max);
        photos.push((photo, (0.8 / most) as f32));
    }
    let png = side_by_side(&photos.iter().map(|(p, e)| (p, *e)).collect::<Vec<_>>())?;
    let alt = "Five balls, the light farther and farther round to the right; the highlight lies nearer to the rim than a mirror's would.";
    Ok(Picture::png("balls", alt, png).labelled(
        "balls, the mirrored light at ψ = 10°, 30°, 45°, 60°, 75°; each exposed for its brightest pixel",
    ))
}

const CAPTION: &str = "Each strip is a plate that is seen from straight above, at its lower end, to the horizon, at its upper end, and lit from \
    ahead at ψ = 10°, 30°, 45°, 60° and 75°. A mirror would be brightest at ψ. All strips are equally bright there; the rough plate is brighter beyond, \
    the more the lower the light.";

fn formula() -> Vec<Formula> {
    vec![Formula::new(
        "f_r = k frac{F(ψ', n) G(ψ, θ) exp(-c^2 α^2)}{4 cos ψ cos θ} + frac{ρ_d}{π}",
        "[TorranceSparrow1967]",
        "models/src/surface/torrance_sparrow_1967.rs: eval",
    )]
}

fn commands(material: &Material) -> Vec<String> {
    vec![
        format!("sparrow render scenes/lecture/plate-45.pbrt --material '{}'", material.scene()),
        format!("sparrow render scenes/lecture/ball-45.pbrt --material '{}'", material.scene()),
    ]
}

/// Slide 5.
pub(super) fn aluminium(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let material = Material { eta: 0.77, k: 6.08, diffuse: 0.0 };
    let mut table = Table::new(["material", "psi_deg", "theta_deg", "over_mirror_direction"]);
    let plates = Plates::shoot(studio, &material, &mut table, "aluminium")?;
    let mut checks = plates.checks(&ALUMINIUM);
    let alt = "Five strips, bright towards their upper ends, the more the lower the light.";
    let label = "plates, ψ = 10°, 30°, 45°, 60°, 75°";
    let pictures = vec![
        Picture::png("plates", alt, plates.png()?).labelled(label),
        balls(studio, &material, &mut checks)?,
    ];
    let figure = Figure {
        caption: CAPTION.to_owned(),
        formulas: formula(),
        commands: commands(&material),
        pictures,
        table: Some(table),
        checks,
        ..Figure::default()
    };
    Ok(figure.with("c", "0.05 per degree").with("index", "0.77 + 6.08 i"))
}

/// Slide 6.
pub(super) fn magnesium_oxide(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let facets = Material { eta: 1.7, k: 0.0, diffuse: 0.0 };
    let mirror = f_in_plane(&surface(&facets.words())?, 10.0, 10.0);
    let mut table = Table::new(["g_over_f", "psi_deg", "theta_deg", "over_mirror_direction"]);
    let (mut pictures, mut checks) = (Vec::new(), Vec::new());
    let mut before = vec![f64::INFINITY; PSI.len()];
    for share in CONSTANT {
        let material = Material { diffuse: PI * share * mirror, ..facets };
        let plates = Plates::shoot(studio, &material, &mut table, &share.to_string())?;
        if share <= 0.0 {
            checks.append(&mut plates.checks(&OXIDE));
        }
        // Where the peak is no higher than 7 % there is little to lower.
        for ((psi, [_, height]), before) in
            PSI.iter().zip(&plates.peaks).zip(&mut before).filter(|((psi, _), _)| **psi >= 30)
        {
            if share > 0.0 {
                checks.push(Check::at_most(
                    format!("peak for ψ = {psi}° with g/f = {share}, lower than with less"),
                    *height,
                    *before,
                ));
            }
            *before = *height;
        }
        if share >= 2.0 {
            for (psi, [_, height]) in PSI.iter().zip(&plates.peaks).filter(|(psi, _)| **psi >= 45) {
                checks.push(Check::at_least(
                    format!("peak for ψ = {psi}° with g/f = {share}, still above the mirror direction"),
                    *height,
                    1.1,
                ));
            }
        }
        let alt = format!(
            "Five strips of magnesium oxide with a constant term of {share}, less uneven the larger it is."
        );
        pictures.push(
            Picture::png(&format!("plates-{share}"), alt, plates.png()?).labelled(format!("g/f = {share}")),
        );
    }
    let oxide = Material { diffuse: PI * mirror, ..facets };
    pictures.push(balls(studio, &oxide, &mut checks)?);
    let figure = Figure {
        caption: format!(
            "{CAPTION}\nFour sets of strips, with more and more of a constant term g for light from within, over the facets' value f in the mirror direction at 10°; the balls have g = f. Both g and the index are our choice."
        ),
        formulas: formula(),
        commands: commands(&oxide),
        pictures,
        table: Some(table),
        checks,
        ..Figure::default()
    };
    Ok(figure.with("c", "0.05 per degree").with("index", "1.7").with("g/f", "0, 0.5, 1, 2"))
}
