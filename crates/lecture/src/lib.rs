//! The lecture as a book: every slide's figure, computed by the code that renders, with its check.
//!
//! ```text
//! SLIDES ◀── rows ── Entry ──make(Studio)──▶ Figure ──write──▶ folder of HTML, SVG, PNG, CSV
//! ```
//!
//! [`TOPICS`] lists the pages and the [`Entry`]s on each; an entry makes its [`Figure`] with a [`Studio`], which knows the
//! [`Quality`] and renders scenes; [`Book`] gathers figures and writes the folder. To add a figure: a file in the folder of its
//! topic with a function `fn(&Studio) -> Result<Figure, LectureError>`, and a line in the topic's table.

mod ask;
mod book;
mod chart;
mod check;
mod entry;
mod error;
mod figure;
mod formula;
mod mathml;
mod measure;
mod overlay;
mod photo;
mod quality;
mod scenes;
mod sheet;
mod sketch;
mod slide;
mod studio;
pub mod topic;

pub use book::{Book, Made, Row, Standing};
pub use check::{Bound, Check};
pub use entry::{Entry, Topic, select};
pub use error::LectureError;
pub use figure::{Content, Figure, Picture};
pub use formula::Formula;
pub use photo::Photo;
pub use quality::Quality;
pub use slide::{SLIDES, Slide};
pub use studio::Studio;
pub use topic::TOPICS;
