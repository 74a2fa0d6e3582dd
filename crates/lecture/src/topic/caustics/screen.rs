//! Slide 23 as a picture: the light of a glass fibre on screens before and behind it.

use sparrow_math::{Real, Vec3};
use sparrow_models::cylinder::attenuation::Inside;
use sparrow_models::cylinder::azimuthal::{TrimmedLogistic, exit_azimuth, wrapped};
use sparrow_models::cylinder::roughness::logistic_scale;
use sparrow_plot::draw::table::Table;
use sparrow_spectra::Spectrum;

use crate::chart::steps;
use crate::measure::{peak, smoothed};
use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

/// Middle of the fibre, which lies along y, in the dome of radius 1.
const FIBRE: Vec3<f64> = Vec3 { x: 0.0, y: -0.06, z: 0.0 };
/// Inclination of the lamp.
const THETA_DEG: f64 = 10.0;
const ETA: f64 = 1.55;
/// Absorption per radius.
const SIGMA_A: f64 = 0.05;
/// Roughness around the fibre, as the scene has it.
const BETA_N: f64 = 0.05;

/// Azimuth from the lamp in degrees and inclination from the fibre's middle to the screen.
fn angles(photo: &Photo, x: usize, y: usize) -> [f64; 2] {
    let ray = photo.camera.ray([x as f32 + 0.5, y as f32 + 0.5], [0.5; 2], 0.0);
    let (o, d) = (ray.o.to_f64(), ray.d.to_f64());
    let b = o.dot(d);
    let w = (o + d * (-b + (b * b + 1.0 - o.dot(o)).sqrt()) - FIBRE).normalized();
    [Real::atan2(w.z, w.x).to_degrees(), Real::asin(w.y).to_degrees()]
}

/// Brightness of the cone over the azimuth, both sides together.
fn profile(photo: &Photo) -> Vec<[f64; 2]> {
    let mut classes = vec![(0.0, 0.0); 30];
    for (x, y) in (0..photo.size[1]).flat_map(|y| (0..photo.size[0]).map(move |x| (x, y))) {
        let [phi, theta] = angles(photo, x, y);
        if let (true, Some((sum, n))) = ((theta + THETA_DEG).abs() < 5.0, classes.get_mut(phi.abs() as usize))
        {
            *sum += photo.grey(x, y);
            *n += 1.0;
        }
    }
    let of = |(k, (sum, n)): (usize, &(f64, f64))| (*n > 0.0).then(|| [k as f64 + 0.5, sum / n]);
    smoothed(&classes.iter().enumerate().filter_map(of).collect::<Vec<_>>(), 1)
}

/// Azimuth in degrees of the most light of TRT: of rays at many offsets, each spread by the lobe of the model.
fn predicted() -> f64 {
    let (sin, cos) = Real::sin_cos(THETA_DEG.to_radians());
    let lobe = TrimmedLogistic::new(logistic_scale(BETA_N));
    let rays: Vec<[f64; 2]> = (0..4000)
        .map(|k| (f64::from(k) + 0.5) / 2000.0 - 1.0)
        .map(|h| {
            let ray = Inside::new([sin, cos], h, ETA);
            let share = ray.attenuation(Spectrum::splat(SIGMA_A))[2].average();
            [exit_azimuth(2, Real::asin(h), ray.angle()), share]
        })
        .collect();
    let density =
        |deg: f64| rays.iter().map(|[phi, a]| a * lobe.value(wrapped(deg.to_radians() - phi))).sum::<f64>();
    let points: Vec<[f64; 2]> = steps(0.0, 30.0, 300).into_iter().map(|d| [d, density(d)]).collect();
    peak(&points).map_or(f64::NAN, |p| p[0])
}

/// Slide 23.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let size = studio.pick([112, 56], [400, 200]);
    let spp = studio.pick(48, 384);
    let front = studio.render("lecture/caustic-front.pbrt", size, spp)?;
    let behind = studio.render("lecture/caustic-behind.pbrt", size, spp)?;
    let profile = profile(&front);
    let mut table = Table::new(["phi_deg", "brightness"]);
    profile.iter().for_each(|p| table.numbers(*p));
    let [at, height] = peak(&profile).unwrap_or([f64::NAN; 2]);
    let middle = profile.first().map_or(f64::NAN, |p| p[1]);
    let outside = profile.last().map_or(f64::NAN, |p| p[1]);
    let hair = |eta: f64| {
        format!(
            r#""fibre" "string type" "hair" "rgb sigma_a" [ 0.05 0.05 0.05 ] "float eta" {eta} "float beta_m" {BETA_N} "float beta_n" {BETA_N} "float alpha" 0"#
        )
    };
    let figure = Figure {
        caption: "A glass fibre stands upright in a dome that serves as screen; the lamp shines on it from ten degrees above the horizon, so that all light that leaves \
            it lies on a cone ten degrees below. Before the fibre, on the lamp's side: light that was reflected once inside, TRT, cannot leave at more than some \
            18° to either side and crowds there, in two glints. Behind it: light that passed through, TT; the black disc is a trap for the light that missed the fibre.\n\
            The roughness of the model blurs the caustic, so that its maximum lies a little inside the caustic angle."
            .to_owned(),
        formulas: vec![
            Formula::new("φ(2, h) = 4 γ_t - 2 γ_i + 2 π", "[Marschner2003, sec. 5.2]", "models/src/cylinder/azimuthal.rs: exit_azimuth"),
            Formula::new("frac{dφ}{dh} = 0 : h_c^2 = frac{4 - η'^2}{3}", "[Marschner2003, sec. 5.2]", "models/src/cylinder/roots.rs: caustic"),
        ],
        commands: vec![
            "sparrow render scenes/lecture/caustic-front.pbrt".to_owned(),
            format!("sparrow render scenes/lecture/caustic-front.pbrt --material '{}'", hair(1.4)),
            "sparrow render scenes/lecture/caustic-behind.pbrt".to_owned(),
        ],
        pictures: vec![
            Picture::png("front", "A dim band with two bright patches at equal distances left and right of the middle.", front.png(1.5)?).labelled("the screen on the lamp's side: TRT and its glints"),
            Picture::png("behind", "A bright bent band with a black disc in its middle.", behind.png(1.0)?).labelled("the screen behind the fibre: TT"),
        ],
        table: Some(table),
        checks: vec![
            Check::near("azimuth of the glints, in degrees, by rays followed apart", at, predicted(), 1.5),
            Check::at_least("brightness of the glints over that of the middle", height / middle, 1.15),
            Check::at_least("brightness of the glints over that 29.5° from the lamp, where no TRT goes", height / outside, 2.0),
        ],
        ..Figure::default()
    };
    Ok(figure.with("η", ETA).with("βn", BETA_N).with("θi", "10°"))
}
