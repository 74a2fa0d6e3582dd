//! Piecewise-constant and discrete distributions.
//!
//! All cumulative tables hold multiples of 2^-24. Uniform numbers of the samplers are such multiples
//! too, so what [`Discrete::probability`] and the densities report is exactly how often a bin is drawn:
//! there is no rounding between sampling and density. A bin of positive weight gets at least one step
//! (as long as there are fewer than 2^23 bins), hence nothing that shines has density zero; bins of
//! weight zero are never drawn. The price is a tilt of at most `n * 2^-24` of the probabilities towards
//! uniform for `n` bins, 0.02 % for 4096.
//!
//! Weights that are negative or not finite count as zero. Where all weights are zero, the
//! distribution is uniform. Memory: one `f32` per bin, and 264 bytes per row; an environment map of
//! 4096 x 4096 takes 65 MiB.

use rayon::prelude::*;
use sparrow_math::ONE_MINUS_EPSILON;

/// Steps of a cumulative table.
const STEPS: f64 = 16_777_216.0;

/// A weight as it counts.
fn counted(w: f32) -> f64 {
    if w.is_finite() && w > 0.0 { f64::from(w) } else { 0.0 }
}

/// Writes the cumulative table of `n` weights to `cdf[0..=n]`; returns the sum of the weights.
fn accumulate(weights: impl Iterator<Item = f64> + Clone, cdf: &mut [f32]) -> f64 {
    let total: f64 = weights.clone().sum();
    let n = cdf.len() - 1;
    let positive = weights.clone().filter(|w| *w > 0.0).count();
    let floor = if positive < 1 << 23 { 1.0 } else { 0.0 };
    // Where all is zero, equal shares stand in.
    let (scale, share) =
        if total > 0.0 { ((STEPS - floor * positive as f64) / total, 0.0) } else { (1.0, STEPS / n as f64) };
    let (mut sum, mut count) = (0.0, 0.0);
    cdf[0] = 0.0;
    for (i, w) in weights.enumerate() {
        sum += w + share;
        count += if w > 0.0 { floor } else { 0.0 };
        cdf[i + 1] = ((count + (sum * scale).round_ties_even()).min(STEPS) / STEPS) as f32;
    }
    close(cdf);
    total
}

/// Sets the end to one, and with it every entry behind the last positive bin.
fn close(cdf: &mut [f32]) {
    let last = cdf[cdf.len() - 1];
    for c in cdf.iter_mut().rev().take_while(|c| **c >= last) {
        *c = 1.0;
    }
}

/// Parts of [0, 1) for which a search knows where to begin.
const N_GUIDES: usize = 64;

/// A cumulative table with the bins that `k / N_GUIDES` falls into, `k` in `0..=N_GUIDES`.
///
/// The guides leave a few entries of one or two cache lines to search, where halving the whole table
/// would touch one line per step.
#[derive(Clone, Copy)]
struct Table<'a> {
    cdf: &'a [f32],
    guides: &'a [u32],
}

/// Writes the guides of a table.
fn guide(cdf: &[f32], guides: &mut [u32]) {
    for (k, g) in guides.iter_mut().enumerate() {
        *g = search(cdf, k as f32 / N_GUIDES as f32, 0, cdf.len() - 2) as u32;
    }
}

/// The last bin in `low..=high` whose lower end is not above `u`; `low` where there is none.
#[inline]
fn search(cdf: &[f32], u: f32, low: usize, high: usize) -> usize {
    let mut low = low;
    let mut len = high - low + 1;
    // Halves without branches on the data: the comparison becomes a conditional move.
    while len > 1 {
        let half = len / 2;
        low = if cdf[low + half] <= u { low + half } else { low };
        len -= half;
    }
    low
}

impl Table<'_> {
    /// Bin, place in it in [0, 1), and its probability. Bins without width are passed over.
    #[inline]
    fn draw(self, u: f32) -> (usize, f32, f32) {
        let u = u.clamp(0.0, ONE_MINUS_EPSILON);
        let k = (u * N_GUIDES as f32) as usize;
        let i = search(self.cdf, u, self.guides[k] as usize, self.guides[k + 1] as usize);
        let width = self.cdf[i + 1] - self.cdf[i];
        (i, ((u - self.cdf[i]) / width).min(ONE_MINUS_EPSILON), width)
    }
}

/// A cumulative table and its guides, of one dimension.
#[derive(Clone, Debug)]
struct Cumulative {
    cdf: Vec<f32>,
    guides: Vec<u32>,
}

impl Cumulative {
    /// From at least one weight; also the sum of the weights.
    fn new(weights: impl ExactSizeIterator<Item = f64> + Clone) -> (Cumulative, f64) {
        let mut cdf = vec![0.0; weights.len() + 1];
        let mut guides = vec![0; N_GUIDES + 1];
        let total = accumulate(weights, &mut cdf);
        guide(&cdf, &mut guides);
        (Cumulative { cdf, guides }, total)
    }
    fn n_bins(&self) -> usize {
        self.cdf.len() - 1
    }
    #[inline]
    fn width(&self, i: usize) -> f32 {
        self.cdf[i + 1] - self.cdf[i]
    }
    #[inline]
    fn table(&self) -> Table<'_> {
        Table { cdf: &self.cdf, guides: &self.guides }
    }
    fn bytes(&self) -> usize {
        self.cdf.len() * size_of::<f32>() + self.guides.len() * size_of::<u32>()
    }
}

/// Bin of `x` among `n` equal ones; numbers outside [0, 1) count as the nearest inside.
#[inline]
fn bin(x: f32, n: usize) -> usize {
    ((x * n as f32) as usize).min(n - 1)
}

/// Place `t` in bin `i` of `n`, as a number in [0, 1) that [`bin`] brings back to `i`.
#[inline]
fn place(i: usize, t: f32, n: usize) -> f32 {
    let x = ((i as f32 + t) / n as f32).min(ONE_MINUS_EPSILON);
    // Rounding may have reached the next bin.
    if bin(x, n) == i { x } else { (i as f32 + 0.5) / n as f32 }
}

/// The inverse of [`Table::draw`] and [`place`].
#[inline]
fn invert(cdf: &[f32], x: f32) -> f32 {
    let n = cdf.len() - 1;
    let i = bin(x, n);
    let t = (x * n as f32 - i as f32).clamp(0.0, 1.0);
    (cdf[i] + t * (cdf[i + 1] - cdf[i])).min(ONE_MINUS_EPSILON)
}

/// A draw from a piecewise-constant distribution over [0, 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw1 {
    /// The point.
    pub x: f32,
    /// Density at the point.
    pub pdf: f32,
    /// The bin.
    pub index: usize,
}

/// A density over [0, 1) that is constant in each of `n` equal bins.
#[derive(Clone, Debug)]
pub struct Piecewise1 {
    cumulative: Cumulative,
    mean: f64,
}

impl Piecewise1 {
    /// The density proportional to `f`, one value per bin; no value at all counts as one bin.
    pub fn new(f: &[f32]) -> Piecewise1 {
        let f = if f.is_empty() { &[0.0] } else { f };
        let (cumulative, total) = Cumulative::new(f.iter().map(|w| counted(*w)));
        Piecewise1 { cumulative, mean: total / f.len() as f64 }
    }
    /// Number of bins.
    pub fn n_bins(&self) -> usize {
        self.cumulative.n_bins()
    }
    /// Integral of the counted values of `f` over [0, 1).
    pub fn integral(&self) -> f64 {
        self.mean
    }
    /// A point with this density; `u` in [0, 1) is mapped monotonically.
    #[inline]
    pub fn sample(&self, u: f32) -> Draw1 {
        let n = self.n_bins();
        let (index, t, width) = self.cumulative.table().draw(u);
        Draw1 { x: place(index, t, n), pdf: width * n as f32, index }
    }
    /// Density at `x`.
    #[inline]
    pub fn pdf(&self, x: f32) -> f32 {
        self.cumulative.width(bin(x, self.n_bins())) * self.n_bins() as f32
    }
    /// The uniform number that [`Piecewise1::sample`] maps to `x`, up to rounding.
    #[inline]
    pub fn invert(&self, x: f32) -> f32 {
        invert(&self.cumulative.cdf, x)
    }
    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.cumulative.bytes()
    }
}

/// A draw from a piecewise-constant distribution over the unit square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw2 {
    /// The point, column coordinate first.
    pub p: [f32; 2],
    /// Density at the point, per unit area.
    pub pdf: f32,
    /// Column and row of the cell.
    pub index: [usize; 2],
}

/// A density over the unit square that is constant in each cell of a grid.
#[derive(Clone, Debug)]
pub struct Piecewise2 {
    width: usize,
    height: usize,
    /// `width + 1` numbers per row.
    rows: Vec<f32>,
    /// `N_GUIDES + 1` numbers per row.
    guides: Vec<u32>,
    /// Which row.
    marginal: Cumulative,
    mean: f64,
}

impl Piecewise2 {
    /// The density proportional to `f`, stored row by row.
    ///
    /// Cells that `f` is too short for count as zero; a side of 0 counts as 1.
    pub fn new(f: &[f32], width: usize, height: usize) -> Piecewise2 {
        let (width, height) = (width.max(1), height.max(1));
        let mut rows = vec![0.0; (width + 1) * height];
        let mut guides = vec![0; (N_GUIDES + 1) * height];
        let mut totals = vec![0.0; height];
        let tables = rows.par_chunks_exact_mut(width + 1).zip(guides.par_chunks_exact_mut(N_GUIDES + 1));
        tables.zip(&mut totals).enumerate().for_each(|(y, ((row, guides), total))| {
            let values = (0..width).map(|x| f.get(y * width + x).map_or(0.0, |w| counted(*w)));
            *total = accumulate(values, row);
            guide(row, guides);
        });
        let (marginal, total) = Cumulative::new(totals.iter().copied());
        Piecewise2 { width, height, rows, guides, marginal, mean: total / (width * height) as f64 }
    }
    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }
    /// Integral of the counted values of `f` over the unit square.
    pub fn integral(&self) -> f64 {
        self.mean
    }
    #[inline]
    fn row(&self, y: usize) -> &[f32] {
        &self.rows[y * (self.width + 1)..(y + 1) * (self.width + 1)]
    }
    /// A point with this density; `u[1]` chooses the row, `u[0]` the place in it.
    #[inline]
    pub fn sample(&self, u: [f32; 2]) -> Draw2 {
        let (y, ty, py) = self.marginal.table().draw(u[1]);
        let guides = &self.guides[y * (N_GUIDES + 1)..(y + 1) * (N_GUIDES + 1)];
        let (x, tx, px) = Table { cdf: self.row(y), guides }.draw(u[0]);
        Draw2 {
            p: [place(x, tx, self.width), place(y, ty, self.height)],
            pdf: px * py * (self.width * self.height) as f32,
            index: [x, y],
        }
    }
    /// Density at a point, per unit area.
    #[inline]
    pub fn pdf(&self, p: [f32; 2]) -> f32 {
        let (x, y) = (bin(p[0], self.width), bin(p[1], self.height));
        let row = self.row(y);
        let (px, py) = (row[x + 1] - row[x], self.marginal.width(y));
        px * py * (self.width * self.height) as f32
    }
    /// The uniform numbers that [`Piecewise2::sample`] maps to `p`, up to rounding.
    #[inline]
    pub fn invert(&self, p: [f32; 2]) -> [f32; 2] {
        [invert(self.row(bin(p[1], self.height)), p[0]), invert(&self.marginal.cdf, p[1])]
    }
    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.rows.len() * size_of::<f32>() + self.guides.len() * size_of::<u32>() + self.marginal.bytes()
    }
}

/// A draw from a [`Discrete`] distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The item.
    pub index: usize,
    /// Its probability.
    pub probability: f32,
    /// A uniform number in [0, 1), independent of the item; it has as many bits fewer than `u` as the choice took.
    pub u: f32,
}

/// A choice among items with given weights.
///
/// A cumulative table rather than an alias table: the map is monotone, so stratified numbers choose
/// stratified items.
#[derive(Clone, Debug)]
pub struct Discrete {
    cumulative: Cumulative,
}

impl Discrete {
    /// Probabilities proportional to the weights; `None` where there are no items.
    pub fn new(weights: &[f32]) -> Option<Discrete> {
        if weights.is_empty() {
            return None;
        }
        Some(Discrete { cumulative: Cumulative::new(weights.iter().map(|w| counted(*w))).0 })
    }
    /// Number of items.
    pub fn n_items(&self) -> usize {
        self.cumulative.n_bins()
    }
    /// Chooses an item with `u` in [0, 1).
    #[inline]
    pub fn sample(&self, u: f32) -> Choice {
        let (index, u, probability) = self.cumulative.table().draw(u);
        Choice { index, probability, u }
    }
    /// Probability of an item; 0 where there is no such item.
    #[inline]
    pub fn probability(&self, index: usize) -> f32 {
        if index < self.n_items() { self.cumulative.width(index) } else { 0.0 }
    }
    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.cumulative.bytes()
    }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "that these numbers agree to the last bit is what is tested")]
mod tests {
    use super::*;

    /// Numbers a sampler gives out: multiples of 2^-24.
    fn units(n: u32) -> impl Iterator<Item = f32> {
        (0..n).map(move |i| (u64::from(i) * (1 << 24) / u64::from(n)) as f32 / STEPS as f32)
    }

    const WEIGHTS: [f32; 9] = [0.0, 1.0, 0.0, 0.0, 5.0, 2.5, 1e-12, 1.5, 0.0];

    #[test]
    fn frequencies_equal_probabilities_to_the_last_step() {
        let d = Discrete::new(&WEIGHTS).unwrap();
        let mut count = [0u32; 9];
        // Every number there is.
        for i in 0..1u32 << 24 {
            count[d.sample(i as f32 / STEPS as f32).index] += 1;
        }
        for (i, c) in count.iter().enumerate() {
            assert_eq!(f64::from(*c) / STEPS, f64::from(d.probability(i)), "item {i}");
            assert_eq!(*c > 0, WEIGHTS[i] > 0.0, "item {i}");
            assert!((f64::from(*c) / STEPS - f64::from(WEIGHTS[i]) / 10.0).abs() < 1e-6, "item {i}");
        }
        assert_eq!(d.probability(9), 0.0);
    }

    #[test]
    fn the_remapped_number_is_uniform() {
        let d = Discrete::new(&WEIGHTS).unwrap();
        let mut bins = [[0u32; 4]; 9];
        for u in units(100_000) {
            let c = d.sample(u);
            bins[c.index][(c.u * 4.0) as usize] += 1;
        }
        for i in [1, 4, 5, 7] {
            let spread = bins[i].iter().max().unwrap() - bins[i].iter().min().unwrap();
            assert!(spread <= 2, "item {i}: {:?}", bins[i]);
        }
    }

    #[test]
    fn draws_agree_with_density_and_inverse() {
        let f = Piecewise1::new(&WEIGHTS);
        assert!((f.integral() - 10.0 / 9.0).abs() < 1e-7);
        for u in units(5000) {
            let d = f.sample(u);
            assert_eq!(d.index, bin(d.x, 9), "u {u}");
            assert!(d.pdf > 0.0 && d.pdf == f.pdf(d.x), "u {u}");
            // Bin 6 is one step wide, and its inverse as exact as `x` is there.
            assert!((f.invert(d.x) - u).abs() < 1e-6, "u {u}: {}", f.invert(d.x));
        }
    }

    #[test]
    fn the_plane_is_sampled_with_its_density() {
        let (w, h) = (7, 5);
        let f: Vec<f32> = (0..35).map(|i| if i / w == 2 { 0.0 } else { (i * i % 11) as f32 }).collect();
        let d = Piecewise2::new(&f, w, h);
        let sum: f32 = f.iter().sum();
        assert!((d.integral() - f64::from(sum) / 35.0).abs() < 1e-6);
        let mut count = [0u32; 35];
        for u in units(300) {
            for v in units(300) {
                let s = d.sample([u, v]);
                assert!(s.pdf > 0.0 && s.pdf == d.pdf(s.p), "{u} {v}");
                let back = d.invert(s.p);
                assert!((back[0] - u).abs() < 1e-5 && (back[1] - v).abs() < 1e-5, "{u} {v}: {back:?}");
                count[s.index[1] * w + s.index[0]] += 1;
            }
        }
        for (i, c) in count.iter().enumerate() {
            let want = f[i] / sum;
            assert!((*c as f32 / 90_000.0 - want).abs() < 2e-3, "cell {i}: {c} for {want}");
            let p = [((i % w) as f32 + 0.5) / w as f32, ((i / w) as f32 + 0.5) / h as f32];
            assert!((d.pdf(p) - want * 35.0).abs() < 1e-4 * 35.0, "cell {i}");
        }
        assert_eq!(d.bytes(), (8 * 5 + 6 + 65 * 6) * 4);
    }

    #[test]
    fn nothing_positive_means_uniform() {
        for weights in [vec![0.0; 4], vec![f32::NAN, -1.0, f32::INFINITY, 0.0]] {
            let d = Discrete::new(&weights).unwrap();
            assert!((0..4).all(|i| d.probability(i) == 0.25), "{weights:?}");
            let p = Piecewise2::new(&weights, 2, 2);
            assert!(p.pdf([0.1, 0.9]) == 1.0 && p.integral() == 0.0);
            assert_eq!(p.sample([0.75, 0.25]).index, [1, 0]);
        }
        assert!(Discrete::new(&[]).is_none());
        assert_eq!(Piecewise1::new(&[]).sample(0.5), Draw1 { x: 0.5, pdf: 1.0, index: 0 });
    }

    #[test]
    fn a_dim_cell_beside_a_sun_is_still_drawn() {
        let mut f = vec![1e-9f32; 4096];
        f[1000] = 1e9;
        let d = Piecewise1::new(&f);
        assert!((0..4096).all(|i| d.pdf((i as f32 + 0.5) / 4096.0) > 0.0));
        // The tilt towards uniform: 4095 steps of 2^-24.
        assert!((d.pdf(1000.5 / 4096.0) / 4096.0 - (1.0 - 4095.0 / STEPS as f32)).abs() < 1e-6);
    }

    #[test]
    fn ends_of_the_range_are_safe() {
        let d = Piecewise1::new(&[0.0, 3.0, 0.0]);
        for u in [0.0, ONE_MINUS_EPSILON, 1.0, 7.0, -1.0, f32::NAN] {
            let s = d.sample(u);
            assert!(s.x >= 0.0 && s.x < 1.0, "{u}: {s:?}");
        }
        assert_eq!((d.pdf(-3.0), d.pdf(1.0), d.pdf(f32::NAN)), (0.0, 0.0, 0.0));
    }
}
