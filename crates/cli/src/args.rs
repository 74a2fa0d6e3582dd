//! The command line: verbs, options, and what their values may be.

use std::path::PathBuf;
use std::time::Duration;

use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use sparrow_mis::Mis;

use crate::compare_cmd::CompareArgs;
use crate::groom_cmd::GroomArgs;
use crate::lecture_cmd::LectureArgs;
use crate::plot_cmd::PlotArgs;
use crate::race_cmd::RaceArgs;

/// Most samples per pixel: beyond it the film's sums could saturate.
pub(crate) const MAX_SPP: u32 = 1 << 22;

/// Spectral path tracer and laboratory for reflection models
#[derive(Debug, Parser)]
#[command(name = "sparrow", version, propagate_version = true, max_term_width = 100)]
#[command(after_help = "Exit codes: 0 done; 1 the input was wrong, a model failed, or a threshold was \
                        exceeded; 2 the command line was wrong; \
                        130 interrupted, what was rendered so far is saved.")]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) verb: Option<Verb>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    Render(Box<RenderArgs>),
    Info(InfoArgs),
    Compare(CompareArgs),
    Race(RaceArgs),
    Plot(Box<PlotArgs>),
    Models(ModelsArgs),
    Verify(VerifyArgs),
    Groom(Box<GroomArgs>),
    Lecture(LectureArgs),
}

/// Render a scene to OpenEXR, with an sRGB PNG beside it
#[derive(Debug, Args)]
#[command(after_help = "\
Options that change the picture override the scene file. Ctrl-C stops at the next tile and saves the picture \
as far as it is; a second Ctrl-C ends at once. The picture does not depend on --threads.")]
pub(crate) struct RenderArgs {
    /// Scene file, in the pbrt-v4 format
    pub(crate) scene: PathBuf,

    /// Name of the picture; OUT.exr and OUT.png are written, whichever is named [default: the film's "filename", else
    /// the scene's name, in the current folder]
    #[arg(short, long, value_name = "OUT.exr", value_parser = PathBufValueParser::new().try_map(parse_output))]
    pub(crate) output: Option<PathBuf>,

    /// Another material in the place of a named one of the scene, in the words of a scene: '"NAME" "string type" "conductor"
    /// "float roughness" 0.3'; may be given again for others [default: none]
    #[arg(long, value_name = "TEXT")]
    pub(crate) material: Vec<String>,

    /// Samples per pixel [default: the scene's, 16 where it has no sampler; no limit with --time or --noise]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SPP)))]
    pub(crate) spp: Option<u32>,

    /// Seed of the random numbers [default: the scene's, 0 where it names none]
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,

    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(crate) threads: Option<u32>,

    /// Light transport [default: the scene's, path where it names none]
    #[arg(long, value_name = "NAME")]
    pub(crate) integrator: Option<Integrator>,

    /// What paths carry [default: the scene's `Option "colour"`, spectral where it names none]
    #[arg(long, alias = "color", value_name = "NAME")]
    pub(crate) colour: Option<Colour>,

    /// Most scattering events of a path [default: the scene's, 5 where it names none]
    #[arg(long, value_name = "N")]
    pub(crate) max_depth: Option<u32>,

    /// Ways on from the first vertex of each camera sample; 0 for as many as are efficient, which a pilot of a few thousand
    /// paths finds [default: the scene's "splits", 0 where it says nothing]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=i64::from(sparrow_scene::IntegratorDesc::MAX_SPLITS)))]
    pub(crate) splits: Option<u32>,

    /// How light sampling and BSDF sampling are weighted: balance, power (exponent 2), power:BETA, cutoff:A,
    /// maximum, average, optimal (learned for what the camera sees first), one-sample, light-only or bsdf-only [default: the scene's, power where it names none]
    #[arg(long, value_name = "NAME", value_parser = parse_mis)]
    pub(crate) mis: Option<Mis>,

    /// MIS compensation: light sampling of environments leaves dim regions to the BSDF [default: the scene's, on where
    /// it says nothing]
    #[arg(long, value_name = "on|off")]
    pub(crate) mis_compensation: Option<Switch>,

    /// How a light is chosen [default: the scene's, bvh where it names none]
    #[arg(long, value_name = "NAME")]
    pub(crate) lightsampler: Option<LightSampler>,

    /// Render only a part, in fractions of the picture's width and height, from the top left, as pbrt's "cropwindow":
    /// 0,0.5,0,1 is the left half [default: the scene's]
    #[arg(long, value_name = "x0,x1,y0,y1", value_parser = parse_crop)]
    pub(crate) crop: Option<Crop>,

    /// Width and height of the whole picture, in pixels; a crop of the scene is kept in proportion [default: the
    /// scene's, 1280x720 where it names none]
    #[arg(long, value_name = "WxH", value_parser = parse_resolution)]
    pub(crate) resolution: Option<[u32; 2]>,

    /// Stop rendering after this time, in seconds, with what is there; without --spp, sample until then [default: no
    /// limit]
    #[arg(long, value_name = "SECONDS", value_parser = parse_time)]
    pub(crate) time: Option<Duration>,

    /// Sample until the noise is this: the square root of what `sparrow compare` would call relmse-trim0.1 against a converged
    /// picture, estimated from two independent halves; 0.02 is 2 % of a pixel. Samples go where they are wanted, with --spp as
    /// the most of a pixel; channel `samples` and OUT-samples.png tell where [default: the same samples everywhere]
    #[arg(long, value_name = "TARGET", value_parser = parse_noise)]
    pub(crate) noise: Option<f64>,

    /// Store colours as 16-bit floats [default: the film's "savefp16", on where it says nothing]
    #[arg(long, value_name = "on|off", num_args = 0..=1, require_equals = true, default_missing_value = "on")]
    pub(crate) half: Option<Switch>,

    /// Add the variance of each pixel, as 32-bit channels variance.R, variance.G and variance.B [default: off]
    #[arg(long)]
    pub(crate) variance: bool,

    /// Write what light sampling and BSDF sampling find to this folder, which is made where it is not there: alone, their mean
    /// weight, weighted and the deviation of one sample, as PNG of the picture's exposure and side by side in sheet.png; means
    /// and variances as layers of strategies.exr [default: none]
    #[arg(long, value_name = "DIR", conflicts_with = "noise")]
    pub(crate) strategies: Option<PathBuf>,

    /// Write time, rays, memory and the like to this file [default: none]
    #[arg(long, value_name = "FILE.json")]
    pub(crate) stats: Option<PathBuf>,

    /// Print nothing but errors: no progress, no warnings, no summary [default: off]
    #[arg(long)]
    pub(crate) quiet: bool,

    /// Print one JSON object about the outcome on standard output [default: off]
    #[arg(long)]
    pub(crate) json: bool,
}

/// Tell what is in a scene, without rendering it
#[derive(Debug, Args)]
pub(crate) struct InfoArgs {
    /// Scene file, in the pbrt-v4 format
    pub(crate) scene: PathBuf,

    /// Print one JSON object on standard output instead of text [default: off]
    #[arg(long)]
    pub(crate) json: bool,
}

/// List the reflection models, or tell all about one
#[derive(Debug, Args)]
pub(crate) struct ModelsArgs {
    /// Name of a model [default: list them all]
    pub(crate) model: Option<String>,

    /// Print JSON on standard output instead of text [default: off]
    #[arg(long)]
    pub(crate) json: bool,
}

/// Try a reflection model: density, samples, weights, energy, reciprocity, edges, number types
#[derive(Debug, Args)]
#[command(after_help = "\
Every question is asked in three columns: f64 judges the formula, f32 and lanes what renders. Beside a verdict \
stands how far the worst case went, in units of what is allowed. `known` is what the model says it lacks. \
Parameters that are not named stay at their defaults; where none is named, they are drawn from the model's table. \
Exit code 0 where all holds, 1 where anything fails.")]
pub(crate) struct VerifyArgs {
    /// Name of a model
    #[arg(conflicts_with = "all")]
    pub(crate) model: Option<String>,

    /// Parameters: a number, four with commas for a spectrum, or the name of a choice; wo=THETA,PHI is the view, in
    /// degrees
    #[arg(value_name = "NAME=VALUE")]
    pub(crate) params: Vec<String>,

    /// Try every model [default: off]
    #[arg(long)]
    pub(crate) all: bool,

    /// Hold fibre models against a fibre that is traced, lobe by lobe; --samples is rays a place [default: off]
    #[arg(long, conflicts_with_all = ["all", "model"])]
    pub(crate) against_fibre: bool,

    /// Show what --against-fibre finds as a picture; FILE.svg and FILE.csv are written [default: none]
    #[arg(long, value_name = "FILE.svg", requires = "against_fibre")]
    pub(crate) plot: Option<std::path::PathBuf>,

    /// Samples per case and column
    #[arg(long, value_name = "N", default_value_t = 1_000_000,
        value_parser = clap::value_parser!(u32).range(1000..=1_000_000_000))]
    pub(crate) samples: u32,

    /// Cases with all questions, per model
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(crate) cases: u32,

    /// Seed of all that is drawn
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,

    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(crate) threads: Option<u32>,

    /// Print one JSON object on standard output instead of text [default: off]
    #[arg(long)]
    pub(crate) json: bool,
}

/// Names of integrators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Integrator {
    /// Path tracer
    Path,
    /// Path tracer, one path at a time: slower, the same picture to the bit
    Reference,
    /// One bounce of light, and specular chains
    Directlighting,
}

/// Names of colour modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Colour {
    /// Values at wavelengths: what light does
    Spectral,
    /// Red, green and blue of the film's colour space: quicker, less noisy, colours approximate
    Rgb,
}

/// Names of light samplers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LightSampler {
    /// All lights alike
    Uniform,
    /// In proportion to power
    Power,
    /// By a hierarchy over the lights
    Bvh,
}

/// On or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Switch {
    /// On
    On,
    /// Off
    Off,
}

impl Switch {
    pub(crate) fn is_on(self) -> bool {
        self == Switch::On
    }
}

/// A part of the picture, `x0 x1 y0 y1` in fractions of width and height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crop(pub(crate) [f32; 4]);

fn parse_output(path: PathBuf) -> Result<PathBuf, String> {
    let folder = path.as_os_str().as_encoded_bytes().last().is_some_and(|c| matches!(c, b'/' | b'\\'));
    if folder || path.file_name().is_none() {
        return Err("this names a folder; add a file name that ends in .exr".to_owned());
    }
    let known = |e: &std::ffi::OsStr| e.eq_ignore_ascii_case("exr") || e.eq_ignore_ascii_case("png");
    match path.extension() {
        Some(e) if known(e) => Ok(path.with_extension("exr")),
        None => Ok(path.with_extension("exr")),
        Some(_) => Err("pictures are written as .exr and .png; end the name in one of them".to_owned()),
    }
}

fn parse_mis(s: &str) -> Result<Mis, String> {
    s.parse()
}

fn parse_crop(s: &str) -> Result<Crop, String> {
    const FORM: &str =
        "give x0,x1,y0,y1 as fractions of width and height with 0 <= x0 < x1 <= 1 and 0 <= y0 < y1 <= 1";
    let numbers: Result<Vec<f32>, _> = s.split(',').map(|v| v.trim().parse()).collect();
    let numbers = numbers.map_err(|_| FORM)?;
    let &[x0, x1, y0, y1] = numbers.as_slice() else { return Err(FORM.to_owned()) };
    let sound = |a: f32, b: f32| 0.0 <= a && a < b && b <= 1.0;
    if sound(x0, x1) && sound(y0, y1) { Ok(Crop([x0, x1, y0, y1])) } else { Err(FORM.to_owned()) }
}

fn parse_resolution(s: &str) -> Result<[u32; 2], String> {
    const FORM: &str = "give WIDTHxHEIGHT in pixels, such as 1280x720, each from 1 to 65535";
    let (w, h) = s.split_once(['x', 'X']).ok_or(FORM)?;
    let side = |v: &str| v.parse::<u32>().ok().filter(|v| (1..=65_535).contains(v)).ok_or(FORM);
    Ok([side(w)?, side(h)?])
}

fn parse_noise(s: &str) -> Result<f64, String> {
    match s.parse::<f64>() {
        Ok(v) if (1e-4..=10.0).contains(&v) => Ok(v),
        Ok(_) | Err(_) => {
            Err("give a number from 0.0001 to 10, such as 0.02 for 2 % of a pixel; without noise \
                               a picture would need endless samples"
                .to_owned())
        }
    }
}

fn parse_time(s: &str) -> Result<Duration, String> {
    const FORM: &str = "give a number of seconds above 0 and up to 1e8";
    let seconds: f64 = s.parse().map_err(|_| FORM)?;
    if seconds > 0.0 && seconds <= 1e8 {
        Duration::try_from_secs_f64(seconds).map_err(|e| e.to_string())
    } else {
        Err(FORM.to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn values_are_checked() {
        assert_eq!(parse_crop("0,0.5, 0.25,1"), Ok(Crop([0.0, 0.5, 0.25, 1.0])));
        for bad in
            ["", "0,1,0", "0,1,0,1,1", "0.5,0.5,0,1", "0,1,-0.1,1", "0,1,0,1.01", "0,nan,0,1", "a,b,c,d"]
        {
            assert!(parse_crop(bad).is_err(), "{bad}");
        }
        assert_eq!(parse_resolution("64x48"), Ok([64, 48]));
        for bad in ["64", "0x4", "64x-1", "64x48x2", "70000x1", "x"] {
            assert!(parse_resolution(bad).is_err(), "{bad}");
        }
        assert_eq!(parse_time("0.25"), Ok(Duration::from_millis(250)));
        assert_eq!(parse_noise("0.02"), Ok(0.02));
        for bad in ["0", "-0.1", "nan", "inf", "1e-9", "11", "little"] {
            assert!(parse_noise(bad).unwrap_err().contains("0.02"), "{bad}");
        }
        for bad in ["0", "-1", "nan", "inf", "1e30", "soon"] {
            assert!(parse_time(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn outputs_share_their_stem() {
        for s in ["a/b.exr", "a/b.png", "a/b.EXR", "a/b"] {
            assert_eq!(parse_output(s.into()), Ok(PathBuf::from("a/b.exr")), "{s}");
        }
        for bad in ["a/b.jpg", "a/", "..", "", "a/b.v2"] {
            assert!(parse_output(bad.into()).is_err(), "{bad}");
        }
    }
}
