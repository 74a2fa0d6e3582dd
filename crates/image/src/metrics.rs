//! How far a picture is from a reference.
//!
//! Pictures are slices of linear RGB, row by row. Sums are in double precision and in a fixed order, so the
//! same pictures give the same numbers everywhere.

use crate::ImageError;

/// Keeps relative errors finite in the dark: the square of a tenth of the radiance of a white wall in full light.
pub const EPSILON: f64 = 1e-2;

/// Side of a block in [`block_relmse`], in pixels.
pub const BLOCK: usize = 8;

/// Every measure of this module for one pair of pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Comparison {
    /// [`mse`].
    pub mse: f64,
    /// [`relmse`] of all pixels.
    pub relmse: f64,
    /// [`relmse`] without the worst hundredth of the pixels.
    pub relmse_trimmed: f64,
    /// [`block_relmse`]; `None` where the pictures are smaller than a block.
    pub block_relmse: Option<f64>,
    /// [`mean_ratio`].
    pub mean_ratio: [f64; 3],
}

/// Applies all measures; `width` is that of both pictures.
///
/// # Errors
/// [`ImageError::Mismatch`] where the pictures differ in size, are empty or not made of whole rows.
pub fn compare(width: usize, picture: &[[f32; 3]], reference: &[[f32; 3]]) -> Result<Comparison, ImageError> {
    Ok(Comparison {
        mse: mse(picture, reference)?,
        relmse: relmse(picture, reference, 0.0)?,
        relmse_trimmed: relmse(picture, reference, 0.01)?,
        block_relmse: block_relmse(width, picture, reference)?,
        mean_ratio: mean_ratio(picture, reference)?,
    })
}

/// Mean of `(p - r)²` over pixels and channels.
///
/// # Errors
/// [`ImageError::Mismatch`] where the pictures differ in size or are empty.
pub fn mse(picture: &[[f32; 3]], reference: &[[f32; 3]]) -> Result<f64, ImageError> {
    check(picture, reference)?;
    let sum: f64 = picture.iter().zip(reference).map(|(p, r)| square_error(&wide(p), &wide(r))).sum();
    Ok(sum / (3.0 * picture.len() as f64))
}

/// Mean of `(p - r)² / (r² + EPSILON)` over channels and over the pixels that remain after the worst share
/// `trim`, in [0, 1), is dropped.
///
/// # Errors
/// [`ImageError::Mismatch`] where the pictures differ in size, are empty, or `trim` leaves none of them.
pub fn relmse(picture: &[[f32; 3]], reference: &[[f32; 3]], trim: f64) -> Result<f64, ImageError> {
    check(picture, reference)?;
    let mut errors: Vec<f64> =
        picture.iter().zip(reference).map(|(p, r)| relative_error(&wide(p), &wide(r))).collect();
    if trim > 0.0 {
        errors.sort_unstable_by(f64::total_cmp);
    }
    // Rounded down, like the share of a list in NumPy's slices.
    let kept = (errors.len() as f64 * (1.0 - trim.max(0.0))) as usize;
    if kept == 0 {
        return Err(ImageError::Mismatch(format!(
            "dropping the share {trim} of {} pixels leaves none; drop less",
            errors.len()
        )));
    }
    Ok(errors[..kept].iter().sum::<f64>() / kept as f64)
}

/// [`relmse`] between the means over blocks of 8 x 8 pixels: what is left of the error when noise averages
/// out. Columns and rows beyond the last whole block are ignored; `None` where there is no whole block.
///
/// # Errors
/// [`ImageError::Mismatch`] where the pictures differ in size, are empty or not made of rows of `width`.
pub fn block_relmse(
    width: usize,
    picture: &[[f32; 3]],
    reference: &[[f32; 3]],
) -> Result<Option<f64>, ImageError> {
    check(picture, reference)?;
    if width == 0 || !picture.len().is_multiple_of(width) {
        return Err(ImageError::Mismatch(format!(
            "{} pixels do not make rows of {width}; give the width of the pictures",
            picture.len()
        )));
    }
    let (p, r) = (blocks(width, picture), blocks(width, reference));
    if p.is_empty() {
        return Ok(None);
    }
    Ok(Some(p.iter().zip(&r).map(|(p, r)| relative_error(p, r)).sum::<f64>() / p.len() as f64))
}

/// Mean of the picture over mean of the reference, for each channel: 1 where no light is lost or gained.
/// Not finite where the reference is black.
///
/// # Errors
/// [`ImageError::Mismatch`] where the pictures differ in size or are empty.
pub fn mean_ratio(picture: &[[f32; 3]], reference: &[[f32; 3]]) -> Result<[f64; 3], ImageError> {
    check(picture, reference)?;
    let sum = |v: &[[f32; 3]], c: usize| v.iter().map(|p| f64::from(p[c])).sum::<f64>();
    Ok([0, 1, 2].map(|c| sum(picture, c) / sum(reference, c)))
}

/// Means over whole blocks, row by row.
fn blocks(width: usize, picture: &[[f32; 3]]) -> Vec<[f64; 3]> {
    let mut out = Vec::with_capacity(picture.len() / (BLOCK * BLOCK));
    for rows in picture.chunks_exact(width * BLOCK) {
        for x in (0..width / BLOCK).map(|i| i * BLOCK) {
            let mut sum = [0.0f64; 3];
            for p in rows.chunks_exact(width).flat_map(|row| &row[x..x + BLOCK]) {
                (0..3).for_each(|c| sum[c] += f64::from(p[c]));
            }
            out.push(sum.map(|s| s / (BLOCK * BLOCK) as f64));
        }
    }
    out
}

fn wide(p: &[f32; 3]) -> [f64; 3] {
    p.map(f64::from)
}

fn square_error(p: &[f64; 3], r: &[f64; 3]) -> f64 {
    (0..3).map(|c| (p[c] - r[c]) * (p[c] - r[c])).sum()
}

/// Mean over the channels of one pixel. The absolute value puts a NaN of either sign last when sorted.
fn relative_error(p: &[f64; 3], r: &[f64; 3]) -> f64 {
    let sum: f64 = (0..3).map(|c| (p[c] - r[c]) * (p[c] - r[c]) / (r[c] * r[c] + EPSILON)).sum();
    (sum / 3.0).abs()
}

fn check(picture: &[[f32; 3]], reference: &[[f32; 3]]) -> Result<(), ImageError> {
    if picture.len() != reference.len() || picture.is_empty() {
        return Err(ImageError::Mismatch(format!(
            "pictures of {} and {} pixels cannot be compared; render both at the same resolution",
            picture.len(),
            reference.len()
        )));
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    /// Multiples of 1/64, exact in single precision.
    fn pattern(n: usize, step: usize, modulus: usize) -> Vec<[f32; 3]> {
        (0..n).map(|p| [0, 1, 2].map(|c| ((p * 3 + c) * step % modulus) as f32 / 64.0)).collect()
    }

    fn near(got: f64, want: f64) {
        assert!((got / want - 1.0).abs() < 1e-12, "got {got}, want {want}");
    }

    #[test]
    fn measures_agree_with_numpy() {
        // The definitions above, written in NumPy, for 19 x 17 pixels.
        let (p, r) = (pattern(19 * 17, 37, 101), pattern(19 * 17, 53, 97));
        let c = compare(19, &p, &r).unwrap();
        near(c.mse, 0.40492045399574306);
        near(c.relmse, 6.615986195599235);
        near(c.relmse_trimmed, 5.98255708798507);
        near(c.block_relmse.unwrap(), 0.0031180267264263235);
        let ratio = [1.0398118920311794, 1.04530472435856, 1.037757731958763];
        (0..3).for_each(|i| near(c.mean_ratio[i], ratio[i]));
    }

    #[test]
    fn trimming_drops_the_worst_pixel() {
        let reference = vec![[1.0; 3]; 100];
        let mut p = reference.clone();
        p[17] = [1e6; 3];
        assert!(relmse(&p, &reference, 0.0).unwrap() > 1e9);
        assert_eq!(relmse(&p, &reference, 0.01).unwrap(), 0.0);
        p[17] = [f32::NAN; 3];
        assert!(relmse(&p, &reference, 0.0).unwrap().is_nan());
        assert_eq!(relmse(&p, &reference, 0.01).unwrap(), 0.0, "a NaN counts as worst");
    }

    #[test]
    fn noise_averages_out_in_blocks_but_bias_does_not() {
        let reference = vec![[1.0; 3]; 256];
        let noisy: Vec<_> = (0..256).map(|i| [if i % 2 == 0 { 0.5 } else { 1.5 }; 3]).collect();
        let biased = vec![[1.5; 3]; 256];
        assert_eq!(block_relmse(16, &noisy, &reference).unwrap(), Some(0.0));
        near(block_relmse(16, &biased, &reference).unwrap().unwrap(), 0.25 / 1.01);
        assert_eq!(block_relmse(256, &noisy, &reference).unwrap(), None, "one row holds no block");
        assert_eq!(mean_ratio(&biased, &reference).unwrap(), [1.5; 3]);
    }

    #[test]
    fn pictures_that_do_not_fit_are_refused() {
        let (a, b) = (vec![[0.0; 3]; 4], vec![[0.0; 3]; 5]);
        assert!(mse(&a, &b).unwrap_err().to_string().contains("same resolution"));
        assert!(mse(&[], &[]).is_err() && relmse(&a, &a, 1.0).is_err());
        assert!(block_relmse(3, &a, &a).is_err() && block_relmse(0, &a, &a).is_err());
    }
}
