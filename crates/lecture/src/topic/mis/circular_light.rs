//! The circular light over a rough surface, as an integral of one dimension: lights of four sizes, lobes of four widths.
//!
//! The light is a ball of radius R at the distance 4, seen in the mirror direction; the surface's value times the cosine is its
//! lobe's density. Technique 1 is uniform in the light's cone, technique 2 draws from the lobe.

use core::f64::consts::PI;

use sparrow_math::{LocalDir, vec3, warp};
use sparrow_mis::{Heuristic, Technique};
use sparrow_models::{Surface, Uniforms};
use sparrow_stats::Random;

use crate::LectureError;
use crate::ask::{density, sample, surface};

/// Distance of the light.
const DISTANCE: f64 = 4.0;

/// One light over one surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// R
    pub(super) radius: f64,
    /// Width of the lobe.
    pub(super) alpha: f64,
    /// Exponent of its cosine, 1 / (2 alpha^2).
    pub(super) exponent: u32,
    /// Variance over the square of the integral: light alone, lobe alone, balance, power, maximum. `matrix.*` of the reference sheet.
    pub(super) known: [f64; 5],
}

/// All sixteen, by radius and width.
#[rustfmt::skip]
pub(super) const CELLS: [Cell; 16] = [
    Cell { radius: 0.033_33, alpha: 0.005, exponent: 20000, known: [0.039_855_24, 0.997_57, 0.126_552_1, 0.062_655_73, 0.039_855_24] },
    Cell { radius: 0.033_33, alpha: 0.02, exponent: 1250, known: [0.000_156_926_6, 22.529_01, 0.037_593_31, 0.000_228_593_6, 0.000_156_926_6] },
    Cell { radius: 0.033_33, alpha: 0.05, exponent: 200, known: [4.017_444e-6, 142.807_8, 0.006_814_314, 4.350_164e-6, 4.017_444e-6] },
    Cell { radius: 0.033_33, alpha: 0.1, exponent: 50, known: [2.510_904e-7, 564.299_4, 0.001_759_865, 2.566_115e-7, 2.510_904e-7] },
    Cell { radius: 0.1, alpha: 0.005, exponent: 20000, known: [2.137_787, 0.001_929_801, 0.117_712_2, 0.102_597_8, 0.190_093_4] },
    Cell { radius: 0.1, alpha: 0.02, exponent: 1250, known: [0.012_691_19, 2.089_66, 0.132_198_9, 0.027_865_86, 0.012_691_19] },
    Cell { radius: 0.1, alpha: 0.05, exponent: 200, known: [0.000_325_702_5, 15.420_66, 0.051_115_05, 0.000_529_769_1, 0.000_325_702_5] },
    Cell { radius: 0.1, alpha: 0.1, exponent: 50, known: [2.035_768e-5, 62.226_82, 0.015_105, 2.421_979e-5, 2.035_768e-5] },
    Cell { radius: 0.3, alpha: 0.005, exponent: 20000, known: [27.166_77, 0.0, 0.061_539_22, 0.021_291_54, 0.025_992_64] },
    Cell { radius: 0.3, alpha: 0.02, exponent: 1250, known: [0.868_990_9, 0.030_240_35, 0.090_034_74, 0.107_946_3, 0.295_953_1] },
    Cell { radius: 0.3, alpha: 0.05, exponent: 200, known: [0.026_372_52, 1.310_945, 0.131_534_3, 0.048_962_27, 0.026_372_52] },
    Cell { radius: 0.3, alpha: 0.1, exponent: 50, known: [0.001_656_651, 6.464_034, 0.091_597_85, 0.003_531_453, 0.001_656_651] },
    Cell { radius: 0.9, alpha: 0.005, exponent: 20000, known: [255.431_6, 0.0, 0.011_873_41, 0.002_486_938, 0.002_916_342] },
    Cell { radius: 0.9, alpha: 0.02, exponent: 1250, known: [15.045_01, 7.660_539e-15, 0.085_222_71, 0.035_369_24, 0.044_705_88] },
    Cell { radius: 0.9, alpha: 0.05, exponent: 200, known: [1.611_427, 0.005_430_629, 0.109_266_2, 0.105_982_6, 0.219_170_1] },
    Cell { radius: 0.9, alpha: 0.1, exponent: 50, known: [0.136_320_1, 0.362_150_1, 0.095_463_19, 0.095_310_94, 0.507_430_6] },
];

/// The techniques, joined or alone.
pub(super) const STRATEGIES: [(&str, Option<Heuristic>); 5] = [
    ("light alone", None),
    ("lobe alone", None),
    ("balance", Some(Heuristic::Balance)),
    ("power", Some(Heuristic::Power(2.0))),
    ("maximum", Some(Heuristic::Maximum)),
];

/// The integrand and both densities.
pub(super) struct Problem {
    lobe: Surface<f64>,
    /// `1 - cos` of the light's cone.
    pub(super) cap: f64,
}

/// The direction that makes an angle with the mirror direction, by one minus its cosine.
fn direction(t: f64) -> LocalDir<f64> {
    LocalDir::new(vec3((t * (2.0 - t)).max(0.0).sqrt(), 0.0, 1.0 - t))
}

impl Problem {
    /// Of a cell.
    pub(super) fn new(cell: &Cell) -> Result<Problem, LectureError> {
        let sin2 = (cell.radius / DISTANCE) * (cell.radius / DISTANCE);
        let lobe = surface(&format!("phong diffuse=0 specular=1 exponent={}", cell.exponent))?;
        Ok(Problem { lobe, cap: sin2 / (1.0 + (1.0 - sin2).sqrt()) })
    }
    /// Both densities in 1/sr at the angle with `1 - cos = t`.
    pub(super) fn pdf(&self, t: f64) -> [f64; 2] {
        let light = if t <= self.cap { 1.0 / (2.0 * PI * self.cap) } else { 0.0 };
        [light, density(&self.lobe, direction(0.0), direction(t))]
    }
    /// The integrand: the lobe where the light is, for a radiance of one.
    pub(super) fn f(&self, t: f64) -> f64 {
        if t <= self.cap { self.pdf(t)[1] } else { 0.0 }
    }
    /// Draws a direction with technique `k`, as one minus its cosine.
    pub(super) fn draw(&self, k: usize, random: &mut Random) -> f64 {
        let u = [random.uniform(), random.uniform()];
        if k == 0 {
            let w = warp::uniform_cone(u, self.cap);
            return (w.x * w.x + w.y * w.y) / (1.0 + w.z);
        }
        let s = sample(&self.lobe, direction(0.0), Uniforms { lobe: random.uniform(), dir: u });
        if s.valid { s.wi.sin2_theta() / (1.0 + s.wi.z()) } else { 1.0 }
    }
    /// `int g dω` over the light's cone, for `g` of the angle.
    fn integral(&self, g: &dyn Fn(f64) -> f64) -> f64 {
        // Weights may jump where the densities are equal.
        let crossing = self.crossing();
        let sum = |from: f64, to: f64, n: u32| {
            // Places are dense near zero, where lobes are: t = from + (to - from) s^4.
            let term = |k: u32| {
                let s = (f64::from(k) + 0.5) / f64::from(n);
                g(from + (to - from) * s.powi(4)) * 4.0 * s.powi(3)
            };
            (0..n).map(term).sum::<f64>() * (to - from) / f64::from(n)
        };
        // Two sums, so that the error of the second order drops out.
        let piece = |from: f64, to: f64| (4.0 * sum(from, to, 2000) - sum(from, to, 1000)) / 3.0;
        2.0 * PI * (piece(0.0, crossing) + piece(crossing, self.cap))
    }
    /// Where both densities are equal, within the cone; its border where they nowhere are.
    fn crossing(&self) -> f64 {
        let lobe_wins = |t: f64| {
            let [light, lobe] = self.pdf(t);
            lobe > light
        };
        let (mut lo, mut hi) = (0.0, self.cap);
        if lobe_wins(hi) || !lobe_wins(lo) {
            return self.cap;
        }
        for _ in 0..100 {
            let middle = 0.5 * (lo + hi);
            if lobe_wins(middle) { lo = middle } else { hi = middle }
        }
        lo
    }
    /// The integral, and the relative variances of all [`STRATEGIES`], one sample of each technique that they use.
    pub(super) fn variances(&self) -> (f64, [f64; 5]) {
        let whole = self.integral(&|t| self.f(t));
        let alone = |k: usize| self.integral(&|t| self.f(t) * self.f(t) / self.pdf(t)[k]) - whole * whole;
        let joined = |h: Heuristic| {
            let part = |k: usize| {
                let wf = |t: f64| weight(h, self.pdf(t), k) * self.f(t);
                let second = self.integral(&|t| {
                    let wf = wf(t);
                    wf * wf / self.pdf(t)[k]
                });
                let first = self.integral(&wf);
                second - first * first
            };
            part(0) + part(1)
        };
        let relative = |k: usize| match STRATEGIES[k].1 {
            Some(h) => joined(h) / (whole * whole),
            None => alone(k) / (whole * whole),
        };
        (whole, [0, 1, 2, 3, 4].map(relative))
    }
}

/// The weight of technique `k` where the densities are these, for one sample of each.
pub(super) fn weight(h: Heuristic, pdf: [f64; 2], k: usize) -> f64 {
    h.weight(&pdf.map(|pdf| Technique { count: 1.0, pdf }), k)
}
