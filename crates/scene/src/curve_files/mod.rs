//! Strands in files: [`read`], [`hair_bytes`].
//!
//! - HAIR, of Cem Yuksel's cyHair (`.hair`, told by its first four bytes), with any choice of arrays;
//! - AMD's TressFX (`.tfx`), guide strands with their thickness, if it is there;
//! - text as Mitsuba reads it: a line `x y z radius` for each point, an empty line between strands.
//!
//! All may be compressed with gzip, told by content. Widths are diameters, in all of Sparrow.
//!
//! Source of the formats: <http://www.cemyuksel.com/research/hairmodels>; TressFX 4.1, `TressFXFileFormat.h`; Mitsuba 3,
//! plugin reference, `bsplinecurve`.

mod bytes;
mod hair;
#[cfg(test)]
mod tests;
mod text;
mod tfx;
mod write;

use std::io;
use std::path::{Path, PathBuf};

use crate::desc::CurveBasis;
use crate::ply::Place;
use crate::source;

pub use write::hair_bytes;

/// Strands as their file has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurveFile {
    /// Control points with widths, `x y z width`; widths that the file does not give are negative.
    pub points: Vec<[f32; 4]>,
    /// The first point of each strand, which ends where the next one begins. All have two points or more.
    pub strands: Vec<u32>,
    /// The basis that the format means.
    pub basis: CurveBasis,
    /// What was read in another way than the file says, one sentence each.
    pub notes: Vec<String>,
}

/// A file of strands that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CurveFileError {
    /// The file system or the decompression refused.
    #[error("{}: cannot be read: {source}; check the path and that the file is whole", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The contents contradict the format or themselves.
    #[error("{}{}: {fault}; {remedy}", path.display(), place.suffix())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Where the fault was seen.
        place: Place,
        /// What is wrong.
        fault: String,
        /// What to do.
        remedy: &'static str,
    },
}

/// A fault, before the file's name is known.
#[derive(Debug)]
struct Fault {
    place: Place,
    fault: String,
    remedy: &'static str,
}

const EXPORT_AGAIN: &str = "export the strands again";

impl Fault {
    fn at_byte(byte: usize, fault: impl Into<String>) -> Fault {
        Fault { place: Place::Byte(byte as u64), fault: fault.into(), remedy: EXPORT_AGAIN }
    }
    fn at_line(line: usize, fault: impl Into<String>) -> Fault {
        Fault { place: Place::Line(line as u64), fault: fault.into(), remedy: EXPORT_AGAIN }
    }
}

/// Reads strands. Those of fewer than two points, or with numbers that are not finite, are left out; `notes` says how
/// many.
///
/// # Errors
/// [`CurveFileError`] names the file, the byte or line, the fault and a remedy.
pub fn read(path: &Path) -> Result<CurveFile, CurveFileError> {
    let bytes =
        source::read_bytes(path).map_err(|source| CurveFileError::Io { path: path.to_path_buf(), source })?;
    read_from(&bytes, path)
}

/// Like [`read`], from the bytes of a file; the name serves the messages and tells TressFX files.
///
/// # Errors
/// As [`read`].
pub fn read_from(bytes: &[u8], path: &Path) -> Result<CurveFile, CurveFileError> {
    let name = path.file_name().map(|n| n.to_string_lossy().to_lowercase()).unwrap_or_default();
    let read = if bytes.starts_with(hair::MAGIC) {
        hair::read(bytes)
    } else if name.ends_with(".tfx") || name.ends_with(".tfx.gz") {
        tfx::read(bytes)
    } else if name.ends_with(".hair") {
        Err(Fault::at_byte(0, "the file does not begin with the letters HAIR"))
    } else {
        text::read(bytes)
    };
    read.map_err(|Fault { place, fault, remedy }| CurveFileError::Damaged {
        path: path.to_path_buf(),
        place,
        fault,
        remedy,
    })
}

/// Takes strand after strand and leaves out what cannot be used.
#[derive(Default)]
struct Gathered {
    file: CurveFile,
    n_short: usize,
    n_not_finite: usize,
}

impl Gathered {
    fn push(&mut self, points: impl ExactSizeIterator<Item = [f32; 4]>) {
        let first = self.file.points.len();
        if points.len() < 2 {
            self.n_short += 1;
            return;
        }
        self.file.points.extend(points);
        if self.file.points[first..].iter().flatten().all(|v| v.is_finite()) {
            self.file.strands.push(first as u32);
        } else {
            self.file.points.truncate(first);
            self.n_not_finite += 1;
        }
    }
    fn finish(mut self, basis: CurveBasis) -> CurveFile {
        self.file.basis = basis;
        let reasons = [
            (self.n_short, "of fewer than two points"),
            (self.n_not_finite, "with numbers that are not finite"),
        ];
        for (n, reason) in reasons {
            if n > 0 {
                let strands = if n == 1 { "1 strand".to_string() } else { format!("{n} strands") };
                self.file.notes.push(format!("{strands} {reason} left out"));
            }
        }
        self.file
    }
}
