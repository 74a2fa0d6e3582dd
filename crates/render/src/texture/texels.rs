//! Texels in memory: [`Texels`].

use sparrow_image::{Image, Pixels};

/// Texels along the side of a block.
const SIDE: usize = 4;

/// The largest number of [`Numbers::Fixed`].
const FIXED_ONE: f32 = 65_535.0;

/// Linear values as they are kept.
#[derive(Debug)]
enum Numbers {
    /// Codes, and what each stands for.
    Codes(Vec<u8>, Box<[f32; 256]>),
    /// 65535 stands for one.
    Fixed(Vec<u16>),
    /// Bits of half floats.
    Half(Vec<u16>),
    Float(Vec<f32>),
}

/// Linear red, green and blue of an image's texels; one number each where the image is grey.
///
/// Blocks of 4 x 4 lie together, so that the neighbours a filter asks for share a line or two of the cache in both directions. A number
/// takes what it takes in the file: 1 byte, 2 for half floats, 4 for floats; means of 8-bit codes take 2.
#[derive(Debug)]
pub(super) struct Texels {
    pub(super) width: usize,
    pub(super) height: usize,
    n_channels: usize,
    numbers: Numbers,
}

/// The first numbers of `texel(x, y)` for all texels, block by block; places of a block beyond the edges hold zeros.
fn in_blocks<T: Copy + Default>(
    [width, height]: [usize; 2],
    n_channels: usize,
    texel: impl Fn(usize, usize) -> [T; 3],
) -> Vec<T> {
    let n_blocks = width.div_ceil(SIDE) * height.div_ceil(SIDE);
    let mut numbers = vec![T::default(); n_blocks * SIDE * SIDE * n_channels];
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let at = place(width, x, y) * n_channels;
        numbers[at..at + n_channels].iter_mut().zip(texel(x, y)).for_each(|(slot, v)| *slot = v);
    }
    numbers
}

/// The place of texel (x, y) among those of an image of that width.
#[inline(always)]
fn place(width: usize, x: usize, y: usize) -> usize {
    let block = (y / SIDE) * width.div_ceil(SIDE) + x / SIDE;
    (block * SIDE + y % SIDE) * SIDE + x % SIDE
}

impl Texels {
    /// Of an image; `matrix` brings its colours to another space, which takes half floats, or floats where the image has them.
    pub(super) fn new(image: &Image, matrix: Option<&[[f32; 3]; 3]>) -> Texels {
        let (width, height) = (image.width, image.height);
        let (size, channels) = ([width, height], image.rgb_channels());
        let n_channels = if image.has_colour() { 3 } else { 1 };
        let at = |x: usize, y: usize| channels.map(|c| (y * width + x) * image.n_channels() + c);
        let numbers = if let Some(m) = matrix.filter(|_| image.has_colour()) {
            let converted = |x, y| {
                let [r, g, b] = image.rgb(x, y);
                m.map(|m| m[0] * r + m[1] * g + m[2] * b)
            };
            match &image.pixels {
                Pixels::U8(_) | Pixels::F16(_) => {
                    Numbers::Half(in_blocks(size, 3, |x, y| converted(x, y).map(f32_to_half)))
                }
                Pixels::F32(_) => Numbers::Float(in_blocks(size, 3, converted)),
            }
        } else {
            match &image.pixels {
                Pixels::U8(v) => {
                    let codes = in_blocks(size, n_channels, |x, y| at(x, y).map(|i| v[i]));
                    Numbers::Codes(codes, image.encoding.table())
                }
                Pixels::F16(v) => {
                    Numbers::Half(in_blocks(size, n_channels, |x, y| at(x, y).map(|i| v[i].to_bits())))
                }
                Pixels::F32(v) => Numbers::Float(in_blocks(size, n_channels, |x, y| at(x, y).map(|i| v[i]))),
            }
        };
        Texels { width, height, n_channels, numbers }
    }

    /// Half as wide and high, rounded up: means of four.
    pub(super) fn halved(&self) -> Texels {
        let size = [self.width.div_ceil(2), self.height.div_ceil(2)];
        let mean = |x: usize, y: usize| {
            let mut sum = [0.0; 3];
            for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let texel = self.rgb((2 * x + dx).min(self.width - 1), (2 * y + dy).min(self.height - 1));
                sum.iter_mut().zip(texel).for_each(|(s, v)| *s += v);
            }
            sum.map(|s| s * 0.25)
        };
        let n = self.n_channels;
        let numbers = match &self.numbers {
            Numbers::Codes(..) | Numbers::Fixed(_) => {
                Numbers::Fixed(in_blocks(size, n, |x, y| mean(x, y).map(|v| (v * FIXED_ONE + 0.5) as u16)))
            }
            Numbers::Half(_) => Numbers::Half(in_blocks(size, n, |x, y| mean(x, y).map(f32_to_half))),
            Numbers::Float(_) => Numbers::Float(in_blocks(size, n, mean)),
        };
        Texels { width: size[0], height: size[1], n_channels: self.n_channels, numbers }
    }

    /// The texel in column `x` of row `y`, which lie within the image.
    #[inline]
    pub(super) fn rgb(&self, x: usize, y: usize) -> [f32; 3] {
        debug_assert!(x < self.width && y < self.height, "outside the image");
        let at = place(self.width, x, y);
        match &self.numbers {
            Numbers::Codes(v, table) => self.spread(at, v, |code| table[usize::from(code)]),
            Numbers::Fixed(v) => self.spread(at, v, |fixed| f32::from(fixed) * (1.0 / FIXED_ONE)),
            Numbers::Half(v) => self.spread(at, v, half_to_f32),
            Numbers::Float(v) => self.spread(at, v, |v| v),
        }
    }

    #[inline(always)]
    fn spread<T: Copy>(&self, at: usize, numbers: &[T], value: impl Fn(T) -> f32) -> [f32; 3] {
        if self.n_channels == 1 {
            return [value(numbers[at]); 3];
        }
        let texel = &numbers[3 * at..3 * at + 3];
        [value(texel[0]), value(texel[1]), value(texel[2])]
    }

    /// Memory, in bytes.
    pub(super) fn bytes(&self) -> usize {
        match &self.numbers {
            Numbers::Codes(v, _) => v.len(),
            Numbers::Fixed(v) | Numbers::Half(v) => 2 * v.len(),
            Numbers::Float(v) => 4 * v.len(),
        }
    }
}

/// The exponents of single and half floats are 112 apart, and a product moves them exactly, for denormal numbers too.
const SHIFT: f32 = f32::from_bits((127 + 112) << 23);

/// Bits of the nearest half float; what is no number becomes zero, and large numbers 65504.
#[inline]
fn f32_to_half(v: f32) -> u16 {
    let bits = (v.abs().min(65_504.0) * (1.0 / SHIFT)).to_bits();
    let nearest = if v.is_nan() { 0 } else { (bits + 0x0fff + (bits >> 13 & 1)) >> 13 };
    nearest as u16 | if v < 0.0 { 0x8000 } else { 0 }
}

/// The value of a half float; infinity and what is no number become numbers above 65504.
#[inline(always)]
fn half_to_f32(bits: u16) -> f32 {
    let magnitude = f32::from_bits(u32::from(bits & 0x7fff) << 13) * SHIFT;
    if bits & 0x8000 != 0 { -magnitude } else { magnitude }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "numbers are kept as they are")]
mod tests {
    use sparrow_image::Encoding;

    use super::*;

    fn names(s: &str) -> Vec<String> {
        s.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn texels_are_those_of_the_image() {
        for (channels, n) in [("R G B", 3), ("B A R G", 4), ("Y", 1)] {
            for (w, h) in [(1, 1), (4, 4), (5, 7), (13, 2)] {
                let codes = Pixels::U8((0..w * h * n).map(|i| (i * 37) as u8).collect());
                let floats = Pixels::F32((0..w * h * n).map(|i| i as f32 * 0.1 - 1.0).collect());
                for pixels in [codes, floats] {
                    let image = Image::new(w, h, names(channels), pixels, Encoding::Srgb).expect("an image");
                    let texels = Texels::new(&image, None);
                    for (x, y) in (0..h).flat_map(|y| (0..w).map(move |x| (x, y))) {
                        assert_eq!(texels.rgb(x, y), image.rgb(x, y), "{channels} {w} x {h} at {x}, {y}");
                    }
                }
            }
        }
    }

    #[test]
    fn neighbours_share_a_block() {
        for (x, y) in [(0, 0), (4, 8), (20, 12)] {
            let first = place(23, x, y);
            let mut block: Vec<usize> = (0..16).map(|i| place(23, x + i % 4, y + i / 4)).collect();
            block.sort_unstable();
            assert_eq!(block, (first..first + 16).collect::<Vec<_>>());
        }
    }

    #[test]
    fn all_half_floats_have_their_value() {
        // Sign, exponent and fraction by their definition.
        for bits in 0..=u16::MAX {
            let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023) / 1024.0);
            if exponent == 31 {
                assert!(half_to_f32(bits).abs() > 65_504.0);
                continue;
            }
            let magnitude = match exponent {
                0 => fraction * 2f64.powi(-14),
                e => (1.0 + fraction) * 2f64.powi(e - 15),
            };
            let value = if bits >> 15 == 1 { -magnitude } else { magnitude };
            assert_eq!(f64::from(half_to_f32(bits)), value, "{bits:#x}");
            assert_eq!(f32_to_half(half_to_f32(bits)) & 0x7fff, bits & 0x7fff, "{bits:#x}");
        }
    }

    #[test]
    fn the_nearest_half_float_is_taken() {
        for i in 0..100_000 {
            let v = (i as f32 * 0.618_034).fract() * f32::from_bits((100 + i % 40) << 23);
            let error = (half_to_f32(f32_to_half(v)) - v).abs();
            // Half a unit in the last of eleven places, or of the denormal numbers.
            assert!(error <= v * (1.0 / 2048.0) || error <= f32::from_bits((127 - 25) << 23), "{v} {error}");
        }
        assert_eq!([f32::NAN, 1e30, -f32::INFINITY].map(f32_to_half), [0, 0x7bff, 0xfbff]);
    }

    #[test]
    fn halves_are_means_and_keep_the_mean() {
        let numbers: Vec<f32> = (0..8 * 8 * 3).map(|i| ((i * 29) % 64) as f32 / 64.0).collect();
        let image =
            Image::new(8, 8, names("R G B"), Pixels::F32(numbers), Encoding::Linear).expect("an image");
        let mut texels = Texels::new(&image, None);
        let four = [(2, 4), (3, 4), (2, 5), (3, 5)].map(|(x, y)| image.rgb(x, y)[1]);
        assert_eq!(texels.halved().rgb(1, 2)[1], four.iter().sum::<f32>() * 0.25);
        let mean: f32 = image.to_rgb().iter().map(|t| t[0]).sum::<f32>() / 64.0;
        (0..3).for_each(|_| texels = texels.halved());
        assert_eq!((texels.width, texels.height), (1, 1));
        assert!((texels.rgb(0, 0)[0] - mean).abs() < 1e-6);
    }

    #[test]
    fn means_of_codes_are_nearer_than_codes_are_to_each_other() {
        let image =
            Image::new(64, 64, names("Y"), Pixels::U8(vec![1; 64 * 64]), Encoding::Srgb).expect("an image");
        let (mut texels, dark) = (Texels::new(&image, None), image.rgb(0, 0)[0]);
        (0..6).for_each(|_| texels = texels.halved());
        // Code 1 of sRGB is 3.0e-4; a step of the means is 1.5e-5.
        assert!((texels.rgb(0, 0)[0] - dark).abs() <= 0.5 / FIXED_ONE, "{} {dark}", texels.rgb(0, 0)[0]);
        assert_eq!((Texels::new(&image, None).bytes(), texels.bytes()), (4096, 2 * 16));
    }
}
