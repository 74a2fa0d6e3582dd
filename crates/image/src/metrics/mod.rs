//! How far a picture is from a reference.
//!
//! A [`Pair`] holds two pictures of the same size in linear RGB. Sums are in double precision and in a fixed
//! order, so the same pictures give the same numbers everywhere.
//!
//! | measure | of | is |
//! | --- | --- | --- |
//! | [`mse`] | linear values | mean squared error |
//! | [`relmse`] | linear values | squared error over the squared reference, with or without the worst pixels |
//! | [`block_relmse`] | means of 8 x 8 pixels | the same: error that does not average out |
//! | [`mean_ratio`] | linear values | light gained or lost |
//! | [`psnr`] | sRGB-encoded values in [0, 1] | signal to noise, in dB |
//! | [`ssim`] | sRGB-encoded values in [0, 1] | structural similarity |
//! | [`flip_map`] | linear values in [0, 1] | LDR-FLIP, what a viewer sees |
//! | [`flip_hdr_map`] | linear values | HDR-FLIP, the same for the worst of all exposures |

mod display;
mod flip;
mod pair;
mod plane;
mod relative;
mod square;
mod ssim;

pub use self::flip::{PIXELS_PER_DEGREE, flip_hdr_map, flip_map};
pub use self::pair::Pair;
pub use self::relative::{BLOCK, EPSILON, block_relmse, mean_ratio, relative_error_map, relmse};
pub use self::square::{mse, psnr};
pub use self::ssim::ssim;

#[cfg(test)]
mod tests {
    /// Multiples of 1/64, exact in single precision.
    pub(super) fn pattern(n: usize, step: usize, modulus: usize) -> Vec<[f32; 3]> {
        (0..n).map(|p| [0, 1, 2].map(|c| ((p * 3 + c) * step % modulus) as f32 / 64.0)).collect()
    }

    pub(super) const WIDTH: usize = 48;

    /// A picture and its reference: waves, a checkerboard and a bright square, in multiples of 1/256; and the same with a
    /// pattern of errors.
    pub(super) fn pictures() -> [Vec<[f32; 3]>; 2] {
        let reference = |x: usize, y: usize| {
            let square = if (20..28).contains(&x) && (8..16).contains(&y) { 1024 } else { 0 };
            [(x * 5 + y * 3) % 256 + square, x * y % 256, ((x / 8 + y / 8) % 2) * 200 + 20]
        };
        let error = |x: usize, y: usize| (x * 7 + y * 13) % 32 + if x > 36 { 40 } else { 0 };
        let places = || (0..36).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
        let scaled = |v: [usize; 3]| v.map(|c| c as f32 / 256.0);
        let r = places().map(|(x, y)| scaled(reference(x, y))).collect();
        let p = places().map(|(x, y)| scaled(reference(x, y).map(|c| c + error(x, y)))).collect();
        [p, r]
    }

    pub(super) fn near(got: f64, want: f64) {
        assert!((got / want - 1.0).abs() < 1e-12, "got {got}, want {want}");
    }
}
