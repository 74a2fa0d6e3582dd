//! An image in memory: [`Image`].

use half::f16;

use crate::{Encoding, ImageError};

/// Samples as the file stored them, pixel by pixel from the top left, channels side by side.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// 8-bit codes, to be decoded with the image's [`Encoding`].
    U8(Vec<u8>),
    /// Half floats, linear.
    F16(Vec<f16>),
    /// Floats, linear.
    F32(Vec<f32>),
}

impl Pixels {
    /// Number of samples.
    pub fn len(&self) -> usize {
        match self {
            Pixels::U8(v) => v.len(),
            Pixels::F16(v) => v.len(),
            Pixels::F32(v) => v.len(),
        }
    }
    /// There are no samples.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Memory taken by the samples, in bytes.
    pub fn bytes(&self) -> usize {
        match self {
            Pixels::U8(v) => v.len(),
            Pixels::F16(v) => 2 * v.len(),
            Pixels::F32(v) => 4 * v.len(),
        }
    }
}

/// CIE xy of the primaries and the white point of an RGB space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chromaticities {
    /// Red primary.
    pub red: [f32; 2],
    /// Green primary.
    pub green: [f32; 2],
    /// Blue primary.
    pub blue: [f32; 2],
    /// White point.
    pub white: [f32; 2],
}

impl Chromaticities {
    /// ITU-R BT.709 with D65, the space of sRGB, and what OpenEXR assumes where a file is silent.
    pub const REC_709: Chromaticities = Chromaticities {
        red: [0.64, 0.33],
        green: [0.30, 0.60],
        blue: [0.15, 0.06],
        white: [0.3127, 0.3290],
    };
}

/// A picture with named channels.
///
/// Made by [`Image::read`] or [`Image::new`], which see to it that the fields agree. Readers put red, green,
/// blue and alpha first, in this order, and the other channels behind them in the order of the file.
#[derive(Clone, Debug)]
pub struct Image {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Channel names: `R`, `G`, `B`, `A`, `Y`, or whatever an OpenEXR file calls them.
    pub channels: Vec<String>,
    /// The samples.
    pub pixels: Pixels,
    /// How 8-bit samples map to linear values; `Linear` for floating-point samples.
    pub encoding: Encoding,
    /// The RGB space, where the file names one.
    pub chromaticities: Option<Chromaticities>,
    rgb: [usize; 3],
    table: Option<Box<[f32; 256]>>,
}

impl Image {
    /// An image of `width * height * channels.len()` samples, the channels of one pixel side by side.
    ///
    /// # Errors
    /// [`ImageError::Mismatch`] where the number of samples differs from that, or is zero.
    pub fn new(
        width: usize,
        height: usize,
        channels: Vec<String>,
        pixels: Pixels,
        encoding: Encoding,
    ) -> Result<Image, ImageError> {
        let wanted = width.checked_mul(height).and_then(|n| n.checked_mul(channels.len()));
        if pixels.is_empty() || wanted != Some(pixels.len()) {
            return Err(ImageError::Mismatch(format!(
                "{} samples do not make an image of {width} x {height} pixels with {} channels; \
                 give exactly one sample for each channel of each pixel",
                pixels.len(),
                channels.len()
            )));
        }
        let (encoding, table) = match pixels {
            Pixels::U8(_) => (encoding, Some(encoding.table())),
            Pixels::F16(_) | Pixels::F32(_) => (Encoding::Linear, None),
        };
        let rgb = rgb_channels(&channels);
        Ok(Image { width, height, channels, pixels, encoding, chromaticities: None, rgb, table })
    }

    /// Linear value of channel `c` at column `x`, row `y`; row 0 is the top.
    ///
    /// The encoding is undone in every channel, alpha included, as pbrt-v4 does it; read a mask whose alpha is
    /// meant linearly with [`Encoding::Linear`].
    ///
    /// Panics where `x`, `y` or `c` lies outside the image: which texel to take there is the caller's affair.
    #[inline]
    pub fn value(&self, x: usize, y: usize, c: usize) -> f32 {
        debug_assert!(x < self.width && y < self.height && c < self.channels.len(), "outside the image");
        self.sample((y * self.width + x) * self.channels.len() + c)
    }

    /// Linear red, green and blue at column `x`, row `y`; three times the same where the image has no colour.
    ///
    /// Panics where `x` or `y` lies outside the image.
    #[inline]
    pub fn rgb(&self, x: usize, y: usize) -> [f32; 3] {
        debug_assert!(x < self.width && y < self.height, "outside the image");
        let i = (y * self.width + x) * self.channels.len();
        self.rgb.map(|c| self.sample(i + c))
    }

    #[inline]
    fn sample(&self, i: usize) -> f32 {
        match &self.pixels {
            Pixels::U8(v) => {
                let code = v[i];
                self.table.as_ref().map_or(f32::from(code) / 255.0, |t| t[usize::from(code)])
            }
            Pixels::F16(v) => v[i].to_f32(),
            Pixels::F32(v) => v[i],
        }
    }

    /// Linear red, green and blue of all pixels, from the top left.
    pub fn to_rgb(&self) -> Vec<[f32; 3]> {
        (0..self.height).flat_map(|y| (0..self.width).map(move |x| self.rgb(x, y))).collect()
    }

    /// The position of the channel called exactly `name`.
    pub fn channel_index(&self, name: &str) -> Option<usize> {
        self.channels.iter().position(|c| c == name)
    }

    /// The channels that [`rgb`](Self::rgb) shows; three times the same where the image has no colour.
    pub fn rgb_channels(&self) -> [usize; 3] {
        self.rgb
    }

    /// Number of channels.
    pub fn n_channels(&self) -> usize {
        self.channels.len()
    }

    /// The image has red, green and blue, not just one channel to be taken as grey.
    pub fn has_colour(&self) -> bool {
        self.rgb[0] != self.rgb[1]
    }

    /// Memory taken by the samples, in bytes.
    pub fn bytes(&self) -> usize {
        self.pixels.bytes()
    }
}

/// The channels that [`Image::rgb`] shows: `R`, `G`, `B`, or those of the first layer that has all three
/// (`beauty.R`, ...), or three times `Y`, or three times the first channel.
pub(crate) fn rgb_channels(names: &[String]) -> [usize; 3] {
    let find = |layer: &str, c: &str| names.iter().position(|n| split_layer(n) == (layer, c));
    let layers = std::iter::once("").chain(names.iter().map(|n| split_layer(n).0));
    for layer in layers {
        if let (Some(r), Some(g), Some(b)) = (find(layer, "R"), find(layer, "G"), find(layer, "B")) {
            return [r, g, b];
        }
    }
    [find("", "Y").unwrap_or(0); 3]
}

/// `beauty.left.R` is channel `R` of layer `beauty.left`; a name without a dot lies in the layer `""`.
pub(crate) fn split_layer(name: &str) -> (&str, &str) {
    name.rsplit_once('.').unwrap_or(("", name))
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    fn names(s: &str) -> Vec<String> {
        s.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn colour_is_found_by_name() {
        assert_eq!(rgb_channels(&names("A B G R")), [3, 2, 1]);
        assert_eq!(rgb_channels(&names("d.R d.G d.B B G R")), [5, 4, 3], "plain names win");
        assert_eq!(rgb_channels(&names("N.X N.Y N.Z s.B s.G s.R")), [5, 4, 3]);
        assert_eq!(rgb_channels(&names("N.X N.Y N.Z")), [0; 3], "N.Y is no luminance");
        assert_eq!(rgb_channels(&names("A Y")), [1; 3]);
        assert_eq!(rgb_channels(&names("a.R b.G a.B")), [0; 3], "never mixed from two layers");
    }

    #[test]
    fn eight_bits_are_decoded_and_floats_are_not() {
        let rgb = names("R G B");
        let a = Image::new(1, 1, rgb.clone(), Pixels::U8(vec![0, 128, 255]), Encoding::Gamma(2.0)).unwrap();
        let half = 128.0f32 / 255.0;
        assert!((a.value(0, 0, 1) - half * half).abs() < 1e-7);
        assert_eq!((a.bytes(), a.n_channels(), a.has_colour()), (3, 3, true));
        let b = Image::new(1, 1, rgb, Pixels::F32(vec![0.0, 0.5, 7.0]), Encoding::Srgb).unwrap();
        assert_eq!(b.rgb(0, 0), [0.0, 0.5, 7.0]);
        assert_eq!(b.encoding, Encoding::Linear);
    }

    #[test]
    fn a_wrong_number_of_samples_is_refused() {
        for (w, h, n) in [(2, 2, 11), (0, 5, 0), (usize::MAX, 3, 12)] {
            let e =
                Image::new(w, h, names("R G B"), Pixels::F32(vec![0.0; n]), Encoding::Linear).unwrap_err();
            assert!(e.to_string().contains("give exactly one sample"), "{e}");
        }
    }
}
