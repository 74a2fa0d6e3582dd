//! Statistics for the trial of reflection models and of pictures: closures in, numbers out, all in `f64`.
//!
//! Nothing here knows what a model is. Densities and values come as closures over directions, samples as numbers.
//!
//! | question | where |
//! | --- | --- |
//! | integral over the sphere, of narrow lobes too | [`Partition`], [`cubature`] |
//! | do samples follow a density? | [`chi_square`], [`Partition::locate`] |
//! | how many tests, and how strict each? | [`sidak`], [`bonferroni`] |
//! | mean, its standard error, albedo | [`Mean`], [`albedo`] |
//! | are viewer and light exchangeable? | [`reciprocity`] |
//! | is a sample's weight value over density? | [`consistency`] |
//! | how uneven are weights? | [`Weights`] |
//! | are two pictures the same but for noise? | [`images_z_test`] |

mod chi_square;
mod compare;
pub mod cubature;
mod images;
mod mean;
mod partition;
mod random;
pub mod special;
mod weights;

pub use chi_square::{Cell, ChiSquare, bonferroni, chi_square, sidak, sidak_p};
pub use compare::{Departure, consistency, reciprocity};
pub use images::{ZTest, images_z_test};
pub use mean::{Mean, albedo};
pub use partition::{Integral, Partition, integrate_sphere};
pub use random::Random;
pub use weights::Weights;
