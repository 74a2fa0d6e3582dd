//! Structural similarity: [`ssim`].

use super::Pair;
use super::display::srgb;
use super::plane::{Plane, gaussian, normalized};

/// Width of the Gaussian window, in pixels. [Wang2004, sec. III-C]
const SIGMA: f64 = 1.5;
/// The window has 11 x 11 pixels.
const RADIUS: usize = 5;
/// `C1 = (K1 L)²` and `C2 = (K2 L)²` with the range L = 1. [Wang2004, sec. III-C]
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// Mean structural similarity of sRGB-encoded values clamped to [0, 1], over the channels and all places where the
/// window lies within the picture [Wang2004, eq. 13]; 1 where they are equal. `None` below 11 x 11 pixels.
///
/// scikit-image gives it as `structural_similarity(a, b, data_range=1, channel_axis=-1, gaussian_weights=True,
/// sigma=1.5, use_sample_covariance=False)`.
pub fn ssim(pair: &Pair) -> Option<f64> {
    let (width, height) = (pair.width(), pair.picture().len() / pair.width());
    if width.min(height) <= 2 * RADIUS {
        return None;
    }
    let sum: f64 = (0..3)
        .map(|c| {
            let channel =
                |v: &[[f32; 3]]| Plane::new(width, v.iter().map(|p| srgb(f64::from(p[c]))).collect());
            sum_inside(&similarity(&channel(pair.picture()), &channel(pair.reference())), height)
        })
        .sum();
    Some(sum / (3 * (width - 2 * RADIUS) * (height - 2 * RADIUS)) as f64)
}

/// The index at every place. [Wang2004, eq. 13]
fn similarity(x: &Plane, y: &Plane) -> Plane {
    let window = normalized(&gaussian(SIGMA, RADIUS));
    let mean = |p: &Plane| p.filtered(&window, &window);
    let moment = |a: &Plane, b: &Plane| mean(&a.zip(b, |a, b| a * b));
    let (mu_x, mu_y) = (mean(x), mean(y));
    let (xx, yy, xy) = (moment(x, x), moment(y, y), moment(x, y));
    let values = (0..x.values.len()).map(|i| {
        let (mu_x, mu_y) = (mu_x.values[i], mu_y.values[i]);
        let var_x = xx.values[i] - mu_x * mu_x;
        let var_y = yy.values[i] - mu_y * mu_y;
        let cov = xy.values[i] - mu_x * mu_y;
        (2.0 * mu_x * mu_y + C1) * (2.0 * cov + C2)
            / ((mu_x * mu_x + mu_y * mu_y + C1) * (var_x + var_y + C2))
    });
    Plane::new(x.width, values.collect())
}

/// Sum over the places at least [`RADIUS`] away from every edge.
fn sum_inside(p: &Plane, height: usize) -> f64 {
    let rows = p.values.chunks_exact(p.width).skip(RADIUS).take(height - 2 * RADIUS);
    rows.flat_map(|row| &row[RADIUS..p.width - RADIUS]).sum()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{WIDTH, pictures};
    use super::*;

    #[test]
    fn agrees_with_scikit_image() {
        let [p, r] = pictures();
        let got = ssim(&Pair::new(WIDTH, &p, &r).unwrap()).unwrap();
        assert!((got - 0.908_063_246_630_074_9).abs() < 1e-12, "{got}");
    }

    #[test]
    fn ends_are_known() {
        let [_, r] = pictures();
        let same = ssim(&Pair::new(WIDTH, &r, &r).unwrap()).unwrap();
        assert!((same - 1.0).abs() < 1e-12);
        // Even pictures have no structure: (2 x y + C1) / (x² + y² + C1) of black and white is C1 / (1 + C1).
        let (black, white) = (vec![[0.0; 3]; 121], vec![[1.0; 3]; 121]);
        let least = ssim(&Pair::new(11, &black, &white).unwrap()).unwrap();
        assert!((least - C1 / (1.0 + C1)).abs() < 1e-12, "{least}");
        assert_eq!(
            ssim(&Pair::new(10, &white[..120], &black[..120]).unwrap()),
            None,
            "the window does not fit"
        );
    }
}
