//! The sphere in cells that follow samples: [`Partition`].
//!
//! Polar angle and azimuth are halved in turn at the median of samples. Cells then hold about equal numbers, however
//! narrow a lobe is, and a density is smooth within a cell where samples follow it. Where they do not follow it, the
//! cells still cover the sphere, and the integral over them shows it.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use sparrow_math::{LocalDir, Real, vec3};

use crate::cubature::{self, Cubature, Region, Stop};

/// Samples in the regions with which integration begins, at least.
const PER_REGION: usize = 2;
/// Largest extent of such a region, in radians: lobes without samples are found where they are no narrower.
const WIDEST: f64 = 0.16;
/// A rule of degree 7 looks at a fortieth of its region's width from the border: gaps up to this many times wider than
/// their neighbours are seen where they begin.
const MUCH_WIDER: f64 = 64.0;

/// Integrals over the cells of a partition.
pub type Integral<const K: usize> = Cubature<K>;

/// A division of the sphere into cells.
#[derive(Clone, Debug)]
pub struct Partition {
    nodes: Vec<Node>,
    regions: Vec<Region>,
    cells: usize,
    azimuth: f64,
}

#[derive(Clone, Copy, Debug)]
enum Node {
    Split { axis: usize, at: f64, low: u32, high: u32 },
    Cell(u32),
}

impl Partition {
    /// About `cells` cells of equal numbers of the given samples; azimuths are counted from `azimuth`, where a lobe
    /// ought to lie, and no cell is cut where half of its samples lie within `finest` radians.
    pub fn new(samples: &[LocalDir<f64>], cells: usize, azimuth: f64, finest: f64) -> Partition {
        let mut p = Partition { nodes: Vec::new(), regions: Vec::new(), cells: 0, azimuth };
        let mut points: Vec<[f64; 2]> = samples.iter().map(|w| p.angles(*w)).collect();
        // The horizon is a border always: densities may break off there.
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let at = points.partition_point(|q| q[0] < FRAC_PI_2);
        p.nodes.push(Node::Cell(0));
        let plan = Plan { per_cell: (samples.len() / cells.max(1)).max(16), finest };
        let (upper, lower) = points.split_at_mut(at);
        let low = p.grow(upper, [[0.0, -PI], [FRAC_PI_2, PI]], 0, None, &plan);
        let high = p.grow(lower, [[FRAC_PI_2, -PI], [PI, PI]], 0, None, &plan);
        p.nodes[0] = Node::Split { axis: 0, at: FRAC_PI_2, low, high };
        p
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.cells
    }
    /// Never: the sphere is always covered.
    pub fn is_empty(&self) -> bool {
        self.cells == 0
    }

    /// The cell that holds `w`.
    pub fn locate(&self, w: LocalDir<f64>) -> usize {
        let p = self.angles(w);
        // The first node is the horizon, where the sign of z is sharper than the angle.
        let mut i = match self.nodes[0] {
            Node::Split { low, high, .. } => {
                if w.z() > 0.0 {
                    low
                } else {
                    high
                }
            }
            Node::Cell(c) => return c as usize,
        };
        loop {
            match self.nodes[i as usize] {
                Node::Split { axis, at, low, high } => i = if p[axis] < at { low } else { high },
                Node::Cell(c) => return c as usize,
            }
        }
    }

    /// Integrals of `f` over solid angle, per cell.
    pub fn integrate<const K: usize>(
        &self,
        f: impl Fn(LocalDir<f64>) -> [f64; K],
        stop: Stop,
    ) -> Integral<K> {
        let on_angles = |p: [f64; 2]| {
            let (sin_theta, cos_theta) = Real::sin_cos(p[0]);
            let (s, c) = Real::sin_cos(p[1] + self.azimuth);
            f(LocalDir::new(vec3(sin_theta * c, sin_theta * s, cos_theta))).map(|v| v * sin_theta)
        };
        cubature::integrate(self.regions.iter().copied(), on_angles, stop)
    }

    /// Polar angle, and azimuth from the centre in [-pi, pi).
    fn angles(&self, w: LocalDir<f64>) -> [f64; 2] {
        let phi = Real::atan2(w.y(), w.x()) - self.azimuth;
        [Real::atan2(w.sin2_theta().sqrt(), w.z()), phi - TAU * ((phi + PI) / TAU).floor()]
    }

    /// Divides a rectangle and its samples; gives its node.
    fn grow(
        &mut self,
        points: &mut [[f64; 2]],
        rect: [[f64; 2]; 2],
        axis: usize,
        cell: Option<u32>,
        plan: &Plan,
    ) -> u32 {
        // Below the size of a cell halving goes on for the sake of integration alone.
        let full = cell.is_none() && points.len() >= 2 * plan.per_cell;
        let cut = if full {
            [axis, 1 - axis].into_iter().find_map(|a| plan.cut(points, rect, a, plan.finest))
        } else {
            None
        };
        let cell = if cut.is_some() { None } else { Some(cell.unwrap_or_else(|| self.new_cell())) };
        let cut = cut.or_else(|| [axis, 1 - axis].into_iter().find_map(|a| plan.cut(points, rect, a, 0.0)));
        let index = self.nodes.len() as u32;
        let Some((axis, at, middle)) = cut.filter(|_| points.len() >= 2 * PER_REGION) else {
            let cell = cell.unwrap_or_else(|| self.new_cell());
            self.nodes.push(Node::Cell(cell));
            self.tile(rect, points, cell as usize);
            return index;
        };
        self.nodes.push(Node::Cell(cell.unwrap_or(0)));
        let (mut below, mut above) = (rect, rect);
        below[1][axis] = at;
        above[0][axis] = at;
        let (low_points, high_points) = points.split_at_mut(middle);
        let low = self.grow(low_points, below, 1 - axis, cell, plan);
        let high = self.grow(high_points, above, 1 - axis, cell, plan);
        if cell.is_none() {
            self.nodes[index as usize] = Node::Split { axis, at, low, high };
        }
        index
    }

    fn new_cell(&mut self) -> u32 {
        self.cells += 1;
        (self.cells - 1) as u32
    }

    /// Regions of a rectangle, none wider than [`WIDEST`], and growing by doubling into gaps between samples: tails fall
    /// off by powers, and a rule over a whole gap would not see where it begins.
    fn tile(&mut self, rect: [[f64; 2]; 2], points: &[[f64; 2]], cell: usize) {
        let sine = [rect[0][0], rect[1][0], FRAC_PI_2.clamp(rect[0][0], rect[1][0])]
            .map(Real::sin)
            .into_iter()
            .fold(1e-9, f64::max);
        let cuts = [(0, WIDEST), (1, WIDEST / sine)].map(|(axis, widest)| {
            let mut at = vec![rect[0][axis], rect[1][axis]];
            at.extend(points.iter().map(|p| p[axis]));
            at.sort_by(f64::total_cmp);
            graded(&at, widest)
        });
        for a in cuts[0].windows(2) {
            for b in cuts[1].windows(2) {
                self.regions.push(Region { lo: [a[0], b[0]], hi: [a[1], b[1]], cell });
            }
        }
    }
}

/// Cuts of the interval from the first to the last of `at`, none farther apart than `widest`. A gap that is much wider
/// than its neighbour is cut at distances that double from there.
fn graded(at: &[f64], widest: f64) -> Vec<f64> {
    let (Some(&first), Some(&last)) = (at.first(), at.last()) else { return Vec::new() };
    let gap = |k: usize| at[k + 1] - at[k];
    let mut cuts = vec![first, last];
    for k in 0..at.len() - 1 {
        let above = Some(k + 1).filter(|j| j + 1 < at.len());
        for (neighbour, from, sign) in [(k.checked_sub(1), at[k], 1.0), (above, at[k + 1], -1.0)] {
            let Some(scale) = neighbour.map(|j| gap(j).max(1e-9 * (last - first))) else { continue };
            if gap(k) > MUCH_WIDER * scale {
                let (mut step, mut place) = (scale, 0.0);
                while place < 0.5 * gap(k) {
                    cuts.push(from + sign * place);
                    place += step;
                    step *= 2.0;
                }
            }
        }
    }
    cuts.sort_by(f64::total_cmp);
    let mut all = vec![first];
    for pair in cuts.windows(2) {
        let n = ((pair[1] - pair[0]) / widest).ceil();
        (1..=n as usize).for_each(|k| all.push(pair[0] + (pair[1] - pair[0]) * k as f64 / n));
    }
    all
}

struct Plan {
    per_cell: usize,
    finest: f64,
}

impl Plan {
    /// Axis, place and number of samples below a cut at the median, where the samples' middle half is wide enough.
    fn cut(
        &self,
        points: &mut [[f64; 2]],
        rect: [[f64; 2]; 2],
        axis: usize,
        finest: f64,
    ) -> Option<(usize, f64, usize)> {
        let n = points.len();
        if n < 4 {
            return None;
        }
        let mut nth = |k: usize| points.select_nth_unstable_by(k, |a, b| a[axis].total_cmp(&b[axis])).1[axis];
        let width = if finest > 0.0 { nth(3 * n / 4) - nth(n / 4) } else { f64::INFINITY };
        let median = nth(n / 2);
        // Between two samples: on one of them, it would seem to have no distance from its border.
        let lower = points[..n / 2].iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        let at = lower + 0.5 * (median - lower);
        let at = if at > lower { at } else { median };
        let mean_sine = || points.iter().map(|p| Real::sin(p[0])).sum::<f64>() / n as f64;
        let wide = finest <= 0.0 || width * if axis == 1 { mean_sine() } else { 1.0 } > finest;
        if !(wide && rect[0][axis] < at && at < rect[1][axis]) {
            return None;
        }
        // Equal angles all belong above the cut.
        let mut below = 0;
        for k in 0..n {
            if points[k][axis] < at {
                points.swap(below, k);
                below += 1;
            }
        }
        Some((axis, at, below))
    }
}

/// The integral of `f` over the sphere, where `importance` holds directions near which it may be large.
pub fn integrate_sphere(f: impl Fn(LocalDir<f64>) -> f64, importance: &[LocalDir<f64>], stop: Stop) -> f64 {
    let partition = Partition::new(importance, 256, 0.0, 0.0);
    partition.integrate(|w| [f(w)], stop).total()[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Random;

    const STOP: Stop = Stop { error: 1e-7, evaluations: 2_000_000 };

    #[test]
    fn whole_sphere_and_a_cosine() {
        let mut r = Random::new(1);
        let dirs: Vec<_> = (0..5000).map(|_| r.direction()).collect();
        assert!((integrate_sphere(|_| 1.0, &dirs, STOP) - 4.0 * PI).abs() < 1e-9);
        assert!((integrate_sphere(|w| w.z().max(0.0), &dirs, STOP) - PI).abs() < 1e-9);
        assert!((integrate_sphere(|w| w.z().max(0.0), &[], STOP) - PI).abs() < 1e-7);
    }

    /// GGX-like tails around a direction, width `a`: `a^2 / (pi (a^2 + tan^2)^2 cos^3)` integrates to one over a hemisphere.
    fn lobe(w: LocalDir<f64>, centre: LocalDir<f64>, a: f64) -> f64 {
        let c = w.dot(centre);
        let cross = w.v().cross(centre.v()).length2();
        if c > 0.0 { a * a * c / (PI * (a * a * c * c + cross).powi(2)) } else { 0.0 }
    }

    fn draw(r: &mut Random, centre: LocalDir<f64>, a: f64) -> LocalDir<f64> {
        let u = r.uniform();
        let t = a * (u / (1.0 - u)).sqrt();
        let (s, c) = Real::sin_cos(TAU * r.uniform());
        let frame = sparrow_math::Frame::from_z(centre.v());
        LocalDir::new(frame.to_world(LocalDir::new(vec3(t * c, t * s, 1.0).normalized())))
    }

    #[test]
    fn narrow_lobes_with_wide_tails_are_resolved() {
        let mut r = Random::new(9);
        for a in [1e-5, 1e-3, 0.1] {
            for theta in [1e-4, 0.7, 1.57] {
                let centre = LocalDir::from_angles(theta, 2.9);
                let dirs: Vec<_> = (0..20_000).map(|_| draw(&mut r, centre, a)).collect();
                let total = integrate_sphere(|w| lobe(w, centre, a), &dirs, STOP);
                assert!((total - 1.0).abs() < 1e-5, "{a} {theta}: {total}");
            }
        }
    }

    #[test]
    fn cells_hold_what_their_integral_says() {
        let mut r = Random::new(10);
        let (centre, a) = (LocalDir::from_angles(1.2, -3.1), 0.01);
        let dirs: Vec<_> = (0..30_000).map(|_| draw(&mut r, centre, a)).collect();
        let cells = Partition::new(&dirs, 200, 0.4, 0.0);
        assert!((100..400).contains(&cells.len()), "{}", cells.len());
        let integral = cells.integrate(|w| [lobe(w, centre, a)], STOP);
        let mut counts = vec![crate::Cell::default(); cells.len()];
        let n = 100_000;
        (0..n).for_each(|_| counts[cells.locate(draw(&mut r, centre, a))].observed += 1.0);
        for (c, v) in counts.iter_mut().zip(&integral.value) {
            c.expected = v[0] * f64::from(n);
        }
        assert!(crate::chi_square(&counts).p > 1e-3);
        // Wider by six hundredths, and the test says no.
        let wide = cells.integrate(|w| [lobe(w, centre, 1.06 * a)], STOP);
        for (c, v) in counts.iter_mut().zip(&wide.value) {
            c.expected = v[0] * f64::from(n);
        }
        assert!(crate::chi_square(&counts).p < 1e-6);
    }

    #[test]
    fn intervals_grow_away_from_samples() {
        assert_eq!(graded(&[0.0, 1.0, 101.0], 1e3), [0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 101.0]);
        assert_eq!(graded(&[0.0, 0.4, 1.0], 0.5), [0.0, 0.5, 1.0]);
    }

    #[test]
    fn cells_stay_as_coarse_as_asked() {
        let mut r = Random::new(11);
        let centre = LocalDir::from_angles(0.9, 0.3);
        let dirs: Vec<_> = (0..30_000).map(|_| draw(&mut r, centre, 1e-6)).collect();
        // Half of the lobe lies within 1e-6: one cut of each axis at most beyond what the tails allow.
        assert!(Partition::new(&dirs, 1000, 0.0, 1e-4).len() < 40);
    }
}
