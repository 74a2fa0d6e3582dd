//! From a film to files: channels, windows and attributes of the OpenEXR file, and the PNG beside it.

use std::path::Path;

use sparrow_image::{Attribute, Chromaticities, ImageError, OutputImage, write_exr, write_png};
use sparrow_render::camera::Camera;
use sparrow_render::film::{self, Developed};
use sparrow_scene::FilmDesc;
use sparrow_spectra::ColorSpace;

use crate::paths::Outputs;
use crate::report::Stats;
use crate::{adaptive, interrupt};

/// The largest 16-bit float; what exceeds it would become infinite and spread in every later filter.
const MAX_HALF: f32 = 65_504.0;

type Matrix = [[f32; 4]; 4];

/// The pixels of a film as they go to files, in linear RGB of the output colour space.
pub(crate) struct Picture {
    size: [usize; 2],
    rgb: Vec<[f32; 3]>,
    /// Empty where the film keeps none.
    variance: Vec<[f32; 3]>,
    /// Number of samples of each pixel; empty where all have the same.
    samples: Vec<f32>,
    /// Pixels whose colour was cut to what 16 bits hold.
    pub(crate) n_clipped: usize,
}

impl Picture {
    /// Reads a finished render; `half` cuts colours to the range of 16-bit floats, `variance` and `samples` keep those layers.
    pub(crate) fn new(film: &dyn film::Picture, half: bool, variance: bool, samples: bool) -> Picture {
        let [width, height] = film.size();
        let limit = if half { MAX_HALF } else { f32::MAX };
        let Developed { rgb, n_clipped, variance, samples } = Developed::new(film, limit, variance, samples);
        Picture { size: [width as usize, height as usize], rgb, variance, samples, n_clipped }
    }

    /// Writes all files. The program does not end while one of them is being written.
    ///
    /// # Errors
    /// Where a file cannot be written; nothing of that file is left behind.
    pub(crate) fn save(
        &self,
        out: &Outputs,
        film: &FilmDesc,
        camera: &Camera,
        stats: &Stats,
    ) -> Result<(), ImageError> {
        let image = self.exr(film, camera, stats);
        {
            let _files = interrupt::hold_files();
            write_exr(&out.exr, &image)?;
        }
        drop(image);
        if let Some(path) = &out.samples {
            adaptive::save_map(path, self.size[0], &self.samples)?;
        }
        let _files = interrupt::hold_files();
        self.save_png(&out.png, film.color_space)
    }

    fn exr(&self, film: &FilmDesc, camera: &Camera, stats: &Stats) -> OutputImage {
        let [width, height] = self.size;
        let [x0, _, y0, _] = film.pixel_bounds;
        let full = film.resolution.map(|v| v as usize);
        let mut image = OutputImage::new(width, height).cropped([x0 as i32, y0 as i32], full);
        image = if film.save_fp16 { image.with_rgb_f16(&self.rgb) } else { image.with_rgb("", &self.rgb) };
        if !self.variance.is_empty() {
            // Always 32 bits: the variance of a dark pixel is below what 16 bits can tell from zero.
            image = image.with_rgb("variance", &self.variance);
        }
        if !self.samples.is_empty() {
            image = image.with_f32("samples", self.samples.clone());
        }
        image.chromaticities = Some(chromaticities(film.color_space));
        let [camera_from_world, ndc_from_world] = matrices(camera, film.resolution);
        image.world_to_camera = Some(camera_from_world);
        image.world_to_ndc = Some(ndc_from_world);
        image.attributes = attributes(stats, camera);
        image
    }

    fn save_png(&self, path: &Path, space: ColorSpace) -> Result<(), ImageError> {
        write_png(path, self.size[0], self.size[1], &to_srgb(space, &self.rgb))
    }

    /// Linear RGB of the output colour space.
    pub(crate) fn rgb(&self) -> &[[f32; 3]] {
        &self.rgb
    }
}

/// Linear RGB of a colour space, brought to that of sRGB.
pub(crate) fn to_srgb(space: ColorSpace, rgb: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let to_srgb = space.to_space(ColorSpace::Srgb);
    match space {
        ColorSpace::Srgb => rgb.to_vec(),
        ColorSpace::DciP3 | ColorSpace::Rec2020 | ColorSpace::Aces2065_1 => {
            rgb.iter().map(|p| to_srgb.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2])).collect()
        }
    }
}

/// The primaries, with the white points as the standards print them.
pub(crate) fn chromaticities(space: ColorSpace) -> Chromaticities {
    let [red, green, blue] = space.primaries().map(|p| p.map(|v| v as f32));
    let white = match space {
        // ITU-R BT.709-6, item 1.4; the same in BT.2020 and P3-D65.
        ColorSpace::Srgb | ColorSpace::DciP3 | ColorSpace::Rec2020 => [0.3127, 0.3290],
        // SMPTE ST 2065-1, section 4.1.1.
        ColorSpace::Aces2065_1 => [0.32168, 0.33767],
    };
    Chromaticities { red, green, blue, white }
}

/// Camera from world, and normalised device coordinates from world; both for column vectors, as the image crate takes them.
///
/// OpenEXR's device coordinates have (0, 0) in the upper left and (1, 1) in the lower right corner of the display window
/// [OpenEXR, standard attributes, worldToNDC]. Its files hold matrices for row vectors, so the transposes of these. Camera
/// space is pbrt's: x right, y up, z ahead, left-handed.
fn matrices(camera: &Camera, resolution: [u32; 2]) -> [Matrix; 2] {
    let camera_from_world = camera.to_world().inverse();
    let world = camera_from_world.rows();
    let mut ndc = [[0.0; 4]; 4];
    let pixels = [f64::from(resolution[0]), f64::from(resolution[1]), 1.0, 1.0];
    for ((row, film), scale) in ndc.iter_mut().zip(camera.film_from_camera()).zip(pixels) {
        for (j, v) in row.iter_mut().enumerate() {
            *v = ((0..4).map(|k| film[k] * world[k][j]).sum::<f64>() / scale) as f32;
        }
    }
    [world.map(|row| row.map(|v| v as f32)), ndc]
}

fn attributes(stats: &Stats, camera: &Camera) -> Vec<(String, Attribute)> {
    let text = |t: &str| Attribute::Text(t.to_owned());
    let whole = |v: u32| Attribute::Int(i32::try_from(v).unwrap_or(i32::MAX));
    let list = [
        ("software", text(&format!("Sparrow {}", stats.version))),
        ("command", text(&stats.command_line.iter().map(|w| quoted(w)).collect::<Vec<_>>().join(" "))),
        ("scene", text(&stats.scene)),
        // Seeds have 64 bits, whole numbers in OpenEXR 32.
        ("seed", text(&stats.seed.to_string())),
        ("samplesPerPixel", whole(stats.samples_per_pixel)),
        ("renderSeconds", Attribute::Double(stats.times.render_seconds)),
        ("integrator", text(stats.integrator)),
        ("maxDepth", whole(stats.max_depth)),
        ("splits", whole(stats.splits)),
        ("mis", text(&stats.mis)),
        ("lightSampler", text(stats.light_sampler)),
        ("colourMode", text(stats.colour)),
        ("sampler", text(stats.sampler)),
        ("cameraToWorld", Attribute::Matrix(camera.to_world().rows().map(|row| row.map(|v| v as f32)))),
    ];
    list.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// A word of a command line as a POSIX shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "_-+=./,:@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;
    use sparrow_math::{Transform, vec3};
    use sparrow_render::film::Film;
    use sparrow_scene::{CameraDesc, Projection};

    fn camera() -> Camera {
        let to_world = Transform::translate(vec3(1.0, -2.0, 5.0));
        let desc = CameraDesc {
            projection: Projection::Perspective { fov: 40.0 },
            to_world,
            moves_to: None,
            motion_times: [0.0, 1.0],
            screen_window: None,
            frame_aspect: None,
            lens_radius: 0.0,
            focal_distance: 1e6,
            shutter: [0.0, 1.0],
        };
        Camera::new(&desc, [320, 200])
    }

    #[test]
    fn world_points_land_on_their_pixels() {
        let camera = camera();
        let [world_to_camera, ndc] = matrices(&camera, [320, 200]);
        for pixel in [[0.0, 0.0], [320.0, 200.0], [31.5, 170.25]] {
            let ray = camera.ray(pixel, [0.5; 2], 0.0);
            let p = ray.o + ray.d * 3.0;
            let on = |m: &Matrix| m.map(|r| r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3]);
            let h = on(&ndc);
            let (x, y) = (320.0 * h[0] / h[3], 200.0 * h[1] / h[3]);
            assert!((x - pixel[0]).abs() < 2e-3 && (y - pixel[1]).abs() < 2e-3, "{pixel:?}: {x} {y}");
            let c = on(&world_to_camera);
            assert!(c[2] > 0.0, "the camera looks along its z: {c:?}");
        }
    }

    #[test]
    fn bright_pixels_fit_into_half_floats() {
        let mut film = Film::new(2, 1, true);
        film.add(0, 0, [1e6, 1.0, -1e6], 1.0);
        film.add(1, 0, [0.5, 2.0, 4.0], 1.0);
        let half = Picture::new(&film, true, true, false);
        assert_eq!((half.n_clipped, half.rgb[0]), (1, [MAX_HALF, 1.0, -MAX_HALF]));
        let full = Picture::new(&film, false, true, true);
        assert_eq!((full.n_clipped, full.rgb[0]), (0, [1e6, 1.0, -1e6]));
        assert_eq!((full.variance.len(), full.samples), (2, vec![1.0, 1.0]));
    }

    #[test]
    fn words_survive_the_shell() {
        assert_eq!(["a-b=c", "", "it's", "a b"].map(quoted), ["a-b=c", "''", r"'it'\''s'", "'a b'"]);
    }

    #[test]
    fn srgb_is_what_openexr_assumes() {
        assert_eq!(chromaticities(ColorSpace::Srgb), Chromaticities::REC_709);
    }
}
