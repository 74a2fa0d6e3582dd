//! The scene reader of Sparrow: pbrt-v4 scene text to a checked [`SceneDesc`].
//!
//! [`read`] takes a file, [`read_str`] a text. Both report every fault of the scene at once, each with its place.

mod desc;
mod diagnostic;
mod read;

pub use desc::*;
pub use diagnostic::{Diagnostic, DisplayDiagnostic, SceneError, Severity, Span};
pub use read::{read, read_str};
