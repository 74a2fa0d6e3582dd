//! The probability with which a path goes on: [`Roulette`].
//!
//! A path that goes on with probability `q` from where it carries `beta` adds `(beta / I)^2 M / q` to the relative variance of its pixel,
//! and `q C` to the cost: `M` is the second moment of what it finds from there, `C` the rays that takes, `I` the pixel's radiance. With `V`
//! and `C_I` for a path of the whole picture, variance times cost is least where both grow alike,
//! `(beta / I)^2 M / (q^2 V) = C / C_I`, so at
//!
//! ```text
//! q = beta / I sqrt(M / C) sqrt(C_I / V)
//! ```
//!
//! [Rath2022] choose splitting in the same way, which here is done apart. [`Learned`] has what a pilot found of each, without splits. Few paths do not know of
//! rare bright light, and ending those that would find it doubled the error behind rough glass. So a path goes on at least with the
//! probability that its throughput gives: efficiency makes paths longer where that pays, and no weight is larger than without it.
//!
//! The pilot has numbers of its own, and whatever it learned, the mean of the picture is the same.

mod cells;
mod learned;
mod pilot;
mod trail;

use sparrow_math::{Real, Vec3};
use sparrow_spectra::{N_LAMBDA, Spectrum};

pub(crate) use learned::Learned;
pub(crate) use pilot::learn;

/// How paths of one pixel are ended.
#[derive(Clone, Copy, Debug)]
pub struct Roulette<'a> {
    /// What is known, and the pixel of the full picture.
    learned: Option<(&'a Learned, [u32; 2])>,
}

impl<'a> Roulette<'a> {
    /// By throughput alone.
    pub const THROUGHPUT: Roulette<'static> = Roulette { learned: None };

    /// For a pixel of the full picture.
    #[inline]
    pub(crate) fn of_pixel(learned: Option<&'a Learned>, pixel: [u32; 2]) -> Roulette<'a> {
        Roulette { learned: learned.map(|l| (l, pixel)) }
    }

    /// Probability with which a path goes on from `p` that carries `beta`; `eta_scale` undoes the squeeze of refraction.
    #[inline]
    pub(crate) fn survival(self, p: Vec3<f32>, beta: Spectrum<f32>, eta_scale: f32) -> f32 {
        self.at_least(by_throughput((beta * eta_scale).max_value()), p, beta)
    }
    /// The same, where throughput gives `q`.
    #[inline]
    pub(crate) fn at_least(self, q: f32, p: Vec3<f32>, beta: Spectrum<f32>) -> f32 {
        match self.learned {
            Some((learned, pixel)) if q < 1.0 => Real::clamp(learned.value(pixel, p) * mean(beta), q, 1.0),
            _ => q,
        }
    }
}

/// Paths are ended only when they have lost more than half: ending them in proportion to what they lost, as pbrt-v4
/// does, costs a third more error on diffuse scenes for the same time (`docs/performance.md`).
#[inline(always)]
pub(crate) fn by_throughput<R: Real>(carried: R) -> R {
    R::select(carried.lt(R::ONE), (R::of(2.0) * carried).min(R::of(0.95)), R::ONE)
}

/// What a spectrum is to a picture, about.
#[inline]
fn mean(s: Spectrum<f32>) -> f32 {
    (s[0] + s[1] + s[2] + s[3]) * (1.0 / N_LAMBDA as f32)
}

#[cfg(test)]
mod tests;
