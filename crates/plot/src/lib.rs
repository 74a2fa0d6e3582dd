//! Plots of reflection models: numbers in, SVG and CSV text out.
//!
//! Two layers. [`draw`] holds axes, polar axes, heat maps, meshes, legends and colours, and knows no model; it may be
//! used alone. [`figure`] asks models for numbers, in `f64` and through the same text that is rendered, and hands them to
//! [`draw`]. Nothing here touches a file.
//!
//! ```
//! use sparrow_plot::{Kind, Options, Series, draw_figure, parse_series};
//!
//! let words = ["conductor", "alpha=0.1,0.3,0.6", "wo=45"].map(String::from);
//! let series: Vec<Series> = parse_series(&words)?;
//! assert_eq!(series.len(), 3);
//! let figure = draw_figure(&series, &Options { kind: Kind::Polar, ..Options::default() })?;
//! assert!(figure.svg.starts_with("<svg"));
//! assert!(figure.table.csv().starts_with("theta_i_deg,"));
//! # Ok::<(), sparrow_plot::PlotError>(())
//! ```

pub mod draw;
mod error;
pub mod figure;
mod series;
mod words;

pub use error::{Fault, PlotError};
pub use figure::{Figure, Kind, Options, Quantity, draw_fibres, draw_figure};
pub use series::{Family, Series};
pub use words::{names_a_fibre, parse_series};
