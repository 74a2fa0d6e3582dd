//! One channel of a picture, and separable filters of it: [`Plane`].

use sparrow_math::Real;

/// Numbers row by row from the top left.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) values: Vec<f64>,
}

impl Plane {
    pub(super) fn new(width: usize, values: Vec<f64>) -> Plane {
        Plane { width, values }
    }

    /// A number made of each place's numbers in both.
    pub(super) fn zip(&self, other: &Plane, f: impl Fn(f64, f64) -> f64) -> Plane {
        let values = self.values.iter().zip(&other.values).map(|(a, b)| f(*a, *b)).collect();
        Plane::new(self.width, values)
    }

    /// Correlates rows with `x` and columns with `y`, of odd lengths, centred. Beyond an edge its value goes on.
    pub(super) fn filtered(&self, x: &[f64], y: &[f64]) -> Plane {
        self.along_rows(x).along_columns(y)
    }

    fn along_rows(&self, weights: &[f64]) -> Plane {
        let (width, radius) = (self.width, weights.len() / 2);
        let mut padded = vec![0.0; width + 2 * radius];
        let mut out = vec![0.0; self.values.len()];
        for (row, sums) in self.values.chunks_exact(width).zip(out.chunks_exact_mut(width)) {
            padded[..radius].fill(row[0]);
            padded[radius..radius + width].copy_from_slice(row);
            padded[radius + width..].fill(row[width - 1]);
            for (i, w) in weights.iter().enumerate() {
                add_scaled(sums, *w, &padded[i..i + width]);
            }
        }
        Plane::new(width, out)
    }

    fn along_columns(&self, weights: &[f64]) -> Plane {
        let (width, radius) = (self.width, weights.len() / 2);
        let height = self.values.len() / width;
        let mut out = vec![0.0; self.values.len()];
        for (y, sums) in out.chunks_exact_mut(width).enumerate() {
            for (i, w) in weights.iter().enumerate() {
                let from = (y + i).saturating_sub(radius).min(height - 1);
                add_scaled(sums, *w, &self.values[from * width..(from + 1) * width]);
            }
        }
        Plane::new(width, out)
    }
}

fn add_scaled(sums: &mut [f64], w: f64, values: &[f64]) {
    sums.iter_mut().zip(values).for_each(|(s, v)| *s += w * v);
}

/// `exp(-x² / (2 sigma²))` at the whole numbers within `radius`.
pub(super) fn gaussian(sigma: f64, radius: usize) -> Vec<f64> {
    offsets(radius).map(|x| Real::exp(-x * x / (2.0 * sigma * sigma))).collect()
}

/// The whole numbers from `-radius` to `radius`.
pub(super) fn offsets(radius: usize) -> impl Iterator<Item = f64> {
    (0..=2 * radius).map(move |i| i as f64 - radius as f64)
}

/// Scaled to the sum 1.
pub(super) fn normalized(weights: &[f64]) -> Vec<f64> {
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| w / sum).collect()
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn edges_go_on() {
        let p = Plane::new(3, vec![1.0, 2.0, 4.0, 8.0, 16.0, 32.0]);
        assert_eq!(p.filtered(&[1.0, 0.0, 0.0], &[1.0]).values, [1.0, 1.0, 2.0, 8.0, 8.0, 16.0]);
        assert_eq!(p.filtered(&[1.0], &[0.0, 0.0, 1.0]).values, [8.0, 16.0, 32.0, 8.0, 16.0, 32.0]);
        // Wider than the picture.
        let wide = p.filtered(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], &[1.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(wide.values, [4.0, 4.0, 4.0, 4.0, 4.0, 4.0]);
    }

    #[test]
    fn a_gaussian_is_one_in_the_middle() {
        let g = gaussian(2.0, 3);
        assert_eq!((g.len(), g[3]), (7, 1.0));
        assert!((g[1] - 0.606_530_659_712_633_4).abs() < 1e-15, "exp(-1/2)");
        assert!((normalized(&g).iter().sum::<f64>() - 1.0).abs() < 1e-15);
    }
}
