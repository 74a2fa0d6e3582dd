//! The trial of reflection models: the same questions to every one of them, over parameters of its own table.
//!
//! A [`Subject`] is tried in three columns: `f64` judges the formula; `f32` and the batch form in lanes judge what
//! renders. Every [`Question`] ends in a [`Verdict`] with its worst case and the words that reproduce it. What a model
//! says it lacks is shown as known, never hidden.
//!
//! ```
//! use sparrow_models::SurfaceKind;
//! use sparrow_verify::{Options, Pins, verify};
//!
//! let kind = SurfaceKind::from_name("lambert").ok_or("no such model")?;
//! let pins = Pins::parse(kind.params(), &["reflectance=0.8", "wo=60,0"])?;
//! let options = Options { samples: 10_000, ..Options::default() };
//! let reports = verify(&[&kind], &pins, &options, &|_, _| ());
//! assert!(reports[0].holds());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod case;
mod column;
mod comparison;
mod edges;
mod furnace;
mod integrals;
mod pins;
mod points;
mod question;
pub mod reference_fibre;
mod report;
mod run;
mod subject;
mod tally;

pub use case::Case;
pub use column::{Batch, Column, Contract, Drawn, OfFibre, OfSurface, Scalar, Value, narrow};
pub use pins::{PinError, Pins};
pub use question::{ColumnName, Question};
pub use report::{Claim, Report, Row, Verdict};
pub use run::{Options, verify};
pub use subject::Subject;
