//! `sparrow race`: which of two settings renders a scene with less error for the same work.

mod options;
mod report;
mod runner;
mod verdict;

use std::path::PathBuf;

use clap::Args;
use sparrow_image::Image;

use self::options::Setting;
use self::report::Outcome;
use self::runner::{Run, Runner};
use self::verdict::{Pictures, Verdict};
use crate::failure::{DONE, Failure};
use crate::{console, interrupt};

/// Race two settings of a render: which has less error for the same work?
#[derive(Debug, Args)]
#[command(after_help = "\
Each run of a setting has another seed and about the same processor time, of rendering alone. Efficiency is 1 / (relMSE x CPU \
seconds); the ratio is the geometric mean over the seeds of that of A over that of B, with Student's interval of its \
logarithm at 95 %. With --reference the error is relMSE as `sparrow compare` has it. Without, it is the scatter of a setting's \
runs around their own mean, relative to the mean of all runs; it knows no bias. Means of both over blocks of 8 x 8 pixels are \
held against each other by Welch's test, corrected for their number: where they differ at the level 0.01, one setting is \
biased, or finds some light so seldom that it looks so.

    sparrow race scene.pbrt --a '--mis balance' --b '--mis power' --both '--resolution 256x256'")]
pub(crate) struct RaceArgs {
    /// Scene file, in the pbrt-v4 format
    pub(crate) scene: PathBuf,

    /// Options of `sparrow render` that make the first setting, as one word
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true)]
    pub(crate) a: String,

    /// Options of the second
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true)]
    pub(crate) b: String,

    /// Options that both share, such as --resolution [default: none]
    #[arg(
        long,
        value_name = "OPTIONS",
        allow_hyphen_values = true,
        hide_default_value = true,
        default_value = ""
    )]
    pub(crate) both: String,

    /// Runs of each setting, every one with another seed
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(3..=1000))]
    pub(crate) seeds: u32,

    /// Processor time of one run, in seconds; settings with --spp or --noise take what they need
    #[arg(long, value_name = "SECONDS", default_value_t = 4.0, value_parser = parse_seconds)]
    pub(crate) cpu_time: f64,

    /// A converged picture to measure errors against [default: the runs themselves]
    #[arg(long, value_name = "FILE")]
    pub(crate) reference: Option<PathBuf>,

    /// Print nothing but errors and the verdict [default: off]
    #[arg(long)]
    pub(crate) quiet: bool,

    /// Print one JSON object on standard output instead of a table [default: off]
    #[arg(long)]
    pub(crate) json: bool,
}

fn parse_seconds(s: &str) -> Result<f64, String> {
    match s.parse::<f64>() {
        Ok(v) if v > 0.0 && v <= 1e6 => Ok(v),
        Ok(_) | Err(_) => Err("give a number of seconds above 0 and up to 1e6".to_owned()),
    }
}

/// Races, and gives the exit code.
///
/// # Errors
/// Everything that is wrong with the options and the files.
pub(crate) fn run(args: &RaceArgs) -> Result<u8, Failure> {
    let [a, b] = [("--a", &args.a), ("--b", &args.b)]
        .map(|(name, text)| Setting::read(name, text, &args.both, &args.scene));
    let settings = [a?, b?];
    interrupt::install();
    let log = |text: &str| {
        if !args.quiet {
            console::log(text);
        }
    };
    let mut runners = Vec::new();
    for setting in &settings {
        runners.push(Runner::new(setting, args.cpu_time, &log)?);
    }
    let [a, b] = runners.as_mut_slice() else { return Err(Failure::usage("a race has two settings")) };
    if a.bounds() != b.bounds() {
        return Err(Failure::usage(
            "--a and --b render pictures of different size or place; give --resolution and --crop in --both",
        ));
    }
    let reference = args.reference.as_deref().map(|path| read_reference(path, a.size())).transpose()?;
    interrupt::rendering_begins();
    let mut runs: [Vec<Run>; 2] = [Vec::new(), Vec::new()];
    a.warm_up()?;
    b.warm_up()?;
    for seed in 0..u64::from(args.seeds) {
        // Who comes first changes from seed to seed, so that a machine that slows down is fair.
        for i in if seed % 2 == 0 { [0, 1] } else { [1, 0] } {
            let run = if i == 0 { a.run(seed)? } else { b.run(seed)? };
            log(&format!("seed {seed}, {}: {:.2} CPU s", settings[i].name, run.cpu_seconds));
            runs[i].push(run);
        }
    }
    let verdict = Verdict::of(&Pictures { width: a.size()[0], runs: &runs, reference: reference.as_deref() });
    let verdict = verdict.map_err(|e| Failure::input(e.to_string()))?;
    let outcome = Outcome { args, settings: &settings, runs: &runs, verdict: &verdict };
    if args.json {
        console::print(outcome.json()?)?;
    } else {
        console::print(outcome.text().trim_end())?;
    }
    Ok(DONE)
}

fn read_reference(path: &std::path::Path, size: [usize; 2]) -> Result<Vec<[f32; 3]>, Failure> {
    let image = Image::read(path, None).map_err(|e| Failure::input(e.to_string()))?;
    let shown = path.display();
    if [image.width, image.height] != size {
        return Err(Failure::input(format!(
            "{shown} has {} x {} pixels, the race {} x {}; give --both '--resolution {}x{}' or another reference",
            image.width, image.height, size[0], size[1], image.width, image.height
        )));
    }
    let rgb = image.to_rgb();
    match rgb.iter().position(|p| p.iter().any(|v| !v.is_finite())) {
        Some(i) => Err(Failure::input(format!(
            "{shown}: the pixel in column {} and row {} is no finite number; use another reference",
            i % size[0],
            i / size[0]
        ))),
        None => Ok(rgb),
    }
}
