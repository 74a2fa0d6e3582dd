//! The CIE 1931 observer: matching functions, XYZ, luminance.

use std::sync::OnceLock;

use crate::DenseSpectrum;
use crate::named::tables;

/// The integral of y-bar as pbrt-v4 rounds it, in nm. The table sums to the same within 1e-6.
pub const Y_INTEGRAL: f32 = 106.856_895;

/// x-bar of the CIE 1931 2 degree observer.
pub fn x() -> &'static DenseSpectrum {
    &observer()[0]
}

/// y-bar, the luminous efficiency.
pub fn y() -> &'static DenseSpectrum {
    &observer()[1]
}

/// z-bar.
pub fn z() -> &'static DenseSpectrum {
    &observer()[2]
}

/// CIE XYZ of a spectrum, scaled so that the constant spectrum 1 has Y = 1.
pub fn xyz_of(s: &DenseSpectrum) -> [f64; 3] {
    [x(), y(), z()].map(|bar| bar.inner_product(s) / f64::from(Y_INTEGRAL))
}

/// The integral of the spectrum times y-bar, in nm times the spectrum's unit.
///
/// This is what pbrt-v4 divides every light's scale by, so that a light's number is its luminance:
/// there is no factor of 683 lm/W. For [`RgbRole::Illuminant`](crate::RgbRole) pass the illuminant
/// alone, without the RGB multiplier.
pub fn photometric(s: &DenseSpectrum) -> f32 {
    y().inner_product(s) as f32
}

/// Chromaticity x, y of XYZ; zero for black.
pub fn chromaticity(xyz: [f64; 3]) -> [f64; 2] {
    let sum = xyz[0] + xyz[1] + xyz[2];
    if sum > 0.0 { [xyz[0] / sum, xyz[1] / sum] } else { [0.0; 2] }
}

fn observer() -> &'static [DenseSpectrum; 3] {
    static OBSERVER: OnceLock<[DenseSpectrum; 3]> = OnceLock::new();
    OBSERVER.get_or_init(|| {
        let bars = tables(include_str!("data/cie1931.txt"));
        ["x", "y", "z"].map(|name| {
            let samples = bars.iter().find(|b| b.0 == name).map_or(&[][..], |b| &b.1);
            DenseSpectrum::from_samples(samples)
        })
    })
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn matching_functions_have_their_integrals() {
        // The published 5 nm sums are 21.3714, 21.3711, 21.3715 [CIE15], times 5 nm.
        for (bar, integral) in [(x(), 106.8654), (y(), 106.8569), (z(), 106.8922)] {
            assert!((bar.sum() - integral).abs() < 2e-3, "{} against {integral}", bar.sum());
        }
        assert!((y().sum() / f64::from(Y_INTEGRAL) - 1.0).abs() < 1e-6, "{}", y().sum());
        assert_eq!(y().value(555.0), 1.0);
        assert_eq!(x().value(600.0), 1.0622);
        assert_eq!(z().value(450.0), 1.77211);
    }

    #[test]
    fn the_equal_energy_spectrum_is_white() {
        let [x, y] = chromaticity(xyz_of(&DenseSpectrum::constant(1.0)));
        assert!((x - 0.33331).abs() < 1e-4 && (y - 0.33329).abs() < 1e-4, "{x} {y}");
    }
}
