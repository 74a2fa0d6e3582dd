//! `sparrow verify --against-fibre`: fibre models held against a fibre that is traced.

use std::fmt::Write;
use std::io::IsTerminal;
use std::time::Instant;

use serde::Serialize;
use sparrow_verify::reference_fibre::{LobeError, ModelError, against};

use crate::args::VerifyArgs;
use crate::failure::{DONE, Failure};
use crate::verify_cmd::cores;
use crate::{console, fibre_plot, paths};

/// What `--json` prints.
#[derive(Serialize)]
struct Outcome<'a> {
    samples: u32,
    seed: u64,
    seconds: f64,
    rows: &'a [ModelError],
}

/// Prints the table.
///
/// # Errors
/// Where it cannot be written.
pub(crate) fn run(args: &VerifyArgs) -> Result<u8, Failure> {
    let threads = args.threads.map_or_else(cores, |n| n as usize);
    let live = std::io::stderr().is_terminal() && !args.json;
    let progress = |done: usize, all: usize| {
        if live {
            eprint!("\r{done} of {all} pieces{}", if done == all { "\r\x1b[K" } else { "" });
        }
    };
    let start = Instant::now();
    let picture = args.plot.as_ref().map(|path| path.with_extension("svg"));
    let files = picture.iter().flat_map(|svg| [svg.clone(), svg.with_extension("csv")]);
    files.clone().try_for_each(|path| paths::check_writable(&path))?;
    let rows = against(args.samples as usize, args.seed, threads, &progress);
    let seconds = start.elapsed().as_secs_f64();
    let figure = fibre_plot::draw(&rows, args.samples);
    for (path, text) in files.zip([figure.svg, figure.table.csv()]) {
        paths::write_whole(&path, text)?;
    }
    if args.json {
        let outcome = Outcome { samples: args.samples, seed: args.seed, seconds, rows: &rows };
        let json = serde_json::to_string(&outcome)
            .map_err(|e| Failure::input(format!("the result is no JSON: {e}; please report this")))?;
        console::print(json)?;
    } else {
        console::print(table(&rows, args.samples, seconds).trim_end())?;
    }
    Ok(DONE)
}

/// One line per model and place: of every lobe the light of the fibre, the model's excess, and what the model misplaces.
fn table(rows: &[ModelError], samples: u32, seconds: f64) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "eta 1.55, no tilt, far field, {samples} rays a place. Per lobe, in percent: light of the fibre +- standard error of it; the\n\
         model's excess over that; share of the lobe in the wrong place (what chance alone would show). `fur` against a fibre with a core.\n"
    );
    let _ = write!(out, "{:<16}{:>5}{:>6}{:>7}", "model", "beta", "theta", "sigma");
    for lobe in ["R", "TT", "TRT", "more"] {
        let _ = write!(out, "  {lobe:<36}");
    }
    let _ = writeln!(out);
    for r in rows {
        let _ = write!(out, "{:<16}{:>5}{:>6}{:>7}", r.model, r.at.beta, r.at.theta_deg, r.sigma_a);
        for lobe in &r.lobes {
            let _ = write!(out, "  {:<36}", cell(lobe));
        }
        let _ = writeln!(out);
    }
    let _ = writeln!(out, "\n{seconds:.1} s");
    out
}

fn cell(e: &LobeError) -> String {
    let whole = e.truth.max(1e-300);
    format!(
        "{:6.3} +- {:.2} %  {:+7.2} {:6.1} ({:.1})",
        100.0 * e.truth,
        100.0 * e.truth_error / whole,
        100.0 * (e.model / whole - 1.0),
        100.0 * e.misplaced,
        100.0 * e.chance
    )
}
