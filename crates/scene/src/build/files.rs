//! Files: the scene's own, and those it names.

use std::path::{Path, PathBuf};

use super::Builder;
use crate::diagnostic::{Diagnostic, Span};
use crate::parser::Parser;
use crate::source::{read_bytes, reason};

/// Deeper nesting of files is taken for a mistake.
const MAX_DEPTH: usize = 64;
/// More files than this are taken for a mistake: a file that includes another twice, and so on, grows without bound.
const MAX_INCLUDES: usize = 100_000;

impl Builder {
    /// Reads the main scene file.
    pub(crate) fn read_main(&mut self, path: &Path, materials: &[String]) {
        let file = self.report.add_file(path.to_path_buf());
        materials.iter().for_each(|text| self.replace_material(text));
        let whole = Span { file, ..Span::default() };
        match read_bytes(path) {
            Ok(bytes) => {
                self.open_files.push(true_path(path));
                self.read_text(&bytes, file);
            }
            Err(e) => {
                let message = format!("the scene cannot be read, {}; check the path", reason(&e));
                self.report.error(whole, message);
            }
        }
    }

    /// Reads a text as the main scene file.
    pub(crate) fn read_main_text(&mut self, text: &[u8], name: &str) {
        let file = self.report.add_file(PathBuf::from(name));
        self.open_files.push(true_path(Path::new(name)));
        self.read_text(text, file);
    }

    /// Reads all statements of a text.
    fn read_text(&mut self, text: &[u8], file: u32) {
        if text.starts_with(b"\xfe\xff") || text.starts_with(b"\xff\xfe") {
            let whole = Span { file, ..Span::default() };
            self.report.error(whole, "the file is UTF-16; save it as UTF-8");
            return;
        }
        let mut parser = Parser::new(text, file);
        loop {
            match parser.directive() {
                Ok(Some((directive, at))) => {
                    if let Err(fault) = self.statement(&mut parser, directive, at) {
                        self.report.push(fault);
                        parser.recover();
                    }
                }
                Ok(None) => return,
                Err(fault) => self.report.push(fault),
            }
        }
    }

    /// Reads `Include` or `Import`; false where it is another statement.
    pub(super) fn file_statement(
        &mut self,
        parser: &mut Parser<'_>,
        directive: &'static str,
    ) -> Result<bool, Diagnostic> {
        match directive {
            "Include" => {
                let (name, at) = parser.text()?;
                self.include(&name, at);
            }
            "Import" => {
                let (name, at) = parser.text()?;
                // An imported file sees the state here, and leaves it as it was.
                let (saved, n_open) = (self.graphics.clone(), self.n_open());
                self.include(&name, at);
                self.close_all(n_open);
                self.graphics = saved;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn include(&mut self, name: &str, at: Span) {
        let path = self.resolve(name);
        let identity = true_path(&path);
        self.n_includes += 1;
        if let Some(i) = self.open_files.iter().position(|f| *f == identity) {
            let short = |p: &PathBuf| p.file_name().unwrap_or(p.as_os_str()).to_string_lossy().into_owned();
            let mut chain: Vec<String> = self.open_files[i..].iter().map(short).collect();
            chain.push(short(&identity));
            self.report
                .error(at, format!("the file includes itself: {}; remove one of these", chain.join(" -> ")));
            return;
        }
        if self.open_files.len() >= MAX_DEPTH {
            self.report.error(at, format!("files are nested more than {MAX_DEPTH} deep; join some of them"));
            return;
        }
        if self.n_includes > MAX_INCLUDES {
            if self.n_includes == MAX_INCLUDES + 1 {
                self.report
                    .error(at, format!("more than {MAX_INCLUDES} files are included; join some of them"));
            }
            return;
        }
        match read_bytes(&path) {
            Ok(bytes) => {
                let file = self.report.add_file(path);
                self.open_files.push(identity);
                self.read_text(&bytes, file);
                self.open_files.pop();
            }
            Err(e) => {
                let message = format!("\"{name}\" cannot be read, {}; {}", reason(&e), self.looked_at(&path));
                self.report.error(at, message);
            }
        }
    }

    /// The path of a file the scene names; relative paths start at the main scene file's folder, as in pbrt-v4.
    pub(super) fn resolve(&self, name: &str) -> PathBuf {
        self.base_dir.join(name)
    }

    /// The path of a file that must be there; `None`, and a fault, where it is not.
    pub(super) fn existing(&mut self, name: &str, at: Span) -> Option<PathBuf> {
        let path = self.resolve(name);
        let problem = match std::fs::metadata(&path) {
            Ok(m) if m.is_dir() => "it is a folder".to_string(),
            Ok(_) => return Some(path),
            Err(e) => reason(&e),
        };
        let message = format!("\"{name}\" cannot be read, {problem}; {}", self.looked_at(&path));
        self.report.error(at, message);
        None
    }

    /// What to do about a missing file.
    fn looked_at(&self, path: &Path) -> String {
        format!("looked for {}; paths start at the scene file's folder", path.display())
    }
}

/// The path without links and `..`, where the file exists; it tells whether two names are one file.
fn true_path(path: &Path) -> PathBuf {
    std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf())
}
