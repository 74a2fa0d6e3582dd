//! The density with which paths draw their wavelengths: [`Visible`].

use std::sync::OnceLock;

use sparrow_math::Real;

use crate::{ColorSpace, LAMBDA_MAX, LAMBDA_MIN, N_DENSE, N_LAMBDA, cie};

/// Bins of one nanometre between 360 and 830.
const N_BINS: usize = N_DENSE - 1;
/// Cells of equal probability.
const N_CELLS: usize = 1024;
/// Cells of a quarter of the probability.
const N_QUARTER: usize = N_CELLS / N_LAMBDA;
/// Width of the smoothing, in nm.
const SIGMA: f32 = 20.0;

/// A density over wavelengths in proportion to what they weigh in a linear RGB picture.
///
/// For light of the illuminant D65 a wavelength adds to red, green and blue in proportion to the sRGB matching
/// functions times D65; the density is the length of that vector, smoothed with a Gaussian of 20 nm, so that
/// coloured light too finds no wavelength neglected. Four stratified draws from it leave white light with a variance
/// of 0.044 (summed over the channels, relative to white), where pbrt-v4's density for luminance leaves 0.365, most of
/// that in blue. With bins of one nanometre instead of the cells below it was 0.043 (and for incandescent light 0.12 against 0.15, for
/// saturated red 0.34 against 1.6); light of a black body of 2856 K, relative to its own colour, has 0.053 where it had 0.051.
///
/// Constant within each of [`N_CELLS`] cells of equal probability, so that no cell has to be searched for.
pub(crate) struct Visible {
    /// Ends of the cells, in nm.
    ends: [f32; N_CELLS + 1],
    /// For each cell of the first quarter: where that one and its companions of the other quarters begin, then their widths, in nm.
    cells: [[f32; 2 * N_LAMBDA]; N_QUARTER],
}

impl Visible {
    /// The one table, made at first use.
    pub(crate) fn get() -> &'static Visible {
        static TABLE: OnceLock<Visible> = OnceLock::new();
        TABLE.get_or_init(Visible::new)
    }

    fn new() -> Visible {
        let weight = smoothed(&rgb_weight());
        let total: f64 = weight.iter().sum();
        let mut ends = [LAMBDA_MIN; N_CELLS + 1];
        let (mut below, mut cell) = (0.0, 1);
        for (i, w) in weight.iter().enumerate() {
            let share = w / total * N_CELLS as f64;
            while cell < N_CELLS && below + share >= cell as f64 {
                ends[cell] = (f64::from(LAMBDA_MIN) + i as f64 + (cell as f64 - below) / share) as f32;
                cell += 1;
            }
            below += share;
        }
        ends[N_CELLS] = LAMBDA_MAX;
        let cells = core::array::from_fn(|j| {
            let of = |k: usize| j + k % N_LAMBDA * N_QUARTER;
            core::array::from_fn(|k| if k < N_LAMBDA { ends[of(k)] } else { ends[of(k) + 1] - ends[of(k)] })
        });
        Visible { ends, cells }
    }

    /// The four wavelengths in nm that `u + i/4` in [0, 1), wrapped, stand for, and their densities in 1/nm.
    #[inline(always)]
    pub(crate) fn sample<R: Real>(&self, u: R) -> ([R; N_LAMBDA], [R; N_LAMBDA]) {
        let place = u * R::of(N_CELLS as f64);
        let (half, quarter) = (R::of((N_CELLS / 2) as f64), R::of(N_QUARTER as f64));
        // In the upper half, and in the upper quarter of a half.
        let upper = place.ge(half);
        let place = R::select(upper, place - half, place);
        let odd = place.ge(quarter);
        let place = R::select(odd, place - quarter, place);
        let [a, b, c, d, v, w, x, y] = place.look_up_rows(&self.cells);
        let nearest = place.round();
        let inside = place - R::select(nearest.gt(place), nearest - R::ONE, nearest);
        let (lambda, width) =
            ([a + inside * v, b + inside * w, c + inside * x, d + inside * y], [v, w, x, y]);
        let share = R::of(1.0 / N_CELLS as f64);
        let pdf = [share / width[0], share / width[1], share / width[2], share / width[3]];
        (turned(lambda, odd, upper), turned(pdf, odd, upper))
    }

    /// Density of a wavelength, in 1/nm; zero outside 360..830 nm.
    #[inline]
    pub(crate) fn pdf(&self, lambda: f32) -> f32 {
        if !(LAMBDA_MIN..=LAMBDA_MAX).contains(&lambda) {
            return 0.0;
        }
        let cell = self.ends[1..N_CELLS].partition_point(|end| *end <= lambda);
        1.0 / (N_CELLS as f32 * (self.ends[cell + 1] - self.ends[cell]))
    }
}

/// Numbers of the quarters, the own one first: one on where `odd`, two where `upper`.
#[inline(always)]
fn turned<R: Real>([a, b, c, d]: [R; N_LAMBDA], odd: R::Mask, upper: R::Mask) -> [R; N_LAMBDA] {
    let [a, b, c, d] =
        [R::select(odd, b, a), R::select(odd, c, b), R::select(odd, d, c), R::select(odd, a, d)];
    [R::select(upper, c, a), R::select(upper, d, b), R::select(upper, a, c), R::select(upper, b, d)]
}

/// Length of the RGB vector that D65 light of a wavelength adds to a picture.
fn rgb_weight() -> [f64; N_BINS] {
    let space = ColorSpace::Srgb;
    let (light, m) = (space.illuminant(), space.xyz_to_rgb());
    core::array::from_fn(|i| {
        // The middle of the bin lies between two entries.
        let mid = |t: &[f32; N_DENSE]| 0.5 * f64::from(t[i] + t[i + 1]);
        let xyz = [mid(cie::x().values()), mid(cie::y().values()), mid(cie::z().values())];
        let rgb = m.map(|row| row.iter().zip(xyz).map(|(&a, b)| f64::from(a) * b).sum::<f64>());
        mid(light.values()) * rgb.iter().map(|c| c * c).sum::<f64>().sqrt()
    })
}

/// Convolved with a Gaussian; nothing lies beyond the ends.
fn smoothed(w: &[f64; N_BINS]) -> [f64; N_BINS] {
    let kernel = |d: usize| Real::exp(-0.5 * (d as f64 / f64::from(SIGMA)) * (d as f64 / f64::from(SIGMA)));
    core::array::from_fn(|i| w.iter().enumerate().map(|(j, v)| v * kernel(i.abs_diff(j))).sum())
}
