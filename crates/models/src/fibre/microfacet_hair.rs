//! Hair with a surface of facets: R, TT and TRT of a rough cylinder of circular or elliptical section, with a density that is
//! exact. [Huang2022]
//!
//! Every lobe is made of facets in space, so that nothing is a product of a longitudinal and an azimuthal term. R is the facets'
//! reflection at the offset h, in the far field its integral over the width, `1 / (2 W) int F D G2 / (4 cos_o) cos(delta) rho dpsi` with the
//! radius of curvature rho and the half width W, by a rule that follows the lobe. [Huang2022, eq. 8]
//! For TT and TRT light from the viewer enters at [`NODES`] facets, in the far field at as many offsets, is absorbed along its way, for
//! TRT reflected at one facet each, and leaves at any facet of the scale that it meets. The paper draws such nodes anew at each call, and its
//! density is a stand-in. Here they are fixed, numbers of low discrepancy: value and density are finite sums over the same nodes, samples
//! choose a node and then a facet where the light leaves, and the density is theirs without approximation.
//!
//! The section has the semi-axes 1 along y and `aspect` along z of the fibre's frame. Light at the offset h meets the scale there, tilted or not:
//! the paper weights scales by their tilted area instead, which is the same without tilt.
//! Limits: single scattering at each surface; what is reflected inside more than once is left out; with roughness below 0.1 the nodes
//! of TRT stand apart.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use sparrow_math::{LocalDir, Real, Vec3};
use sparrow_spectra::Spectrum;

use crate::cylinder::attenuation::Inside;
use crate::cylinder::far_field::FarField;
use crate::cylinder::scale::{Ray, Scale, Scales};
use crate::cylinder::section::{Flat, Section, dot, turn};
use crate::cylinder::{FibreDir, LobeChoice};
use crate::ggx::Ggx;
use crate::summed::{Seen, Sum, Summed};
use crate::{About, Lack, N_LOBES, ParamBlock, ParamInfo, Uniforms, fresnel};

/// Nodes of TT and TRT.
const NODES: usize = 32;
/// Segments that serve to choose a lobe.
const FEW: usize = 8;
/// Least slope width.
const ROUGHNESS: f64 = 0.02;
/// A little less than a right angle.
const RIGHT: f64 = FRAC_PI_2 - 1e-4;
/// Least probability of a lobe, before normalisation.
const LEAST: f64 = 0.02;

/// Nodes above zero and weights of the Gauss-Legendre rule with 16 points on [-1, 1]. [AbramowitzStegun, table 25.4]
const GAUSS: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_095),
];

/// `frac(1/2 + (n + 1/2) x)` of the nodes n.
const fn sequence(x: f64) -> [f64; NODES] {
    let (mut out, mut n) = ([0.0; NODES], 0);
    while n < NODES {
        let at = 0.5 + (n as f64 + 0.5) * x;
        out[n] = at - (at as u32) as f64;
        n += 1;
    }
    out
}

/// Points of low discrepancy, one column per dimension: the offset in even steps, then multiples of `1 / g^k` with `g^5 = g + 1`.
/// [Roberts2018]
static POINTS: [[f64; NODES]; 5] = [
    sequence(1.0 / NODES as f64),
    sequence(0.856_674_883_854_502_9),
    sequence(0.733_891_856_627_126_7),
    sequence(0.628_706_721_037_809_3),
    sequence(0.538_597_257_223_612_1),
];

/// A hair of facets.
pub(super) type MicrofacetHair<R> = Summed<R, Facets>;

/// The model in double precision.
#[derive(Clone, Copy, Debug)]
pub struct Facets {
    sigma_a: Spectrum<f64>,
    scales: Scales,
    section: Section<f64>,
    h: f64,
    far: bool,
    mirror: bool,
}

impl Sum for Facets {
    type Seen = SeenFacets;

    const ABOUT: About = About::new(
        "rough dielectric cylinder of facets, circular or elliptical, near or far field",
        "Huang2022, Walter2007",
    )
    .anisotropic()
    .transmits()
    .lacks(&[
        Lack::reciprocity(
            "the nodes of TT and TRT lie where the viewer's light enters, and h is that of the viewer",
        ),
        Lack::energy(
            "no view is brighter than uniform light, but a lamp may be given back more than it sent",
        ),
    ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::unbounded("sigma_a").unit("1/radius").default(0.5).soft(0.0, 10.0).doc("Absorption."),
        ParamInfo::real("eta")
            .default(1.55)
            .range(1.1, 3.0)
            .soft(1.3, 1.9)
            .doc("Relative index of refraction."),
        ParamInfo::real("alpha_m")
            .default(0.2)
            .range(ROUGHNESS, 1.0)
            .soft(0.1, 0.6)
            .doc("Slope width of the facets along the fibre, alpha of GGX."),
        ParamInfo::real("alpha_n")
            .default(0.2)
            .range(ROUGHNESS, 1.0)
            .soft(0.1, 0.6)
            .doc("Slope width of the facets around the fibre."),
        ParamInfo::real("tilt")
            .unit("deg")
            .default(2.0)
            .range(-20.0, 20.0)
            .soft(0.0, 10.0)
            .doc("By how much the scales' normals lean towards the tip."),
        ParamInfo::real("aspect")
            .default(1.0)
            .range(0.3, 2.0)
            .soft(0.5, 1.0)
            .doc("Semi-axis of the section along z of the frame over that along y."),
        ParamInfo::choice("field", &["near", "far"])
            .doc("Where the ray met the fibre, or the mean over its width."),
        ParamInfo::choice("fresnel", &["exact", "one"])
            .doc("F of the index, or a mirror, which has no TT and TRT."),
    ];

    fn new(p: &ParamBlock<f64>) -> Self {
        let alpha = [p.reals[1], p.reals[2]].map(|a| a.max(ROUGHNESS));
        Facets {
            sigma_a: p.spectra[0],
            scales: Scales {
                ggx: Ggx::new(alpha[0], alpha[1]),
                eta: p.reals[0],
                tilt: Real::sin_cos(p.reals[3] * (PI / 180.0)).into(),
            },
            section: Section { b: p.reals[4] },
            h: p.h,
            far: p.choices[0] != 0,
            mirror: p.choices[1] != 0,
        }
    }

    fn seen_from(&self, wo: LocalDir<f64>) -> SeenFacets {
        let o = FibreDir::new(wo);
        let nodes = if self.mirror { [[Arrived::NOWHERE; NODES]; 2] } else { self.nodes(&o, wo.v()) };
        SeenFacets { of: *self, wo: wo.v(), chances: self.chances(&o), o, nodes }
    }
}

/// Light from the viewer at the point of the surface where it may leave.
#[derive(Clone, Copy, Debug)]
struct Arrived {
    w: Vec3<f64>,
    /// The point, and its scale.
    at: Flat<f64>,
    scale: Scale,
    /// What facets left of it, zero where it went nowhere, and the length of its way inside.
    weight: f64,
    length: f64,
}

impl Arrived {
    const NOWHERE: Arrived = Arrived {
        w: Vec3 { x: 0.0, y: 0.0, z: 0.0 },
        at: [1.0, 0.0],
        scale: Scale::NONE,
        weight: 0.0,
        length: 0.0,
    };
}

impl Facets {
    fn scale(&self, n: Flat<f64>) -> Scale {
        Scale::new(&self.scales, n)
    }
    /// The point that the viewer sees at the offset `h`, and its scale.
    fn entry(&self, o: &FibreDir<f64>, h: f64) -> (Flat<f64>, Scale) {
        let at = self.section.entry(o.across, h);
        (at, self.scale(self.section.normal(at)))
    }
    /// The nodes of TT and TRT.
    fn nodes(&self, o: &FibreDir<f64>, wo: Vec3<f64>) -> [[Arrived; NODES]; 2] {
        let mut nodes = [[Arrived::NOWHERE; NODES]; 2];
        for n in 0..NODES {
            let [u0, u1, u2, u3, u4] = POINTS.map(|column| column[n]);
            let (from, scale) = self.entry(o, if self.far { 2.0 * u0 - 1.0 } else { self.h });
            let tt = self.scales.enter(&scale, wo, [u1, u2]).and_then(|ray| self.crossed(from, ray, 0.0));
            let Some(tt) = tt else { continue };
            nodes[0][n] = tt;
            let ray = self.scales.turn_back(&tt.scale, tt.w, [u3, u4]);
            let ray = ray.map(|ray| Ray { weight: ray.weight * tt.weight, ..ray });
            if let Some(trt) = ray.and_then(|ray| self.crossed(tt.at, ray, tt.length)) {
                nodes[1][n] = trt;
            }
        }
        nodes
    }
    /// Light that left the point `from` of the surface after a way of `length`, at the next point; none outwards.
    fn crossed(&self, from: Flat<f64>, ray: Ray, length: f64) -> Option<Arrived> {
        let d = [ray.w.y, ray.w.z];
        let t = self.section.across(from, d);
        (t > 0.0).then(|| {
            let at = [from[0] + t * d[0], from[1] + t * d[1]];
            let scale = self.scale(self.section.normal(at));
            Arrived { w: ray.w, at, scale, weight: ray.weight, length: length + t }
        })
    }
    fn fresnel(&self, cos: f64) -> f64 {
        if self.mirror { 1.0 } else { fresnel::dielectric(cos, self.scales.eta).0 }
    }
    /// Probabilities of the lobes, not normalised: what a smooth circular fibre sends by them.
    fn chances(&self, o: &FibreDir<f64>) -> [f64; N_LOBES] {
        if self.mirror {
            return [1.0, 0.0, 0.0, 0.0];
        }
        let (theta, eta) = ([o.sin, o.cos], self.scales.eta);
        let shares = if self.far {
            FarField { theta, eta, sigma_a: self.sigma_a }.shares(FEW)
        } else {
            Inside::new(theta, self.h, eta).attenuation(self.sigma_a)
        };
        [shares[0].average() + LEAST, shares[1].average() + LEAST, shares[2].average() + LEAST, 0.0]
    }
}

/// A hair with its viewer.
pub struct SeenFacets {
    of: Facets,
    o: FibreDir<f64>,
    wo: Vec3<f64>,
    chances: [f64; N_LOBES],
    /// Of TT and TRT.
    nodes: [[Arrived; NODES]; 2],
}

impl SeenFacets {
    /// Value and density of R.
    fn r(&self, wi: LocalDir<f64>) -> [f64; 2] {
        if !self.of.far {
            let scale = self.of.entry(&self.o, self.of.h).1;
            let [value, density, cos] = self.of.scales.reflected(&scale, self.wo, wi.v());
            return [value * self.of.fresnel(cos), density];
        }
        [self.over_width(wi, true), self.over_width(wi, false)]
    }
    /// How far around the fibre from a vector's azimuth scales face it, in rad; by its components along and across the fibre.
    fn facing(&self, along: f64, across: f64) -> f64 {
        let [s, c] = self.of.scales.tilt;
        Real::acos((-s * along / (c * across).max(1e-9)).clamp(-1.0, 1.0)).min(PI - 1e-4)
    }
    /// R of the far field: the value, over the part of the width that sees the light too, or the density.
    ///
    /// The azimuth of the normal is `psi = psi_h + atan(k tan x)` from that of the half vector, with which `D` becomes `cos^4 x`
    /// but for the tilt, for any roughness.
    #[allow(non_snake_case, reason = "names of the formula")]
    fn over_width(&self, wi: LocalDir<f64>, value: bool) -> f64 {
        let (sum, scales, section) = (self.wo + wi.v(), &self.of.scales, &self.of.section);
        let flat = (sum.y.sqr() + sum.z.sqr()).sqrt();
        let half = if flat > 1e-9 { [sum.y / flat, sum.z / flat] } else { [1.0, 0.0] };
        let [s, c] = scales.tilt;
        let C = (s * sum.x + c * flat) / sum.length().max(1e-9);
        let [along, around] = scales.ggx.alphas();
        let slope = ((1.0 - C) * (1.0 + C)).max(0.0) * (around / along).sqr();
        let k = ((slope + (C * around).sqr()) / (slope + C.sqr()).max(1e-12)).min(1.0).sqrt().max(around);
        // Limits of psi - psi_h, from the azimuths whose scales face the viewer, on his side of the fibre, the half vector and the light.
        let seen = self.facing(sum.x, flat);
        let seen_o = self.facing(self.o.sin, self.o.cos).min(RIGHT);
        let mut limits = within([-seen, seen], turn(half, self.o.across), seen_o);
        if value {
            let i = FibreDir::new(wi);
            limits = within(limits, turn(half, i.across), self.facing(i.sin, i.cos));
        }
        let [low, high] = limits.map(|x| bent(x, k));
        if low >= high {
            return 0.0;
        }
        let (middle, reach) = (0.5 * (low + high), 0.5 * (high - low));
        let mut sum = 0.0;
        for (x, weight) in GAUSS.into_iter().flat_map(|(x, w)| [(-x, w), (x, w)]) {
            let (sin, cos) = Real::sin_cos(middle + reach * x);
            let stretch = cos.sqr() + (k * sin).sqr();
            let inv = 1.0 / stretch.sqrt();
            let (sin, cos) = (k * sin * inv, cos * inv);
            let n = [half[0] * cos - half[1] * sin, half[1] * cos + half[0] * sin];
            let [q, density, cos_d] = scales.reflected(&self.of.scale(n), self.wo, wi.v());
            let one = if value { q * self.of.fresnel(cos_d) } else { density };
            sum += weight * one * dot(n, self.o.across).max(0.0) * section.radius(n) / stretch;
        }
        sum * reach * k * 0.5 / section.half_width(self.o.across)
    }
    /// Value and density of TT or TRT.
    fn through(&self, lobe: usize, wi: LocalDir<f64>) -> (Spectrum<f64>, f64) {
        let (mut q, mut pdf) = (Spectrum::ZERO, 0.0);
        for light in self.nodes[lobe].iter().filter(|light| light.weight > 0.0) {
            let [value, density] = self.of.scales.left(&light.scale, light.w, wi.v());
            if density > 0.0 {
                let value = value * light.weight;
                q += self.of.sigma_a.map(|sigma| Real::exp(-sigma * light.length) * value);
                pdf += density;
            }
        }
        let each = 1.0 / NODES as f64;
        (q * each, pdf * each)
    }
    fn scattered(&self, wi: LocalDir<f64>) -> ([Spectrum<f64>; 3], [f64; 3]) {
        let [r, density] = self.r(wi);
        let (tt, tt_density) = self.through(0, wi);
        let (trt, trt_density) = self.through(1, wi);
        ([Spectrum::splat(r), tt, trt], [density, tt_density, trt_density])
    }
}

impl Seen for SeenFacets {
    fn f_cos_pdf(&self, wi: LocalDir<f64>) -> (Spectrum<f64>, f64) {
        let ([r, tt, trt], density) = self.scattered(wi);
        let c = self.chances;
        let pdf = (c[0] * density[0] + c[1] * density[1] + c[2] * density[2]) / (c[0] + c[1] + c[2]);
        (r + tt + trt, pdf)
    }

    fn lobes(&self, wi: LocalDir<f64>) -> [Spectrum<f64>; N_LOBES] {
        let [r, tt, trt] = self.scattered(wi).0;
        [r, tt, trt, Spectrum::ZERO]
    }

    fn draw(&self, u: Uniforms<f64>) -> Option<LocalDir<f64>> {
        let c = self.chances;
        let lobe = LobeChoice::new(u.lobe, c, c[0] + c[1] + c[2]);
        let scales = &self.of.scales;
        let wi = if lobe.from[0] {
            let n = ((lobe.left * NODES as f64) as usize).min(NODES - 1);
            let light = &self.nodes[usize::from(lobe.from[1])][n];
            (light.weight > 0.0).then(|| scales.draw_left(&light.scale, light.w, u.dir)).flatten()
        } else {
            let h = if self.of.far { 2.0 * lobe.left - 1.0 } else { self.of.h };
            scales.draw_reflected(&self.of.entry(&self.o, h).1, self.wo, u.dir)
        };
        wi.map(|wi| LocalDir::new(wi.normalized()))
    }
}

/// The part of the limits, two angles in [-pi, pi], that lies within `reach` of `around`; all of it where that has two parts.
fn within([low, high]: [f64; 2], around: f64, reach: f64) -> [f64; 2] {
    let (a, b) = (around - reach, around + reach);
    [if b - TAU > low { low } else { low.max(a) }, if a + TAU < high { high } else { high.min(b) }]
}

/// `atan(tan x / k)`, in the quadrant of x.
fn bent(x: f64, k: f64) -> f64 {
    let (sin, cos) = Real::sin_cos(x);
    Real::atan2(sin, k * cos)
}
