//! `sparrow render --noise`: what is told of it, and the map of the samples.

use std::fmt;
use std::path::Path;

use serde::Serialize;
use sparrow_image::{Encoding, Image, ImageError, Pixels, write_png};
use sparrow_plot::draw::colour_map;
use sparrow_render::RenderStats;

use crate::args::RenderArgs;
use crate::failure::Failure;
use crate::interrupt;
use crate::report::Stats;

/// Fewest samples of a pixel that can be divided into halves with a variance of their own.
const LEAST: u32 = 16;

/// How far a render to a stated noise came.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct NoiseReport {
    target: f64,
    /// As estimated; none where it was stopped before anything could be.
    estimate: Option<f64>,
    samples_per_pixel_mean: f64,
}

impl fmt::Display for NoiseReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.estimate {
            Some(noise) => write!(f, "noise {noise:.4}, ")?,
            None => write!(f, "noise unknown, ")?,
        }
        write!(f, "{:.1} samples per pixel", self.samples_per_pixel_mean)
    }
}

/// Refuses what cannot be halved.
///
/// # Errors
/// Where `--spp` is too small for `--noise`.
pub(crate) fn check(args: &RenderArgs) -> Result<(), Failure> {
    match (args.noise, args.spp) {
        (Some(_), Some(spp)) if spp < LEAST => Err(Failure::usage(format!(
            "--spp {spp}: with --noise this is the most samples of a pixel, and noise is estimated from {LEAST} or more; \
             raise --spp or leave it out"
        ))),
        _ => Ok(()),
    }
}

/// What is aimed at.
pub(crate) fn goal(args: &RenderArgs) -> String {
    let mut goal = format!("to a noise of {}", args.noise.unwrap_or_default());
    if let Some(spp) = args.spp {
        goal += &format!(", with at most {spp} samples per pixel");
    }
    if let Some(time) = args.time {
        goal += &format!(", for at most {} s", time.as_secs_f64());
    }
    goal
}

/// Enters how far it came, and says so where it is not far enough.
pub(crate) fn note_noise(
    args: &RenderArgs,
    did: &RenderStats,
    stats: &mut Stats,
    mut note: impl FnMut(String),
) {
    let Some(target) = args.noise else { return };
    let [x0, x1, y0, y1] = stats.pixel_bounds.map(f64::from);
    let pixels = (x1 - x0) * (y1 - y0);
    stats.noise = Some(NoiseReport {
        target,
        estimate: did.noise,
        samples_per_pixel_mean: did.samples as f64 / pixels.max(1.0),
    });
    match did.noise {
        Some(noise) if noise > target && !did.stopped => note(format!(
            "every pixel has its {} samples and the noise is {noise:.4}, above {target}; raise --spp",
            stats.samples_per_pixel_wanted
        )),
        _ => {}
    }
}

/// Writes numbers of samples from dark violet (none) to yellow (the most).
///
/// # Errors
/// Where the file cannot be written.
pub(crate) fn save_map(path: &Path, width: usize, samples: &[f32]) -> Result<(), ImageError> {
    let most = samples.iter().fold(1.0f32, |a, b| a.max(*b));
    let codes = samples.iter().flat_map(|n| colour_map::rgb(f64::from(n / most)));
    let codes = Pixels::U8(codes.map(|c| c.round() as u8).collect());
    let height = samples.len() / width.max(1);
    let rgb = Image::new(width, height, ["R", "G", "B"].map(str::to_owned).to_vec(), codes, Encoding::Srgb)?
        .to_rgb();
    let _files = interrupt::hold_files();
    write_png(path, width, height, &rgb)
}
