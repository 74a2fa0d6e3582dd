//! The two files: [`Pictures`], and all that can be wrong with them.

use std::path::Path;

use sparrow_image::metrics::Pair;
use sparrow_image::{Chromaticities, Image, ImageError};

use crate::failure::Remark;

/// Channels with the variances of the pixels' means, as `sparrow render --variance` writes them.
const VARIANCES: [&str; 3] = ["variance.R", "variance.G", "variance.B"];

/// Two pictures of the same size, every pixel finite.
pub(super) struct Pictures {
    pub(super) size: [usize; 2],
    pub(super) warnings: Vec<Remark>,
    picture: Half,
    reference: Half,
}

/// One of the two.
struct Half {
    path: String,
    image_size: [usize; 2],
    chromaticities: Chromaticities,
    rgb: Vec<[f32; 3]>,
    /// None where the file has none; else them, or what is wrong with them.
    variance: Option<Result<Vec<[f32; 3]>, String>>,
}

impl Pictures {
    /// Reads both.
    ///
    /// # Errors
    /// Every fault of either file, and where they do not fit together.
    pub(super) fn read(picture: &Path, reference: &Path) -> Result<Pictures, Vec<Remark>> {
        let (a, b) = match (Half::read(picture), Half::read(reference)) {
            (Ok(a), Ok(b)) => (a, b),
            (a, b) => return Err([a.err(), b.err()].into_iter().flatten().flatten().collect()),
        };
        let [p, r] = [picture, reference].map(|path| path.display().to_string());
        let mut faults = Vec::new();
        if a.image_size != b.image_size {
            let [[w, h], [v, g]] = [a.image_size, b.image_size];
            faults.push(Remark::plain(format!(
                "{p} has {w} x {h} pixels, {r} has {v} x {g}; render both at the same --resolution and --crop"
            )));
        }
        if differ(&a.chromaticities, &b.chromaticities) {
            faults.push(Remark::plain(format!(
                "{p} and {r} have different primaries, so equal numbers are different colours; save both in the same RGB space"
            )));
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let mut warnings = Vec::new();
        if differ(&a.chromaticities, &Chromaticities::REC_709) {
            warnings.push(Remark::plain(
                "the pictures are not in the RGB space of sRGB; psnr, ssim and flip take their numbers as if they were",
            ));
        }
        Ok(Pictures { size: a.image_size, warnings, picture: a, reference: b })
    }

    pub(super) fn pair(&self) -> Result<Pair<'_>, ImageError> {
        Pair::new(self.size[0], &self.picture.rgb, &self.reference.rgb)
    }

    /// Those of picture and reference; else why there are none.
    pub(super) fn variances(&self) -> Result<[&[[f32; 3]]; 2], String> {
        let halves = [&self.picture, &self.reference];
        if let [Some(Ok(a)), Some(Ok(b))] = halves.map(|h| h.variance.as_ref()) {
            return Ok([a, b]);
        }
        let without: Vec<&str> =
            halves.iter().filter(|h| h.variance.is_none()).map(|h| h.path.as_str()).collect();
        let absent = (!without.is_empty()).then(|| {
            let (names, files) = (VARIANCES.join(", "), without.join(" and "));
            format!("there are no channels {names} in {files}; `sparrow render --variance` writes them")
        });
        let unsound = halves.iter().filter_map(|h| h.variance.as_ref()?.as_ref().err().cloned());
        Err(absent.into_iter().chain(unsound).collect::<Vec<_>>().join("; "))
    }
}

impl Half {
    fn read(path: &Path) -> Result<Half, Vec<Remark>> {
        let image = Image::read(path, None).map_err(|e| vec![Remark::plain(e.to_string())])?;
        if !image.has_colour() && image.channel_index("Y").is_none() {
            let message = format!(
                "there are no channels R, G, B and no Y, only {}; save a picture with colours or luminance",
                image.channels.join(", ")
            );
            return Err(vec![Remark::in_file(path, &message)]);
        }
        let rgb = image.to_rgb();
        if let Some(what) = unsound(&rgb, image.width, "not finite (NaN or infinite)", f32::is_finite) {
            let message = format!("{what}; no measure is defined with such, so render again or repair them");
            return Err(vec![Remark::in_file(path, &message)]);
        }
        Ok(Half {
            path: path.display().to_string(),
            image_size: [image.width, image.height],
            chromaticities: image.chromaticities.unwrap_or(Chromaticities::REC_709),
            variance: variance_of(&image, path),
            rgb,
        })
    }
}

fn variance_of(image: &Image, path: &Path) -> Option<Result<Vec<[f32; 3]>, String>> {
    let [Some(r), Some(g), Some(b)] = VARIANCES.map(|name| image.channel_index(name)) else { return None };
    let row = |y: usize| (0..image.width).map(move |x| [r, g, b].map(|c| image.value(x, y, c)));
    let all: Vec<[f32; 3]> = (0..image.height).flat_map(row).collect();
    let sound = |v: f32| v.is_finite() && v >= 0.0;
    Some(match unsound(&all, image.width, "negative or not finite", sound) {
        Some(what) => {
            Err(format!("{}: of the variances, {what}; render with more samples per pixel", path.display()))
        }
        None => Ok(all),
    })
}

/// How many pixels are not sound in any channel, what they are instead, and where the first is.
fn unsound(pixels: &[[f32; 3]], width: usize, what: &str, sound: impl Fn(f32) -> bool) -> Option<String> {
    let bad = |p: &[f32; 3]| p.iter().any(|v| !sound(*v));
    let first = pixels.iter().position(bad)?;
    let n = pixels.iter().filter(|p| bad(p)).count();
    let (x, y) = (first % width, first / width);
    Some(format!(
        "{n} of {} pixels {} {what}, the first in column {x}, row {y}, counted from 0 at the top left",
        pixels.len(),
        if n == 1 { "is" } else { "are" }
    ))
}

/// Beyond the rounding of whoever wrote them.
fn differ(a: &Chromaticities, b: &Chromaticities) -> bool {
    let list = |c: &Chromaticities| [c.red, c.green, c.blue, c.white];
    list(a).iter().flatten().zip(list(b).iter().flatten()).any(|(a, b)| (a - b).abs() > 1e-3)
}
