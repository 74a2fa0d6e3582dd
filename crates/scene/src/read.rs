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
    read_with_materials(path, &[])
}

/// Reads a scene file as [`read`] does, with other materials in the place of some of its named ones.
///
/// Each text is what follows `MakeNamedMaterial` in a scene: a name, `"string type"` and parameters. It stands for the scene's
/// material of that name wherever that is used.
///
/// # Errors
/// All faults of the texts and the scene; a name that the scene does not define is one.
pub fn read_with_materials(path: &Path, materials: &[String]) -> Result<SceneDesc, SceneError> {
    let mut builder = Builder::new(path.parent().unwrap_or(Path::new("")).to_path_buf());
    builder.read_main(path, materials);
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
