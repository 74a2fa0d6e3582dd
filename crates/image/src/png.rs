//! A picture to look at: [`write_png`], [`encode_png`].

use std::path::Path;

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use crate::encoding::to_srgb8;
use crate::{ImageError, atomic};

/// Writes linear RGB as an 8-bit sRGB PNG: clamped to [0, 1], encoded, rounded. NaN becomes black.
///
/// No tone mapping happens here; scale the values before where a picture is too dark or too bright.
///
/// # Errors
/// [`ImageError::Mismatch`] where `rgb` has not `width * height` pixels, [`ImageError::Io`] where the file
/// cannot be written; then nothing is left behind.
pub fn write_png(path: &Path, width: usize, height: usize, rgb: &[[f32; 3]]) -> Result<(), ImageError> {
    let file = encode_png(width, height, rgb)
        .map_err(|what| ImageError::Mismatch(format!("{}: {what}", path.display())))?;
    atomic::write(path, &file)
}

/// The bytes that [`write_png`] writes.
///
/// # Errors
/// A sentence where `rgb` has not `width * height` pixels or they are too many.
pub fn encode_png(width: usize, height: usize, rgb: &[[f32; 3]]) -> Result<Vec<u8>, String> {
    if rgb.is_empty() || width.checked_mul(height) != Some(rgb.len()) {
        return Err(format!("{} pixels do not make {width} x {height}", rgb.len()));
    }
    let (Ok(w), Ok(h)) = (u32::try_from(width), u32::try_from(height)) else {
        return Err(format!("{width} x {height} is too large for a PNG; crop it"));
    };
    let codes: Vec<u8> = rgb.iter().flatten().map(|v| to_srgb8(*v)).collect();
    let mut file = Vec::new();
    PngEncoder::new(&mut file)
        .write_image(&codes, w, h, ExtendedColorType::Rgb8)
        .map_err(|e| format!("cannot be encoded: {e}"))?;
    Ok(file)
}
