//! FLIP: the difference that a viewer sees when two pictures alternate in place. [Andersson2020; Andersson2021]
//!
//! A map has one number a pixel, from 0 (no difference) to 1; a picture's number is the mean of its map.

mod colour;
mod contrast;
mod features;
mod hdr;

pub use self::hdr::flip_hdr_map;

use sparrow_math::Real;

use self::colour::{hunt_lab, hyab, linear_from_opponent, opponent};
use self::contrast::Contrast;
use self::features::{Detector, Features};
use super::Pair;
use super::display::shown;
use super::plane::Plane;

/// Pixels per degree of a screen 0.7 m wide with 3840 pixels, seen from 0.7 m: `3840 pi / 180`. [Andersson2020]
pub const PIXELS_PER_DEGREE: f64 = 3840.0 * core::f64::consts::PI / 180.0;

/// Exponent of the colour difference. [Andersson2020]
const Q_COLOUR: f64 = 0.7;
/// Share of the largest difference that is mapped to the share [`P_T`] of the range. [Andersson2020]
const P_C: f64 = 0.4;
/// See [`P_C`].
const P_T: f64 = 0.95;

/// LDR-FLIP of every pixel, in [0, 1]: `dE_c^(1 - dE_f)` of colour and feature differences. [Andersson2020]
///
/// Linear values are clamped to [0, 1]: what exceeds 1 is white on any display.
pub fn flip_map(pair: &Pair) -> Vec<f64> {
    let planes = |v: &[[f32; 3]]| v.iter().map(|p| p.map(|c| shown(f64::from(c)))).collect::<Vec<_>>();
    Eye::new(PIXELS_PER_DEGREE).difference(pair.width(), &planes(pair.picture()), &planes(pair.reference()))
}

/// What depends on the viewing distance alone.
struct Eye {
    contrast: Contrast,
    detector: Detector,
    /// The largest colour difference, between green and blue, to the power [`Q_COLOUR`].
    largest: f64,
}

/// A picture as the eye has it.
struct Seen {
    colour: Vec<[f64; 3]>,
    features: Features,
}

impl Eye {
    fn new(pixels_per_degree: f64) -> Eye {
        let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(hunt_lab);
        Eye {
            contrast: Contrast::new(pixels_per_degree),
            detector: Detector::new(pixels_per_degree),
            largest: Real::pow(hyab(green, blue), Q_COLOUR),
        }
    }

    /// Differences between pictures in linear RGB within [0, 1].
    fn difference(&self, width: usize, a: &[[f64; 3]], b: &[[f64; 3]]) -> Vec<f64> {
        let (a, b) = (self.see(width, a), self.see(width, b));
        let colour = a.colour.iter().zip(&b.colour).map(|(a, b)| self.remap(hyab(*a, *b)));
        colour.zip(a.features.difference(&b.features)).map(|(c, f)| power(c, 1.0 - f)).collect()
    }

    fn see(&self, width: usize, rgb: &[[f64; 3]]) -> Seen {
        let pixels: Vec<[f64; 3]> = rgb.iter().map(|p| opponent(*p)).collect();
        let [y, cx, cz] = [0, 1, 2].map(|c| Plane::new(width, pixels.iter().map(|p| p[c]).collect()));
        let features = self.detector.detect(&y);
        let [y, cx, cz] = self.contrast.filter([y, cx, cz]);
        let rest = cx.values.iter().zip(&cz.values);
        let colour = y
            .values
            .iter()
            .zip(rest)
            .map(|(y, (cx, cz))| hunt_lab(linear_from_opponent([*y, *cx, *cz]).map(shown)))
            .collect();
        Seen { colour, features }
    }

    /// The colour difference in [0, 1]; large ones, of which the eye tells little, are compressed. [Andersson2020]
    fn remap(&self, hyab: f64) -> f64 {
        let (e, knee) = (power(hyab, Q_COLOUR), P_C * self.largest);
        if e < knee { P_T * e / knee } else { P_T + (1.0 - P_T) * (e - knee) / (self.largest - knee) }
    }
}

/// `x^y` for `x >= 0`; zero at zero, and NaN stays NaN.
fn power(x: f64, y: f64) -> f64 {
    if x > 0.0 { Real::pow(x, y) } else { 0.0 * x }
}

#[cfg(test)]
mod tests;
