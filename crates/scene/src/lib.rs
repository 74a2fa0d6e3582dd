//! The scene reader of Sparrow: pbrt-v4 scene text to a checked [`SceneDesc`].
//!
//! [`read`] takes a file, [`read_str`] a text. Both report every fault of the scene at once, each with its place.

mod build;
mod check;
mod desc;
mod diagnostic;
mod lexer;
mod params;
mod parser;
pub mod ply;
mod read;
mod report;
mod source;
pub mod spd;
mod suggest;
mod tables;

pub use desc::*;
pub use diagnostic::{Diagnostic, DisplayDiagnostic, SceneError, Severity, Span};
pub use read::{read, read_str};
