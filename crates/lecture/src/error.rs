//! What can go wrong with a book: [`LectureError`].

use std::path::PathBuf;

/// What can go wrong with a book.
#[derive(Debug, thiserror::Error)]
pub enum LectureError {
    /// Nothing of that name.
    #[error("there is no slide or figure `{name}`; {remedy}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// What there is.
        remedy: String,
    },
    /// A scene of the lecture cannot be rendered.
    #[error("{scene}: {message}")]
    Scene {
        /// Its name.
        scene: String,
        /// What is wrong with it.
        message: String,
    },
    /// A figure cannot be made.
    #[error("{0}")]
    Figure(String),
    /// A folder is not ours to write.
    #[error("{}: {message}", .folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// What is in the way; what to do.
        message: String,
    },
    /// A file cannot be read or written.
    #[error("{}: {source}; check path and free space", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The user has stopped the work.
    #[error("interrupted; nothing was written")]
    Interrupted,
}
