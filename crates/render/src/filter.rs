//! Pixel filters, and samples of a pixel distributed like them. [PharrJakobHumphreys2023, sec. 8.8]
//!
//! All five filters are products of a function of x and one of y. Offsets are drawn with density
//! proportional to `|f|`, so a sample's weight is the sign of `f`: exactly +1 or -1. That weight is
//! `f / pdf` divided by [`FilterSampler::abs_integral`], a constant which the film's division by the
//! sum of weights takes out.

use core::f64::consts::PI;

use sparrow_math::{Mask, ONE_MINUS_EPSILON, Real};

/// A pixel filter; radii in pixels, along x and y. [`Filter::default`] is pbrt-v4's.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Filter {
    /// Constant.
    Box {
        /// Half the width and height.
        radius: [f32; 2],
    },
    /// Falls linearly to zero at the radius.
    Triangle {
        /// Half the width and height.
        radius: [f32; 2],
    },
    /// Normal density, lowered so that it is zero at the radius.
    Gaussian {
        /// Half the width and height.
        radius: [f32; 2],
        /// Standard deviation.
        sigma: f32,
    },
    /// Cubic with the parameters of [MitchellNetravali1988], stretched to the radius.
    Mitchell {
        /// Half the width and height.
        radius: [f32; 2],
        /// Blur.
        b: f32,
        /// Ringing.
        c: f32,
    },
    /// `sinc(x) sinc(x / tau)`: Lanczos' window.
    Sinc {
        /// Half the width and height.
        radius: [f32; 2],
        /// Width of the window, in cycles.
        tau: f32,
    },
}

impl Default for Filter {
    fn default() -> Filter {
        Filter::gaussian()
    }
}

/// `sin(pi x) / (pi x)`
fn sinc(x: f64) -> f64 {
    let a = PI * x;
    if a.abs() < 1e-5 { 1.0 - a * a / 6.0 } else { Real::sin(a) / a }
}

fn normal_density(x: f64, sigma: f64) -> f64 {
    Real::exp(-0.5 * (x / sigma) * (x / sigma)) / (sigma * (2.0 * PI).sqrt())
}

/// [MitchellNetravali1988, eq. 8], `x` in [-2, 2].
fn mitchell(x: f64, b: f64, c: f64) -> f64 {
    let x = x.abs();
    let sum = if x <= 1.0 {
        (12.0 - 9.0 * b - 6.0 * c) * x * x * x + (-18.0 + 12.0 * b + 6.0 * c) * x * x + (6.0 - 2.0 * b)
    } else if x <= 2.0 {
        (-b - 6.0 * c) * x * x * x
            + (6.0 * b + 30.0 * c) * x * x
            + (-12.0 * b - 48.0 * c) * x
            + (8.0 * b + 24.0 * c)
    } else {
        0.0
    };
    sum / 6.0
}

impl Filter {
    /// pbrt's box: radius 0.5.
    pub fn box_filter() -> Filter {
        Filter::Box { radius: [0.5; 2] }
    }
    /// pbrt's triangle: radius 2.
    pub fn triangle() -> Filter {
        Filter::Triangle { radius: [2.0; 2] }
    }
    /// pbrt's Gaussian, the filter of a scene that names none: radius 1.5, sigma 0.5.
    pub fn gaussian() -> Filter {
        Filter::Gaussian { radius: [1.5; 2], sigma: 0.5 }
    }
    /// pbrt's Mitchell: radius 2, B = C = 1/3.
    pub fn mitchell() -> Filter {
        Filter::Mitchell { radius: [2.0; 2], b: 1.0 / 3.0, c: 1.0 / 3.0 }
    }
    /// pbrt's windowed sinc: radius 4, tau 3.
    pub fn sinc() -> Filter {
        Filter::Sinc { radius: [4.0; 2], tau: 3.0 }
    }

    /// Half the width and height of where the filter is not zero.
    pub fn radius(&self) -> [f32; 2] {
        match *self {
            Filter::Box { radius }
            | Filter::Triangle { radius }
            | Filter::Gaussian { radius, .. }
            | Filter::Mitchell { radius, .. }
            | Filter::Sinc { radius, .. } => radius,
        }
    }

    /// Value at an offset from the pixel's centre; scaled as in pbrt, zero beyond the radius.
    pub fn eval(&self, offset: [f32; 2]) -> f64 {
        self.factor(0, f64::from(offset[0])) * self.factor(1, f64::from(offset[1]))
    }

    /// The factor of one axis.
    fn factor(&self, axis: usize, x: f64) -> f64 {
        let r = f64::from(self.radius()[axis]);
        if x.abs() > r {
            return 0.0;
        }
        match *self {
            Filter::Box { .. } => 1.0,
            Filter::Triangle { .. } => r - x.abs(),
            Filter::Gaussian { sigma, .. } => {
                let sigma = f64::from(sigma);
                (normal_density(x, sigma) - normal_density(r, sigma)).max(0.0)
            }
            Filter::Mitchell { b, c, .. } => mitchell(2.0 * x / r, f64::from(b), f64::from(c)),
            Filter::Sinc { tau, .. } => sinc(x) * sinc(x / f64::from(tau)),
        }
    }
}

/// Cells per axis of the tabulated filters; even, so that the centre is an edge.
const N_CELLS: usize = 256;

/// Parts of [0, 1) for which a search knows where to begin; with these, it rarely has a step to go.
const N_GUIDES: usize = 1024;

/// One axis of a tabulated filter: constant per cell, each the mean of the filter over the cell.
#[derive(Clone, Debug)]
struct Axis {
    radius: f32,
    /// Cumulative shares of `|f|`.
    cdf: Vec<f32>,
    /// Where the search for u in `[k, k + 1) / N_GUIDES` begins.
    guide: Vec<f32>,
    /// Sign of `f`, 1 or -1.
    sign: Vec<f32>,
    integral: f64,
    abs_integral: f64,
}

impl Axis {
    fn new(filter: &Filter, axis: usize) -> Axis {
        let radius = filter.radius()[axis];
        let cell = 2.0 * f64::from(radius) / N_CELLS as f64;
        let mean = |i: usize| {
            // Simpson's rule, inside the cell by a hair so that a jump at the edge stays outside.
            let at = |t: f64| filter.factor(axis, (i as f64 + t - 0.5 * N_CELLS as f64) * cell);
            (at(1e-9) + 4.0 * at(0.5) + at(1.0 - 1e-9)) / 6.0
        };
        let means: Vec<f64> = (0..N_CELLS).map(mean).collect();
        let total: f64 = means.iter().map(|m| m.abs()).sum();
        let mut cdf = vec![0.0; N_CELLS + 1];
        let mut sum = 0.0;
        for (i, m) in means.iter().enumerate() {
            sum += m.abs();
            // A filter that vanishes everywhere is sampled as a box.
            cdf[i + 1] = if total > 0.0 { sum / total } else { (i + 1) as f64 / N_CELLS as f64 } as f32;
        }
        for c in cdf.iter_mut().rev().take_while(|c| **c > ONE_MINUS_EPSILON) {
            *c = 1.0;
        }
        let below = |u: f32| cdf.partition_point(|c| *c <= u).clamp(1, N_CELLS) - 1;
        let guide = (0..N_GUIDES).map(|k| below(k as f32 / N_GUIDES as f32) as f32).collect();
        let sign = means.iter().map(|m| if *m < 0.0 { -1.0 } else { 1.0 }).collect();
        Axis {
            radius,
            guide,
            sign,
            integral: means.iter().sum::<f64>() * cell,
            abs_integral: total * cell,
            cdf,
        }
    }

    /// Offset and sign.
    #[inline(always)]
    fn sample<R: Real>(&self, u: R) -> (R, R) {
        let mut i = (u * R::of(N_GUIDES as f64)).look_up(&self.guide);
        loop {
            let next = i + R::ONE;
            let beyond = next.lt(R::of(N_CELLS as f64)) & next.look_up(&self.cdf).le(u);
            if !beyond.any() {
                break;
            }
            i = R::select(beyond, next, i);
        }
        let below = i.look_up(&self.cdf);
        let width = ((i + R::ONE).look_up(&self.cdf) - below).max(R::of(f64::from(f32::MIN_POSITIVE)));
        let t = ((u - below) / width).min(R::ONE);
        let x = (i + t) * R::of(2.0 / N_CELLS as f64) - R::ONE;
        (x * R::of(f64::from(self.radius)), i.look_up(&self.sign))
    }
}

#[derive(Clone, Debug)]
enum Plan {
    Box,
    Triangle,
    Table(Box<[Axis; 2]>),
}

/// A sample of the pixel.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FilterSample<R = f32> {
    /// From the pixel's centre, in pixels.
    pub offset: [R; 2],
    /// `f / pdf`, divided by the integral of `|f|`: +1 or -1.
    pub weight: R,
}

/// Draws offsets distributed like a filter.
///
/// Box and triangle are inverted in closed form. The others are tabulated per axis, 256 cells
/// that each hold the filter's mean (pbrt: 64 cells per unit of radius, on a 2D grid).
#[derive(Clone, Debug)]
pub struct FilterSampler {
    filter: Filter,
    plan: Plan,
    integral: f64,
    abs_integral: f64,
}

impl FilterSampler {
    /// Prepares the tables: 5 KiB where there are any.
    pub fn new(filter: &Filter) -> FilterSampler {
        let [rx, ry] = filter.radius().map(f64::from);
        let (plan, integral, abs_integral) = match filter {
            Filter::Box { .. } => (Plan::Box, 4.0 * rx * ry, 4.0 * rx * ry),
            Filter::Triangle { .. } => (Plan::Triangle, rx * rx * ry * ry, rx * rx * ry * ry),
            Filter::Gaussian { .. } | Filter::Mitchell { .. } | Filter::Sinc { .. } => {
                let axes = [Axis::new(filter, 0), Axis::new(filter, 1)];
                let integral = axes[0].integral * axes[1].integral;
                let abs_integral = axes[0].abs_integral * axes[1].abs_integral;
                (Plan::Table(Box::new(axes)), integral, abs_integral)
            }
        };
        FilterSampler { filter: *filter, plan, integral, abs_integral }
    }

    /// The filter sampled.
    pub fn filter(&self) -> &Filter {
        &self.filter
    }
    /// Half the width and height of where the filter is not zero.
    pub fn radius(&self) -> [f32; 2] {
        self.filter.radius()
    }
    /// Integral of the filter over the plane.
    pub fn integral(&self) -> f64 {
        self.integral
    }
    /// Integral of the filter's magnitude: what `f / pdf` is, up to its sign.
    pub fn abs_integral(&self) -> f64 {
        self.abs_integral
    }

    /// A sample of the pixel from a point of the unit square, each axis mapped monotonically.
    #[inline(always)]
    pub fn sample<R: Real>(&self, u: [R; 2]) -> FilterSample<R> {
        let [rx, ry] = self.filter.radius();
        let (rx, ry) = (R::of(f64::from(rx)), R::of(f64::from(ry)));
        match &self.plan {
            Plan::Box => {
                let (x, y) = (R::of(2.0) * u[0] - R::ONE, R::of(2.0) * u[1] - R::ONE);
                FilterSample { offset: [x * rx, y * ry], weight: R::ONE }
            }
            Plan::Triangle => FilterSample { offset: [tent(u[0]) * rx, tent(u[1]) * ry], weight: R::ONE },
            Plan::Table(axes) => {
                let (x, x_sign) = axes[0].sample(u[0]);
                let (y, y_sign) = axes[1].sample(u[1]);
                FilterSample { offset: [x, y], weight: x_sign * y_sign }
            }
        }
    }
}

/// Inverts the distribution with density `1 - |x|` over [-1, 1].
#[inline(always)]
fn tent<R: Real>(u: R) -> R {
    let rising = (R::of(2.0) * u).safe_sqrt() - R::ONE;
    let falling = R::ONE - (R::of(2.0) * (R::ONE - u)).safe_sqrt();
    R::select(u.lt(R::of(0.5)), rising, falling)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> [Filter; 6] {
        [
            Filter::box_filter(),
            Filter::triangle(),
            Filter::gaussian(),
            Filter::mitchell(),
            Filter::sinc(),
            Filter::Gaussian { radius: [2.0, 0.75], sigma: 0.9 },
        ]
    }

    /// Midpoint rule of `g` over one axis.
    fn integrate(r: f64, g: impl Fn(f64) -> f64) -> f64 {
        let n = 20_000;
        (0..n).map(|i| g(r * (2.0 * (f64::from(i) + 0.5) / f64::from(n) - 1.0))).sum::<f64>() * 2.0 * r
            / f64::from(n)
    }

    #[test]
    fn values_worked_by_hand() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-6, "{a} for {b}");
        near(Filter::triangle().eval([0.5, -1.0]), 1.5);
        // (16/18 + 0)^2 at the centre; the cubic is 1/18 at distance 1 of 2.
        near(Filter::mitchell().eval([0.0, 0.0]), (8.0f64 / 9.0).powi(2));
        near(Filter::mitchell().eval([1.0, 0.0]), 8.0 / 9.0 / 18.0);
        // Densities of the normal distribution at 0 and 3 sigma, sigma 0.5.
        near(Filter::gaussian().eval([0.0, 0.0]), (0.797_884_561f64 - 0.008_863_697).powi(2));
        near(Filter::sinc().eval([0.0, 0.0]), 1.0);
        near(Filter::sinc().eval([0.5, 0.0]), 2.0 / PI * 3.0 / PI);
        near(Filter::sinc().eval([0.0, 4.5]), 0.0);
    }

    #[test]
    fn integrals_match_quadrature() {
        for filter in all() {
            let s = FilterSampler::new(&filter);
            let [rx, ry] = filter.radius().map(f64::from);
            let axis = |a: usize, r| integrate(r, |x| filter.factor(a, x));
            let want = axis(0, rx) * axis(1, ry);
            assert!((s.integral() - want).abs() < 2e-5 * want, "{filter:?}: {} for {want}", s.integral());
            assert!(s.abs_integral() >= s.integral() - 1e-9);
        }
    }

    #[test]
    fn samples_follow_the_filter() {
        for filter in all() {
            let s = FilterSampler::new(&filter);
            let [rx, ry] = s.radius();
            // Signed mass left of x, against quadrature; 4096 equidistant numbers invert it.
            let n = 4096;
            let of = |i: u32| (f64::from(i) as f32 + 0.5) / n as f32;
            let v_positive = (0..n).map(of).find(|v| s.sample([0.5, *v]).weight > 0.0).unwrap();
            let total = integrate(f64::from(rx), |x| filter.factor(0, x).abs());
            for edge in [-0.8f32, -0.5, -0.1, 0.0, 0.3, 0.9] {
                let x = edge * rx;
                let mut mass = 0.0;
                for i in 0..n {
                    let draw = s.sample([of(i), v_positive]);
                    assert!(draw.offset[0].abs() <= rx && draw.offset[1].abs() <= ry);
                    assert_eq!(draw.weight.abs().to_bits(), 1f32.to_bits());
                    mass += if draw.offset[0] < x { f64::from(draw.weight) } else { 0.0 };
                }
                let want =
                    integrate(f64::from(rx), |t| if t < f64::from(x) { filter.factor(0, t) } else { 0.0 });
                let got = mass / f64::from(n) * total;
                assert!((got - want).abs() < 4e-3 * total, "{filter:?} up to {edge}: {got} for {want}");
            }
        }
    }

    #[test]
    fn the_map_is_monotone_and_ends_at_the_radius() {
        for filter in all() {
            let s = FilterSampler::new(&filter);
            let mut last = -s.radius()[0] - 1e-6;
            for i in 0..1000 {
                let x = s.sample([i as f32 / 1000.0, 0.5]).offset[0];
                assert!(x >= last, "{filter:?}: {x} after {last}");
                last = x;
            }
            let end = s.sample([ONE_MINUS_EPSILON; 2]).offset;
            assert!(end[0] <= s.radius()[0] && end[0] > 0.9 * s.radius()[0], "{filter:?}: {end:?}");
        }
    }

    #[test]
    fn a_filter_without_mass_is_a_box() {
        let s = FilterSampler::new(&Filter::Mitchell { radius: [0.0, 2.0], b: 0.0, c: 0.5 });
        let x = s.sample([0.25, 0.5]).offset[0];
        assert!(x.abs() < 1e-6, "{x}");
    }
}
