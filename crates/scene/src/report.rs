//! Where faults and warnings are gathered while a scene is read: [`Report`].

use std::collections::HashMap;
use std::path::PathBuf;

use crate::diagnostic::{Diagnostic, SceneError, Span};

/// More faults than this are counted, not kept: a file in another format has one per line.
const MAX_FAULTS: usize = 100;

/// The faults and warnings of a scene, and the files they point into.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) files: Vec<PathBuf>,
    faults: Vec<Diagnostic>,
    n_more_faults: usize,
    warnings: Vec<Diagnostic>,
    /// How often each warning was given; the value is its index and count.
    seen: HashMap<String, (usize, usize)>,
}

impl Report {
    /// Notes a file and returns its index.
    pub(crate) fn add_file(&mut self, path: PathBuf) -> u32 {
        self.files.push(path);
        self.files.len() as u32 - 1
    }
    /// Notes a fault; `message` says what is wrong and, after a semicolon, what to do.
    pub(crate) fn error(&mut self, at: Span, message: impl Into<String>) {
        if self.faults.len() < MAX_FAULTS {
            self.faults.push(Diagnostic::error(at, message));
        } else {
            self.n_more_faults += 1;
        }
    }
    /// Notes a fault that was found elsewhere.
    pub(crate) fn push(&mut self, fault: Diagnostic) {
        self.error(fault.at, fault.message);
    }
    /// Notes a warning. The same sentence is kept once, with the number of places.
    pub(crate) fn warn(&mut self, at: Span, message: impl Into<String>) {
        let message = message.into();
        if let Some((_, n)) = self.seen.get_mut(&message) {
            *n += 1;
            return;
        }
        self.seen.insert(message.clone(), (self.warnings.len(), 1));
        self.warnings.push(Diagnostic::warning(at, message));
    }
    /// No fault was found so far.
    pub(crate) fn is_clean(&self) -> bool {
        self.faults.is_empty()
    }
    /// A place as text, for messages that name a second one.
    pub(crate) fn place(&self, at: Span) -> String {
        match self.files.get(at.file as usize) {
            Some(file) => format!("{}:{}:{}", file.display(), at.line, at.column),
            None => format!("{}:{}", at.line, at.column),
        }
    }
    /// The warnings in file order, and the files.
    pub(crate) fn into_warnings(mut self) -> (Vec<Diagnostic>, Vec<PathBuf>) {
        let warnings = self.take_warnings();
        (warnings, self.files)
    }
    /// All of it as an error.
    pub(crate) fn into_error(mut self) -> SceneError {
        let warnings = self.take_warnings();
        self.faults.sort_by_key(|d| d.at);
        if let (Some(last), n @ 1..) = (self.faults.last().map(|d| d.at), self.n_more_faults) {
            self.faults.push(Diagnostic::error(last, format!("and {n} more faults; mend these first")));
        }
        SceneError { faults: self.faults, warnings, files: self.files }
    }
    fn take_warnings(&mut self) -> Vec<Diagnostic> {
        for &(i, n) in self.seen.values() {
            if n > 1 {
                self.warnings[i].message.push_str(&format!(" ({n} places, this is the first)"));
            }
        }
        self.seen.clear();
        self.warnings.sort_by_key(|d| d.at);
        std::mem::take(&mut self.warnings)
    }
}
