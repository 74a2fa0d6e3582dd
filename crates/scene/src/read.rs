//! The entry points: [`read`] and [`read_str`].

use std::path::Path;

use crate::desc::SceneDesc;
use crate::diagnostic::{Diagnostic, SceneError, Span};

/// Reads a scene file, and all files it names.
///
/// # Errors
/// All faults of the scene, in file order.
pub fn read(path: &Path) -> Result<SceneDesc, SceneError> {
    Err(not_yet(path))
}

/// Reads a scene from a text; `name` stands for its file in messages, relative paths start at `base_dir`.
///
/// # Errors
/// All faults of the scene, in file order.
pub fn read_str(text: &str, name: &str, base_dir: &Path) -> Result<SceneDesc, SceneError> {
    let _ = (text, base_dir);
    Err(not_yet(Path::new(name)))
}

fn not_yet(path: &Path) -> SceneError {
    SceneError {
        faults: vec![Diagnostic::error(Span::default(), "scenes cannot be read yet")],
        warnings: Vec::new(),
        files: vec![path.to_path_buf()],
    }
}
