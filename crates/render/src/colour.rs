//! What a path carries: values at wavelengths, or red, green and blue.

use sparrow_scene::{ColourMode, FilmDesc, SpectrumDesc};
use sparrow_spectra::{
    ColorSpace, DenseSpectrum, N_LAMBDA, RgbRole, Spectrum, Wavelengths, cie, photometric, rgb_to_sigmoid,
};

use crate::spectrum::{SceneSpectrum, light_table};

/// Wavelengths in nm that stand for red, green and blue where a model asks for one: the dominant wavelengths of the primaries of sRGB,
/// where the line from its white through each meets the spectral locus of the CIE 1931 observer.
const PRIMARIES: [f32; 3] = [611.3, 549.1, 464.3];

/// What the numbers of a path's [`Spectrum`] are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Carrier {
    /// Values at the path's wavelengths.
    Wavelengths,
    /// Red, green, blue, and green again, of a linear RGB space.
    ///
    /// The fourth is green so that nothing is ever divided by it that is not there; as a copy it changes no colour, and makes the
    /// means with which models weigh their lobes nearer to luminance.
    Rgb(ColorSpace),
}

impl Carrier {
    /// As the film asks.
    pub(crate) fn new(film: &FilmDesc) -> Carrier {
        match film.colour {
            ColourMode::Spectral => Carrier::Wavelengths,
            ColourMode::Rgb => Carrier::Rgb(film.color_space),
        }
    }

    /// The space of red, green and blue, where these are carried.
    pub(crate) fn space(self) -> Option<ColorSpace> {
        match self {
            Carrier::Wavelengths => None,
            Carrier::Rgb(space) => Some(space),
        }
    }

    /// The wavelengths of a path, from a uniform number; for RGB always the same.
    #[inline]
    pub(crate) fn wavelengths(self, u: f32) -> Wavelengths {
        match self {
            Carrier::Wavelengths => Wavelengths::sample_visible(u),
            Carrier::Rgb(_) => Wavelengths::with_pdf(four(PRIMARIES), [1.0; N_LAMBDA]),
        }
    }

    /// [`wavelengths`](Self::wavelengths) of each of the first `n` of `u`: in nm, and their densities. The columns are as long as `n`,
    /// rounded up to whole registers.
    pub(crate) fn wavelengths_many(
        self,
        u: &[f32],
        n: usize,
        mut nm: [&mut [f32]; N_LAMBDA],
        mut pdf: [&mut [f32]; N_LAMBDA],
    ) {
        match self {
            Carrier::Wavelengths => Wavelengths::sample_visible_many(u, n, nm, pdf),
            Carrier::Rgb(_) => {
                let same = self.wavelengths(0.0);
                nm.iter_mut().zip(same.lambda).for_each(|(column, x)| column[..n].fill(x));
                pdf.iter_mut().zip(same.pdf).for_each(|(column, x)| column[..n].fill(x));
            }
        }
    }

    /// A spectrum of the scene, ready for lookup; `role` says what RGB values mean.
    ///
    /// In RGB a tabulated reflectance, absorption or index is its mean as the film's colour space sees it under its white, so
    /// that what is the same at all wavelengths stays so.
    pub(crate) fn spectrum(self, desc: &SpectrumDesc, role: RgbRole) -> SceneSpectrum {
        let Carrier::Rgb(space) = self else { return SceneSpectrum::new(desc, role) };
        let rgb = match (desc, role) {
            (SpectrumDesc::Constant(v), RgbRole::Albedo | RgbRole::Unbounded) => [*v; 3],
            (SpectrumDesc::Rgb(rgb, from), _) => converted(*rgb, *from, space),
            (_, RgbRole::Illuminant) => {
                seen(&SceneSpectrum::new(desc, role).to_dense(), space, cie::Y_INTEGRAL)
            }
            (_, RgbRole::Albedo | RgbRole::Unbounded) => {
                let lit = SceneSpectrum::new(desc, role).to_dense().mul(space.illuminant());
                seen(&lit, space, photometric(space.illuminant()))
            }
        };
        channels(rgb, role)
    }

    /// The emission of a light, brought to unit luminous output before its scale.
    pub(crate) fn emission(self, desc: &SpectrumDesc) -> SceneSpectrum {
        match (self, desc) {
            (Carrier::Wavelengths, _) => SceneSpectrum::from(light_table(desc)),
            (Carrier::Rgb(space), SpectrumDesc::Rgb(rgb, from)) => {
                channels(converted(*rgb, *from, space), RgbRole::Illuminant)
            }
            (Carrier::Rgb(space), _) => channels(seen(&light_table(desc), space, 1.0), RgbRole::Illuminant),
        }
    }

    /// Luminance of an emission.
    pub(crate) fn luminance(self, emission: &SceneSpectrum) -> f32 {
        match (self, emission) {
            (Carrier::Rgb(space), SceneSpectrum::Channels(c)) => {
                let [r, g, b] = space.luminance_weights();
                r * c[0] + g * c[1] + b * c[2]
            }
            _ => photometric(&emission.to_dense()),
        }
    }

    /// What an RGB value of an image stands for.
    #[inline]
    pub(crate) fn of_image(
        self,
        rgb: [f32; 3],
        space: ColorSpace,
        role: RgbRole,
        w: &Wavelengths,
    ) -> Spectrum<f32> {
        if let Carrier::Rgb(own) = self {
            return Spectrum(four(bounded(converted(rgb, space, own), role)));
        }
        if role == RgbRole::Albedo {
            return rgb_to_sigmoid(rgb.map(|c| c.clamp(0.0, 1.0)), space).at(w);
        }
        let scale = 2.0 * rgb[0].max(rgb[1]).max(rgb[2]);
        if scale <= 0.0 {
            return Spectrum::ZERO;
        }
        let s = rgb_to_sigmoid(rgb.map(|c| (c / scale).clamp(0.0, 1.0)), space).at(w) * scale;
        if role == RgbRole::Illuminant { s * space.illuminant().at(w) } else { s }
    }
}

/// Red, green, blue, and green again.
#[inline]
pub(crate) fn four(rgb: [f32; 3]) -> [f32; N_LAMBDA] {
    CHANNEL.map(|i| rgb[i])
}
/// Which channel stands in each place of a spectrum.
pub(crate) const CHANNEL: [usize; N_LAMBDA] = [0, 1, 2, 1];

/// RGB of one space in another. White is not adapted.
#[inline]
pub(crate) fn converted(rgb: [f32; 3], from: ColorSpace, to: ColorSpace) -> [f32; 3] {
    if from == to {
        return rgb;
    }
    from.to_space(to).map(|m| m[0] * rgb[0] + m[1] * rgb[1] + m[2] * rgb[2])
}

/// RGB of a spectrum whose luminance is its integral over y-bar, divided by `unit`.
fn seen(s: &DenseSpectrum, space: ColorSpace, unit: f32) -> [f32; 3] {
    let xyz = [cie::x(), cie::y(), cie::z()].map(|bar| (bar.inner_product(s) / f64::from(unit)) as f32);
    space.xyz_to_rgb().map(|m| m[0] * xyz[0] + m[1] * xyz[1] + m[2] * xyz[2])
}

/// Brought to where values of that role may lie: colours outside the space have negative channels.
#[inline]
fn bounded(rgb: [f32; 3], role: RgbRole) -> [f32; 3] {
    let most = if role == RgbRole::Albedo { 1.0 } else { f32::INFINITY };
    rgb.map(|c| c.max(0.0).min(most))
}

fn channels(rgb: [f32; 3], role: RgbRole) -> SceneSpectrum {
    SceneSpectrum::Channels(Spectrum(four(bounded(rgb, role))))
}

#[cfg(test)]
mod tests {
    use super::*;

    const RGB: Carrier = Carrier::Rgb(ColorSpace::Srgb);

    fn rgb_of(s: &SceneSpectrum) -> [f32; 3] {
        let c = s.at(&RGB.wavelengths(0.3));
        [c[0], c[1], c[2]]
    }

    fn close(a: [f32; 3], b: [f32; 3], tolerance: f32) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
    }

    #[test]
    fn what_is_the_same_at_all_wavelengths_is_grey() {
        let flat = SpectrumDesc::Samples([(300.0, 0.7), (900.0, 0.7)].into());
        for role in [RgbRole::Albedo, RgbRole::Unbounded] {
            let rgb = rgb_of(&RGB.spectrum(&flat, role));
            assert!(close(rgb, [0.7; 3], 1e-3), "{rgb:?}");
        }
    }

    #[test]
    fn spectra_of_rgb_values_return_to_them() {
        // By way of the spectrum that the value stands for, as a measured one would come.
        for rgb in [[0.63, 0.065, 0.05], [0.14, 0.45, 0.091], [0.73; 3]] {
            let own = SpectrumDesc::Rgb(rgb, ColorSpace::Srgb);
            let table = SceneSpectrum::new(&own, RgbRole::Albedo).to_dense();
            let samples: Vec<(f32, f32)> = (0..471).map(|i| (360.0 + i as f32, table.values()[i])).collect();
            let back = rgb_of(&RGB.spectrum(&SpectrumDesc::Samples(samples.into()), RgbRole::Albedo));
            assert!(close(back, rgb, 2e-3), "{rgb:?} {back:?}");
            assert!(close(rgb_of(&RGB.spectrum(&own, RgbRole::Albedo)), rgb, 0.0));
        }
    }

    #[test]
    fn lights_have_the_luminance_of_their_scale_in_both_modes() {
        for desc in [
            SpectrumDesc::Blackbody(2800.0),
            SpectrumDesc::Constant(3.0),
            SpectrumDesc::Rgb([1.0; 3], ColorSpace::Srgb),
        ] {
            for carrier in [Carrier::Wavelengths, RGB] {
                let y = carrier.luminance(&carrier.emission(&desc));
                assert!((y - 1.0).abs() < 1e-3, "{desc:?} {carrier:?} {y}");
            }
        }
    }

    #[test]
    fn colours_of_a_wider_space_stay_within_bounds() {
        let green = [0.0, 1.0, 0.0];
        let w = RGB.wavelengths(0.0);
        let s = RGB.of_image(green, ColorSpace::Rec2020, RgbRole::Albedo, &w);
        assert!(s.0.iter().all(|c| (0.0..=1.0).contains(c)), "{s:?}");
    }
}
