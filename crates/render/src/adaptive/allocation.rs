//! How many samples each tile gets: [`Allocation`].

/// Samples of a pixel of one half come in blocks that the samplers stratify.
const BLOCK: f64 = 16.0;

/// Least share of the mean demand that a tile is given: what the pilot has not seen may still be there.
const FLOOR: f64 = 1.0 / 64.0;

/// Tiles of two halves, with the variance that a sample of each has.
///
/// `n_t` proportional to `sqrt(v_t)` gives the least `sum v_t / n_t` for a given `sum n_t`. [Cochran1977, sec. 5.5]
pub(super) struct Allocation {
    /// Relative variance of one sample as half 0 and half 1 see it, for each tile.
    demand: [Vec<f64>; 2],
    /// Pixels of each tile.
    pixels: Vec<f64>,
    /// Least and greatest number of samples of a pixel, in one half.
    range: [u32; 2],
}

/// Samples of a pixel in each tile, for half 0 and half 1.
pub(super) type Counts = [Vec<u32>; 2];

impl Allocation {
    /// `columns` is the number of tiles in a row.
    pub(super) fn new(
        demand: [Vec<f64>; 2],
        pixels: Vec<f64>,
        columns: usize,
        range: [u32; 2],
    ) -> Allocation {
        let demand = demand.map(|v| {
            let v = smooth(&v, columns);
            let mean = v.iter().sum::<f64>() / v.len().max(1) as f64;
            v.into_iter().map(|d| d.max(FLOOR * mean)).collect()
        });
        Allocation { demand, pixels, range }
    }

    /// Square of the noise that these numbers of samples leave, as far as samples are independent.
    pub(super) fn error2(&self, counts: &Counts) -> f64 {
        let half = |h: usize| -> f64 {
            let tiles = self.demand[h].iter().zip(&counts[h]).zip(&self.pixels);
            tiles.map(|((v, n), pixels)| pixels * v / f64::from(*n)).sum()
        };
        0.25 * (half(0) + half(1)) / self.pixels.iter().sum::<f64>()
    }

    /// All samples together.
    pub(super) fn total(&self, counts: &Counts) -> u64 {
        let half = |h: &Vec<u32>| -> f64 { h.iter().zip(&self.pixels).map(|(n, p)| f64::from(*n) * p).sum() };
        counts.iter().map(half).sum::<f64>() as u64
    }

    /// The fewest samples whose [`error2`](Self::error2) is at most `goal`; the most there may be, where that is not enough.
    pub(super) fn reach(&self, goal: f64) -> Counts {
        let (mut low, mut high) = (0.0f64, 1.0f64);
        while self.error2(&self.counts(high)) > goal && high < 1e12 {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..40 {
            let mid = 0.5 * (low + high);
            if self.error2(&self.counts(mid)) > goal {
                low = mid;
            } else {
                high = mid;
            }
        }
        self.counts(high)
    }

    /// `scale sqrt(v)` samples, in whole blocks; each half by what the *other* has seen.
    fn counts(&self, scale: f64) -> Counts {
        let [least, most] = self.range;
        let count = |v: &f64| {
            let n = (scale * v.sqrt() / BLOCK).ceil() * BLOCK;
            (n as u32).clamp(least, most)
        };
        [1, 0].map(|other: usize| self.demand[other].iter().map(count).collect())
    }
}

/// Half of each value from the tile itself, half from the up to eight around it.
fn smooth(v: &[f64], columns: usize) -> Vec<f64> {
    let columns = columns.max(1);
    let rows = v.len().div_ceil(columns);
    let near = |i: usize, n: usize| i.saturating_sub(1)..(i + 2).min(n);
    let at = |i: usize| {
        let (x, y) = (i % columns, i / columns);
        let all = near(y, rows).flat_map(|r| near(x, columns).map(move |c| r * columns + c));
        let (sum, n) =
            all.filter(|j| *j != i).filter_map(|j| v.get(j)).fold((0.0, 0.0), |(s, n), d| (s + d, n + 1.0));
        if n > 0.0 { 0.5 * (v[i] + sum / n) } else { v[i] }
    };
    (0..v.len()).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn allocation(range: [u32; 2]) -> Allocation {
        let quiet_but_one = |loud: usize| (0..64).map(|i| if i == loud { 100.0 } else { 1.0 }).collect();
        Allocation::new([quiet_but_one(9), quiet_but_one(54)], vec![256.0; 64], 8, range)
    }

    #[test]
    fn each_half_follows_the_other() {
        let counts = allocation([8, 1 << 20]).reach(1e-3);
        let busiest = |c: &[u32]| (0..64).max_by_key(|i| c[*i]).unwrap();
        assert_eq!(counts.each_ref().map(|c| busiest(c)), [54, 9]);
    }

    #[test]
    fn the_goal_is_reached_with_less_than_equal_counts_need() {
        let a = allocation([8, 1 << 20]);
        for goal in [1e-2, 1e-3, 1e-4] {
            let counts = a.reach(goal);
            let error2 = a.error2(&counts);
            assert!(error2 <= goal && error2 > 0.8 * goal, "{error2} for {goal}");
        }
        // Where both halves see the same, as they nearly do; blocks and smoothing take some of the gain.
        let v: Vec<f64> = (0..64).map(|i| if i < 8 { 100.0 } else { 0.1 }).collect();
        let a = Allocation::new([v.clone(), v], vec![256.0; 64], 8, [8, 1 << 20]);
        let counts = a.reach(1e-4);
        let mean = (a.total(&counts) / (2 * 64 * 256)) as u32;
        let equal = a.error2(&[vec![mean; 64], vec![mean; 64]]);
        assert!(equal > 2.0 * a.error2(&counts), "{equal}");
    }

    #[test]
    fn bounds_hold_and_nothing_to_do_is_no_fault() {
        let counts = allocation([8, 40]).reach(1e-9);
        assert!(counts.iter().flatten().all(|n| *n == 40), "{counts:?}");
        let black = Allocation::new([vec![0.0; 4], vec![0.0; 4]], vec![256.0; 4], 2, [8, 64]);
        assert_eq!(black.reach(1e-4), [vec![8; 4], vec![8; 4]]);
    }
}
