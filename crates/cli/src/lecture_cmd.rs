//! `sparrow lecture`: the book of live figures.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde::Serialize;
use sparrow_lecture::{Book, LectureError, Quality, SLIDES, Standing, TOPICS};

use crate::failure::{DONE, Failure, INPUT};
use crate::{console, interrupt};

/// Build the lecture as a book of live figures: HTML, SVG, PNG and CSV that open from disk
#[derive(Debug, Args)]
#[command(after_help = "\
The book's first page says how many of the lecture's 29 slides passed their checks; the exit code is 1 where one failed. An older \
book of the same kind in the folder is replaced, anything else is left alone.")]
pub(crate) struct LectureArgs {
    /// Folder of the book, new or an older book [default: lecture, with --only lecture-N]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Make the figures of one slide, by its number, or one figure, by its name [default: all]
    #[arg(long, value_name = "N")]
    only: Option<String>,

    /// How much work goes into figures: `draft` takes two minutes on two cores, `final` up to half an hour
    #[arg(long, value_name = "NAME", default_value = "draft")]
    quality: QualityName,

    /// List slides and figures and make none [default: off]
    #[arg(long)]
    list: bool,

    /// Print nothing but errors [default: off]
    #[arg(long)]
    pub(crate) quiet: bool,

    /// Print one JSON object about the outcome on standard output [default: off]
    #[arg(long)]
    pub(crate) json: bool,
}

/// Names of qualities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum QualityName {
    /// For a look; every check is asked
    Draft,
    /// For reading
    Final,
}

/// A figure, as `--json` lists it.
#[derive(Serialize)]
struct Figure {
    id: &'static str,
    title: &'static str,
    topic: &'static str,
    slides: &'static [u8],
    #[serde(skip_serializing_if = "Option::is_none")]
    passed: Option<bool>,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Outcome<'a> {
    status: &'static str,
    exit_code: u8,
    version: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    output: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    quality: Option<&'static str>,
    slides: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    passed: Option<usize>,
    figures: &'a [Figure],
}

/// Makes the book, and gives the exit code.
///
/// # Errors
/// Where there is no such slide, the folder is not ours, or a figure cannot be made.
pub(crate) fn run(args: &LectureArgs) -> Result<u8, Failure> {
    if args.list {
        return list(args);
    }
    interrupt::install();
    interrupt::rendering_begins();
    let folder = args.output.clone().unwrap_or_else(|| match &args.only {
        Some(name) => PathBuf::from(format!("lecture-{name}")),
        None => PathBuf::from("lecture"),
    });
    let quality = match args.quality {
        QualityName::Draft => Quality::Draft,
        QualityName::Final => Quality::Final,
    };
    let mut tell = |title: &str, i: usize, n: usize| {
        if !args.quiet {
            console::log(format!("{}/{n}  {title}", i + 1));
        }
    };
    let book =
        Book::write(args.only.as_deref(), quality, &folder, interrupt::stop(), &mut tell).map_err(refuse)?;
    let failed = book.failed();
    let code = if failed.is_empty() { DONE } else { INPUT };
    if !args.quiet {
        for made in &failed {
            console::log(format!("failed: {}, {}", made.entry.id, made.entry.title));
        }
        let slides = book.rows().iter().filter(|r| r.standing != Standing::Absent).count();
        let slides = slides - usize::from(args.only.is_some());
        console::log(format!(
            "wrote {}: {} of {slides} slides passed",
            folder.join("index.html").display(),
            book.count(Standing::Passed)
        ));
    }
    if args.json {
        let figure = |m: &sparrow_lecture::Made| Figure {
            id: m.entry.id,
            title: m.entry.title,
            topic: m.topic.id,
            slides: m.entry.rows,
            passed: Some(m.figure.passed()),
        };
        print(&Outcome {
            status: if failed.is_empty() { "done" } else { "failed" },
            exit_code: code,
            version: env!("CARGO_PKG_VERSION"),
            output: Some(folder.display().to_string()),
            quality: Some(quality.name()),
            slides: SLIDES.len(),
            passed: Some(book.count(Standing::Passed)),
            figures: &book.figures.iter().map(figure).collect::<Vec<_>>(),
        })?;
    }
    Ok(code)
}

fn list(args: &LectureArgs) -> Result<u8, Failure> {
    let chosen = sparrow_lecture::select(args.only.as_deref()).map_err(refuse)?;
    if args.json {
        let figure = |(topic, e): &(&'static sparrow_lecture::Topic, &'static sparrow_lecture::Entry)| {
            Figure { id: e.id, title: e.title, topic: topic.id, slides: e.rows, passed: None }
        };
        print(&Outcome {
            status: "done",
            exit_code: DONE,
            version: env!("CARGO_PKG_VERSION"),
            output: None,
            quality: None,
            slides: SLIDES.len(),
            passed: None,
            figures: &chosen.iter().map(figure).collect::<Vec<_>>(),
        })?;
        return Ok(DONE);
    }
    let mut text = String::new();
    for topic in &TOPICS {
        let here: Vec<_> = chosen.iter().filter(|(t, _)| t.id == topic.id).collect();
        if here.is_empty() {
            continue;
        }
        text.push_str(&format!("{}\n", topic.title));
        for (_, e) in here {
            let rows: Vec<String> = e.rows.iter().map(u8::to_string).collect();
            text.push_str(&format!("  {:<10} {:<32} {}\n", rows.join(","), e.id, e.title));
        }
    }
    console::print(text.trim_end())?;
    Ok(DONE)
}

fn print(outcome: &Outcome<'_>) -> Result<(), Failure> {
    let text = serde_json::to_string(outcome)
        .map_err(|e| Failure::input(format!("the result is no JSON: {e}; please report this")))?;
    console::print(text)
}

fn refuse(e: LectureError) -> Failure {
    match e {
        LectureError::Interrupted => Failure::interrupted("interrupted; nothing was written"),
        LectureError::Unknown { .. } => Failure::usage(e.to_string()),
        LectureError::Scene { .. }
        | LectureError::Figure(_)
        | LectureError::Folder { .. }
        | LectureError::File { .. } => Failure::input(e.to_string()),
    }
}
