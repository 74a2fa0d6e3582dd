//! The entry points: [`read`] and [`read_str`].

use std::path::Path;

use crate::build::Builder;
use crate::desc::SceneDesc;
use crate::diagnostic::SceneError;

/// Reads a scene file, and all files it names.
///
/// # Errors
/// All faults of the scene, in file order.
pub fn read(path: &Path) -> Result<SceneDesc, SceneError> {
    let mut builder = Builder::new(path.parent().unwrap_or(Path::new("")).to_path_buf());
    builder.read_main(path);
    builder.finish()
}

/// Reads a scene from a text; `name` stands for its file in messages, relative paths start at `base_dir`.
///
/// # Errors
/// All faults of the scene, in file order.
pub fn read_str(text: &str, name: &str, base_dir: &Path) -> Result<SceneDesc, SceneError> {
    let mut builder = Builder::new(base_dir.to_path_buf());
    builder.read_main_text(text.as_bytes(), name);
    builder.finish()
}
