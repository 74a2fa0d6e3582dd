//! Rules of the repository that neither compiler nor linter knows.

mod arrows;
mod citations;
mod licences;
mod paths;
mod sizes;

use std::fs;
use std::path::{Path, PathBuf};

/// What a check found. Faults fail it, notes do not.
#[derive(Debug, Default)]
struct Findings {
    faults: Vec<String>,
    notes: Vec<String>,
}

impl Findings {
    fn fault(&mut self, what: impl Into<String>) {
        self.faults.push(what.into());
    }
    fn note(&mut self, what: impl Into<String>) {
        self.notes.push(what.into());
    }
}

/// A text file of the repository.
struct Source {
    /// Relative to the root, with forward slashes.
    path: String,
    text: String,
}

type Check = fn(&Path, &[Source], &mut Findings) -> Result<(), String>;

/// Every check, with what it makes sure of.
const CHECKS: [(&str, Check); 6] = [
    ("crates use only what the crate arrows allow", arrows::check),
    ("citations stand in docs/references.bib", citations::check),
    ("licences of dependencies are on the list", licences::check),
    ("no paths of one machine, no dead links", paths::check),
    ("the path loop fits on a page", sizes::path_loop),
    ("files are short", sizes::files),
];

/// Runs all checks on the repository at `root`.
///
/// # Errors
/// The report, where a check found a fault or could not be made.
pub fn run(root: &Path) -> Result<String, String> {
    let sources = sources(root)?;
    let (mut report, mut failed) = (String::new(), false);
    for (name, check) in CHECKS {
        let mut found = Findings::default();
        if let Err(e) = check(root, &sources, &mut found) {
            found.fault(e);
        }
        failed |= !found.faults.is_empty();
        report += if found.faults.is_empty() { "ok     " } else { "FAILED " };
        report += name;
        for (mark, lines) in [("fault", &found.faults), ("note", &found.notes)] {
            for line in lines {
                report += &format!("\n       {mark}: {line}");
            }
        }
        report.push('\n');
    }
    let report = report.trim_end().to_owned();
    if failed { Err(report) } else { Ok(report) }
}

/// All text files, in the order of their paths.
fn sources(root: &Path) -> Result<Vec<Source>, String> {
    let mut files = Vec::new();
    walk(root, &mut files)?;
    files.sort();
    let mut sources = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).map_err(|e| format!("{}: {e}", file.display()))?;
        let path = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        sources.push(Source { path, text });
    }
    Ok(sources)
}

fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), String> {
    let fail = |e: std::io::Error| format!("{}: {e}", folder.display());
    for entry in fs::read_dir(folder).map_err(fail)? {
        let path = entry.map_err(fail)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() {
            if name != "target" && name != ".git" {
                walk(&path, files)?;
            }
        } else if is_text(&path) || name == "run" {
            files.push(path);
        }
    }
    Ok(())
}

fn is_text(path: &Path) -> bool {
    let kinds = ["rs", "toml", "md", "pbrt", "py", "txt", "bib", "svg", "html", "js", "sh", "yml"];
    path.extension().is_some_and(|e| kinds.iter().any(|k| e == *k))
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn source(path: &str, text: &str) -> Source {
        Source { path: path.to_owned(), text: text.to_owned() }
    }

    #[test]
    fn finds_this_file() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a package lies in its workspace");
        let all = sources(root).expect("the repository is text");
        let own = all.iter().find(|s| s.path == "xtask/src/check/mod.rs").expect("this file");
        assert!(own.text.contains("fn finds_this_file"));
        assert!(all.iter().all(|s| !s.path.starts_with("target/")));
    }
}
