//! The reference fibre: one rough, absorbing, tilted cylinder of circular or elliptical section, with or without a scattering core,
//! traced by Monte Carlo. What it scatters is the truth that fibre models are held against.
//!
//! The surface carries GGX microfacets on scales that are tilted along the fibre; light that meets it goes on a random walk among the
//! facets, reflected and refracted until it leaves, so that no energy is lost [Heitz2016]. Between surfaces light is straight, except in
//! the core. Light is told apart by the number of passages through the inside: R, TT, TRT, and all that is reflected inside more than
//! once.
//!
//! Light is sent from the viewer's direction; by reciprocity the density of the directions in which it leaves is
//! `q(wo, wi) = S cos theta_i`.

mod boundary;
mod like;
mod section;
mod table;
mod trace;

pub use boundary::Surface;
pub use like::{Over, fibre_like};
pub use section::Section;
pub use table::{Grid, LobeError, ModelError, against, comparison_grid};
pub use trace::{Core, Photon, ReferenceFibre};
