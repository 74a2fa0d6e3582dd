//! How far the brightest line of a picture runs from a curve: [`along`].

use crate::measure::contour::Segment;
use crate::measure::profile::{peak, smoothed};

/// Steps of a walk across a curve, in pixels.
const STEP: f64 = 0.25;
/// Steps on either side over which a walk is averaged: a picture that is linear between pixels has its peaks on pixels, which the mean over two
/// pixels mends.
const MEAN: usize = 4;

/// The brightest place on a way across a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ridge {
    /// In pixels from the top left corner.
    pub(crate) place: [f64; 2],
    /// From the curve, in pixels, signed.
    pub(crate) distance: f64,
    /// How bright it is.
    pub(crate) height: f64,
}

/// The brightest places across a curve, up to `reach` pixels from it. `grey` is the picture at the middle of pixels. Ways that leave
/// the picture, and those without a maximum inside, have none.
pub(crate) fn along(
    curve: &[Segment],
    size: [usize; 2],
    grey: &dyn Fn(usize, usize) -> f64,
    reach: f64,
) -> Vec<Ridge> {
    let n = (reach / STEP).round() as i32;
    let ridge = |[a, b]: &Segment| {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        if length < 1e-6 {
            return None;
        }
        let (across, middle) = ([-dy / length, dx / length], [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
        let at = |s: f64| [middle[0] + s * across[0], middle[1] + s * across[1]];
        let walk: Option<Vec<[f64; 2]>> = (-n..=n)
            .map(|k| f64::from(k) * STEP)
            .map(|s| bilinear(size, grey, at(s)).map(|v| [s, v]))
            .collect();
        let [distance, height] = peak(&smoothed(&walk?, MEAN))?;
        Some(Ridge { place: at(distance), distance, height })
    };
    curve.iter().filter_map(ridge).collect()
}

/// The picture between the middles of pixels.
fn bilinear([w, h]: [usize; 2], grey: &dyn Fn(usize, usize) -> f64, [x, y]: [f64; 2]) -> Option<f64> {
    let (x, y) = (x - 0.5, y - 0.5);
    if !(x >= 0.0 && y >= 0.0 && x < (w - 1) as f64 && y < (h - 1) as f64) {
        return None;
    }
    let (i, j) = (x as usize, y as usize);
    let (s, t) = (x - i as f64, y - j as f64);
    let row = |j: usize| grey(i, j) * (1.0 - s) + grey(i + 1, j) * s;
    Some(row(j) * (1.0 - t) + row(j + 1) * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::contour;

    #[test]
    fn a_line_beside_the_curve_is_seen_at_its_distance() {
        let slanted = |[x, y]: [f64; 2]| 0.8 * x + 0.6 * y - 20.0;
        let curve = contour([40, 40], |p| Some(slanted(p)));
        let light = |x: usize, y: usize| {
            // Wide enough for straight lines between pixels.
            let d = (slanted([x as f64 + 0.5, y as f64 + 0.5]) - 0.7) / 3.0;
            1.0 / (1.0 + d * d)
        };
        let found = along(&curve, [40, 40], &light, 4.0);
        assert!(found.len() > 20);
        for r in found {
            assert!((r.distance.abs() - 0.7).abs() < 0.05, "{r:?}");
        }
    }
}
