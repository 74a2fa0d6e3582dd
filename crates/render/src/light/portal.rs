//! Openings through which environment light is sampled. [Bitterli2015]
//!
//! Directions are given by two angles, in which every rectangle parallel to the opening is a rectangle again, wherever it is seen from.

use core::f32::consts::{FRAC_PI_2, PI};

use sparrow_math::{Real, Vec3, vec3};

/// A rectangle that light comes through, and how bright the environment is in each direction outwards.
#[derive(Debug)]
pub struct Portal {
    /// Along the edges, and outwards.
    axes: [Vec3<f32>; 3],
    /// Opposite corners, in the frame of the axes.
    corners: [Vec3<f32>; 2],
    grid: SummedGrid,
}

/// Where a direction lies in the unit square, which stands for the half of the sphere with positive z.
fn to_square(d: Vec3<f32>) -> Option<[f32; 2]> {
    let angle = |x: f32| (Real::atan2(x, d.z) + FRAC_PI_2) / PI;
    (d.z > 0.0).then(|| [angle(d.x), angle(d.y)])
}

/// The unit direction there, and the solid angle for a unit of area.
fn from_square(p: [f32; 2]) -> (Vec3<f32>, f32) {
    let [tx, ty] = p.map(|x| Real::tan((x - 0.5) * PI));
    let d = vec3(tx, ty, 1.0).normalized();
    (d, stretch(d))
}

/// Solid angle for a unit of area of the square. [PharrJakobHumphreys2023, section 12.5.3]
fn stretch(d: Vec3<f32>) -> f32 {
    PI * PI * (1.0 - d.x * d.x) * (1.0 - d.y * d.y) / d.z
}

impl Portal {
    /// From four corners in order, of which `(p3 - p0) x (p1 - p0)` points outwards, as in pbrt-v4; and the radiance of the environment, which is
    /// looked up in `n` by `n` cells.
    ///
    /// `None` where they do not span a rectangle.
    pub(super) fn new(
        corners: [Vec3<f64>; 4],
        n: usize,
        radiance: impl Fn(Vec3<f32>) -> f32,
    ) -> Option<Portal> {
        let [p0, p1, p2, p3] = corners;
        let (x, y) = ((p3 - p0).normalized(), (p1 - p0).normalized());
        let closed = (p0 + p2 - p1 - p3).length() <= 1e-3 * (p2 - p0).length();
        if !(closed && x.dot(y).abs() <= 1e-3) {
            return None;
        }
        let axes = [x, y, x.cross(y)].map(|a| a.to_f32().normalized());
        let [a, b] =
            [p0, p2].map(|p| p.to_f32()).map(|p| vec3(p.dot(axes[0]), p.dot(axes[1]), p.dot(axes[2])));
        // Four directions a cell.
        let cell = |i: usize, j: usize| {
            let at = |k: usize, h: f32| (k as f32 + h) / n as f32;
            let sub = [0.25, 0.75].map(|h| [0.25, 0.75].map(|g| [at(i, h), at(j, g)]));
            let bright = sub.iter().flatten().map(|p| {
                let (d, stretch) = from_square(*p);
                let b = radiance(axes[0] * d.x + axes[1] * d.y + axes[2] * d.z) * stretch;
                if b.is_finite() { f64::from(b.max(0.0)) } else { 0.0 }
            });
            bright.sum::<f64>() / 4.0
        };
        Some(Portal { axes, corners: [a.min(b), a.max(b)], grid: SummedGrid::new(n, cell) })
    }

    /// The part of the square that the opening fills, lower and upper corner; none from beyond it.
    fn window(&self, from: Vec3<f32>) -> Option<[[f32; 2]; 2]> {
        let from = vec3(from.dot(self.axes[0]), from.dot(self.axes[1]), from.dot(self.axes[2]));
        let [lo, hi] = self.corners.map(|c| to_square(c - from));
        let (lo, hi) = (lo?, hi?);
        (lo[0] < hi[0] && lo[1] < hi[1]).then_some([lo, hi])
    }

    /// A direction through the opening and its density in 1/sr; none where nothing shines through.
    pub(super) fn sample(&self, from: Vec3<f32>, u: [f32; 2]) -> Option<(Vec3<f32>, f32)> {
        let (p, pdf) = self.grid.sample(self.window(from)?, u)?;
        let (d, stretch) = from_square(p);
        let pdf = pdf / stretch;
        let wi = self.axes[0] * d.x + self.axes[1] * d.y + self.axes[2] * d.z;
        (pdf > 0.0 && pdf.is_finite()).then_some((wi, pdf))
    }

    /// Density of a direction, in 1/sr.
    pub(super) fn pdf(&self, from: Vec3<f32>, wi: Vec3<f32>) -> f32 {
        let d = vec3(wi.dot(self.axes[0]), wi.dot(self.axes[1]), wi.dot(self.axes[2]));
        let pdf = self.window(from).zip(to_square(d)).map(|(w, p)| self.grid.pdf(w, p) / stretch(d));
        pdf.filter(|p| p.is_finite()).unwrap_or(0.0)
    }

    /// Memory, in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.grid.sums.len() * size_of::<f64>()
    }
}

/// A density over the unit square, constant in each cell, of which any rectangle can be sampled: a summed-area table.
#[derive(Debug)]
struct SummedGrid {
    n: usize,
    /// Sums of all cells before a column and a row, of `n + 1` each.
    sums: Vec<f64>,
}

impl SummedGrid {
    fn new(n: usize, cell: impl Fn(usize, usize) -> f64) -> SummedGrid {
        let mut sums = vec![0.0; (n + 1) * (n + 1)];
        for j in 0..n {
            let mut row = 0.0;
            for i in 0..n {
                row += cell(i, j);
                sums[(j + 1) * (n + 1) + i + 1] = sums[j * (n + 1) + i + 1] + row;
            }
        }
        SummedGrid { n, sums }
    }

    /// Sum up to a place, in cells.
    fn up_to(&self, x: f64, y: f64) -> f64 {
        let cell = |v: f64| (v as usize).min(self.n - 1);
        let (i, j) = (cell(x), cell(y));
        let (s, t) = (x - i as f64, y - j as f64);
        let at = |i: usize, j: usize| self.sums[j * (self.n + 1) + i];
        let row = |j: usize| at(i, j) * (1.0 - s) + at(i + 1, j) * s;
        row(j) * (1.0 - t) + row(j + 1) * t
    }

    fn within(&self, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> f64 {
        let sum = self.up_to(x1, y1) - self.up_to(x0, y1) - self.up_to(x1, y0) + self.up_to(x0, y0);
        sum.max(0.0)
    }

    /// The window in cells: its ranges of columns and rows.
    fn ranges(&self, [lo, hi]: [[f32; 2]; 2]) -> [[f64; 2]; 2] {
        let scaled = |k: usize| [lo[k], hi[k]].map(|v| f64::from(v).clamp(0.0, 1.0) * self.n as f64);
        [scaled(0), scaled(1)]
    }

    /// A point of the window and its density, per unit area.
    fn sample(&self, window: [[f32; 2]; 2], u: [f32; 2]) -> Option<([f32; 2], f32)> {
        let [xs, ys] = self.ranges(window);
        let x = invert(xs, u[0], |x| self.within([xs[0], x], ys))?;
        let column = (x as usize).min(self.n - 1) as f64;
        let y = invert(ys, u[1], |y| self.within([column, column + 1.0], [ys[0], y]))?;
        let p = [x, y].map(|v| (v / self.n as f64) as f32);
        // What rounding has taken out of the window.
        let p = [0, 1].map(|k| p[k].clamp(window[0][k], window[1][k]));
        Some((p, self.pdf(window, p)))
    }

    /// Density of a point, per unit area; zero beyond the window.
    fn pdf(&self, window: [[f32; 2]; 2], p: [f32; 2]) -> f32 {
        if (0..2).any(|k| p[k] < window[0][k] || p[k] > window[1][k]) {
            return 0.0;
        }
        let [xs, ys] = self.ranges(window);
        let [i, j] = p.map(|v| ((f64::from(v) * self.n as f64) as usize).min(self.n - 1) as f64);
        let total = self.within(xs, ys);
        let own = self.within([i, i + 1.0], [j, j + 1.0]);
        if total > 0.0 { (own / total * (self.n * self.n) as f64) as f32 } else { 0.0 }
    }
}

/// Where a sum that grows over a range, evenly within each cell, has reached the part `u` of its whole; none where the whole is zero.
fn invert([lo, hi]: [f64; 2], u: f32, sum: impl Fn(f64) -> f64) -> Option<f64> {
    let whole = sum(hi);
    if !(whole > 0.0) {
        return None;
    }
    let target = f64::from(u) * whole;
    // The last end of a cell in the range up to which the sum does not exceed the target.
    let (mut below, mut above) = (lo.floor(), hi.ceil());
    while above - below > 1.0 {
        let middle = ((below + above) * 0.5).floor();
        if sum(middle) <= target { below = middle } else { above = middle }
    }
    let (a, b) = (below.max(lo), above.min(hi));
    let (sa, sb) = (sum(a), sum(b));
    Some(if sb > sa { (a + (b - a) * (target - sa) / (sb - sa)).clamp(a, b) } else { a })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [Vec3<f64>; 4] =
        [vec3(-1.0, -0.5, 2.0), vec3(-1.0, 1.5, 2.0), vec3(0.5, 1.5, 2.0), vec3(0.5, -0.5, 2.0)];

    /// A sky with a patch sixty times as bright.
    fn sky(d: Vec3<f32>) -> f32 {
        0.2 + d.x.max(0.0) + if d.dot(vec3(-0.2, 0.1, 0.97)) > 0.98 { 60.0 } else { 0.0 }
    }

    fn grid(n: u32) -> impl Iterator<Item = [f32; 2]> {
        let at = move |k: u32| (k as f32 + 0.5) / n as f32;
        (0..n * n).map(move |i| [at(i % n), at(i / n)])
    }

    #[test]
    fn the_square_is_half_of_the_sphere() {
        let mean = grid(400).map(|p| f64::from(from_square(p).1)).sum::<f64>() / 160_000.0;
        assert!((mean / core::f64::consts::TAU - 1.0).abs() < 1e-3, "{mean}");
        for p in grid(9) {
            let (d, s) = from_square(p);
            let back = to_square(d).unwrap();
            assert!((back[0] - p[0]).abs() + (back[1] - p[1]).abs() < 1e-5 && s > 0.0, "{p:?}");
        }
    }

    #[test]
    fn directions_pass_the_opening_with_the_density_that_is_said() {
        let portal = Portal::new(CORNERS, 128, sky).unwrap();
        for from in [vec3(0.0, 0.0, 0.0), vec3(2.0, 1.0, 1.5), vec3(-0.9, 0.2, 1.99), vec3(30.0, -20.0, -9.0)]
        {
            for u in grid(30) {
                let (wi, pdf) = portal.sample(from, u).unwrap();
                let said = portal.pdf(from, wi);
                let through = from + wi * ((2.0 - from.z) / wi.z);
                let slack = 1e-4 * (1.0 + from.length());
                let inside = (-1.0 - slack..=0.5 + slack).contains(&through.x)
                    && (-0.5 - slack..=1.5 + slack).contains(&through.y);
                assert!(inside, "{from:?}: {through:?}");
                // On the edge of a cell rounding may say the neighbour's density.
                assert!(
                    said > 0.0 || u.iter().any(|u| *u < 0.02 || *u > 0.98),
                    "{from:?} {u:?}: {pdf}, {said}"
                );
            }
            let agree = grid(30).filter(|u| {
                let (wi, pdf) = portal.sample(from, *u).unwrap();
                (portal.pdf(from, wi) / pdf - 1.0).abs() < 1e-2
            });
            assert!(agree.count() > 870, "{from:?}");
        }
        assert!(portal.sample(vec3(0.0, 0.0, 2.5), [0.5; 2]).is_none());
    }

    #[test]
    fn densities_integrate_to_one_and_find_the_bright_patch() {
        let portal = Portal::new(CORNERS, 128, sky).unwrap();
        for from in [vec3(0.0, 0.0, 0.0), vec3(2.0, 1.0, 1.5)] {
            let cell = 1.0 / 1_000_000.0;
            let whole: f64 = grid(1000)
                .map(|p| {
                    let (d, s) = from_square(p);
                    let wi = portal.axes[0] * d.x + portal.axes[1] * d.y + portal.axes[2] * d.z;
                    f64::from(portal.pdf(from, wi) * s) * cell
                })
                .sum();
            // From aside the opening is fifty cells of this sum wide, of which its edges cut two.
            assert!((whole - 1.0).abs() < 0.04, "{from:?}: {whole}");
        }
        // Sampling by brightness leaves far less variance than sampling the opening evenly.
        let even = Portal::new(CORNERS, 128, |_| 1.0).unwrap();
        let spread = |portal: &Portal| {
            let from = vec3(0.0, 0.0, 0.0);
            let weight = |u| portal.sample(from, u).map_or(0.0, |(wi, pdf)| f64::from(sky(wi) / pdf));
            let weights: Vec<f64> = grid(40).map(weight).collect();
            let mean = weights.iter().sum::<f64>() / 1600.0;
            weights.iter().map(|w| (w / mean - 1.0).sqr()).sum::<f64>() / 1600.0
        };
        let (bright, even) = (spread(&portal), spread(&even));
        assert!(bright < 0.1 * even, "{bright}, evenly {even}");
    }

    #[test]
    fn what_is_no_rectangle_is_refused() {
        let mut bent = CORNERS;
        bent[2].z += 0.3;
        assert!(Portal::new(bent, 8, sky).is_none());
        assert!(Portal::new([vec3(0.0, 0.0, 0.0); 4], 8, sky).is_none());
    }
}
