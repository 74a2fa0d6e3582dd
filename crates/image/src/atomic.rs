//! Files appear whole or not at all.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::ImageError;

/// Writes `bytes` under a temporary name beside `path`, then renames.
///
/// A reader sees the old file or the new one. On an error the temporary file is removed and what was there
/// before stays.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), ImageError> {
    write_beside(path, bytes).map_err(|source| ImageError::Io {
        path: path.to_path_buf(),
        action: "written",
        source,
    })
}

fn write_beside(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let (temporary, mut file) = create_temporary(path)?;
    // The data must be on the disk before the name is, or a power failure leaves an empty file.
    let done = file.write_all(bytes).and_then(|()| file.sync_all());
    drop(file);
    let done = done.and_then(|()| fs::rename(&temporary, path));
    if done.is_err() {
        // The first error is the one worth telling.
        let _ = fs::remove_file(&temporary);
    }
    done
}

/// A new file `.NAME.PID-N.tmp` in the folder of `path`.
fn create_temporary(path: &Path) -> io::Result<(PathBuf, File)> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let name = path.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "no file name"))?;
    loop {
        let n = COUNT.fetch_add(1, Ordering::Relaxed);
        let mut temporary = OsString::from(".");
        temporary.push(name);
        temporary.push(format!(".{}-{n}.tmp", process::id()));
        let temporary = path.with_file_name(temporary);
        match OpenOptions::new().write(true).create_new(true).open(&temporary) {
            Ok(file) => return Ok((temporary, file)),
            // Left behind by a process that was killed and had our id.
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
            Err(e) => return Err(e),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_leaves_nothing_behind() {
        let dir = std::env::temp_dir().join(format!("sparrow-image-atomic-{}", process::id()));
        let taken = dir.join("taken.exr");
        fs::create_dir_all(taken.join("inside")).unwrap();
        let e = write(&taken, b"x").unwrap_err();
        assert!(e.to_string().contains("taken.exr: cannot be written"), "{e}");
        let left: Vec<_> = fs::read_dir(&dir).unwrap().map(|f| f.unwrap().file_name()).collect();
        assert_eq!(left, ["taken.exr"]);
        let plain = dir.join("plain");
        write(&plain, b"old").unwrap();
        write(&plain, b"new").unwrap();
        assert_eq!(fs::read(&plain).unwrap(), b"new");
        assert!(write(&dir.join("missing/x.exr"), b"x").is_err());
        assert!(write(Path::new(".."), b"x").is_err());
        fs::remove_dir_all(&dir).unwrap();
    }
}
