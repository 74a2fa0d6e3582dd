//! Charts: numbers in, SVG text out. Nothing here knows what a model is.
//!
//! Every picture carries its size as a `viewBox`, names no font but the generic `sans-serif`, needs no script, and has
//! the same bytes in every run on every machine.

pub mod axis;
pub mod cartesian;
pub mod colour_map;
pub mod disc;
pub mod heat;
pub mod mesh;
pub mod page;
pub mod polar;
pub mod simplify;
pub mod svg;
pub mod table;
pub mod text;
pub mod theme;
pub mod ticks;
