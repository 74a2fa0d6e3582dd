//! RGB colour spaces: [`ColorSpace`].

use std::sync::OnceLock;

use crate::matrix::{self, Mat3};
use crate::{DenseSpectrum, cie, named};

/// The linear RGB spaces of pbrt-v4.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ColorSpace {
    /// ITU-R BT.709 primaries, D65.
    #[default]
    Srgb,
    /// The primaries pbrt-v4 gives P3, D65. (Green at .265 .690, as SMPTE RP 431-2.)
    DciP3,
    /// ITU-R BT.2020, D65.
    Rec2020,
    /// ACES2065-1, with the ACES white near D60.
    Aces2065_1,
}

impl ColorSpace {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Srgb, Self::DciP3, Self::Rec2020, Self::Aces2065_1];

    /// The space a scene calls `srgb`, `dci-p3`, `rec2020` or `aces2065-1`; case does not matter.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|s| s.name().eq_ignore_ascii_case(name))
    }

    /// The name a scene gives.
    pub fn name(self) -> &'static str {
        match self {
            Self::Srgb => "srgb",
            Self::DciP3 => "dci-p3",
            Self::Rec2020 => "rec2020",
            Self::Aces2065_1 => "aces2065-1",
        }
    }

    /// Chromaticities x, y of red, green and blue.
    pub fn primaries(self) -> [[f64; 2]; 3] {
        match self {
            Self::Srgb => [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]],
            Self::DciP3 => [[0.68, 0.32], [0.265, 0.690], [0.15, 0.06]],
            Self::Rec2020 => [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]],
            Self::Aces2065_1 => [[0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.077]],
        }
    }

    /// The spectrum that RGB (1, 1, 1) stands for: D65, for ACES D60, with Y = 1.
    pub fn illuminant(self) -> &'static DenseSpectrum {
        named::builtin(match self {
            Self::Srgb | Self::DciP3 | Self::Rec2020 => "stdillum-D65",
            Self::Aces2065_1 => "illum-acesD60",
        })
    }

    /// Chromaticity x, y of the white point, that of [`illuminant`](Self::illuminant).
    pub fn white(self) -> [f64; 2] {
        cie::chromaticity(self.conversions().white)
    }

    /// Matrix from RGB to XYZ, rows first. RGB white has Y = 1.
    pub fn rgb_to_xyz(self) -> [[f32; 3]; 3] {
        matrix::to_f32(&self.conversions().to_xyz)
    }

    /// Matrix from XYZ to RGB, rows first.
    pub fn xyz_to_rgb(self) -> [[f32; 3]; 3] {
        matrix::to_f32(&self.conversions().from_xyz)
    }

    /// Weights of R, G and B in the luminance: the middle row of [`rgb_to_xyz`](Self::rgb_to_xyz).
    pub fn luminance_weights(self) -> [f32; 3] {
        self.rgb_to_xyz()[1]
    }

    /// Matrix that takes RGB of this space to RGB of another, without adapting the white.
    pub fn to_space(self, other: Self) -> [[f32; 3]; 3] {
        matrix::to_f32(&matrix::product(&other.conversions().from_xyz, &self.conversions().to_xyz))
    }

    pub(crate) fn conversions(self) -> &'static Conversions {
        static ALL: OnceLock<[Conversions; 4]> = OnceLock::new();
        let all = ALL.get_or_init(|| ColorSpace::ALL.map(Conversions::of));
        &all[self as usize]
    }
}

/// What is derived from primaries and illuminant, in double precision.
pub(crate) struct Conversions {
    /// XYZ of the illuminant, Y = 1.
    pub(crate) white: [f64; 3],
    pub(crate) to_xyz: Mat3,
    pub(crate) from_xyz: Mat3,
}

impl Conversions {
    fn of(space: ColorSpace) -> Self {
        let white = cie::xyz_of(space.illuminant());
        // Columns are the primaries' XYZ at Y = 1, except that green's and blue's y may be negative.
        let columns = space.primaries().map(|[x, y]| [x / y, 1.0, (1.0 - x - y) / y]);
        let primaries = matrix::transpose(&columns);
        let gains = matrix::inverse(&primaries).map_or([0.0; 3], |m| matrix::apply(&m, white));
        let to_xyz = matrix::product(&primaries, &matrix::diagonal(gains));
        let from_xyz = matrix::inverse(&to_xyz).unwrap_or(matrix::IDENTITY);
        Self { white, to_xyz, from_xyz }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn white_points_are_standard() {
        for (s, x, y) in [(ColorSpace::Srgb, 0.3127, 0.3290), (ColorSpace::Aces2065_1, 0.32168, 0.33767)] {
            let w = s.white();
            assert!((w[0] - x).abs() < 2e-4 && (w[1] - y).abs() < 2e-4, "{s:?} {w:?}");
        }
        for s in ColorSpace::ALL {
            assert!((s.conversions().white[1] - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn srgb_matrix_is_the_standard_one() {
        // IEC 61966-2-1 rounds its white to four digits; ours comes from the spectrum.
        let expect = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        let m = ColorSpace::Srgb.rgb_to_xyz();
        for i in 0..3 {
            for j in 0..3 {
                assert!((m[i][j] - expect[i][j]).abs() < 6e-4, "{m:?}");
            }
        }
    }

    #[test]
    fn white_maps_to_one_and_back() {
        for s in ColorSpace::ALL {
            let c = s.conversions();
            let rgb = matrix::apply(&c.from_xyz, c.white);
            assert!(rgb.iter().all(|v| (v - 1.0).abs() < 1e-12), "{s:?} {rgb:?}");
            assert_eq!(ColorSpace::from_name(&s.name().to_uppercase()), Some(s));
            assert!((s.luminance_weights().iter().sum::<f32>() - 1.0).abs() < 1e-6);
        }
        assert_eq!(ColorSpace::from_name("adobe"), None);
        assert_eq!(ColorSpace::default().to_space(ColorSpace::Srgb)[0][0], 1.0);
    }
}
