//! Lines on standard output and standard error. Neither may end the program: a pipe can break at any time.

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};

use crate::failure::Failure;

/// One line, or several, for people; lost where nobody listens.
pub(crate) fn log(line: impl Display) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// The result, for standard output. A reader that has gone away is content with what it got.
///
/// # Errors
/// Where standard output cannot take it, such as on a full disk.
pub(crate) fn print(text: impl Display) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::input(format!("standard output cannot be written: {e}; free some space")))
        }
        _ => Ok(()),
    }
}
