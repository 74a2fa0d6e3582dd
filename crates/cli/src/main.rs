//! The `sparrow` command: reads the command line, runs a verb, turns its outcome into an exit code.
//!
//! | code | means |
//! | --- | --- |
//! | 0 | done |
//! | 1 | the user's input was wrong: a scene, a file, a folder; a model did not stand its trial; or two pictures differ more than they may |
//! | 2 | the command line was wrong |
//! | 130 | interrupted; what was rendered so far is saved |

mod adaptive;
mod args;
mod compare_cmd;
mod console;
mod failure;
mod fibre_cmd;
mod fibre_plot;
mod groom_cmd;
mod images;
mod info_cmd;
mod interrupt;
mod inventory;
mod lecture_cmd;
mod models_cmd;
mod names;
mod output;
mod overrides;
mod paths;
mod plot_cmd;
mod process;
mod progress;
mod race_cmd;
mod render_cmd;
mod report;
mod strategies;
mod verify_cmd;

use std::ffi::OsStr;
use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use crate::args::{Cli, Verb};
use crate::failure::{Failure, USAGE};

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(e) => return answer(&e),
    };
    let (json, quiet, done) = match &cli.verb {
        Some(Verb::Render(a)) => (a.json, a.quiet, render_cmd::run(a)),
        Some(Verb::Info(a)) => (a.json, false, info_cmd::run(a)),
        Some(Verb::Compare(a)) => (a.json, a.quiet, compare_cmd::run(a)),
        Some(Verb::Race(a)) => (a.json, a.quiet, race_cmd::run(a)),
        Some(Verb::Plot(a)) => (a.json, a.quiet, plot_cmd::run(a)),
        Some(Verb::Models(a)) => (a.json, false, models_cmd::run(a)),
        Some(Verb::Verify(a)) => (a.json, false, verify_cmd::run(a)),
        Some(Verb::Groom(a)) => (a.json, a.quiet, groom_cmd::run(a)),
        Some(Verb::Lecture(a)) => (a.json, a.quiet, lecture_cmd::run(a)),
        None => {
            // A broken pipe is no reason to complain about the help that nobody reads.
            let _ = Cli::command().print_help();
            return ExitCode::from(USAGE);
        }
    };
    match done {
        Ok(code) => ExitCode::from(code),
        Err(failure) => failure.report(json, quiet),
    }
}

/// Help and version go to standard output and are no errors; faults of the command line end with 2.
fn answer(e: &clap::Error) -> ExitCode {
    let _ = e.print();
    if !e.use_stderr() {
        return ExitCode::SUCCESS;
    }
    if std::env::args_os().any(|a| a == OsStr::new("--json")) {
        let text = e.render().to_string();
        let first = text.lines().next().unwrap_or_default();
        Failure::usage(first.trim_start_matches("error: ")).print_json();
    }
    ExitCode::from(USAGE)
}
