//! Errors in proportion to the reference: [`relmse`], [`block_relmse`], [`relative_error_map`], [`mean_ratio`].

use super::Pair;
use crate::ImageError;

/// Keeps relative errors finite in the dark: the square of a tenth of the radiance of a white wall in full light.
pub const EPSILON: f64 = 1e-2;

/// Side of a block in [`block_relmse`], in pixels.
pub const BLOCK: usize = 8;

/// Mean of `(p - r)² / (r² + EPSILON)` over channels and over the pixels that remain after the worst share
/// `trim`, in [0, 1), is dropped.
///
/// # Errors
/// [`ImageError::Mismatch`] where `trim` leaves no pixel.
pub fn relmse(pair: &Pair, trim: f64) -> Result<f64, ImageError> {
    let mut errors: Vec<f64> = pair.pixels().map(|(p, r)| relative_error(&p, &r)).collect();
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
pub fn block_relmse(pair: &Pair) -> Option<f64> {
    let (p, r) = (blocks(pair.width(), pair.picture()), blocks(pair.width(), pair.reference()));
    let sum: f64 = p.iter().zip(&r).map(|(p, r)| relative_error(p, r)).sum();
    (!p.is_empty()).then(|| sum / p.len() as f64)
}

/// Root of the relative squared error of every pixel, of which [`relmse`] is the mean square: about the share by
/// which the pixel is off.
pub fn relative_error_map(pair: &Pair) -> Vec<f64> {
    pair.pixels().map(|(p, r)| relative_error(&p, &r).sqrt()).collect()
}

/// Mean of the picture over mean of the reference, for each channel: 1 where no light is lost or gained.
/// Not finite where the reference is black.
pub fn mean_ratio(pair: &Pair) -> [f64; 3] {
    let sum = |v: &[[f32; 3]], c: usize| v.iter().map(|p| f64::from(p[c])).sum::<f64>();
    [0, 1, 2].map(|c| sum(pair.picture(), c) / sum(pair.reference(), c))
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

/// Mean over the channels of one pixel. The absolute value puts a NaN of either sign last when sorted.
fn relative_error(p: &[f64; 3], r: &[f64; 3]) -> f64 {
    let sum: f64 = (0..3).map(|c| (p[c] - r[c]) * (p[c] - r[c]) / (r[c] * r[c] + EPSILON)).sum();
    (sum / 3.0).abs()
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::super::tests::{near, pattern};
    use super::*;

    #[test]
    fn measures_agree_with_numpy() {
        // The definitions above, written in NumPy, for 19 x 17 pixels.
        let (p, r) = (pattern(19 * 17, 37, 101), pattern(19 * 17, 53, 97));
        let pair = Pair::new(19, &p, &r).unwrap();
        near(relmse(&pair, 0.0).unwrap(), 6.615986195599235);
        near(relmse(&pair, 0.01).unwrap(), 5.98255708798507);
        near(block_relmse(&pair).unwrap(), 0.0031180267264263235);
        let ratio = [1.0398118920311794, 1.04530472435856, 1.037757731958763];
        (0..3).for_each(|i| near(mean_ratio(&pair)[i], ratio[i]));
        let squares: f64 = relative_error_map(&pair).iter().map(|e| e * e).sum();
        near(squares / 323.0, 6.615986195599235);
    }

    #[test]
    fn trimming_drops_the_worst_pixel() {
        let reference = vec![[1.0; 3]; 100];
        let mut p = reference.clone();
        p[17] = [1e6; 3];
        let of = |p: &[[f32; 3]], trim| relmse(&Pair::new(10, p, &reference).unwrap(), trim);
        assert!(of(&p, 0.0).unwrap() > 1e9);
        assert_eq!(of(&p, 0.01).unwrap(), 0.0);
        p[17] = [f32::NAN; 3];
        assert!(of(&p, 0.0).unwrap().is_nan());
        assert_eq!(of(&p, 0.01).unwrap(), 0.0, "a NaN counts as worst");
        assert!(of(&p, 1.0).is_err(), "nothing would be left");
    }

    #[test]
    fn noise_averages_out_in_blocks_but_bias_does_not() {
        let reference = vec![[1.0; 3]; 256];
        let noisy: Vec<_> = (0..256).map(|i| [if i % 2 == 0 { 0.5 } else { 1.5 }; 3]).collect();
        let biased = vec![[1.5; 3]; 256];
        assert_eq!(block_relmse(&Pair::new(16, &noisy, &reference).unwrap()), Some(0.0));
        let pair = Pair::new(16, &biased, &reference).unwrap();
        near(block_relmse(&pair).unwrap(), 0.25 / 1.01);
        assert_eq!(mean_ratio(&pair), [1.5; 3]);
        let row = Pair::new(256, &noisy, &reference).unwrap();
        assert_eq!(block_relmse(&row), None, "one row holds no block");
    }
}
