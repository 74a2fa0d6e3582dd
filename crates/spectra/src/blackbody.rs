//! Thermal radiation and the CIE daylights.

use std::sync::OnceLock;

use sparrow_math::Real;

use crate::named::tables;
use crate::{DenseSpectrum, cie};

/// Planck's law: radiance of a black body per wavelength, in W/(m² sr m). Zero for `kelvin <= 0`.
///
/// Constants as in pbrt-v4 (CODATA 2010), so that scenes keep their colours.
pub fn blackbody(lambda_nm: f32, kelvin: f32) -> f64 {
    if kelvin <= 0.0 || lambda_nm <= 0.0 {
        return 0.0;
    }
    const C: f64 = 299_792_458.0;
    const H: f64 = 6.626_069_57e-34;
    const K_B: f64 = 1.380_648_8e-23;
    let l = f64::from(lambda_nm) * 1e-9;
    let x = H * C / (l * K_B * f64::from(kelvin));
    // Beyond this the exponential overflows while the radiance is far below the smallest f32.
    if x > 700.0 {
        return 0.0;
    }
    2.0 * H * C * C / (l * l * l * l * l * (Real::exp(x) - 1.0))
}

/// [`blackbody`] divided by its largest value over all wavelengths, which Wien's law locates.
///
/// That peak may lie outside the visible range. Black for `kelvin <= 0`.
pub fn blackbody_normalized(kelvin: f32) -> DenseSpectrum {
    let peak_nm = 2.897_772_1e6_f64 as f32 / kelvin;
    let peak = blackbody(peak_nm, kelvin);
    if !(peak > 0.0 && peak.is_finite()) {
        return DenseSpectrum::constant(0.0);
    }
    DenseSpectrum::from_fn(|l| (blackbody(l, kelvin) / peak) as f32)
}

/// The CIE daylight of a nominal colour temperature (6500 for D65), in relative units near one.
///
/// The nominal temperature is corrected for the change of Planck's second constant, by 1.4388 / 1.438.
/// Below 4000 K, where daylight is not defined, a black body with Y = 1 takes its place, as in pbrt-v4.
///
/// Source: [CIE15, eq. 3.1 to 3.4].
pub fn daylight(kelvin: f32) -> DenseSpectrum {
    let t = f64::from(kelvin) * 1.4388 / 1.4380;
    if t < 4000.0 {
        let s = blackbody_normalized(t as f32);
        let y = cie::photometric(&s);
        return if y > 0.0 { s.scaled(cie::Y_INTEGRAL / y) } else { s };
    }
    let q = 1e3 / t;
    let x = if t <= 7000.0 {
        ((-4.6070 * q + 2.9678) * q + 0.09911) * q + 0.244063
    } else {
        ((-2.0064 * q + 1.9018) * q + 0.24748) * q + 0.237040
    };
    let y = (-3.0 * x + 2.870) * x - 0.275;
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
    let m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
    let [s0, s1, s2] = components();
    let mut i = 0;
    s0.map(|v| {
        let d = f64::from(v) + f64::from(s1.values()[i]) * m1 + f64::from(s2.values()[i]) * m2;
        i += 1;
        (d * 0.01) as f32
    })
}

/// Mean and the two variations of daylight.
fn components() -> &'static [DenseSpectrum; 3] {
    static COMPONENTS: OnceLock<[DenseSpectrum; 3]> = OnceLock::new();
    COMPONENTS.get_or_init(|| {
        let all = tables(include_str!("data/daylight.txt"));
        ["S0", "S1", "S2"].map(|name| {
            let samples = all.iter().find(|s| s.0 == name).map_or(&[][..], |s| &s.1);
            DenseSpectrum::from_samples(samples)
        })
    })
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;
    use crate::{named_spectrum, xyz_of};

    #[test]
    fn planck_at_6000_kelvin() {
        // Reference values printed in pbrt-v4's own tests of Blackbody.
        for (nm, t, expect) in
            [(483.0, 6000.0, 3.1849e13), (600.0, 6000.0, 2.86772e13), (500.0, 3700.0, 1.59845e12)]
        {
            let l = blackbody(nm, t);
            assert!((l / expect - 1.0).abs() < 1e-3, "{nm} nm, {t} K: {l:e}");
        }
        assert_eq!(blackbody(500.0, 0.0), 0.0);
        assert_eq!(blackbody(500.0, -3.0), 0.0);
        assert_eq!(blackbody(360.0, 1.0), 0.0);
    }

    #[test]
    fn the_peak_is_where_wien_says_and_one_high() {
        for t in [3600.0, 4500.0, 5800.0, 7500.0] {
            let s = blackbody_normalized(t);
            let at = s.values().iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap().0;
            let wien = 2.897_772e6 / t;
            assert!((360.0 + at as f32 - wien).abs() <= 1.0, "{t} K: {} against {wien}", 360 + at);
            assert!((s.max_value() - 1.0).abs() < 1e-4, "{t} K: {}", s.max_value());
        }
        assert_eq!(blackbody_normalized(0.0).max_value(), 0.0);
    }

    #[test]
    fn daylights_have_their_chromaticity() {
        for (t, name) in [(5000.0, "stdillum-D50"), (6500.0, "stdillum-D65"), (6000.0, "illum-acesD60")] {
            let d = cie::chromaticity(xyz_of(&daylight(t)));
            let s = cie::chromaticity(xyz_of(&named_spectrum(name).unwrap()));
            assert!((d[0] - s[0]).abs() < 2e-4 && (d[1] - s[1]).abs() < 2e-4, "{name}: {d:?} {s:?}");
        }
        // Blue sky, above 7000 K: CIE 15 gives D75 as 0.2990, 0.3149.
        let d75 = cie::chromaticity(xyz_of(&daylight(7500.0)));
        assert!((d75[0] - 0.2990).abs() < 3e-4 && (d75[1] - 0.3149).abs() < 3e-4, "{d75:?}");
        assert!((xyz_of(&daylight(3000.0))[1] - 1.0).abs() < 1e-5);
    }
}
