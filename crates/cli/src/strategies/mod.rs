//! `sparrow render --strategies DIR`: the light of each sampling technique, as layers and as pictures.

mod letters;
mod sheet;

use std::fs;
use std::path::{Path, PathBuf};

use sparrow_image::{ImageError, OutputImage, write_exr, write_png};
use sparrow_mis::Mis;
use sparrow_render::film::Film;
use sparrow_render::{Strategies, Technique};
use sparrow_scene::FilmDesc;

use crate::args::RenderArgs;
use crate::failure::Failure;
use crate::output::{Picture, chromaticities, to_srgb};
use crate::{interrupt, paths};

type Pixels = Vec<[f32; 3]>;

/// What a technique's layers are called.
const LAYERS: [&str; 4] = ["unweighted", "weight", "weighted", "deviation"];

/// Sees to it that the folder can be written, and that the heuristic can do what else is asked for.
///
/// # Errors
/// What is in the way, and what to do.
pub(crate) fn check(args: &RenderArgs, mis: Mis) -> Result<(), Failure> {
    if mis == Mis::Optimal && args.noise.is_some() {
        return Err(Failure::usage(
            "--noise and the weights `optimal` both learn from samples, and not yet together; use --mis balance or --spp",
        ));
    }
    let Some(folder) = &args.strategies else { return Ok(()) };
    if mis == Mis::Optimal {
        return Err(Failure::usage(
            "--strategies shows weights of places, and those of `optimal` depend on the light as well; use --mis balance, on \
             which they build",
        ));
    }
    if folder.is_dir() {
        return files(folder).iter().try_for_each(|file| paths::check_writable(file));
    }
    if folder.exists() {
        let told =
            format!("{}: this is a file, --strategies needs a folder; choose another name", folder.display());
        return Err(Failure::input(told));
    }
    paths::check_writable(folder)
}

/// Every file that is written: the layers, the contact sheet, and one picture for each layer.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    let of = |technique: &'static str| LAYERS.map(|layer| format!("{technique}-{layer}.png"));
    let names = ["strategies.exr", "sheet.png", "seen.png"].map(str::to_owned);
    names.into_iter().chain(of("light")).chain(of("bsdf")).map(|name| folder.join(name)).collect()
}

/// Bytes that the films and layers of one pixel take.
pub(crate) fn bytes_per_pixel() -> u64 {
    let films = 5 * Film::new(1, 1, true).bytes();
    (films + 2 * 4 * 12 * size_of::<f32>()) as u64
}

/// What is shown of one technique.
struct Shown {
    unweighted: Pixels,
    unweighted_variance: Pixels,
    weight: Vec<f32>,
    weighted: Pixels,
    weighted_variance: Pixels,
    /// Standard deviation of one weighted sample.
    deviation: Pixels,
}

impl Shown {
    fn new(technique: &Technique) -> Shown {
        let (alone, share) = (&technique.unweighted, &technique.weighted);
        let (unweighted, weighted) = (means(alone), means(share));
        let sum = |p: &[f32; 3]| p[0] + p[1] + p[2];
        // The mean weight of the light that was found; zero where none was.
        let weight = |(a, s): (&[f32; 3], &[f32; 3])| if sum(a) > 0.0 { sum(s) / sum(a) } else { 0.0 };
        Shown {
            weight: unweighted.iter().zip(&weighted).map(weight).collect(),
            unweighted_variance: each(alone, |p| p.variance),
            weighted_variance: each(share, |p| p.variance),
            deviation: each(share, |p| p.variance.map(|v| (v * p.n as f64).sqrt())),
            unweighted,
            weighted,
        }
    }
    /// In the order of [`LAYERS`].
    fn pictures(&self) -> [Pixels; 4] {
        let grey = self.weight.iter().map(|w| [*w; 3]).collect();
        [self.unweighted.clone(), grey, self.weighted.clone(), self.deviation.clone()]
    }
    fn add_to(&self, image: OutputImage, technique: &str) -> OutputImage {
        let name = |layer: &str| format!("{technique}.{layer}");
        image
            .with_rgb(&name("unweighted"), &self.unweighted)
            .with_rgb(&name("unweighted.variance"), &self.unweighted_variance)
            .with_f32(&name("weight.Y"), self.weight.clone())
            .with_rgb(&name("weighted"), &self.weighted)
            .with_rgb(&name("weighted.variance"), &self.weighted_variance)
    }
}

/// Writes all files.
///
/// # Errors
/// Where the folder cannot be made or a file not be written.
pub(crate) fn save(
    folder: &Path,
    parts: &Strategies,
    picture: &Picture,
    film: &FilmDesc,
) -> Result<(), Failure> {
    fs::create_dir_all(folder)
        .map_err(|e| Failure::input(format!("{}: cannot be made: {e}", folder.display())))?;
    write(folder, parts, picture, film).map_err(|e| Failure::input(e.to_string()))
}

fn write(folder: &Path, parts: &Strategies, picture: &Picture, film: &FilmDesc) -> Result<(), ImageError> {
    let width = parts.seen.width() as usize;
    let [light, bsdf] = [&parts.light, &parts.bsdf].map(Shown::new);
    let seen = means(&parts.seen);
    {
        let [x0, _, y0, _] = film.pixel_bounds;
        let full = film.resolution.map(|v| v as usize);
        let mut image = OutputImage::new(width, seen.len() / width).cropped([x0 as i32, y0 as i32], full);
        image = image.with_rgb("", picture.rgb()).with_rgb("seen", &seen);
        image = bsdf.add_to(light.add_to(image, "light"), "bsdf");
        image.chromaticities = Some(chromaticities(film.color_space));
        let _files = interrupt::hold_files();
        write_exr(&folder.join("strategies.exr"), &image)?;
    }
    let png = |name: String, pixels: &Pixels| {
        let _files = interrupt::hold_files();
        let pixels = to_srgb(film.color_space, pixels);
        write_png(&folder.join(name), width, pixels.len() / width, &pixels)
    };
    let mut sheet = sheet::Sheet::new(width);
    for (technique, title, shown) in [("light", "LIGHT SAMPLING", &light), ("bsdf", "BSDF SAMPLING", &bsdf)] {
        for (layer, pixels) in LAYERS.into_iter().zip(shown.pictures()) {
            sheet.add(&format!("{title} {}", layer.to_uppercase()), &pixels);
            png(format!("{technique}-{layer}.png"), &pixels)?;
        }
    }
    sheet.add("PICTURE", picture.rgb());
    sheet.add("SEEN BY THE CAMERA", &seen);
    png("seen.png".to_owned(), &seen)?;
    let (width, pixels) = sheet.finish();
    let _files = interrupt::hold_files();
    let pixels = to_srgb(film.color_space, &pixels);
    write_png(&folder.join("sheet.png"), width, pixels.len() / width, &pixels)
}

fn means(film: &Film) -> Pixels {
    each(film, |p| p.rgb)
}

fn each(film: &Film, of: impl Fn(sparrow_render::film::PixelView) -> [f64; 3]) -> Pixels {
    let rows = (0..film.height()).flat_map(|y| (0..film.width()).map(move |x| (x, y)));
    rows.map(|(x, y)| of(film.pixel(x, y)).map(|v| v as f32)).collect()
}
