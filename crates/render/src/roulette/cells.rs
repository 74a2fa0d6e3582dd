//! Means of what is found and what that costs, over the space of a scene: [`Cells`].

use sparrow_math::{Aabb, Vec3};

/// Cells along the longest side of the scene.
const N: usize = 32;
/// A cell this many times as wide holds what is known where a cell knows little.
const COARSER: usize = 4;
/// Outlooks that make a cell count as much as the coarser one.
const TRUST: f64 = 16.0;

/// Sums over outlooks.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    n: f64,
    /// Of the squares of what was found.
    squares: f64,
    rays: f64,
}

impl Sums {
    fn add(&mut self, o: &Sums) {
        self.n += o.n;
        self.squares += o.squares;
        self.rays += o.rays;
    }
}

/// Cubes of equal size that fill the bounds of a scene.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    lo: Vec3<f32>,
    per_length: f32,
    size: [usize; 3],
    sums: Vec<Sums>,
}

impl Cells {
    pub(super) fn new(bounds: &Aabb) -> Cells {
        let d = bounds.hi - bounds.lo;
        let longest = d.x.max(d.y).max(d.z);
        let per_length = if longest > 0.0 && longest.is_finite() { N as f32 / longest } else { 0.0 };
        let size = [d.x, d.y, d.z].map(|side| (((side * per_length) as usize) + 1).min(N));
        Cells { lo: bounds.lo, per_length, size, sums: vec![Sums::default(); size.iter().product()] }
    }

    /// The cell of a point; the nearest one for points outside.
    #[inline]
    pub(super) fn of(&self, p: Vec3<f32>) -> usize {
        let d = (p - self.lo) * self.per_length;
        let [x, y, z] = [(d.x, 0), (d.y, 1), (d.z, 2)].map(|(d, axis)| (d as usize).min(self.size[axis] - 1));
        index(self.size, [x, y, z])
    }

    /// A path found `found` from `p` on, by so many rays.
    pub(super) fn add(&mut self, p: Vec3<f32>, found: f64, rays: f64) {
        let cell = self.of(p);
        self.sums[cell].add(&Sums { n: 1.0, squares: found * found, rays });
    }

    /// `sqrt(M / C)` of every cell.
    pub(super) fn worth(&self) -> Vec<f32> {
        means(&self.sums, self.size).into_iter().map(|[m, c]| (m / c).sqrt() as f32).collect()
    }
}

fn index(size: [usize; 3], [x, y, z]: [usize; 3]) -> usize {
    (z * size[1] + y) * size[0] + x
}

/// Mean square and mean number of rays of each cell, the less its own the fewer there are.
fn means(sums: &[Sums], size: [usize; 3]) -> Vec<[f64; 2]> {
    if let [all] = sums {
        return vec![if all.n > 0.0 { [all.squares / all.n, all.rays / all.n] } else { [0.0, 1.0] }];
    }
    let coarse_size = size.map(|n| n.div_ceil(COARSER));
    let around = |i: usize| {
        let place = [i % size[0], i / size[0] % size[1], i / (size[0] * size[1])];
        index(coarse_size, place.map(|k| k / COARSER))
    };
    let mut coarse = vec![Sums::default(); coarse_size.iter().product()];
    sums.iter().enumerate().for_each(|(i, s)| coarse[around(i)].add(s));
    let coarse = means(&coarse, coarse_size);
    let mean = |(i, s): (usize, &Sums)| {
        let [squares, rays] = coarse[around(i)];
        [(s.squares + TRUST * squares) / (s.n + TRUST), (s.rays + TRUST * rays) / (s.n + TRUST)]
    };
    sums.iter().enumerate().map(mean).collect()
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "a single mean is exact")]
mod tests {
    use sparrow_math::vec3;

    use super::*;

    fn cells() -> Cells {
        Cells::new(&Aabb { lo: vec3(-1.0, 0.0, 0.0), hi: vec3(1.0, 0.5, 0.0) })
    }

    #[test]
    fn every_point_has_a_cell() {
        let cells = cells();
        assert_eq!(cells.size, [32, 9, 1]);
        let inside = cells.of(vec3(0.99, 0.49, 0.0));
        assert_eq!((cells.of(vec3(-1.0, 0.0, 0.0)), inside), (0, 7 * 32 + 31));
        for p in [vec3(9.0, 9.0, 9.0), vec3(f32::NAN, -1e30, f32::INFINITY)] {
            assert!(cells.of(p) < cells.sums.len(), "{p:?}");
        }
        assert_eq!(Cells::new(&Aabb::EMPTY).sums.len(), 1);
    }

    #[test]
    fn what_many_paths_found_counts_where_they_were() {
        let mut cells = cells();
        let (bright, dark) = (vec3(-0.9, 0.1, 0.0), vec3(0.9, 0.1, 0.0));
        assert!(cells.worth().iter().all(|w| *w == 0.0));
        for _ in 0..10_000 {
            cells.add(bright, 6.0, 4.0);
            cells.add(dark, 1.0, 1.0);
        }
        let worth = cells.worth();
        let (b, d) = (worth[cells.of(bright)], worth[cells.of(dark)]);
        // Own means are 3 and 1. Of 10 016 squares 16 are the surroundings': 18.5 each, 1.5 % of the smaller root.
        assert!((b - 3.0).abs() < 0.02 && (d - 1.0).abs() < 0.02, "{b} {d}");
        // An empty cell takes what was found in its half of the scene.
        let empty = worth[cells.of(vec3(0.05, 0.3, 0.0))];
        assert!((empty - 1.0).abs() < 0.02, "{empty}");
    }
}
