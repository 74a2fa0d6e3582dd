//! `sparrow verify`: the trial of models.

use std::fmt::Write;
use std::io::IsTerminal;
use std::time::Instant;

use serde::Serialize;
use sparrow_models::ModelKind;
use sparrow_models::suggest::nearest;
use sparrow_verify::{ColumnName, Options, Pins, Question, Report, Row, Subject, Verdict};

use crate::args::VerifyArgs;
use crate::console;
use crate::failure::{DONE, Failure, INPUT};

/// What `--json` prints.
#[derive(Serialize)]
struct Outcome<'a> {
    status: &'static str,
    version: &'static str,
    samples: usize,
    cases: usize,
    seed: u64,
    seconds: f64,
    models: &'a [Report],
}

/// Tries a model, or all.
///
/// # Errors
/// Where the model or a parameter is unknown, or a value out of range.
pub(crate) fn run(args: &VerifyArgs) -> Result<u8, Failure> {
    if args.against_fibre {
        return crate::fibre_cmd::run(args);
    }
    let kinds = subjects(args)?;
    let pins = match kinds.as_slice() {
        [one] => Pins::parse_for(one, &args.params).map_err(|e| {
            Failure::usage(format!("{}: {e} (see `sparrow models {}`)", one.name(), one.name()))
        })?,
        _ => Pins::default(),
    };
    let threads = args.threads.map_or_else(cores, |n| n as usize);
    let options = Options {
        samples: args.samples as usize,
        cases: args.cases as usize,
        seed: args.seed,
        threads,
        ..Options::default()
    };
    let subjects: Vec<&dyn Subject> = kinds.iter().map(|k| k as &dyn Subject).collect();
    let start = Instant::now();
    let live = std::io::stderr().is_terminal() && !args.json;
    let progress = |done: usize, all: usize| {
        if live {
            eprint!("\r{done} of {all} cases{}", if done == all { "\r\x1b[K" } else { "" });
        }
    };
    let reports = sparrow_verify::verify(&subjects, &pins, &options, &progress);
    let seconds = start.elapsed().as_secs_f64();
    let holds = reports.iter().all(Report::holds);
    if args.json {
        let outcome = Outcome {
            status: if holds { "holds" } else { "fails" },
            version: env!("CARGO_PKG_VERSION"),
            samples: options.samples,
            cases: options.cases,
            seed: options.seed,
            seconds,
            models: &reports,
        };
        let json = serde_json::to_string(&outcome)
            .map_err(|e| Failure::input(format!("the result is no JSON: {e}; please report this")))?;
        console::print(json)?;
    } else {
        let mut text = String::new();
        reports.iter().for_each(|r| table(r, args, &mut text));
        summary(&reports, &options, seconds, &mut text);
        console::print(text.trim_end())?;
    }
    Ok(if holds { DONE } else { INPUT })
}

pub(crate) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn subjects(args: &VerifyArgs) -> Result<Vec<ModelKind>, Failure> {
    match (&args.model, args.all) {
        (None, true) => Ok(ModelKind::all().collect()),
        (Some(name), false) => kind(name).map(|k| vec![k]),
        _ => Err(Failure::usage("name one model, or give --all; `sparrow models` lists them")),
    }
}

/// The model of that name.
///
/// # Errors
/// Where there is none.
pub(crate) fn kind(name: &str) -> Result<ModelKind, Failure> {
    ModelKind::from_name(name).ok_or_else(|| {
        let remedy = match nearest(name, ModelKind::all().map(ModelKind::name)) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => "`sparrow models` lists them".to_owned(),
        };
        Failure::usage(format!("there is no model `{name}`; {remedy}"))
    })
}

fn table(report: &Report, args: &VerifyArgs, out: &mut String) {
    // Writing to a string cannot fail.
    let _ = write!(out, "{:<28}", report.model);
    ColumnName::ALL.iter().for_each(|c| {
        let _ = write!(out, "{:<14}", c.name());
    });
    let _ = writeln!(out);
    for question in Question::ALL {
        let _ = write!(out, "  {:<26}", question.name());
        for row in report.rows.iter().filter(|r| r.question == question) {
            let _ = write!(out, "{:<14}", mark(row));
        }
        let _ = writeln!(out);
    }
    let _ = writeln!(
        out,
        "  largest weight {:.3}, least effective samples {:.1} %",
        report.largest_weight,
        100.0 * report.least_efficiency
    );
    for question in Question::ALL {
        let rows = || report.rows.iter().filter(|r| r.question == question);
        rows().filter(|r| r.verdict == Verdict::Fail).for_each(|row| detail(row, args, out));
        // Of what is as it ought to be, or known, the worst column will do; among many models that is left out.
        let rest = rows().filter(|r| r.verdict != Verdict::Fail);
        let worst = rest.max_by(|a, b| a.severity.total_cmp(&b.severity));
        if let Some(row) = worst.filter(|r| matches!(r.verdict, Verdict::Known(_)) || !args.all) {
            detail(row, args, out);
        }
    }
    for claim in report.claims.iter().filter(|c| c.cases > 0 && c.found == 0) {
        let _ = writeln!(
            out,
            "  said to lack {} ({}), not found in {} cases",
            claim.property, claim.reason, claim.cases
        );
    }
    let _ = writeln!(out);
}

/// The verdict, and how far the worst case went in units of what is allowed.
fn mark(row: &Row) -> String {
    let severity = if row.severity < 100.0 {
        format!("{:.2}", row.severity)
    } else if row.severity < 1e9 {
        format!("{:.0e}", row.severity)
    } else {
        String::new()
    };
    match row.verdict {
        Verdict::Pass => format!("pass {severity}"),
        Verdict::Fail => format!("FAIL {severity}"),
        Verdict::Known(_) => format!("known {severity}"),
        Verdict::NotAsked => "-".to_owned(),
    }
}

fn detail(row: &Row, args: &VerifyArgs, out: &mut String) {
    if row.measured.is_empty() {
        return;
    }
    let (question, column) = (row.question.name(), row.column.name());
    let _ = match &row.verdict {
        Verdict::Fail => writeln!(out, "  FAIL {question} in {column}: {}", row.question.sentence()),
        Verdict::Known(why) => writeln!(out, "  known {question} in {column}: {why}"),
        Verdict::Pass | Verdict::NotAsked => writeln!(out, "  {question} in {column}"),
    };
    let seed = if args.seed == 0 { String::new() } else { format!(" --seed {}", args.seed) };
    let _ = writeln!(out, "    {}", row.measured);
    let _ = writeln!(out, "    sparrow verify {} --samples {}{seed}", row.reproduce, args.samples);
}

fn summary(reports: &[Report], options: &Options, seconds: f64, out: &mut String) {
    let count = |want: fn(&Verdict) -> bool| {
        reports.iter().flat_map(|r| &r.rows).filter(|r| want(&r.verdict)).count()
    };
    let (pass, fail) = (count(|v| *v == Verdict::Pass), count(|v| *v == Verdict::Fail));
    let known = count(|v| matches!(v, Verdict::Known(_)));
    let _ = writeln!(
        out,
        "{} {}: {pass} pass, {fail} fail, {known} known; {} samples a case, seed {}, {seconds:.1} s on {} threads",
        reports.len(),
        if reports.len() == 1 { "model" } else { "models" },
        options.samples,
        options.seed,
        options.threads
    );
    let wrong: Vec<&str> = reports.iter().filter(|r| !r.holds()).map(|r| r.model).collect();
    if !wrong.is_empty() {
        let _ = writeln!(out, "not as it ought to be: {}", wrong.join(", "));
    }
}
