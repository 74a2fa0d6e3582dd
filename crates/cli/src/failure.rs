//! Why a verb could not do its work: [`Failure`].

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde::Serialize;
use sparrow_scene::{Diagnostic, SceneError, Severity};

use crate::console;

/// Exit code where all went well.
pub(crate) const DONE: u8 = 0;
/// Exit code where the user's input was wrong.
pub(crate) const INPUT: u8 = 1;
/// Exit code where the command line was wrong.
pub(crate) const USAGE: u8 = 2;
/// Exit code after Ctrl-C.
pub(crate) const INTERRUPTED: u8 = 130;

/// A sentence about the input, with its place where it has one.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct Remark {
    /// File; none where the command line or the machine is meant.
    pub(crate) file: Option<String>,
    /// Line, from 1.
    pub(crate) line: Option<u32>,
    /// Column in characters, from 1.
    pub(crate) column: Option<u32>,
    /// What is wrong; what to do.
    pub(crate) message: String,
    /// As a person reads it: `file:line:column: message`.
    pub(crate) text: String,
}

impl Remark {
    /// About a place in a scene file.
    pub(crate) fn of(d: &Diagnostic, files: &[PathBuf]) -> Remark {
        let known = d.at.line > 0;
        Remark {
            file: files.get(d.at.file as usize).map(|f| f.display().to_string()),
            line: known.then_some(d.at.line),
            column: known.then_some(d.at.column),
            message: d.message.clone(),
            text: d.display(files).to_string(),
        }
    }
    /// About nothing that has lines.
    pub(crate) fn plain(message: impl Into<String>) -> Remark {
        let message = message.into();
        Remark { text: message.clone(), message, ..Remark::default() }
    }
    /// About a file as a whole.
    pub(crate) fn in_file(file: &Path, message: &str) -> Remark {
        let file = file.display().to_string();
        Remark {
            text: format!("{file}: {message}"),
            file: Some(file),
            message: message.to_owned(),
            ..Remark::default()
        }
    }
}

/// The outcome of a verb that could not do its work.
#[derive(Debug)]
pub(crate) struct Failure {
    code: u8,
    errors: Vec<Remark>,
    warnings: Vec<Remark>,
    /// The warnings are in the log already.
    told: bool,
}

#[derive(Serialize)]
struct JsonFailure<'a> {
    status: &'static str,
    exit_code: u8,
    version: &'static str,
    errors: &'a [Remark],
    warnings: &'a [Remark],
}

impl Failure {
    /// The user's input was wrong.
    pub(crate) fn input(message: impl Into<String>) -> Failure {
        Failure::plain(INPUT, message)
    }
    /// The command line was wrong.
    pub(crate) fn usage(message: impl Into<String>) -> Failure {
        Failure::plain(USAGE, message)
    }
    /// Several things of the command line were wrong.
    pub(crate) fn usages(errors: Vec<Remark>) -> Failure {
        Failure { code: USAGE, errors, warnings: Vec::new(), told: true }
    }
    /// Several things of the user's input were wrong.
    pub(crate) fn inputs(errors: Vec<Remark>) -> Failure {
        Failure { code: INPUT, errors, warnings: Vec::new(), told: true }
    }
    /// It ended before anything was there to be saved.
    pub(crate) fn interrupted(message: &str) -> Failure {
        Failure::plain(INTERRUPTED, message)
    }
    fn plain(code: u8, message: impl Into<String>) -> Failure {
        Failure { code, errors: vec![Remark::plain(message)], warnings: Vec::new(), told: true }
    }
    /// The scene file was wrong.
    pub(crate) fn scene(e: &SceneError) -> Failure {
        let remarks = |list: &[Diagnostic]| list.iter().map(|d| Remark::of(d, &e.files)).collect();
        Failure { code: INPUT, errors: remarks(&e.faults), warnings: remarks(&e.warnings), told: false }
    }
    /// The scene was read and its warnings told, but it cannot be rendered.
    pub(crate) fn in_scene(mut errors: Vec<Remark>, warnings: Vec<Remark>) -> Failure {
        // The same image, used twice, is broken once.
        errors.dedup_by(|a, b| a.text == b.text);
        Failure { code: INPUT, errors, warnings, told: true }
    }

    /// Tells the user, and gives the exit code.
    pub(crate) fn report(&self, json: bool, quiet: bool) -> ExitCode {
        let told = self.told || quiet;
        for remark in self.warnings.iter().filter(|_| !told).chain(&self.errors) {
            console::log(&remark.text);
        }
        if json {
            self.print_json();
        }
        ExitCode::from(self.code)
    }

    /// The same for machines.
    pub(crate) fn print_json(&self) {
        let object = JsonFailure {
            status: if self.code == INTERRUPTED { "interrupted" } else { "error" },
            exit_code: self.code,
            version: env!("CARGO_PKG_VERSION"),
            errors: &self.errors,
            warnings: &self.warnings,
        };
        if let Ok(text) = serde_json::to_string(&object) {
            // There is nobody left to tell that this failed too.
            let _ = console::print(text);
        }
    }
}

/// What is only a warning, with places.
pub(crate) fn warnings(list: &[Diagnostic], files: &[PathBuf]) -> Vec<Remark> {
    list.iter().filter(|d| d.severity == Severity::Warning).map(|d| Remark::of(d, files)).collect()
}
