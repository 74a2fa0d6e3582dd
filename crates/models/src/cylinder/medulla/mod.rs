//! The medulla of fur, a scattering core, by moments of the light that leaves it: [`Moments`].
//!
//! [Yan2015] tabulates whole profiles of such light, over optical thickness and anisotropy among others. It is spread so widely that
//! four numbers tell most of it: mean cosines along and around the fibre, mean and spread of its way. They come from random walks of our own
//! (`walk.rs`) and lie in `table.txt`. The walks begin at all offsets of the core, at an inclination of 25 degrees: that of the light is
//! below 42 degrees inside a fibre of an index above 1.5.

use std::sync::OnceLock;

use sparrow_math::Real;

use crate::table::{Place, interpolate};

#[cfg(test)]
mod walk;

/// Nodes over the optical radius, even in its logarithm, and over the mean cosine.
const NODES: [usize; 2] = [13, 7];
/// Optical radii of the first and the last node.
const OPTICAL: [f64; 2] = [0.1, 30.0];
/// Greatest mean cosine of scattering.
pub const MOST_FORWARD: f64 = 0.9;

/// The chords in cortex and core of a ray at the angle `gamma_t`, given by its sine and cosine, through a core of the radius `kappa`, in
/// radii and seen along the axis. [Yan2015, section 4.2]
pub fn chords(kappa: f64, [sin, cos]: [f64; 2]) -> [f64; 2] {
    let core = 2.0 * (kappa.sqr() - sin.sqr()).max(0.0).sqrt();
    [2.0 * cos - core, core]
}

/// Light that was scattered in the core, where it leaves it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// The component along the fibre over that of light that goes on straight, its mean.
    pub along: f64,
    /// The mean cosine of the turn around the fibre.
    pub around: f64,
    /// Length of the way in the core, in its radii: mean, and the square of the mean over the variance.
    pub way: [f64; 2],
}

/// The table as it was written, read once: one column for each number.
fn table() -> &'static [[f32; NODES[0] * NODES[1]]; 4] {
    static TABLE: OnceLock<[[f32; NODES[0] * NODES[1]]; 4]> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut table = [[0.0; NODES[0] * NODES[1]]; 4];
        let lines = include_str!("table.txt").lines().filter(|l| !l.starts_with('#'));
        for (k, line) in lines.take(NODES[0] * NODES[1]).enumerate() {
            for (column, word) in table.iter_mut().zip(line.split_ascii_whitespace()) {
                column[k] = word.parse().unwrap_or(0.0);
            }
        }
        table
    })
}

impl Moments {
    /// Of a core with the optical radius `tau`, the scattering along a radius, and the mean cosine `g` after Henyey and Greenstein, 0 to
    /// [`MOST_FORWARD`]. Below and above the table's optical radii those of its ends.
    pub fn of(tau: f64, g: f64) -> Moments {
        let decades = Real::ln(tau.max(OPTICAL[0]) / OPTICAL[0]) / Real::ln(OPTICAL[1] / OPTICAL[0]);
        let at = [Place::unit(NODES[0], decades.min(1.0)), Place::unit(NODES[1], g / MOST_FORWARD)];
        let [along, around, length, shape] = table().each_ref().map(|column| interpolate(column, at));
        Moments { along, around, way: [length, shape] }
    }
    /// Share of the light that is left of it where the core absorbs `sigma` along a radius, its ways distributed after Gamma.
    pub fn left(&self, sigma: f64) -> f64 {
        let [mean, shape] = self.way;
        Real::pow(1.0 + sigma * mean / shape, -shape)
    }
    /// The variance of the lobe that has the mean [`along`](Self::along): `coth(1 / v) - v`, inverted. [Banerjee2005, eq. 4.4]
    pub fn variance(&self) -> f64 {
        let r = self.along.clamp(0.01, 0.999);
        (1.0 - r * r) / (r * (3.0 - r * r))
    }
}
