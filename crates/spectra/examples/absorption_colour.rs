//! The RGB of white light that an RGB absorption has dimmed, by the two spectra that the RGB can stand for: one without an upper bound,
//! as here and in pbrt-v4, or a reflectance, as in Mitsuba 3.
//!
//! Run from the workspace root: `cargo run --release -p sparrow-spectra --example absorption_colour`

use sparrow_math::Real;
use sparrow_spectra::{ColorSpace, RgbRole, cie, rgb_spectrum_exact};

/// Of the fibres of the benchmark scene `furball`, per radius.
const SIGMA_A: [f32; 3] = [0.2095, 0.3485, 0.685];

/// Red, green and blue of the white of sRGB after `exp(-sigma_a length)`.
fn left(role: RgbRole, length: f32) -> [f64; 3] {
    let space = ColorSpace::Srgb;
    let sigma_a = rgb_spectrum_exact(SIGMA_A, role, space).to_dense();
    let light = sigma_a.map(|sigma| Real::exp(-sigma * length)).mul(space.illuminant());
    let white = cie::xyz_of(space.illuminant())[1];
    let xyz = cie::xyz_of(&light).map(|v| v / white);
    space.xyz_to_rgb().map(|row| (0..3).map(|i| f64::from(row[i]) * xyz[i]).sum())
}

#[allow(clippy::print_stdout, reason = "an example shows its table")]
fn main() {
    println!("length    unbounded                 reflectance               ratio");
    for length in [0.5, 1.0, 2.0, 4.0, 8.0] {
        let [a, b] = [RgbRole::Unbounded, RgbRole::Albedo].map(|role| left(role, length));
        let show = |v: [f64; 3]| v.map(|v| format!("{v:.4}")).join("  ");
        let ratio: [f64; 3] = std::array::from_fn(|i| a[i] / b[i]);
        println!("{length:6}    {}    {}    {}", show(a), show(b), show(ratio));
    }
}
