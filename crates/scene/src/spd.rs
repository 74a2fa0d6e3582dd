//! Spectra in `.spd` files: [`read`].
//!
//! Pairs of wavelength in nanometres and value, separated by blanks; `#` begins a comment that ends with the
//! line. This is pbrt-v4's format.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A spectrum file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SpdError {
    /// The file system refused.
    #[error("{}: cannot be read: {source}; check the path and the permissions", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The text is no spectrum.
    #[error("{}:{line}: {fault}; {remedy}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// What is wrong.
        fault: String,
        /// What to do.
        remedy: &'static str,
    },
}

/// Reads pairs of wavelength in nanometres and value, in ascending order of wavelength.
///
/// # Errors
/// [`SpdError`] names the file, the line, the fault and a remedy.
pub fn read(path: &Path) -> Result<Vec<(f32, f32)>, SpdError> {
    let bytes = fs::read(path).map_err(|source| SpdError::Io { path: path.to_path_buf(), source })?;
    parse(&String::from_utf8_lossy(&bytes), path)
}

/// Like [`read`], for the contents of a file; `path` serves the messages.
///
/// # Errors
/// As [`read`].
pub fn parse(text: &str, path: &Path) -> Result<Vec<(f32, f32)>, SpdError> {
    let damaged = |line: usize, fault: String, remedy| SpdError::Damaged {
        path: path.to_path_buf(),
        line,
        fault,
        remedy,
    };
    let mut pairs: Vec<(f32, f32)> = Vec::new();
    let mut lambda: Option<(f32, usize)> = None;
    let words = text.lines().enumerate().flat_map(|(i, line)| {
        let data = line.split('#').next().unwrap_or_default();
        data.split_whitespace().map(move |word| (word, i + 1))
    });
    for (word, line) in words {
        let value = word.parse().ok().filter(|v: &f32| v.is_finite()).ok_or_else(|| {
            let fault = format!("`{}` is no finite number", word.escape_debug());
            damaged(line, fault, "write a wavelength in nm and a value on each line, comments after `#`")
        })?;
        let Some((at, _)) = lambda.take() else {
            let last = pairs.last().map(|p| p.0);
            if let Some(last) = last.filter(|last| *last >= value) {
                let fault = format!("wavelength {value} follows {last}");
                return Err(damaged(line, fault, "sort the lines by wavelength and keep each only once"));
            }
            lambda = Some((value, line));
            continue;
        };
        pairs.push((at, value));
    }
    match lambda {
        Some((at, line)) => Err(damaged(
            line,
            format!("wavelength {at} has no value"),
            "write a value behind each wavelength",
        )),
        None if pairs.is_empty() => Err(damaged(
            1,
            "there is no value".to_owned(),
            "write a wavelength in nm and a value on each line",
        )),
        None => Ok(pairs),
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn given(text: &str) -> Result<Vec<(f32, f32)>, SpdError> {
        parse(text, Path::new("a.spd"))
    }

    #[test]
    fn pairs_comments_and_blanks() {
        let want = [(300.0, 1.5), (400.0, -2.0), (830.5, 1e-3)];
        assert_eq!(given("# sunlight\n300 1.5 # first\n\n\t400\t-2\r\n830.5 1e-3").unwrap(), want);
        assert_eq!(given("300 1.5 400\n-2 830.5 1e-3").unwrap(), want, "line ends are blanks, as in pbrt");
    }

    #[test]
    fn faults_are_named_with_their_line() {
        let cases = [
            ("", "a.spd:1: there is no value"),
            ("# nothing\n\n", "a.spd:1: there is no value"),
            ("300 1\n400", "a.spd:2: wavelength 400 has no value"),
            ("300 1\n\n300 2", "a.spd:3: wavelength 300 follows 300"),
            ("300 1\n299 2", "a.spd:2: wavelength 299 follows 300"),
            ("300, 1", "a.spd:1: `300,` is no finite number"),
            ("300 nan", "a.spd:1: `nan` is no finite number"),
            ("300 1e99", "a.spd:1: `1e99` is no finite number"),
        ];
        for (text, want) in cases {
            let e = given(text).unwrap_err().to_string();
            assert!(e.starts_with(want) && e.contains("; "), "{text:?}: {e}");
        }
        let e = read(Path::new("no/such.spd")).unwrap_err().to_string();
        assert!(e.starts_with("no/such.spd: cannot be read"), "{e}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(500) })]
        #[test]
        fn any_text_is_read_or_refused(text in "[0-9 .#\\n\\-e]{0,80}|\\PC{0,40}") {
            if let Ok(pairs) = given(&text) {
                prop_assert!(pairs.is_sorted_by(|a, b| a.0 < b.0) && !pairs.is_empty());
            }
        }
    }
}
