//! Adaptive integration over rectangles, several integrands at once.
//!
//! The rule of degree 7 with an embedded one of degree 5 [GenzMalik1980]: 17 points in two dimensions. The region whose
//! rules differ most is halved first, across the axis with the larger fourth difference.
//!
//! No point of the rules lies in the outer twentieth of a region. A step or a steep tail that enters there alone would be
//! missed by both, with an estimated error of zero; so eight more points just inside the border are asked, and a change
//! beyond the range of all values further in counts as error.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A rectangle, and the cell its integral is booked under.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    /// Lower ends.
    pub lo: [f64; 2],
    /// Upper ends.
    pub hi: [f64; 2],
    /// Place in [`Cubature::value`].
    pub cell: usize,
}

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub struct Stop {
    /// Sum of the estimated errors of all integrands together.
    pub error: f64,
    /// Most evaluations.
    pub evaluations: usize,
}

/// Integrals per cell.
#[derive(Clone, Debug)]
pub struct Cubature<const K: usize> {
    /// Integrals of the K integrands, per cell.
    pub value: Vec<[f64; K]>,
    /// Estimated error of their sum, per cell.
    pub error: Vec<f64>,
    /// Evaluations spent.
    pub evaluations: usize,
}

impl<const K: usize> Cubature<K> {
    /// Integrals over all cells.
    pub fn total(&self) -> [f64; K] {
        let mut sum = [0.0; K];
        for v in &self.value {
            (0..K).for_each(|k| sum[k] += v[k]);
        }
        sum
    }
    /// Estimated error of the sum of all integrands over all cells.
    pub fn total_error(&self) -> f64 {
        self.error.iter().sum()
    }
}

/// Integrates `f` over the regions, into as many cells as they name.
pub fn integrate<const K: usize>(
    regions: impl IntoIterator<Item = Region>,
    f: impl Fn([f64; 2]) -> [f64; K],
    stop: Stop,
) -> Cubature<K> {
    let mut evaluations = 0;
    let mut error = 0.0;
    let mut queue: BinaryHeap<Piece<K>> = BinaryHeap::new();
    for region in regions {
        let piece = measure(region, &f);
        evaluations += POINTS;
        error += piece.error;
        queue.push(piece);
    }
    while error > stop.error && evaluations + 2 * POINTS <= stop.evaluations {
        let Some(piece) = queue.pop() else { break };
        if piece.error <= 0.0 {
            // Nothing can be gained any more.
            queue.push(piece);
            break;
        }
        error -= piece.error;
        match halves(&piece) {
            Some(pair) => {
                for region in pair {
                    let part = measure(region, &f);
                    error += part.error;
                    queue.push(part);
                }
                evaluations += 2 * POINTS;
            }
            // Too small to halve: its error stands, and it is not asked again.
            None => queue.push(Piece { error: 0.0, settled: piece.error, ..piece }),
        }
    }
    let cells = queue.iter().map(|p| p.region.cell + 1).max().unwrap_or(0);
    let mut out = Cubature { value: vec![[0.0; K]; cells], error: vec![0.0; cells], evaluations };
    // In the order of their places, so that sums do not depend on the heap.
    let mut pieces = queue.into_vec();
    pieces.sort_by(|a, b| {
        let key = |p: &Piece<K>| (p.region.cell, p.region.lo);
        key(a).partial_cmp(&key(b)).unwrap_or(Ordering::Equal)
    });
    for p in pieces {
        (0..K).for_each(|k| out.value[p.region.cell][k] += p.value[k]);
        out.error[p.region.cell] += p.error + p.settled;
    }
    out
}

struct Piece<const K: usize> {
    region: Region,
    value: [f64; K],
    error: f64,
    settled: f64,
    axis: usize,
}

impl<const K: usize> PartialEq for Piece<K> {
    fn eq(&self, o: &Self) -> bool {
        self.cmp(o) == Ordering::Equal
    }
}
impl<const K: usize> Eq for Piece<K> {}
impl<const K: usize> PartialOrd for Piece<K> {
    fn partial_cmp(&self, o: &Self) -> Option<Ordering> {
        Some(self.cmp(o))
    }
}
impl<const K: usize> Ord for Piece<K> {
    fn cmp(&self, o: &Self) -> Ordering {
        self.error.total_cmp(&o.error)
    }
}

fn halves<const K: usize>(piece: &Piece<K>) -> Option<[Region; 2]> {
    let r = piece.region;
    let middle = |a: usize| 0.5 * (r.lo[a] + r.hi[a]);
    let room = |a: usize| r.hi[a] - r.lo[a] > 1e-14 * r.lo[a].abs().max(r.hi[a].abs());
    let axis = if room(piece.axis) { piece.axis } else { 1 - piece.axis };
    if !room(axis) {
        return None;
    }
    let (mut low, mut high) = (r, r);
    low.hi[axis] = middle(axis);
    high.lo[axis] = middle(axis);
    Some([low, high])
}

/// Evaluations per region.
const POINTS: usize = 25;
/// Distance of the points at the border from the centre, in half widths: densities may break off on the border itself.
const BORDER: f64 = 0.999;
/// Share of a region's area that a point at its border speaks for: the strip beyond the outermost points of the rules is
/// `1 - sqrt(9/10)` wide and an eighth of the border long.
const STRIP: f64 = 0.0125;
/// Squares of the distances of points from the centre, in half widths.
const NEAR2: f64 = 9.0 / 70.0;
const FAR2: f64 = 9.0 / 10.0;
const CORNER2: f64 = 9.0 / 19.0;
/// Weights of degree 7 for centre, near, far, diagonal, corner points; then of degree 5.
const W7: [f64; 5] = [-3816.0 / 19683.0, 980.0 / 6561.0, 1020.0 / 19683.0, 200.0 / 19683.0, 6859.0 / 78732.0];
const W5: [f64; 4] = [-971.0 / 729.0, 245.0 / 486.0, 65.0 / 1458.0, 25.0 / 729.0];

fn measure<const K: usize>(region: Region, f: &impl Fn([f64; 2]) -> [f64; K]) -> Piece<K> {
    let c = [0, 1].map(|a| 0.5 * (region.lo[a] + region.hi[a]));
    let h = [0, 1].map(|a| 0.5 * (region.hi[a] - region.lo[a]));
    let at = |x: f64, y: f64| f([c[0] + x * h[0], c[1] + y * h[1]]);
    let (near, far, corner) = (NEAR2.sqrt(), FAR2.sqrt(), CORNER2.sqrt());
    let add = |a: [f64; K], b: [f64; K]| core::array::from_fn(|k| a[k] + b[k]);
    let centre = at(0.0, 0.0);
    let pairs = [
        [near, 0.0],
        [0.0, near],
        [far, 0.0],
        [0.0, far],
        [far, far],
        [-far, far],
        [corner, corner],
        [-corner, corner],
    ];
    let values = pairs.map(|[x, y]| [at(x, y), at(-x, -y)]);
    let [near_x, near_y, far_x, far_y, up, down, corner_up, corner_down] = values.map(|[a, b]| add(a, b));
    let (diagonal, corners): ([f64; K], [f64; K]) = (add(up, down), add(corner_up, corner_down));
    // The outermost points of the rules, each with its neighbour at the border.
    let border = [[BORDER, 0.0], [0.0, BORDER], [BORDER, BORDER], [-BORDER, BORDER]];
    let edges = border.map(|[x, y]| [at(x, y), at(-x, -y)]);
    let area = 4.0 * h[0] * h[1];
    let (mut value, mut error, mut bend) = ([0.0; K], 0.0, [0.0; 2]);
    for k in 0..K {
        let (n, f) = (near_x[k] + near_y[k], far_x[k] + far_y[k]);
        let seven = W7[0] * centre[k] + W7[1] * n + W7[2] * f + W7[3] * diagonal[k] + W7[4] * corners[k];
        let five = W5[0] * centre[k] + W5[1] * n + W5[2] * f + W5[3] * diagonal[k];
        value[k] = area * seven;
        error += area * ((seven - five).abs() + STRIP * beyond(k, &centre, &values, &edges));
        bend[0] += (near_x[k] - 2.0 * centre[k] - NEAR2 / FAR2 * (far_x[k] - 2.0 * centre[k])).abs();
        bend[1] += (near_y[k] - 2.0 * centre[k] - NEAR2 / FAR2 * (far_y[k] - 2.0 * centre[k])).abs();
    }
    let even = (bend[0] - bend[1]).abs() <= 1e-6 * bend[0].max(bend[1]);
    let axis = if even { usize::from(h[1] > h[0]) } else { usize::from(bend[1] > bend[0]) };
    // A value that is not finite cannot be refined; it shows in the integral.
    let error = if error.is_finite() { error } else { 0.0 };
    Piece { region, value, error, settled: 0.0, axis }
}

/// By how much the k-th integrand changes towards the border beyond the range of its values further in, in sum.
fn beyond<const K: usize>(
    k: usize,
    centre: &[f64; K],
    inner: &[[[f64; K]; 2]; 8],
    edges: &[[[f64; K]; 2]; 4],
) -> f64 {
    let all = || inner.iter().flatten().map(|v| v[k]).chain([centre[k]]);
    let range = all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min);
    let outermost = inner[2..6].iter().flatten();
    let change = |(a, b): (&[f64; K], &[f64; K])| ((a[k] - b[k]).abs() - range).max(0.0);
    outermost.zip(edges.iter().flatten()).map(change).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::Real;

    const SQUARE: Region = Region { lo: [0.0, 0.0], hi: [1.0, 1.0], cell: 0 };

    #[test]
    fn degree_seven_is_exact() {
        // x^4 y^3 + x^7 integrates to 1/20 + 1/8 over the unit square.
        let p = measure(SQUARE, &|[x, y]| [x.powi(4) * y.powi(3) + x.powi(7)]);
        assert!((p.value[0] - (0.05 + 0.125)).abs() < 1e-15);
        let p = measure(SQUARE, &|[x, _]| [x.powi(8)]);
        assert!((p.value[0] - 1.0 / 9.0).abs() > 1e-8);
    }

    #[test]
    fn a_ridge_across_the_square_is_found_and_resolved() {
        // exp(-((x - 0.3) / 0.001)^2) integrates to 0.001 sqrt(pi) where its tails are inside.
        let stop = Stop { error: 1e-9, evaluations: 1_000_000 };
        let narrow = |[x, _]: [f64; 2]| [Real::exp(-((x - 0.3) / 1e-3).powi(2)), 1.0];
        let parts = (0..64).map(|i| Region {
            lo: [f64::from(i) / 64.0, 0.0],
            hi: [f64::from(i + 1) / 64.0, 1.0],
            cell: usize::from(i >= 32),
        });
        let c = integrate(parts, narrow, stop);
        let want = 1e-3 * core::f64::consts::PI.sqrt();
        assert!((c.total()[0] - want).abs() < 1e-8, "{:?}", c.total());
        assert!((c.value[1][1] - 0.5).abs() < 1e-12 && c.evaluations < 100_000, "{}", c.evaluations);
    }

    #[test]
    fn a_step_beyond_the_outermost_points_is_found() {
        // The rules see one everywhere; two hundredths along one side are zero.
        let stop = Stop { error: 1e-5, evaluations: 1_000_000 };
        let c = integrate([SQUARE], |[x, _]| [if x < 0.98 { 1.0 } else { 0.0 }], stop);
        assert!((c.total()[0] - 0.98).abs() < 1e-5, "{:?}", c.total());
    }

    #[test]
    fn a_corner_of_a_function_is_worth_halving() {
        let stop = Stop { error: 1e-6, evaluations: 1_000_000 };
        let c = integrate([SQUARE], |[x, y]| [(x + y - 0.7f64).max(0.0)], stop);
        // Over the square the plane gives 0.3; the pyramid cut off below zero has the volume 0.7^3 / 6.
        assert!((c.total()[0] - (0.3 + 0.343 / 6.0)).abs() < 1e-6 && c.total_error() <= 1e-6);
    }
}
