//! Squared errors: [`mse`], [`psnr`].

use core::f64::consts::LN_10;

use sparrow_math::Real;

use super::Pair;
use super::display::srgb;

/// Mean of `(p - r)²` over pixels and channels, of linear values.
pub fn mse(pair: &Pair) -> f64 {
    mean_square(pair.pixels())
}

/// Peak signal-to-noise ratio `10 log10(1 / mse)` in dB, of sRGB-encoded values clamped to [0, 1]; infinite where
/// they are equal.
pub fn psnr(pair: &Pair) -> f64 {
    let mse = mean_square(pair.pixels().map(|(p, r)| (p.map(srgb), r.map(srgb))));
    if mse > 0.0 { -10.0 * Real::ln(mse) / LN_10 } else { mse + f64::INFINITY }
}

fn mean_square(pixels: impl Iterator<Item = ([f64; 3], [f64; 3])>) -> f64 {
    let (mut sum, mut n) = (0.0, 0.0);
    for (p, r) in pixels {
        sum += (0..3).map(|c| (p[c] - r[c]) * (p[c] - r[c])).sum::<f64>();
        n += 3.0;
    }
    sum / n
}

#[cfg(test)]
mod tests {
    use super::super::tests::{WIDTH, near, pattern, pictures};
    use super::*;

    #[test]
    fn mse_agrees_with_numpy() {
        let (p, r) = (pattern(19 * 17, 37, 101), pattern(19 * 17, 53, 97));
        near(mse(&Pair::new(19, &p, &r).unwrap()), 0.40492045399574306);
    }

    #[test]
    fn psnr_agrees_with_scikit_image() {
        let [p, r] = pictures();
        let pair = Pair::new(WIDTH, &p, &r).unwrap();
        assert!((psnr(&pair) - 18.722_035_336_275_45).abs() < 1e-9, "{}", psnr(&pair));
    }

    #[test]
    fn psnr_counts_what_a_display_shows() {
        // Codes 0 and 51 of 255, 0.2 apart: 10 log10(1 / 0.04) = 13.979 dB.
        let (p, r) = ([[0.033_104_767; 3]], [[0.0; 3]]);
        assert!((psnr(&Pair::new(1, &p, &r).unwrap()) - 13.979_400_086_720_377).abs() < 1e-5);
        let (p, r) = ([[1.0; 3]], [[7.0; 3]]);
        assert!(psnr(&Pair::new(1, &p, &r).unwrap()).is_infinite(), "both are white");
        let nan = [[f32::NAN; 3]];
        assert!(psnr(&Pair::new(1, &nan, &r).unwrap()).is_nan());
    }
}
