//! The scene reader of Sparrow: pbrt-v4 scene text to a checked [`SceneDesc`].
//!
//! [`read`] takes a file, [`read_str`] a text. Both report every fault of the scene at once, each with its place.
//! What pbrt-v4 knows and Sparrow does not render yet is a warning with its place, and says what is done instead;
//! what neither knows is a fault.
//!
//! ```
//! use std::path::Path;
//!
//! let scene = sparrow_scene::read_str("WorldBegin Shape \"sphere\"", "ball.pbrt", Path::new("."))?;
//! assert_eq!(scene.shapes.len(), 1);
//!
//! let e = sparrow_scene::read_str("WorldBegin Shape \"shpere\"", "ball.pbrt", Path::new(".")).unwrap_err();
//! assert_eq!(e.to_string(), "ball.pbrt:1:18: there is no shape \"shpere\"; did you mean \"sphere\"?");
//! # Ok::<(), sparrow_scene::SceneError>(())
//! ```
//!
//! Text passes through `lexer` and `parser` to `build`, which keeps the graphics state; `tables` holds pbrt-v4's
//! statements, types and parameters, and what of them is rendered.

mod build;
mod check;
pub mod curve_files;
mod desc;
mod diagnostic;
mod lexer;
pub mod obj;
mod params;
mod parser;
pub mod ply;
mod read;
mod report;
mod source;
pub mod spd;
mod tables;

use sparrow_models::suggest;

pub use desc::*;
pub use diagnostic::{Diagnostic, DisplayDiagnostic, SceneError, Severity, Span};
pub use read::{read, read_str, read_with_materials};
