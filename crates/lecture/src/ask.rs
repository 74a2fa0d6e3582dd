//! Models by the words of `sparrow plot`, and what figures ask of them.

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::{Bcsdf, Bsdf, BsdfSample, Fibre, FibreKind, N_LOBES, Surface, SurfaceKind, Uniforms};
use sparrow_plot::figure::plane_direction;
use sparrow_plot::{Options, Quantity, Series, draw_fibres, draw_figure, parse_series};

use crate::chart::SIZE;
use crate::error::LectureError;

fn words(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_owned).collect()
}

fn fault(e: &dyn core::fmt::Display) -> LectureError {
    LectureError::Figure(e.to_string())
}

/// One model, as `sparrow plot` names it: `torrance_sparrow exponent=20 masking=none`.
pub(crate) fn surface(text: &str) -> Result<Surface<f64>, LectureError> {
    let series = parse_series::<SurfaceKind>(&words(text)).map_err(|e| fault(&e))?;
    series.first().map(Series::model).ok_or_else(|| LectureError::Figure(format!("`{text}` names no model")))
}

/// One model of a fibre, at its own offset or on the axis.
pub(crate) fn fibre(text: &str) -> Result<Fibre<f64>, LectureError> {
    let series = parse_series::<FibreKind>(&words(text)).map_err(|e| fault(&e))?;
    let first = series.first().ok_or_else(|| LectureError::Figure(format!("`{text}` names no model")))?;
    Ok(first.model_at(first.h.unwrap_or(0.0)))
}

// Models are inlined whole into whoever calls them, so that each question stands here once: others would cost seconds of building.

/// `f(wo, wi)` in 1/sr, the mean over the wavelengths.
pub(crate) fn value(model: &Surface<f64>, wo: LocalDir<f64>, wi: LocalDir<f64>) -> f64 {
    Quantity::F.of(model, wo, wi)
}

/// The density of sampling, in 1/sr.
pub(crate) fn density(model: &Surface<f64>, wo: LocalDir<f64>, wi: LocalDir<f64>) -> f64 {
    Quantity::Pdf.of(model, wo, wi)
}

/// A sample of a surface.
#[inline(never)]
pub(crate) fn sample(model: &Surface<f64>, wo: LocalDir<f64>, u: Uniforms<f64>) -> BsdfSample<f64> {
    model.sample(wo, u)
}

/// A sample of a fibre.
#[inline(never)]
pub(crate) fn scattered(model: &Fibre<f64>, wo: LocalDir<f64>, u: Uniforms<f64>) -> BsdfSample<f64> {
    model.sample(wo, u)
}

/// `S cos theta_i` of a fibre by lobe, in 1/sr, the mean over the wavelengths.
#[inline(never)]
pub(crate) fn lobes(model: &Fibre<f64>, wo: LocalDir<f64>, wi: LocalDir<f64>) -> [f64; N_LOBES] {
    model.lobes(wo, wi).map(|q| q.average())
}

/// `f` for light at `psi` degrees and a viewer at `theta` degrees in the plane of incidence, positive on the mirror's side.
pub(crate) fn f_in_plane(model: &Surface<f64>, psi: f64, theta: f64) -> f64 {
    let light = LocalDir::from_angles(psi.to_radians(), 0.0);
    value(model, light, plane_direction([psi, 0.0], theta))
}

/// The directions of a pair of the reference sheet: polar angle and azimuth of light and viewer, in degrees.
pub(crate) fn pair([ti, pi, to, po]: [f64; 4]) -> [LocalDir<f64>; 2] {
    let of = |t: f64, p: f64| LocalDir::from_angles(t.to_radians(), p.to_radians());
    [of(ti, pi), of(to, po)]
}

/// The direction of inclination and azimuth in degrees, in a fibre's frame.
pub(crate) fn inclined(theta: f64, phi: f64) -> LocalDir<f64> {
    let ((s, c), (t, d)) = (Real::sin_cos(theta.to_radians()), Real::sin_cos(phi.to_radians()));
    LocalDir::new(vec3(s, c * d, c * t))
}

/// A figure of `sparrow plot` in the size of the book, and the command for it.
pub(crate) fn plotted(text: &str, options: &Options) -> Result<(sparrow_plot::Figure, String), LectureError> {
    let options = Options { size: SIZE.map(Some), ..options.clone() };
    let words = words(text);
    let figure = if options.kind.of_fibres() {
        parse_series::<FibreKind>(&words).and_then(|s| draw_fibres(&s, &[], &options))
    } else {
        parse_series::<SurfaceKind>(&words).and_then(|s| draw_figure(&s, &options))
    };
    let flags = [(options.log, " --log"), (options.normalize, " --normalize")];
    let flags: String = flags.iter().filter(|f| f.0).map(|f| f.1).collect();
    let command = format!("sparrow plot {text} --kind {}{flags}", options.kind.name());
    Ok((figure.map_err(|e| fault(&e))?, command))
}
