//! `sparrow compare`: how far a picture is from a reference.

mod maps;
mod measure;
mod noise;
mod pictures;
mod report;

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};

use self::measure::{Measure, Threshold, Value, parse_threshold};
use self::pictures::Pictures;
use self::report::{Judged, Outcome};
use crate::failure::{DONE, Failure, INPUT, Remark};
use crate::{console, paths};

/// Compare a picture with a reference: MSE, relMSE, PSNR, SSIM, FLIP, z-test
#[derive(Debug, Args)]
#[command(after_help = "\
Both files may be OpenEXR, PFM, HDR, PNG, JPEG, TGA or QOI; of layers, the one named R, G, B counts. Integer samples are \
decoded from sRGB, so all are compared as linear light. Maps of -o run from dark violet (0) to yellow (1): OUT.png shows FLIP \
(HDR-FLIP where the reference exceeds 1), OUT-relative.png the relative error.\n\n\
The z-test asks whether noise alone explains the difference. It needs the variance of each pixel in both files, as channels \
variance.R, variance.G and variance.B, which `sparrow render --variance` writes; p is corrected for the number of pixels.\n\n\
A threshold is exceeded by greater errors, by smaller PSNR and SSIM, by mean ratios farther from 1, by a z-test of smaller p. \
Exit code 0 where none is, 1 otherwise.")]
pub(crate) struct CompareArgs {
    /// Picture to be judged
    picture: PathBuf,

    /// What it is held against
    reference: PathBuf,

    /// Measure to take; may be given again for others [default: all that are defined for the pictures]
    #[arg(long, value_name = "NAME")]
    metric: Vec<Measure>,

    /// Value than which a measure may not be worse, for scripts; may be given again for others [default: none]
    #[arg(long, value_name = "NAME=VALUE", value_parser = parse_threshold)]
    threshold: Vec<Threshold>,

    /// Name of a picture of the differences; OUT.png and OUT-relative.png are written [default: none]
    #[arg(short, long, value_name = "OUT.png", value_parser = PathBufValueParser::new().try_map(parse_output))]
    output: Option<PathBuf>,

    /// Print nothing but errors [default: off]
    #[arg(long)]
    pub(crate) quiet: bool,

    /// Print one JSON object on standard output instead of a table [default: off]
    #[arg(long)]
    pub(crate) json: bool,
}

impl CompareArgs {
    /// A measure that the user named.
    fn names(&self, measure: Measure) -> bool {
        self.metric.contains(&measure) || self.threshold.iter().any(|t| t.measure == measure)
    }
    /// All measures to take, in their usual order.
    fn measures(&self) -> Vec<Measure> {
        let all = self.metric.is_empty();
        Measure::all().filter(|m| all || self.names(*m)).collect()
    }
}

/// Compares, and gives the exit code.
///
/// # Errors
/// Everything that is wrong with the files.
pub(crate) fn run(args: &CompareArgs) -> Result<u8, Failure> {
    let outputs = args.output.as_deref().map(maps::names);
    for path in outputs.iter().flatten() {
        check_output(path, args)?;
    }
    let pictures = Pictures::read(&args.picture, &args.reference).map_err(Failure::inputs)?;
    let pair = pictures.pair().map_err(|e| Failure::input(e.to_string()))?;
    let taken = measure::Taken::new(&pictures, pair);
    let values: Vec<(Measure, Value)> = args.measures().into_iter().map(|m| (m, taken.value(m))).collect();
    refuse_undefined(&values, args)?;
    let judged: Vec<Judged> = args.threshold.iter().filter_map(|t| Judged::new(*t, &values)).collect();
    if let Some(names) = &outputs {
        taken.save_maps(names).map_err(|e| Failure::input(e.to_string()))?;
    }
    let exceeded = judged.iter().any(|j| j.exceeded);
    let outcome = Outcome {
        exit_code: if exceeded { INPUT } else { DONE },
        args,
        pictures: &pictures,
        values: &values,
        judged: &judged,
        outputs: outputs.as_ref().map_or(&[], |names| names.as_slice()),
    };
    if args.json {
        console::print(outcome.json()?)?;
    } else if !args.quiet {
        console::print(outcome.text().trim_end())?;
    }
    Ok(outcome.exit_code)
}

/// What the user names has to be defined.
fn refuse_undefined(values: &[(Measure, Value)], args: &CompareArgs) -> Result<(), Failure> {
    let undefined = values.iter().filter(|(m, _)| args.names(*m)).filter_map(|(m, v)| match v {
        Value::Undefined(why) => Some(Remark::plain(format!("{}: {why}", m.name()))),
        Value::Number(_) | Value::Channels(_) | Value::Test(_) => None,
    });
    let faults: Vec<Remark> = undefined.collect();
    if faults.is_empty() { Ok(()) } else { Err(Failure::inputs(faults)) }
}

fn check_output(path: &Path, args: &CompareArgs) -> Result<(), Failure> {
    if paths::is_one_of(path, [args.picture.as_path(), args.reference.as_path()]) {
        return Err(Failure::input(format!(
            "{}: this file is compared; name another with -o",
            path.display()
        )));
    }
    paths::check_writable(path)
}

fn parse_output(path: PathBuf) -> Result<PathBuf, String> {
    let folder = path.as_os_str().as_encoded_bytes().last().is_some_and(|c| matches!(c, b'/' | b'\\'));
    if folder || path.file_name().is_none() {
        return Err("this names a folder; add a file name that ends in .png".to_owned());
    }
    match path.extension() {
        Some(e) if e.eq_ignore_ascii_case("png") => Ok(path),
        None => Ok(path.with_extension("png")),
        Some(_) => Err("the differences are written as .png; end the name in it".to_owned()),
    }
}
