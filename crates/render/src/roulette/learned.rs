//! What a pilot has learned: [`Learned`].

use sparrow_math::Vec3;

use super::cells::Cells;
use super::trail::Trail;

/// Radiances count as no darker than this share of the picture's mean.
const DARKEST: f64 = 0.1;

/// What paths of a scene find and what it costs.
#[derive(Debug)]
pub(crate) struct Learned {
    cells: Cells,
    /// `sqrt(M / C)` of each cell.
    worth: Vec<f32>,
    windows: Windows,
    /// `sqrt(C_I / V) / I` of each window.
    eagerness: Vec<f32>,
}

/// Squares of pixels.
#[derive(Clone, Debug)]
struct Windows {
    /// Logarithm of the pixels along a side.
    log2_side: u32,
    size: [u32; 2],
}

impl Windows {
    #[inline]
    fn of(&self, pixel: [u32; 2]) -> usize {
        let [x, y] = [0, 1].map(|i| (pixel[i] >> self.log2_side).min(self.size[i] - 1));
        (y * self.size[0] + x) as usize
    }
}

/// Sums over the paths of a window.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    n: f64,
    first: f64,
    second: f64,
}

impl Learned {
    /// From the trails of pixels, in windows whose side has the logarithm `log2_side`.
    pub(super) fn new<'a>(
        mut cells: Cells,
        size: [u32; 2],
        log2_side: u32,
        trails: impl Iterator<Item = &'a ([u32; 2], Trail)>,
    ) -> Learned {
        let windows = Windows { log2_side, size: size.map(|s| (s >> log2_side) + 1) };
        let mut sums = vec![Sums::default(); (windows.size[0] * windows.size[1]) as usize];
        let mut rays = 0.0;
        for (pixel, trail) in trails.filter(|(_, trail)| trail.total().is_finite()) {
            let total = f64::from(trail.total());
            let window = &mut sums[windows.of(*pixel)];
            window.n += 1.0;
            window.first += total;
            window.second += total * total;
            rays += f64::from(trail.n_rays());
            trail.outlooks().for_each(|o| cells.add(o.p, f64::from(o.found), f64::from(o.n_rays)));
        }
        let eagerness = eagerness(&windows, &sums, rays);
        Learned { worth: cells.worth(), cells, windows, eagerness }
    }

    /// The probability to go on from `p` with all of what a path of `pixel` began with; above one where more paths would pay.
    #[inline]
    pub(super) fn value(&self, pixel: [u32; 2], p: Vec3<f32>) -> f32 {
        self.eagerness[self.windows.of(pixel)] * self.worth[self.cells.of(p)]
    }
}

/// `sqrt(C_I / V) / I` of each window, from means that fade over its neighbours.
fn eagerness(windows: &Windows, sums: &[Sums], rays: f64) -> Vec<f32> {
    let n: f64 = sums.iter().map(|s| s.n).sum();
    let darkest = DARKEST * sums.iter().map(|s| s.first).sum::<f64>() / n.max(1.0);
    let [w, h] = windows.size.map(i64::from);
    let (mut v, mut radiance) = (0.0, Vec::with_capacity(sums.len()));
    for (x, y) in (0..h).flat_map(|y| (0..w).map(move |x| (x, y))) {
        let mut around = Sums::default();
        for (dx, dy) in (-1..=1i64).flat_map(|dy| (-1..=1i64).map(move |dx| (dx, dy))) {
            let (x, y) = ((x + dx).clamp(0, w - 1), (y + dy).clamp(0, h - 1));
            let (s, weight) =
                (&sums[(y * w + x) as usize], f64::from((2 - dx.abs() as i32) * (2 - dy.abs() as i32)));
            around.n += weight * s.n;
            around.first += weight * s.first;
            around.second += weight * s.second;
        }
        let (mean, square) = (around.first / around.n.max(1.0), around.second / around.n.max(1.0));
        let i2 = mean * mean + darkest * darkest;
        radiance.push(i2.sqrt());
        if i2 > 0.0 {
            v += sums[(y * w + x) as usize].n * (square - mean * mean).max(0.0) / i2;
        }
    }
    // Where nothing was found, or nothing varied, throughput decides.
    let per_radiance = if v > 0.0 { (rays / v).sqrt() } else { 0.0 };
    radiance.into_iter().map(|i| if i > 0.0 { (per_radiance / i) as f32 } else { 0.0 }).collect()
}
