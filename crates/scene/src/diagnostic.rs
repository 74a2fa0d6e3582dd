//! Places in scene files and what is said about them: [`Span`], [`Diagnostic`], [`SceneError`].

use std::fmt;
use std::path::{Path, PathBuf};

/// A place in a scene file.
///
/// Lines and columns count from 1; columns count characters, not bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// Index into [`SceneDesc::files`](crate::SceneDesc::files) or [`SceneError::files`].
    pub file: u32,
    /// Line; 0 where the whole file is meant.
    pub line: u32,
    /// Column, in characters.
    pub column: u32,
    /// Length of the marked text, in characters.
    pub len: u32,
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The scene renders, but the picture may differ from what the file's author saw.
    Warning,
    /// The scene cannot be rendered.
    Error,
}

/// One remark about a scene file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Where.
    pub at: Span,
    /// How bad.
    pub severity: Severity,
    /// What is wrong; what to do.
    pub message: String,
}

impl Diagnostic {
    /// A fault.
    pub fn error(at: Span, message: impl Into<String>) -> Self {
        Diagnostic { at, severity: Severity::Error, message: message.into() }
    }
    /// A remark that does not keep the scene from rendering.
    pub fn warning(at: Span, message: impl Into<String>) -> Self {
        Diagnostic { at, severity: Severity::Warning, message: message.into() }
    }
    /// Writes itself as `file:line:column: message`, with the names of the files it may point into.
    pub fn display<'a>(&'a self, files: &'a [PathBuf]) -> DisplayDiagnostic<'a> {
        DisplayDiagnostic { diagnostic: self, files }
    }
}

/// A [`Diagnostic`] together with the names of files; see [`Diagnostic::display`].
#[derive(Clone, Copy, Debug)]
pub struct DisplayDiagnostic<'a> {
    diagnostic: &'a Diagnostic,
    files: &'a [PathBuf],
}

impl fmt::Display for DisplayDiagnostic<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = self.diagnostic;
        let file = self.files.get(d.at.file as usize).map_or(Path::new("?"), PathBuf::as_path);
        write!(f, "{}:", file.display())?;
        if d.at.line > 0 {
            write!(f, "{}:{}:", d.at.line, d.at.column)?;
        }
        if d.severity == Severity::Warning {
            f.write_str(" warning:")?;
        }
        write!(f, " {}", d.message)
    }
}

/// Everything that is wrong with a scene, in file order.
///
/// Its text has one line per fault, `file:line:column: what is wrong; what to do`.
#[derive(Clone, Debug)]
pub struct SceneError {
    /// The faults; never empty.
    pub faults: Vec<Diagnostic>,
    /// What was noticed beside them.
    pub warnings: Vec<Diagnostic>,
    /// Every file that was read, the scene file first.
    pub files: Vec<PathBuf>,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, fault) in self.faults.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            fault.display(&self.files).fmt(f)?;
        }
        Ok(())
    }
}

impl std::error::Error for SceneError {}
