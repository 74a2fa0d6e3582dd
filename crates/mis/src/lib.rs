//! Multiple importance sampling [VeachGuibas1995]: several ways to draw samples of one integral, joined so that each does what it
//! does best.
//!
//! An integral `I = int f` is estimated with the techniques k, each a density `p_k` and a number of samples `n_k`:
//!
//! ```text
//! F = sum_k (1 / n_k) sum_j w_k(X_kj) f(X_kj) / p_k(X_kj),   sum_k w_k = 1 where f is not zero
//! ```
//!
//! Nothing here knows what is integrated: densities and values are numbers. All densities at one place are in one measure.
//!
//! | what | where |
//! | --- | --- |
//! | weights from densities: balance, power, cutoff, maximum, average | [`Heuristic`] |
//! | the two techniques of direct light | [`Mis`] |
//! | the estimator with several samples, and with one sample of one technique | [`multi_sample`], [`one_sample`] |
//! | the weights of least variance [Kondapaneni2019] | [`Moments`], [`control_variate`]; of two techniques [`PairMoments`] |
//! | densities scaled by how noisy each technique is [Grittmann2019] | [`variance_factor`], [`Heuristic::weight`] |
//! | a tabulated density that leaves to others what they do anyway [Karlik2019] | [`compensate`], [`sharpen`] |

mod compensation;
mod direct;
mod estimator;
mod heuristic;
mod linear;
mod optimal;
mod pair;
mod variance;

pub use compensation::{compensate, sharpen};
pub use direct::{Mis, Turn};
pub use estimator::{Drawn, multi_sample, one_sample};
pub use heuristic::{Heuristic, ParseError, Technique};
pub use optimal::{Moments, control_variate};
pub use pair::PairMoments;
pub use variance::variance_factor;
