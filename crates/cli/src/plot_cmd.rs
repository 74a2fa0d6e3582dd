//! `sparrow plot`: a figure of models, as SVG with its numbers beside it as CSV.

use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum, builder::TypedValueParser};
use serde::Serialize;
use sparrow_models::{FibreKind, SurfaceKind};
use sparrow_plot::figure::Traced;
use sparrow_plot::{
    Family, Figure, Kind, Options, PlotError, Quantity, Series, draw_fibres, draw_figure, names_a_fibre,
    parse_series,
};

use sparrow_verify::reference_fibre::{Over, fibre_like};

use crate::failure::{DONE, Failure, Remark};
use crate::{console, paths};

/// Plot reflection models: lobes, samples, albedo, as SVG with its numbers as CSV
#[derive(Debug, Args)]
#[command(after_help = "\
A value list makes one series per value: `conductor alpha=0.1,0.3,0.6`. `+` adds another model: `phong exponent=50 + \
blinn_phong exponent=200`. `alpha` sets alpha_x and alpha_y. A spectrum takes one number for all wavelengths, a choice one \
of its words. wo=THETA,PHI is the direction towards the viewer, in degrees, for all models [default: wo=45,0]; given \
several times, each makes series of its own. For half-difference its PHI is the azimuth of the half vector.\n\n\
Kinds: polar and cartesian show the lobe in the plane of incidence, lobe3d the whole lobe, half-difference the value over \
half and difference angle, samples the sampled directions over their density, albedo the share of light that leaves \
over the angle of the view, albedo-map that over angle and roughness.\n\n\
Fibres (`hair`, `marschner` ...) have kinds of their own: azimuthal, longitudinal, caustic and fibre-map. THETA is then \
the inclination [default: wo=20,0]; h=OFFSET shows the ray that meets the fibre there, else the mean over the width is shown.")]
pub(crate) struct PlotArgs {
    /// Models and their parameters, and the view
    #[arg(required = true, value_name = "MODEL [NAME=VALUE,..] [+ MODEL ..] [wo=THETA,PHI]")]
    words: Vec<String>,

    /// What is plotted [default: polar, of fibres azimuthal]
    #[arg(long, value_name = "KIND",
        value_parser = PossibleValuesParser::new(Kind::ALL.map(Kind::name)).map(kind))]
    kind: Option<Kind>,

    /// What lobes show: the value f, the value times the cosine of the light, or the density of sampling
    #[arg(long, value_name = "NAME", default_value = "f")]
    quantity: QuantityName,

    /// Name of the picture; FILE.svg and FILE.csv are written [default: models and kind, in the current folder]
    #[arg(short, long, value_name = "FILE.svg")]
    output: Option<PathBuf>,

    /// Trace the fibre that the parameters mean and lay what it sends over azimuthal, longitudinal and caustic [default: off]
    #[arg(long)]
    reference: bool,

    /// Write the numbers only, no picture [default: off]
    #[arg(long)]
    csv: bool,

    /// Logarithmic lengths, ordinates or colours [default: off; half-difference decides by the values]
    #[arg(long)]
    log: bool,

    /// Show each lobe of polar and cartesian over its own greatest value [default: off]
    #[arg(long)]
    normalize: bool,

    /// Parameter over which albedo-map runs [default: the model's roughness]
    #[arg(long, value_name = "NAME")]
    over: Option<String>,

    /// Samples of each series that are drawn
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u32).range(0..=20_000))]
    samples: u32,

    /// Seed of the samples
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,

    /// Title of the picture [default: the names of the models]
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,

    /// Width of the picture in pixels [default: 960, more for several panels]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(320..=8000))]
    width: Option<u32>,

    /// Height of the picture in pixels [default: what suits the kind]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(320..=8000))]
    height: Option<u32>,

    /// Light on dark [default: off]
    #[arg(long)]
    dark: bool,

    /// Print nothing but errors [default: off]
    #[arg(long)]
    pub(crate) quiet: bool,

    /// Print one JSON object about the outcome on standard output [default: off]
    #[arg(long)]
    pub(crate) json: bool,
}

/// Names of quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum QuantityName {
    /// The value, in 1/sr
    F,
    /// The value times the cosine of the light, in 1/sr
    #[value(name = "f_cos")]
    FCos,
    /// The density of sampling, in 1/sr
    Pdf,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Outcome {
    status: &'static str,
    version: &'static str,
    kind: &'static str,
    series: Vec<String>,
    svg: Option<String>,
    csv: String,
}

/// Plots, and gives the exit code.
///
/// # Errors
/// Everything that is wrong with the words, and files that cannot be written.
pub(crate) fn run(args: &PlotArgs) -> Result<u8, Failure> {
    if names_a_fibre(&args.words) {
        let kind = args.kind.unwrap_or(Kind::Azimuthal);
        plot::<FibreKind>(args, kind, |series, options| {
            let traced = if args.reference { trace(series, kind, args.seed)? } else { Vec::new() };
            draw_fibres(series, &traced, options)
        })
    } else {
        if args.reference {
            return Err(Failure::usage("--reference traces a fibre, and none is named; leave it out"));
        }
        plot::<SurfaceKind>(args, args.kind.unwrap_or(Kind::Polar), draw_figure)
    }
}

/// Rays that are traced for each series, and the width of cells in degrees.
const RAYS: usize = 1_000_000;
const CELL: f64 = 4.0;

/// What the reference fibre of each series sends.
fn trace(series: &[Series<FibreKind>], kind: Kind, seed: u64) -> Result<Vec<Traced>, PlotError> {
    let (over, end) = match kind {
        Kind::Longitudinal => (Over::Inclination, 90.0),
        Kind::Azimuthal | Kind::Caustic => (Over::Azimuth, 180.0),
        Kind::Polar
        | Kind::Cartesian
        | Kind::Lobe3d
        | Kind::HalfDifference
        | Kind::Samples
        | Kind::Albedo
        | Kind::AlbedoMap
        | Kind::FibreMap => {
            let name = kind.name();
            return Err(PlotError::plain(format!(
                "--reference is for azimuthal, longitudinal and caustic, not for {name}; leave it out"
            )));
        }
    };
    let one = |s: &Series<FibreKind>| {
        let fibre = fibre_like(s.kind, &s.params).ok_or_else(|| {
            PlotError::plain(format!(
                "{} stands for no fibre that could be traced; leave --reference out",
                s.kind.name()
            ))
        })?;
        let cells = (2.0 * end / CELL) as usize;
        let lobes = fibre.section(s.wo(), s.h, over, cells, RAYS, seed);
        Ok(Traced { angles: (0..cells).map(|k| (k as f64 + 0.5) * CELL - end).collect(), lobes })
    };
    series.iter().map(one).collect()
}

fn plot<K: Family>(
    args: &PlotArgs,
    kind: Kind,
    draw: impl Fn(&[Series<K>], &Options) -> Result<Figure, PlotError>,
) -> Result<u8, Failure> {
    let series = parse_series::<K>(&args.words).map_err(|e| refuse(&e))?;
    let svg = output(args, kind, &series)?;
    let csv = svg.with_extension("csv");
    let files = if args.csv { vec![&csv] } else { vec![&svg, &csv] };
    files.iter().try_for_each(|path| paths::check_writable(path))?;
    let figure = draw(&series, &options(args, kind)).map_err(|e| refuse(&e))?;
    if !args.csv {
        paths::write_whole(&svg, &figure.svg)?;
    }
    paths::write_whole(&csv, figure.table.csv())?;
    if args.json {
        let outcome = Outcome {
            status: "done",
            version: env!("CARGO_PKG_VERSION"),
            kind: kind.name(),
            series: series.iter().map(Series::name).collect(),
            svg: (!args.csv).then(|| svg.display().to_string()),
            csv: csv.display().to_string(),
        };
        let text = serde_json::to_string(&outcome)
            .map_err(|e| Failure::input(format!("the result is no JSON: {e}; please report this")))?;
        console::print(text)?;
    } else if !args.quiet {
        let names: Vec<String> = files.iter().map(|f| f.display().to_string()).collect();
        console::log(format!("wrote {}", names.join(" and ")));
    }
    Ok(DONE)
}

fn refuse(e: &PlotError) -> Failure {
    Failure::usages(e.faults.iter().map(|f| Remark::plain(f.to_string())).collect())
}

fn kind(name: String) -> Kind {
    Kind::ALL.into_iter().find(|k| k.name() == name).unwrap_or(Kind::Polar)
}

fn options(args: &PlotArgs, kind: Kind) -> Options {
    Options {
        kind,
        quantity: match args.quantity {
            QuantityName::F => Quantity::F,
            QuantityName::FCos => Quantity::FCos,
            QuantityName::Pdf => Quantity::Pdf,
        },
        log: args.log,
        normalize: args.normalize,
        size: [args.width, args.height].map(|v| v.map(f64::from)),
        dark: args.dark,
        title: args.title.clone(),
        over: args.over.clone(),
        samples: args.samples as usize,
        seed: args.seed,
    }
}

/// Name of the picture: as given, else models and kind in the current folder.
fn output<K: Family>(args: &PlotArgs, kind: Kind, series: &[Series<K>]) -> Result<PathBuf, Failure> {
    let Some(path) = &args.output else {
        let mut models: Vec<&str> = series.iter().map(|s| s.kind.name()).collect();
        models.dedup();
        return Ok(PathBuf::from(format!("{}-{}.svg", models.join("-"), kind.name())));
    };
    let known = |e: &std::ffi::OsStr| e.eq_ignore_ascii_case("svg") || e.eq_ignore_ascii_case("csv");
    let wrong = |what: &str| Err(Failure::usage(format!("{}: {what}", path.display())));
    let folder = path.as_os_str().as_encoded_bytes().last().is_some_and(|c| matches!(c, b'/' | b'\\'));
    match path.extension() {
        _ if folder || path.file_name().is_none() => wrong("this names a folder; add a file name"),
        Some(e) if known(e) => Ok(path.with_extension("svg")),
        Some(_) => wrong("plots are written as .svg and .csv; end the name in one of them"),
        None => Ok(Path::new(path).with_extension("svg")),
    }
}
