//! Fur: a cortex about a medulla that scatters. [Yan2015], [Yan2017]
//!
//! Unscattered light leaves by R, TT, TRT and further lobes as in [`hair`](super::hair), where a passage leaves it
//! `T = exp(-(sigma_c s_c + (sigma_m + sigma_s) s_m) / cos theta_t)` of itself with the chords `s_c` in the cortex and `s_m` in the medulla.
//! What the medulla scatters, `S`, leaves by TT^s, TRT^s and further lobes, `q = sum_p M_p A_p N_p` over both kinds. A cuticle of `l` layers
//! reflects `F_l = l F / (1 + (l - 1) F)`. [Yan2015, section 4.2]
//!
//! The lobe of TT^s has the means along and around the fibre that random walks in the medulla have ([`Moments`]), as a lobe of [dEon2011]
//! and a wrapped Cauchy density; later ones go evenly around the fibre. The papers tabulate profiles instead, over the offset too; their
//! tables are not used. With a white cortex and medulla all light leaves. Far field: the mean over h.
//!
//! Limits: medulla and cortex have one index; what the rough cuticle does to scattered light is not told apart.

use core::f64::consts::PI;

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::cylinder::FibreDir;
use crate::cylinder::attenuation::Inside;
use crate::cylinder::azimuthal::{Azimuthal, TrimmedLogistic, WrappedCauchy, exit_azimuth, wrapped};
use crate::cylinder::longitudinal::{Longitudinal, tilted};
use crate::cylinder::medulla::{MOST_FORWARD, Moments, chords};
use crate::cylinder::roughness::{logistic_scale, variance};
use crate::summed::{Seen, Sum, Summed};
use crate::{About, Lack, N_LOBES, ParamBlock, ParamInfo, Uniforms, fresnel};

/// Least roughness, as of hair.
const SMOOTHEST: f64 = 0.02;
/// Points of the mean reflectance of scattered light, around and along the fibre.
const POINTS: [usize; 2] = [4, 8];

/// Segments of equal angle across a fibre of the far field.
const SEGMENTS: usize = 32;

/// Fur.
pub(super) type Fur<R> = Summed<R, Medullated>;

/// The model in double precision.
#[derive(Clone, Copy, Debug)]
pub struct Medullated {
    /// Absorption of cortex and medulla, scattering of the medulla, per radius of the fibre.
    sigma_c: Spectrum<f64>,
    sigma_m: Spectrum<f64>,
    sigma_s: f64,
    eta: f64,
    kappa: f64,
    layers: f64,
    moments: Moments,
    longitudinal: [Longitudinal<f64>; 3],
    azimuthal: TrimmedLogistic<f64>,
    /// Sine and cosine of the tilts of R, TT, TRT.
    tilts: [[f64; 2]; 3],
    h: f64,
    far: bool,
}

impl Sum for Medullated {
    type Seen = SeenFur;
    const ABOUT: About = About::new("cortex and scattering medulla in a rough dielectric cylinder, near or far field", "Yan2015, Yan2017, Chiang2016")
        .anisotropic()
        .transmits()
        .lacks(&[
            Lack::reciprocity("the tilt, the angle inside and h are those of the viewer alone"),
            Lack::energy("no view is brighter than uniform light, but a lamp near the axis may be given back more than it sent"),
        ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::unbounded("sigma_a")
            .unit("1/radius")
            .default(0.5)
            .soft(0.0, 10.0)
            .doc("Absorption of the cortex."),
        ParamInfo::unbounded("sigma_m_a")
            .unit("1/radius")
            .default(0.1)
            .soft(0.0, 10.0)
            .doc("Absorption of the medulla."),
        ParamInfo::real("eta")
            .default(1.55)
            .range(1.0, 3.0)
            .soft(1.3, 1.9)
            .doc("Relative index of refraction."),
        ParamInfo::real("kappa")
            .default(0.7)
            .range(0.0, 0.98)
            .soft(0.2, 0.95)
            .doc("Radius of the medulla over that of the fibre."),
        ParamInfo::real("sigma_m_s")
            .unit("1/radius")
            .default(3.0)
            .range(0.0, 30.0)
            .soft(0.0, 10.0)
            .doc("Scattering of the medulla."),
        ParamInfo::real("g")
            .default(0.4)
            .range(0.0, MOST_FORWARD)
            .doc("Mean cosine of the medulla's scattering, after Henyey and Greenstein."),
        ParamInfo::real("layers").default(1.0).range(0.2, 10.0).soft(0.5, 3.0).doc("Layers of the cuticle."),
        ParamInfo::real("beta_m")
            .default(0.3)
            .range(0.0, 1.0)
            .soft(0.05, 1.0)
            .doc("Roughness along the fibre, as of hair."),
        ParamInfo::real("beta_n")
            .default(0.3)
            .range(0.0, 1.0)
            .soft(0.05, 1.0)
            .doc("Roughness around the fibre, as of hair."),
        ParamInfo::real("alpha")
            .unit("deg")
            .default(2.0)
            .range(-20.0, 20.0)
            .soft(0.0, 10.0)
            .doc("Tilt of the scales, positive as in pbrt-v4."),
        ParamInfo::choice("field", &["near", "far"])
            .doc("Where the ray met the fibre, or the mean over its width."),
    ];

    fn new(p: &ParamBlock<f64>) -> Self {
        let [eta, kappa, sigma_s, g, layers] = [p.reals[0], p.reals[1], p.reals[2], p.reals[3], p.reals[4]];
        let v = variance(p.reals[5].max(SMOOTHEST));
        let tilt = p.reals[7] * (PI / 180.0);
        Medullated {
            sigma_c: p.spectra[0],
            sigma_m: p.spectra[1],
            sigma_s,
            eta,
            kappa,
            layers,
            moments: Moments::of(sigma_s * kappa, g),
            longitudinal: [Longitudinal::new(v), Longitudinal::new(0.25 * v), Longitudinal::new(4.0 * v)],
            azimuthal: TrimmedLogistic::new(logistic_scale(p.reals[6].max(SMOOTHEST))),
            tilts: [-2.0 * tilt, tilt, 4.0 * tilt].map(|t| Real::sin_cos(t).into()),
            h: p.h,
            far: p.choices[0] != 0,
        }
    }

    fn seen_from(&self, wo: LocalDir<f64>) -> SeenFur {
        let o = FibreDir::new(wo);
        let theta = [o.sin, o.cos];
        let lobe = |p: usize| Way {
            m: self.longitudinal[p],
            theta: tilted(theta, self.tilts[p]),
            exit: Some(p),
            around: Around::Logistic(self.azimuthal),
        };
        let even = |m: Longitudinal<f64>| Way { m, theta, exit: None, around: Around::Even };
        let [once, twice] = [self.moments, Moments { along: self.moments.along.sqr(), ..self.moments }]
            .map(|moments| Longitudinal::new(moments.variance()));
        let ways = [
            lobe(0),
            lobe(1),
            lobe(2),
            even(self.longitudinal[2]),
            Way {
                m: once,
                around: Around::Cauchy(WrappedCauchy { mean_cosine: self.moments.around }),
                ..lobe(1)
            },
            even(twice),
            even(twice),
        ];
        let mut segments = [Segment::NONE; SEGMENTS];
        if self.far {
            for (k, segment) in segments.iter_mut().enumerate() {
                *segment = self.segment(theta, k);
            }
        } else {
            segments[0] = self.point(theta, self.h);
        }
        let n_segments = if self.far { SEGMENTS } else { 1 };
        SeenFur::new(o, ways, segments, n_segments)
    }
}

/// `A_p` of R, TT, TRT and further lobes, then of TT^s, TRT^s and further ones.
const WAYS: usize = 7;

impl Medullated {
    /// What meets the fibre at the offset `h`.
    fn point(&self, theta: [f64; 2], h: f64) -> Segment {
        let inside = Inside::new(theta, h, self.eta);
        let (gamma_o, gamma_t) = (Real::asin(h), inside.angle());
        let exits = [0, 1, 2].map(|p| exit_azimuth(p, gamma_o, gamma_t));
        Segment { a: self.shares(&inside), exits, turns: [0.0; 3] }
    }
    /// What meets the `k`-th segment: its middle, with the share of the width that it has.
    fn segment(&self, theta: [f64; 2], k: usize) -> Segment {
        let step = PI / SEGMENTS as f64;
        let (sin, cos) = Real::sin_cos((k as f64 + 0.5) * step - 0.5 * PI);
        let inside = Inside::new(theta, sin, self.eta);
        let slope = cos * inside.over_eta / inside.gamma_t[1].max(1e-9);
        let share = cos * Real::sin(0.5 * step);
        let middle = self.point(theta, sin);
        Segment {
            a: middle.a.map(|a| a * share),
            turns: [0.0, 2.0, 4.0].map(|twice_p| (step * (twice_p * slope - 2.0)).abs()),
            ..middle
        }
    }
    /// `F_l`
    fn layered(&self, f: f64) -> f64 {
        self.layers * f / (1.0 + (self.layers - 1.0) * f)
    }
    /// The mean reflectance of the cuticle for light that comes from the medulla evenly.
    fn inner_reflectance(&self) -> f64 {
        let cosine = |k: usize, n: usize, most: f64| {
            let sin = most * (k as f64 + 0.5) / n as f64;
            ((1.0 - sin) * (1.0 + sin)).sqrt()
        };
        let (mut sum, mut whole) = (0.0, 0.0);
        for k in 0..POINTS[0] {
            let cos_gamma = cosine(k, POINTS[0], self.kappa);
            for j in 0..POINTS[1] {
                // Even radiance sends light in proportion to the cosine.
                let cos_theta = cosine(j, POINTS[1], 1.0);
                sum += cos_theta * self.layered(fresnel::dielectric(cos_theta * cos_gamma, 1.0 / self.eta).0);
                whole += cos_theta;
            }
        }
        sum / whole
    }
    /// `A_p` of every way; their sum is 1 where nothing is absorbed.
    #[allow(non_snake_case, reason = "names of the formula")]
    fn shares(&self, inside: &Inside<f64>) -> [Spectrum<f64>; WAYS] {
        let F = self.layered(inside.fresnel);
        let [s_c, s_m] = chords(self.kappa, inside.gamma_t);
        // In space a way is longer by 1 / cos theta_t.
        let longer = 0.5 * inside.length / inside.gamma_t[1].max(1e-9);
        let missed = Real::exp(-self.sigma_s * s_m * longer);
        // What goes on nearly as before meets the cuticle as the ray does.
        let F_s = lerp(self.inner_reflectance(), F, self.moments.along.clamp(0.0, 1.0));
        let mut a = [Spectrum::ZERO; WAYS];
        for (k, (sigma_c, sigma_m)) in self.sigma_c.0.into_iter().zip(self.sigma_m.0).enumerate() {
            let T = missed * Real::exp(-(sigma_c * s_c + sigma_m * s_m) * longer);
            let S =
                (1.0 - missed) * Real::exp(-sigma_c * s_c * longer) * self.moments.left(sigma_m * self.kappa);
            // Another passage: the mean chord of a cylinder is two radii, whatever scatters, shared as its area is.
            let core = self.kappa.sqr();
            let B = Real::exp(-2.0 * (sigma_c * (1.0 - core) + sigma_m * core));
            // All further passages of what was not scattered.
            let more = (F * T).sqr() / (1.0 - F * T).max(1e-300);
            let [first, FB] = [(1.0 - F) * S, F_s * B];
            let second = FB * first + first * F * T;
            let further = (FB * second + first * more) / (1.0 - FB).max(1e-300);
            let unscattered = [T, T * T * F, T * more].map(|t| (1.0 - F).sqr() * t);
            let scattered = [first, second, further].map(|s| (1.0 - F_s) * s);
            for (a, value) in a.iter_mut().zip([F].into_iter().chain(unscattered).chain(scattered)) {
                a.0[k] = value;
            }
        }
        a
    }
}

fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// How light of one way is spread around the fibre.
#[derive(Clone, Copy, Debug)]
enum Around {
    /// As on a rough cylinder.
    Logistic(TrimmedLogistic<f64>),
    /// As out of the medulla.
    Cauchy(WrappedCauchy),
    Even,
}

impl Around {
    /// Mean density in 1/rad over an interval of that width around `x` in [-pi, pi] from the exit.
    fn mean(&self, x: f64, width: f64) -> f64 {
        match self {
            Around::Logistic(d) => d.mean(x, width),
            Around::Cauchy(d) => d.mean(x, width),
            Around::Even => 0.5 / PI,
        }
    }
    fn sample(&self, u: f64) -> f64 {
        match self {
            Around::Logistic(d) => d.sample(u),
            Around::Cauchy(d) => d.sample(u),
            Around::Even => 2.0 * PI * u,
        }
    }
}

/// One way of leaving.
#[derive(Clone, Copy, Debug)]
struct Way {
    m: Longitudinal<f64>,
    /// The viewer's inclination, tilted.
    theta: [f64; 2],
    /// The lobe with whose exit it leaves; none where it leaves evenly.
    exit: Option<usize>,
    around: Around,
}

/// Light that met one place across the fibre, or a part of its width.
#[derive(Clone, Copy, Debug)]
struct Segment {
    /// `A_p` of every way, times the share of the width.
    a: [Spectrum<f64>; WAYS],
    /// Exits of R, TT, TRT from its middle, and by how much they turn over it.
    exits: [f64; 3],
    turns: [f64; 3],
}

impl Segment {
    const NONE: Segment = Segment { a: [Spectrum::ZERO; WAYS], exits: [0.0; 3], turns: [0.0; 3] };

    fn exit(&self, way: &Way) -> [f64; 2] {
        way.exit.map_or([0.0; 2], |p| [self.exits[p], self.turns[p]])
    }
}

/// Fur with its viewer.
pub struct SeenFur {
    o: FibreDir<f64>,
    ways: [Way; WAYS],
    segments: [Segment; SEGMENTS],
    n_segments: usize,
    /// The light of each way, and of all: means over the wavelengths.
    chances: [f64; WAYS],
    sum: f64,
}

impl SeenFur {
    fn new(o: FibreDir<f64>, ways: [Way; WAYS], segments: [Segment; SEGMENTS], n_segments: usize) -> SeenFur {
        let chances = core::array::from_fn(|k| segments[..n_segments].iter().map(|s| s.a[k].average()).sum());
        let sum = chances.iter().sum::<f64>().max(1e-300);
        SeenFur { o, ways, segments, n_segments, chances, sum }
    }
    fn segments(&self) -> &[Segment] {
        &self.segments[..self.n_segments]
    }
    /// `A M N` of every way.
    fn scattered(&self, wi: LocalDir<f64>) -> [Spectrum<f64>; WAYS] {
        let i = FibreDir::new(wi);
        let (theta_i, phi) = ([i.sin, i.cos], self.o.azimuth_to(&i));
        core::array::from_fn(|k| {
            let way = &self.ways[k];
            let m = way.m.value(theta_i, way.theta);
            if !(m > 0.0) {
                return Spectrum::ZERO;
            }
            let mut sum = Spectrum::ZERO;
            for s in self.segments() {
                let [exit, turn] = s.exit(way);
                sum += s.a[k] * way.around.mean(wrapped(phi - exit), turn);
            }
            sum * m
        })
    }
    /// An exit of the `k`-th way, and a uniform number that is left of `u`.
    fn draw_exit(&self, k: usize, u: f64) -> [f64; 2] {
        let mut x = u * self.chances[k];
        let mut drawn = [0.0, 0.5];
        for s in self.segments() {
            let chance = s.a[k].average();
            let within = (x / chance.max(1e-300)).min(1.0);
            let [exit, turn] = s.exit(&self.ways[k]);
            drawn = if turn > 0.0 {
                // Coarse steps along the segment, which the roughness blurs; the rest of the number is left over.
                let fine = within * STEPS;
                let whole = fine.floor().min(STEPS - 1.0);
                [exit + ((whole + 0.5) / STEPS - 0.5) * turn, fine - whole]
            } else {
                [exit, within]
            };
            if x < chance {
                break;
            }
            x -= chance;
        }
        drawn
    }
}

/// Steps along a segment.
const STEPS: f64 = 256.0;

impl Seen for SeenFur {
    fn f_cos_pdf(&self, wi: LocalDir<f64>) -> (Spectrum<f64>, f64) {
        let q = self.scattered(wi).into_iter().fold(Spectrum::ZERO, |q, way| q + way);
        (q, q.average() / self.sum)
    }

    fn lobes(&self, wi: LocalDir<f64>) -> [Spectrum<f64>; N_LOBES] {
        let [r, tt, trt, rest, tt_s, trt_s, rest_s] = self.scattered(wi);
        [r, tt + tt_s, trt + trt_s, rest + rest_s]
    }

    fn draw(&self, u: Uniforms<f64>) -> Option<LocalDir<f64>> {
        let mut x = u.lobe * self.sum;
        let last = self.chances.iter().rposition(|&chance| chance > 0.0)?;
        for (k, (&chance, way)) in self.chances.iter().zip(&self.ways).enumerate() {
            if x < chance || k == last {
                let [exit, left] = self.draw_exit(k, (x / chance).min(1.0));
                let sin = way.m.sample(way.theta, u.dir);
                return Some(self.o.turned(sin, exit + way.around.sample(left)));
            }
            x -= chance;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fur(p: &ParamBlock<f64>) -> Medullated {
        Sum::new(p)
    }

    #[test]
    fn white_fur_returns_all_light() {
        let mut p = ParamBlock::<f64>::defaults(Medullated::PARAMS);
        (p.spectra[0], p.spectra[1]) = (Spectrum::ZERO, Spectrum::ZERO);
        for (h, kappa, sigma_s, layers) in
            [(0.0, 0.7, 3.0, 1.0), (0.95, 0.7, 3.0, 2.0), (-1.0, 0.98, 30.0, 0.2), (0.3, 0.0, 0.0, 1.0)]
        {
            p.h = h;
            (p.reals[1], p.reals[2], p.reals[4]) = (kappa, sigma_s, layers);
            for theta in [0.0, 0.8, 1.5] {
                let inside = Inside::new(Real::sin_cos(theta).into(), h, p.reals[0]);
                let whole: f64 = fur(&p).shares(&inside).iter().map(|a| a.0[0]).sum();
                assert!((whole - 1.0).abs() < 1e-12, "{h} {kappa} {theta}: {whole}");
            }
        }
    }

    #[test]
    fn a_cauchy_density_has_its_mean_and_is_drawn() {
        let n = 4000;
        for r in [-0.4, 0.0, 0.7] {
            let d = WrappedCauchy { mean_cosine: r };
            let x = |k: i32| (f64::from(k) + 0.5) / f64::from(n);
            let step = 2.0 * PI / f64::from(n);
            let mean: f64 =
                (0..n).map(|k| d.mean(2.0 * PI * x(k), 0.0) * Real::cos(2.0 * PI * x(k)) * step).sum();
            let drawn: f64 = (0..n).map(|k| Real::cos(d.sample(x(k))) / f64::from(n)).sum();
            assert!((mean - r).abs() < 1e-9 && (drawn - r).abs() < 1e-3, "{r}: {mean} {drawn}");
        }
    }
}
