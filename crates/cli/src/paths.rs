//! Where the results go, and the checks that they can go there, before any time is spent.

use std::fs::{self, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::process;

use crate::failure::Failure;
use crate::interrupt;

/// The two files of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Outputs {
    /// The picture.
    pub(crate) exr: PathBuf,
    /// The picture to look at.
    pub(crate) png: PathBuf,
}

impl Outputs {
    /// As the user named it; else the name in the scene's film, else the scene's own, in the current folder.
    ///
    /// Folders in the film's name are dropped: only the user says where files are written.
    pub(crate) fn new(named: Option<&Path>, film: Option<&Path>, scene: &Path) -> Outputs {
        let own = |p: &Path| p.file_stem().map(|stem| PathBuf::from(stem).into_os_string());
        let exr = match named {
            Some(path) => path.to_path_buf(),
            None => {
                let mut name = film.and_then(own).or_else(|| own(scene)).unwrap_or_else(|| "render".into());
                name.push(".exr");
                PathBuf::from(name)
            }
        };
        Outputs { png: exr.with_extension("png"), exr }
    }
}

/// Sees to it that `path` can be written: its folder is there and takes files, and it is no folder itself.
///
/// Only trying tells whether a folder takes files, so one is made and removed.
///
/// # Errors
/// What is in the way, and what to do.
pub(crate) fn check_writable(path: &Path) -> Result<(), Failure> {
    let fail = |what: String| Err(Failure::input(format!("{}: {what}", path.display())));
    let Some(name) = path.file_name() else {
        return fail("this names a folder; add a file name".to_owned());
    };
    if is_special(path) {
        return Ok(());
    }
    if path.is_dir() {
        return fail("there is a folder of that name; choose another name".to_owned());
    }
    let folder = folder_of(path);
    if !folder.is_dir() {
        return fail(format!("there is no folder `{}`; create it first", folder.display()));
    }
    let mut probe = std::ffi::OsString::from(".");
    probe.push(name);
    probe.push(format!(".{}.tmp", process::id()));
    let probe = folder.join(probe);
    let _files = interrupt::hold_files();
    let made = OpenOptions::new().write(true).create_new(true).open(&probe);
    match made.and_then(|_| fs::remove_file(&probe)) {
        Ok(()) => Ok(()),
        Err(e) if e.kind() == io::ErrorKind::AlreadyExists => Ok(()),
        Err(e) => fail(format!(
            "the folder `{}` takes no files: {e}; choose another with -o or change its permissions",
            folder.display()
        )),
    }
}

/// Sees to it that no input is overwritten.
///
/// # Errors
/// Where `output` is one of `inputs`.
pub(crate) fn check_no_input<'a>(
    output: &Path,
    inputs: impl IntoIterator<Item = &'a Path>,
) -> Result<(), Failure> {
    if !is_one_of(output, inputs) {
        return Ok(());
    }
    Err(Failure::input(format!(
        "{}: the scene itself reads this file; name another with -o",
        output.display()
    )))
}

/// `output` is there and is one of `inputs`, by whatever path.
pub(crate) fn is_one_of<'a>(output: &Path, inputs: impl IntoIterator<Item = &'a Path>) -> bool {
    let Ok(output) = output.canonicalize() else { return false };
    inputs.into_iter().any(|i| i.canonicalize().is_ok_and(|i| i == output))
}

/// A device or a pipe, such as `/dev/null`: written to, never replaced.
fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir())
}

/// The folder that a file lies in.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes a file whole or not at all: under a temporary name, then renamed.
///
/// # Errors
/// Where the system refuses; then nothing is left behind.
pub(crate) fn write_whole(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.tmp", process::id()));
    let temporary = path.with_file_name(name);
    let _files = interrupt::hold_files();
    let done = if is_special(path) {
        fs::write(path, bytes)
    } else {
        fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, path))
    };
    done.map_err(|e| {
        // The first error is the one worth telling.
        let _ = fs::remove_file(&temporary);
        Failure::input(format!("{}: cannot be written: {e}; check path and free space", path.display()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_from_the_user_the_film_and_the_scene() {
        let exr = |named: Option<&str>, film: Option<&str>| {
            Outputs::new(named.map(Path::new), film.map(Path::new), Path::new("in/box.v2.pbrt")).exr
        };
        assert_eq!(exr(Some("out/a.exr"), Some("b.exr")), Path::new("out/a.exr"));
        assert_eq!(exr(None, Some("b.png")), Path::new("b.exr"));
        assert_eq!(exr(None, Some("/etc/b.pfm")), Path::new("b.exr"), "the scene names no folders");
        assert_eq!(exr(None, None), Path::new("box.v2.exr"));
        let out = Outputs::new(None, Some(Path::new("../c.d.exr")), Path::new("s.pbrt"));
        assert_eq!((out.exr, out.png), (PathBuf::from("c.d.exr"), PathBuf::from("c.d.png")));
    }

    #[test]
    fn what_is_in_the_way_is_told() {
        let dir = std::env::temp_dir().join(format!("sparrow-cli-paths-{}", process::id()));
        fs::create_dir_all(dir.join("taken.exr")).unwrap();
        assert!(check_writable(&dir.join("free.exr")).is_ok());
        assert!(check_writable(&dir.join("taken.exr")).is_err());
        assert!(check_writable(&dir.join("missing/a.exr")).is_err());
        let input = dir.join("input.exr");
        fs::write(&input, "x").unwrap();
        let same = dir.join("taken.exr/../input.exr");
        assert!(check_no_input(&input, [same.as_path()]).is_err());
        assert!(check_no_input(&dir.join("new.exr"), [same.as_path()]).is_ok());
        let left = fs::read_dir(&dir).unwrap().count();
        assert_eq!(left, 2, "the probe was removed");
        fs::remove_dir_all(&dir).unwrap();
    }
}
