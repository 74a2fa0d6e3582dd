//! What a display shows of a linear value.

use sparrow_math::Real;

/// Brought into [0, 1]; a NaN stays one.
pub(super) fn shown(linear: f64) -> f64 {
    linear.clamp(0.0, 1.0)
}

/// The sRGB-encoded value in [0, 1], not rounded to a code. [IEC61966, sec. 5.3]
pub(super) fn srgb(linear: f64) -> f64 {
    let v = shown(linear);
    // In this order a NaN stays one.
    if v > 0.003_130_8 { 1.055 * Real::pow(v, 1.0 / 2.4) - 0.055 } else { 12.92 * v }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Encoding;

    #[test]
    fn codes_come_back() {
        for code in 0..=255 {
            let v = f64::from(code) / 255.0;
            // The curve's two constants are rounded, so its pieces meet within 1e-7.
            assert!((srgb(Encoding::Srgb.to_linear(v)) - v).abs() < 1e-7, "{code}");
        }
        assert!(srgb(-1.0).abs() < 1e-15 && (srgb(9.0) - 1.0).abs() < 1e-15 && srgb(f64::NAN).is_nan());
    }
}
