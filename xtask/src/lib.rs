//! Checks and generators of the Sparrow workspace.
//!
//! ```text
//! cargo run -p xtask -- check     # what the compiler cannot see: crate arrows, citations, licences, sizes, links
//! cargo run -p xtask -- assets    # writes scenes/textures and scenes/meshes
//! ```

pub mod assets;
pub mod check;

/// The code of the README is compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
