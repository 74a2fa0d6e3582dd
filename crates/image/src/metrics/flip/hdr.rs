//! HDR-FLIP: the largest LDR-FLIP over all exposures in which something can be seen. [Andersson2021]

use core::f64::consts::LN_2;
use core::num::NonZero;
use std::thread;

use sparrow_math::Real;

use super::{Eye, PIXELS_PER_DEGREE};
use crate::metrics::Pair;

/// The film curve `(k0 x² + k1 x + k2) / (k3 x² + k4 x + k5)`, a fit to ACES. [Andersson2021]
const CURVE: [f64; 6] = [0.9036, 0.018, 0.0, 0.8748, 0.354, 0.14];
/// The tone that the brightest pixel has in the first exposure and the median in the last. [Andersson2021]
const BRIGHT: f64 = 0.85;
/// Weights of red, green and blue in luminance, as ITU-R BT.709 rounds them.
const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];
/// Each takes some hundred bytes a pixel.
const MAX_THREADS: usize = 4;
/// From the darkest median that counts to the largest `f32` there are fewer exposures than this.
const MAX_EXPOSURES: usize = 256;

/// HDR-FLIP of every pixel, in [0, 1]. [Andersson2021]
///
/// The exposures come from the reference. Negative values count as black.
pub fn flip_hdr_map(pair: &Pair) -> Vec<f64> {
    let stops = exposures(pair.reference());
    let n_threads = thread::available_parallelism().map_or(1, NonZero::get).min(MAX_THREADS).min(stops.len());
    // The greatest of all, which does not depend on who finds it.
    if n_threads == 1 {
        return worst_of(pair, stops.into_iter());
    }
    let mut worst = vec![0.0; pair.picture().len()];
    thread::scope(|scope| {
        let every = |first: usize| stops.iter().copied().skip(first).step_by(n_threads);
        let workers: Vec<_> =
            (0..n_threads).map(|first| scope.spawn(move || worst_of(pair, every(first)))).collect();
        for worker in workers {
            match worker.join() {
                Ok(map) => raise(&mut worst, map),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
    });
    worst
}

/// The greatest difference of every pixel in some exposures.
fn worst_of(pair: &Pair, stops: impl Iterator<Item = f64>) -> Vec<f64> {
    let eye = Eye::new(PIXELS_PER_DEGREE);
    let mut worst = vec![0.0; pair.picture().len()];
    for stop in stops {
        let gain = Real::exp(stop * LN_2);
        let toned =
            |v: &[[f32; 3]]| v.iter().map(|p| p.map(|c| tone(gain * f64::from(c)))).collect::<Vec<_>>();
        let map = eye.difference(pair.width(), &toned(pair.picture()), &toned(pair.reference()));
        raise(&mut worst, map);
    }
    worst
}

/// Takes the greater at each place; a NaN is greater than anything.
fn raise(worst: &mut [f64], map: Vec<f64>) {
    worst.iter_mut().zip(map).filter(|(w, e)| !w.is_nan() && !(*e <= **w)).for_each(|(w, e)| *w = e);
}

/// Exposures in stops, from the first to the last about one apart, two at least. [Andersson2021]
fn exposures(reference: &[[f32; 3]]) -> Vec<f64> {
    let mut y: Vec<f64> =
        reference.iter().map(|p| (0..3).map(|c| LUMINANCE[c] * f64::from(p[c])).sum()).collect();
    let middle = y.len() / 2;
    let brightest = y.iter().copied().fold(0.0, f64::max);
    let (_, median, _) = y.select_nth_unstable_by(middle, f64::total_cmp);
    // A black median would ask for exposures without end.
    let darkest = f64::from(f32::EPSILON);
    let bright = input_of(BRIGHT);
    let [start, end] = [brightest, *median].map(|y| Real::ln(bright / y.max(darkest)) / LN_2);
    let n = ((end - start).ceil() as usize).clamp(2, MAX_EXPOSURES);
    (0..n).map(|i| start + (end - start) * i as f64 / (n - 1) as f64).collect()
}

/// The curve at `x`, negative values counting as zero, within [0, 1].
fn tone(x: f64) -> f64 {
    let [k0, k1, k2, k3, k4, k5] = CURVE;
    // Beyond this the curve is past white, and squares would overflow.
    let x = x.clamp(0.0, 1e6);
    (((k0 * x + k1) * x + k2) / ((k3 * x + k4) * x + k5)).clamp(0.0, 1.0)
}

/// Where the curve has the value `t`: the positive root of a quadratic equation.
fn input_of(t: f64) -> f64 {
    let [k0, k1, k2, k3, k4, k5] = CURVE;
    let (a, b, c) = (k0 - t * k3, k1 - t * k4, k2 - t * k5);
    (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_brightest_pixel_and_the_median_are_bright() {
        assert!((tone(input_of(BRIGHT)) - BRIGHT).abs() < 1e-12);
        assert!(tone(-1.0).abs() < 1e-15 && (tone(1e30) - 1.0).abs() < 1e-15);
        let reference = [0.01, 0.5, 0.02, 64.0, 0.04].map(|v| [v; 3]);
        let stops = exposures(&reference);
        let at = |stop: f64, y: f64| tone(y * Real::exp(stop * LN_2));
        assert!((at(stops[0], 64.0) - BRIGHT).abs() < 1e-9);
        assert!((at(stops[stops.len() - 1], f64::from(0.04f32)) - BRIGHT).abs() < 1e-9);
        // 64 / 0.04 is 10.6 stops.
        assert_eq!(stops.len(), 11);
    }

    #[test]
    fn a_nan_of_any_exposure_stays() {
        let mut worst = vec![0.0; 2];
        for map in [[0.5, f64::NAN], [0.25, 0.75], [f64::NAN, 0.0]] {
            raise(&mut worst, map.to_vec());
        }
        assert!(worst.iter().all(|w| w.is_nan()), "{worst:?}");
    }

    #[test]
    fn no_picture_asks_for_endless_exposures() {
        for v in [0.0, 1.0, -1.0, f32::MAX, f32::INFINITY, f32::NAN] {
            let n = exposures(&[[v; 3], [0.0; 3], [0.0; 3]]).len();
            assert!((2..=MAX_EXPOSURES).contains(&n), "{v}: {n}");
        }
    }
}
