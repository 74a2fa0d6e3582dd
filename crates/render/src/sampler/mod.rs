//! Uniform numbers for paths, indexed by pixel, sample and dimension.
//!
//! A [`Sampler`] is built once per render and is immutable; [`Sampler::start`] gives the `Copy` state
//! of one pixel sample, whose numbers depend only on the configuration, the pixel, the sample and the
//! dimension. Neither threads, tiles nor the order of calls matter, and a render may be cut into runs
//! over ranges of samples. All numbers lie in `[0, 1 - 2^-24]`.
//!
//! | kind | points | dimensions | error over the image |
//! | --- | --- | --- | --- |
//! | `zsobol` | Sobol pairs, one Owen-scrambled sequence along a Morton curve | padded | blue noise |
//! | `paddedsobol` | the same pairs, scrambled per pixel | padded | white noise |
//! | `sobol` | one sequence over image and path | 128, then padded | visible patterns at few samples |
//! | `halton` | one sequence over image and path | 128, then padded | the same |
//! | `stratified` | a jittered grid, shuffled per dimension | padded | white noise |
//! | `independent` | a hash | any | white noise |
//! | `pmj02bn` | runs as `zsobol` and says so | padded | blue noise |
//!
//! *Padded* means that every request takes a fresh (0, 2)-sequence, shuffled against the others
//! [Burley2020]; a triple is such a pair with a third coordinate of the same index. What lies beyond the table of a global sequence is padded too.
//!
//! A pixel takes up to 2^32 samples, and each of them 2^32 dimensions, none of which repeats another. A padded kind asked for more samples
//! than it was built for scrambles them anew, and so does the global Sobol sequence beyond its 2^52 points, which an image of side 2^m spends
//! after 2^(52 - 2 m) samples: 2^32 for 1024 pixels, 2^28 for 4096.
//!
//! An Owen-scrambled (0, 2)-sequence has the strata of a progressive multi-jittered (0, 2) one at every power of two, and may be drawn as one
//! [Helmer2021, abstract]. So `pmj02bn` differs from `zsobol` only in what spreads the error over the image, and in that pbrt's tables keep the
//! points of one pixel apart, which is not done here.
//!
//! Sample counts need not be powers of two. All samples of a power of two, and within them every
//! power of two above 16 that is counted from a multiple of itself, are a (0, m, 2)-net in every pair of a
//! padded kind; other counts are as well stratified as a prefix of the sequence can be. Two padded
//! pairs are shuffled against each other in random blocks of 16 samples (fewer where fewer divide the count).

mod column;
mod config;
mod halton;
mod hash;
mod joe_kuo;
mod pixel;
mod scramble;
mod sobol;
mod stratified;
#[cfg(test)]
#[expect(clippy::float_cmp, reason = "repeatability is equality of bits")]
mod tests;
mod zorder;

pub use column::Draw;
pub use config::{Randomize, SamplerConfig, SamplerKind};
pub(crate) use pixel::SampleKey;
pub use pixel::{Pixel, PixelSampler, Sampler};
