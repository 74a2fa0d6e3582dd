//! The film: sums over the samples of each pixel, exact and therefore independent of their order.
//!
//! Floating-point sums depend on the order of their terms, and with it on threads, tiles and passes.
//! Here every term is rounded once to a fixed grid, and integers are added. Any split of a render into
//! tiles, threads, passes or partial renders gives the same bits once all its samples are in.
//!
//! | sum | grid | one term | sum before it saturates |
//! | --- | --- | --- | --- |
//! | `w rgb`, `w^2 rgb` | 2^-64 = 5.4e-20 | cut at ±2^40 = 1.1e12 | ±2^63 = 9.2e18 |
//! | `w^2 rgb^2`, `w^2` | 2^-64 | ends the sum from 9.2e18 on | 2^64 = 1.8e19 |
//! | `w` | 2^-32 = 2.3e-10 | cut at ±256 | ±2^31 |
//!
//! So a term keeps all 24 bits of an `f32` from 2^-40 = 9e-13 on, and values below 2.7e-20 vanish. The
//! cuts apply to single terms, hence do not depend on order either; below 2^23 samples per pixel no signed
//! sum can reach its end, whatever the values, and beyond that only where the values are absurd. There
//! additions saturate instead of wrapping. Sums of squares may reach their end (a value of 4e9 does it);
//! being sums of positive terms they end alike in any order, and the variance is then infinite.
//! Weights are rounded before they multiply, so the mean of a constant is that constant.
//!
//! A [`FilmTile`] adds up small values of weight ±1, as nearly all are, in two words of 64 bits; the sums are the same.
//!
//! Values that are not finite are refused and counted ([`Film::rejected`]); none ever enters a sum.

mod developed;
mod error;
mod fixed;
mod halves;
mod near;
mod pixels;
#[cfg(test)]
#[expect(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests;
mod tile;

pub use developed::Developed;
pub use error::FilmError;
pub use halves::{Halves, Picture};
pub use pixels::{Film, PixelView, RawPixel, RawSquares};
pub use tile::FilmTile;
