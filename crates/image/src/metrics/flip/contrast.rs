//! What the eye blurs: contrast sensitivity as filters of the opponent channels. [Andersson2020]

use core::f64::consts::PI;

use sparrow_math::Real;

use crate::metrics::plane::{Plane, offsets};

/// Sensitivity `sum a exp(-b f²)` to a pattern of frequency `f`, as pairs of `a` and `b`, for lightness, red against green,
/// and blue against yellow. [Andersson2020]
const SENSITIVITY: [&[[f64; 2]]; 3] = [&[[1.0, 0.0047]], &[[1.0, 0.0053]], &[[34.1, 0.04], [13.5, 0.025]]];

/// One filter for each channel.
pub(super) struct Contrast {
    channels: [Vec<Term>; 3],
}

/// A Gaussian of unit height in the middle, along one axis, and its weight.
struct Term {
    weight: f64,
    gaussian: Vec<f64>,
}

impl Contrast {
    pub(super) fn new(pixels_per_degree: f64) -> Contrast {
        let widest = SENSITIVITY.iter().flat_map(|c| c.iter()).fold(0.0, |w: f64, [_, b]| w.max(*b));
        // Three standard deviations of the widest.
        let radius = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as usize;
        Contrast { channels: SENSITIVITY.map(|terms| filter(terms, radius, pixels_per_degree)) }
    }

    pub(super) fn filter(&self, channels: [Plane; 3]) -> [Plane; 3] {
        let blur = |c: usize| {
            let mut terms =
                self.channels[c].iter().map(|t| (t.weight, channels[c].filtered(&t.gaussian, &t.gaussian)));
            let zero = Plane::new(channels[c].width, vec![0.0; channels[c].values.len()]);
            terms.by_ref().fold(zero, |sum, (w, p)| sum.zip(&p, |s, v| s + w * v))
        };
        [0, 1, 2].map(blur)
    }
}

/// The inverse Fourier transform of a sensitivity, `sum a sqrt(pi / b) exp(-pi² x² / b)` at `x` degrees, with the sum 1 over
/// the plane. [Andersson2020]
fn filter(terms: &[[f64; 2]], radius: usize, pixels_per_degree: f64) -> Vec<Term> {
    let mut terms: Vec<Term> = terms
        .iter()
        .map(|[a, b]| {
            let degrees = offsets(radius).map(|x| x / pixels_per_degree);
            let gaussian = degrees.map(|x| Real::exp(-PI * PI * x * x / b)).collect();
            Term { weight: a * (PI / b).sqrt(), gaussian }
        })
        .collect();
    let integral = |t: &Term| {
        let line: f64 = t.gaussian.iter().sum();
        t.weight * line * line
    };
    let total: f64 = terms.iter().map(integral).sum();
    terms.iter_mut().for_each(|t| t.weight /= total);
    terms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_even_stays_as_it_is() {
        let even = |v| Plane::new(7, vec![v; 35]);
        let out = Contrast::new(67.0).filter([even(3.0), even(-2.0), even(40.0)]);
        for (plane, want) in out.iter().zip([3.0, -2.0, 40.0]) {
            assert!(plane.values.iter().all(|v| (v - want).abs() < 1e-12));
        }
    }

    #[test]
    fn colour_is_blurred_more_than_lightness() {
        let stripes = || Plane::new(64, (0..64 * 3).map(|i| f64::from(i % 2)).collect());
        let spread = |p: &Plane| (p.values[96] - p.values[97]).abs();
        let [y, _, cz] = Contrast::new(20.0).filter([stripes(), stripes(), stripes()]);
        assert!(spread(&y) > 10.0 * spread(&cz), "{} {}", spread(&y), spread(&cz));
    }
}
