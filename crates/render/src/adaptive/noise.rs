//! How noisy a picture of two halves is: [`noise`].

use sparrow_image::metrics::EPSILON;

use crate::film::Film;

/// Share of the pixels that does not count, the worst ones: the edge of a lamp that one sample in a hundred meets is as noisy
/// as all others together, and no few samples tell how noisy.
pub const TRIM: f64 = 0.001;

/// Estimate of the noise of the mean of two independent halves, `sqrt(mean((a - b)^2 / 4 / (r^2 + EPSILON)))` over
/// channels and over the pixels that remain without the worst [`TRIM`]: the root of [`sparrow_image::metrics::relmse`].
///
/// `(a - b)^2 / 4` has the variance of `(a + b) / 2` as its mean, for any points and any two numbers of samples. What it is
/// relative to is `r`, the middle one of both halves and the mean of the pixels around: a firefly, which is in one half, is not
/// measured by itself.
///
/// Both films have the same size.
pub fn noise([a, b]: [&Film; 2]) -> f64 {
    let (width, height) = (a.width(), a.height());
    let error = |(x, y)| {
        let [pa, pb] = [a, b].map(|film| film.pixel(x, y).rgb);
        let around = around(a, b, x, y);
        let relative = |c: usize| {
            let (d, r) = (pa[c] - pb[c], middle(pa[c], pb[c], around[c]));
            0.25 * d * d / (r * r + EPSILON)
        };
        (relative(0) + relative(1) + relative(2)) / 3.0
    };
    let mut errors: Vec<f64> = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(error).collect();
    errors.sort_unstable_by(f64::total_cmp);
    let kept = ((errors.len() as f64 * (1.0 - TRIM)) as usize).max(1).min(errors.len());
    (errors[..kept].iter().sum::<f64>() / kept.max(1) as f64).sqrt()
}

/// The middle one of three numbers.
fn middle(a: f64, b: f64, c: f64) -> f64 {
    a.min(b).max(a.max(b).min(c))
}

/// Mean of the up to eight pixels around one.
fn around(a: &Film, b: &Film, x: u32, y: u32) -> [f64; 3] {
    let (mut sum, mut n) = ([0.0; 3], 0.0);
    for v in y.saturating_sub(1)..(y + 2).min(a.height()) {
        for u in x.saturating_sub(1)..(x + 2).min(a.width()) {
            if [u, v] == [x, y] {
                continue;
            }
            let [pa, pb] = [a, b].map(|film| film.pixel(u, v).rgb);
            (0..3).for_each(|c| sum[c] += 0.5 * (pa[c] + pb[c]));
            n += 1.0;
        }
    }
    sum.map(|s| if n > 0.0 { s / n } else { 0.0 })
}

/// For each tile of `side` pixels, row by row: the relative variance of one sample, `n var / (mean^2 + EPSILON)`, as
/// the scatter within the film's own pixels tells it; mean over pixels and channels.
pub(super) fn demand(film: &Film, origins: &[[u32; 2]], side: u32) -> Vec<f64> {
    let of_tile = |&[x0, y0]: &[u32; 2]| {
        let (mut sum, mut n) = (0.0, 0.0);
        for y in y0..(y0 + side).min(film.height()) {
            for x in x0..(x0 + side).min(film.width()) {
                let p = film.pixel(x, y);
                for c in 0..3 {
                    let v = p.n as f64 * p.variance[c] / (p.rgb[c] * p.rgb[c] + EPSILON);
                    // A sum of squares that has reached its end tells nothing.
                    if v.is_finite() {
                        sum += v;
                        n += 1.0;
                    }
                }
            }
        }
        if n > 0.0 { sum / n } else { 0.0 }
    };
    origins.iter().map(of_tile).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Halves, Picture};
    use sparrow_image::metrics::{Pair, relmse};

    /// A generator of test data.
    fn uniform(state: &mut u64) -> f32 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 40) as f32 / (1u64 << 24) as f32
    }

    /// Two films of 64 x 64 pixels; each sample is 2, with the chance `rare` of another 50.
    fn halves(n: [u32; 2], rare: f32) -> Halves {
        let mut state = 1;
        Halves(n.map(|n| {
            let mut film = Film::new(64, 64, true);
            for (x, y) in (0..64).flat_map(|y| (0..64).map(move |x| (x, y))) {
                for _ in 0..n {
                    let firefly = if uniform(&mut state) < rare { 50.0 } else { 0.0 };
                    film.add(x, y, [4.0 * uniform(&mut state) + firefly; 3], 1.0);
                }
            }
            film
        }))
    }

    fn told(h: &Halves) -> f64 {
        noise(h.0.each_ref())
    }

    fn root_of_relmse(h: &Halves, truth: f64) -> f64 {
        let picture: Vec<[f32; 3]> =
            (0..4096).map(|i| h.pixel(i % 64, i / 64).rgb.map(|v| v as f32)).collect();
        let reference = vec![[truth as f32; 3]; 4096];
        relmse(&Pair::new(64, &picture, &reference).unwrap(), TRIM).unwrap().sqrt()
    }

    #[test]
    fn the_estimate_is_the_error() {
        // Standard deviation 4 / sqrt 12 over the mean 2, from 32 and from 16 + 8 samples; known to 1/90 from 4096 pixels.
        for (n, pixels) in [([16, 16], 32.0f64), ([16, 8], 4.0 / (1.0 / 16.0 + 1.0 / 8.0))] {
            let h = halves(n, 0.0);
            let want = (16.0 / 12.0 / pixels / (4.0 + EPSILON)).sqrt();
            assert!((told(&h) / want - 1.0).abs() < 0.05, "{n:?}: {} for {want}", told(&h));
            assert!((root_of_relmse(&h, 2.0) / want - 1.0).abs() < 0.05);
        }
    }

    #[test]
    fn fireflies_are_counted() {
        let h = halves([16, 16], 2e-3);
        let (estimate, is) = (told(&h), root_of_relmse(&h, 2.0 + 0.1));
        assert!((estimate / is - 1.0).abs() < 0.1, "{estimate} for {is}");
    }

    #[test]
    fn demand_is_the_variance_of_a_sample() {
        let film = &halves([256, 1], 0.0).0[0];
        let v = demand(film, &[[0, 0], [48, 48], [60, 0]], 16);
        let want = 16.0 / 12.0 / (4.0 + EPSILON);
        assert!(v.iter().all(|v| (v / want - 1.0).abs() < 0.05), "{v:?} for {want}");
    }
}
