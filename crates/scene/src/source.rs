//! Reading the bytes of scene files, compressed or not.

use std::io::{self, Read};
use std::path::Path;

use flate2::read::MultiGzDecoder;

/// A scene text of more bytes is refused, so that a small compressed file cannot fill the memory.
const MAX_BYTES: u64 = 8 << 30;

/// The bytes of a file, decompressed where it begins as gzip files do.
pub(crate) fn read_bytes(path: &Path) -> io::Result<Vec<u8>> {
    let bytes = std::fs::read(path)?;
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return Ok(bytes);
    }
    let mut text = Vec::new();
    MultiGzDecoder::new(bytes.as_slice()).take(MAX_BYTES + 1).read_to_end(&mut text)?;
    if text.len() as u64 > MAX_BYTES {
        return Err(io::Error::other("it is larger than 8 GiB when decompressed"));
    }
    Ok(text)
}

/// An I/O error in a few words, without the system's error number.
pub(crate) fn reason(e: &io::Error) -> String {
    let known = [
        (io::ErrorKind::NotFound, "there is no such file"),
        (io::ErrorKind::PermissionDenied, "access is denied"),
        (io::ErrorKind::IsADirectory, "it is a folder"),
    ];
    if let Some((_, text)) = known.iter().find(|(kind, _)| *kind == e.kind()) {
        return text.to_string();
    }
    let text = e.to_string();
    text.split(" (os error").next().unwrap_or_default().to_string()
}
