//! The folder of a book, which appears whole or not at all: [`Folder`].

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::error::LectureError;

/// The file that tells a book from other folders.
pub(super) const RECORD: &str = "book.json";

/// A folder under a temporary name; removed unless it is [finished](Folder::finish).
#[derive(Debug)]
pub(super) struct Folder {
    target: PathBuf,
    temporary: PathBuf,
}

impl Folder {
    /// Sees to it that `target` can be written, and makes a folder beside it. `part` is for a book of few figures, which
    /// does not take the place of a whole one.
    ///
    /// # Errors
    /// Where `target` is no book, or one that was changed by hand.
    pub(super) fn begin(target: &Path, part: bool) -> Result<Folder, LectureError> {
        check(target, part)?;
        let refuse = |message: &str| LectureError::Folder {
            folder: target.to_path_buf(),
            message: message.to_owned(),
        };
        let name = target.file_name().ok_or_else(|| refuse("this names no new folder; add a name"))?;
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}.tmp", std::process::id()));
        let folder = Folder { target: target.to_path_buf(), temporary: target.with_file_name(hidden) };
        let parent = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if !parent.is_dir() {
            return Err(refuse(&format!("there is no folder `{}`; create it first", parent.display())));
        }
        for inner in ["", "figures", "data"] {
            let path = folder.path(inner);
            fs::create_dir_all(&path).map_err(|source| LectureError::File { path, source })?;
        }
        Ok(folder)
    }
    /// A path inside.
    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.temporary.join(name)
    }
    /// Writes a file.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub(super) fn put(&self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), LectureError> {
        let path = self.path(name);
        fs::write(&path, bytes).map_err(|source| LectureError::File { path, source })
    }
    /// Gives the folder its name; an older book goes.
    ///
    /// # Errors
    /// Where the system refuses; then what was there is there still.
    pub(super) fn finish(self) -> Result<(), LectureError> {
        let file = |source| LectureError::File { path: self.target.clone(), source };
        if !self.target.exists() {
            return fs::rename(&self.temporary, &self.target).map_err(file);
        }
        let mut old = self.temporary.clone().into_os_string();
        old.push(".old");
        let old = PathBuf::from(old);
        fs::rename(&self.target, &old).map_err(file)?;
        if let Err(e) = fs::rename(&self.temporary, &self.target) {
            // Whether or not this succeeds, the first error is the one worth telling.
            let _ = fs::rename(&old, &self.target);
            return Err(file(e));
        }
        // The new book is in its place; what is left of the old one does no harm.
        let _ = fs::remove_dir_all(&old);
        Ok(())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.temporary);
    }
}

fn check(target: &Path, part: bool) -> Result<(), LectureError> {
    let refuse = |message: String| Err(LectureError::Folder { folder: target.to_path_buf(), message });
    let entries = match fs::read_dir(target) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(e) => return refuse(format!("{e}; name another folder with -o")),
        Ok(entries) => entries.count(),
    };
    if entries == 0 {
        return Ok(());
    }
    let Ok(record) = fs::read_to_string(target.join(RECORD)) else {
        return refuse("the folder holds something else than a book; name another with -o".to_owned());
    };
    if part && record.contains("\"only\": null") {
        return refuse("the folder holds a whole book; name another with -o".to_owned());
    }
    match changed(target) {
        Some(scene) => refuse(format!(
            "{scene} was changed after the book was made; move it away or name another folder with -o"
        )),
        None => Ok(()),
    }
}

/// A scene that is younger than the book.
fn changed(book: &Path) -> Option<String> {
    let age = |path: &Path| -> Option<SystemTime> { path.metadata().ok()?.modified().ok() };
    let made = age(&book.join(RECORD))?;
    let mut folders = vec![book.join("scenes")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).ok()?.flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if age(&path).is_some_and(|t| t > made) {
                return Some(path.strip_prefix(book).unwrap_or(&path).display().to_string());
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scratch(name: &str) -> PathBuf {
        let dir = std::env::temp_dir().join(format!("sparrow-lecture-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&dir);
        fs::create_dir_all(&dir).unwrap();
        dir
    }

    #[test]
    fn a_book_takes_the_place_of_a_book_alone() {
        let dir = scratch("place");
        let book = dir.join("book");
        let write = |text: &str, part: bool| {
            let folder = Folder::begin(&book, part)?;
            folder.put("index.html", text)?;
            folder.put(RECORD, if part { "{\"only\": \"8\"}" } else { "{\"only\": null}" })?;
            folder.finish()
        };
        let read = || fs::read_to_string(book.join("index.html")).unwrap();
        write("first", true).unwrap();
        write("second", false).unwrap();
        assert_eq!(read(), "second");
        assert!(write("part", true).is_err(), "a part does not replace the whole");
        fs::create_dir_all(book.join("scenes/inner")).unwrap();
        fs::write(book.join("scenes/inner/a.pbrt"), "changed").unwrap();
        let e = write("third", false).unwrap_err();
        assert!(e.to_string().contains("a.pbrt was changed"), "{e}");
        fs::remove_file(book.join(RECORD)).unwrap();
        assert!(write("fourth", false).is_err(), "this is no book");
        assert_eq!(read(), "second");
        drop(Folder::begin(&dir.join("other"), false).unwrap());
        let left: Vec<_> = fs::read_dir(&dir).unwrap().map(|e| e.unwrap().file_name()).collect();
        assert_eq!(left, ["book"], "nothing is left behind");
        fs::remove_dir_all(&dir).unwrap();
    }
}
