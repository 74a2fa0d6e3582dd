//! What can go wrong with an image: [`ImageError`].

use std::io;
use std::path::{Path, PathBuf};

/// An image that cannot be read, written or used as asked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImageError {
    /// The file system refused.
    #[error("{}: cannot be {action}: {source}; check the path, the permissions and the free space", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// `read` or `written`.
        action: &'static str,
        /// What the system said.
        source: io::Error,
    },
    /// The file contradicts its own format, or ends too early.
    #[error("{}: {fault}; {remedy}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong, with the place where it is known.
        fault: String,
        /// What to do.
        remedy: &'static str,
    },
    /// The file may be sound, but this reader or writer does not know the format or the feature.
    #[error("{}: {fault}; {remedy}", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// What is not known.
        fault: String,
        /// What to do.
        remedy: &'static str,
    },
    /// Sizes, names or numbers handed over by the caller do not fit together.
    #[error("{0}")]
    Mismatch(String),
}

/// A fault found by a decoder that was given bytes and does not know the file's name.
#[derive(Debug)]
pub(crate) struct Fault {
    unsupported: bool,
    what: String,
    remedy: &'static str,
}

impl Fault {
    /// The bytes contradict the format.
    pub(crate) fn damaged(what: impl Into<String>) -> Fault {
        Fault { unsupported: false, what: what.into(), remedy: "write the file again or fetch a fresh copy" }
    }
    /// The bytes may be sound but are not understood.
    pub(crate) fn unsupported(what: impl Into<String>, remedy: &'static str) -> Fault {
        Fault { unsupported: true, what: what.into(), remedy }
    }
    /// The error for the user, who knows the file by its path.
    pub(crate) fn at(self, path: &Path) -> ImageError {
        let Fault { unsupported, what: fault, remedy } = self;
        let path = path.to_path_buf();
        if unsupported {
            ImageError::Unsupported { path, fault, remedy }
        } else {
            ImageError::Damaged { path, fault, remedy }
        }
    }
}

/// Bytes a decoded image of a file this long may take.
///
/// A header of a few bytes can claim any size. The densest coding in use, deflate, reaches about 1030 to 1
/// and half floats stored as float double that; whatever claims more cannot be filled by the file.
pub(crate) fn allowed_bytes(file_len: usize) -> u64 {
    (64u64 << 20).saturating_add((file_len as u64).saturating_mul(2100))
}

/// Refuses dimensions that are empty, overflow or cannot be filled by a file of `file_len` bytes.
pub(crate) fn check_size(
    width: u64,
    height: u64,
    pixel_bytes: u64,
    file_len: usize,
) -> Result<(usize, usize), Fault> {
    if width == 0 || height == 0 {
        return Err(Fault::damaged(format!("the header says {width} x {height} pixels, which is empty")));
    }
    let bytes = width.checked_mul(height).and_then(|n| n.checked_mul(pixel_bytes.max(1)));
    match (bytes, usize::try_from(width), usize::try_from(height)) {
        (Some(bytes), Ok(w), Ok(h)) if bytes <= allowed_bytes(file_len) && isize::try_from(bytes).is_ok() => {
            Ok((w, h))
        }
        _ => Err(Fault::damaged(format!(
            "the header says {width} x {height} pixels, far more than the file's {file_len} bytes can hold"
        ))),
    }
}
