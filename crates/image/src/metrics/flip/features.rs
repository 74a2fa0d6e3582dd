//! What draws the eye: edges and points of the lightness. [Andersson2020]

use crate::metrics::plane::{Plane, gaussian, normalized, offsets};

/// Width of an edge that the eye detects, in degrees. [Andersson2020]
const EDGE_WIDTH: f64 = 0.082;

/// First and second derivatives of a Gaussian, along one axis, and the Gaussian for the other.
pub(super) struct Detector {
    smooth: Vec<f64>,
    edge: Vec<f64>,
    point: Vec<f64>,
}

/// Magnitudes of the two gradients at each pixel.
pub(super) struct Features {
    edges: Plane,
    points: Plane,
}

impl Detector {
    pub(super) fn new(pixels_per_degree: f64) -> Detector {
        let sigma = 0.5 * EDGE_WIDTH * pixels_per_degree;
        let radius = (3.0 * sigma).ceil() as usize;
        let g = gaussian(sigma, radius);
        let times = |f: &dyn Fn(f64) -> f64| g.iter().zip(offsets(radius)).map(|(g, x)| f(x) * g).collect();
        let edge: Vec<f64> = times(&|x| -x);
        let point: Vec<f64> = times(&|x| x * x / (sigma * sigma) - 1.0);
        Detector { smooth: normalized(&g), edge: balanced(&edge), point: balanced(&point) }
    }

    /// `lightness` is `Y` of the opponent channels.
    pub(super) fn detect(&self, lightness: &Plane) -> Features {
        let values = lightness.values.iter().map(|y| (y + 16.0) / 116.0).collect();
        let y = Plane::new(lightness.width, values);
        let magnitude = |derivative: &[f64]| {
            let (dx, dy) = (y.filtered(derivative, &self.smooth), y.filtered(&self.smooth, derivative));
            dx.zip(&dy, |x, y| (x * x + y * y).sqrt())
        };
        Features { edges: magnitude(&self.edge), points: magnitude(&self.point) }
    }
}

impl Features {
    /// The difference in [0, 1] of each pixel. [Andersson2020]
    pub(super) fn difference(&self, other: &Features) -> impl Iterator<Item = f64> {
        let distance = |a: &Plane, b: &Plane| a.zip(b, |a, b| (a - b).abs());
        let edges = distance(&self.edges, &other.edges);
        let points = distance(&self.points, &other.points);
        edges.zip(&points, f64::max).values.into_iter().map(|d| (d * core::f64::consts::FRAC_1_SQRT_2).sqrt())
    }
}

/// Positive weights scaled to the sum 1, negative ones to -1.
fn balanced(weights: &[f64]) -> Vec<f64> {
    let sum = |sign: f64| weights.iter().map(|w| (sign * w).max(0.0)).sum::<f64>();
    let (above, below) = (sum(1.0), sum(-1.0));
    weights.iter().map(|w| if *w > 0.0 { w / above } else { w / below }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_an_edge_of_its_height() {
        let step = |h: f64| {
            Plane::new(60, (0..60 * 40).map(|i| if i % 60 < 30 { -16.0 } else { 116.0 * h - 16.0 }).collect())
        };
        let detector = Detector::new(67.0);
        let (flat, edge) = (detector.detect(&step(0.0)), detector.detect(&step(0.5)));
        let at = edge.edges.values[20 * 60 + 30];
        // The pixel in the middle of the filter has no weight, so the step is seen whole.
        assert!((at - 0.5).abs() < 1e-12, "{at}");
        let seen: Vec<f64> = edge.difference(&flat).collect();
        assert!((seen[20 * 60 + 30] - (0.5f64 / 2.0f64.sqrt()).sqrt()).abs() < 1e-12);
        assert!(seen[20 * 60] < 1e-7, "far from the edge there is nothing");
    }
}
