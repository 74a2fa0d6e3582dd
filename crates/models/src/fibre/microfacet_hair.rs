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

use core::f64::consts::{FRAC_PI_2, PI};

use sparrow_math::{LocalDir, Real, Vec3, vec3};
use sparrow_spectra::Spectrum;

use crate::bcsdf::weighed;
use crate::cylinder::attenuation::Inside;
use crate::cylinder::far_field::FarField;
use crate::cylinder::scale::{Scale, Scales};
use crate::cylinder::section::{Flat, Section, dot, turn};
use crate::cylinder::{FibreDir, LobeChoice};
use crate::ggx::Ggx;
use crate::{About, Bcsdf, BsdfSample, Lack, Model, N_LOBES, ParamBlock, ParamInfo, Uniforms, fresnel};

/// Nodes of TT and TRT.
const NODES: usize = 32;
/// Segments that serve to choose a lobe.
const FEW: usize = 8;
/// Least slope width.
const ROUGHNESS: f64 = 0.02;
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
const fn sequence(x: f64) -> [f32; NODES] {
    let (mut out, mut n) = ([0.0; NODES], 0);
    while n < NODES {
        let at = 0.5 + (n as f64 + 0.5) * x;
        out[n] = (at - (at as u32) as f64) as f32;
        n += 1;
    }
    out
}

/// Points of low discrepancy, one column per dimension: the offset in even steps, then multiples of `1 / g^k` with `g^5 = g + 1`.
/// [Roberts2018]
static POINTS: [[f32; NODES]; 5] = [
    sequence(1.0 / NODES as f64),
    sequence(0.856_674_883_854_502_9),
    sequence(0.733_891_856_627_126_7),
    sequence(0.628_706_721_037_809_3),
    sequence(0.538_597_257_223_612_1),
];

/// A hair of facets.
#[derive(Clone, Copy, Debug)]
pub struct MicrofacetHair<R> {
    sigma_a: Spectrum<R>,
    scales: Scales<R>,
    section: Section<R>,
    h: R,
    far: bool,
    mirror: bool,
}

impl<R: Real> Model<R> for MicrofacetHair<R> {
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

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let alpha = [p.reals[1], p.reals[2]].map(
            #[inline(always)]
            |a| a.max(R::of(ROUGHNESS)),
        );
        MicrofacetHair {
            sigma_a: p.spectra[0],
            scales: Scales {
                ggx: Ggx::new(alpha[0], alpha[1]),
                eta: p.reals[0],
                tilt: (p.reals[3] * R::of(PI / 180.0)).sin_cos().into(),
            },
            section: Section { b: p.reals[4] },
            h: p.h,
            far: p.choices[0] != 0,
            mirror: p.choices[1] != 0,
        }
    }
}

/// `atan(tan x / k)`, x in [-pi/2, pi/2].
#[inline(always)]
fn bent<R: Real>(x: R, k: R) -> R {
    let (sin, cos) = x.sin_cos();
    sin.atan2(k * cos)
}

/// Light from the viewer at the point of the surface where it may leave.
struct Arrived<R> {
    w: Vec3<R>,
    at: Scale<R>,
    /// What facets left of it, zero where it went nowhere, and the length of its way inside.
    weight: R,
    length: R,
}

/// Directions, seen from the axis.
struct Pair<R> {
    o: FibreDir<R>,
    wo: Vec3<R>,
    wi: Vec3<R>,
}

impl<R: Real> MicrofacetHair<R> {
    #[inline(always)]
    fn scale(&self, n: Flat<R>) -> Scale<R> {
        Scale::new(self.scales, n)
    }
    /// The point that the viewer sees at the offset `h`, and its scale.
    #[inline(always)]
    fn entry(&self, o: &FibreDir<R>, h: R) -> (Flat<R>, Scale<R>) {
        let at = self.section.entry(o.across, h);
        (at, self.scale(self.section.normal(at)))
    }
    #[inline(always)]
    fn fresnel(&self, cos: R) -> R {
        if self.mirror { R::ONE } else { fresnel::dielectric(cos, self.scales.eta).0 }
    }
    /// Value and density of R.
    #[inline(always)]
    fn r(&self, pair: &Pair<R>) -> [R; 2] {
        if !self.far {
            let [value, density, cos] = self.entry(&pair.o, self.h).1.reflected(pair.wo, pair.wi);
            return [value * self.fresnel(cos), density];
        }
        [self.over_width(pair, true), self.over_width(pair, false)]
    }
    /// R of the far field: the value, over the part of the width that sees the light too, or the density.
    ///
    /// The azimuth of the normal is `psi = psi_h + atan(k tan x)` from that of the half vector, with which `D` becomes `cos^4 x`
    /// but for the tilt, for any roughness.
    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn over_width(&self, pair: &Pair<R>, value: bool) -> R {
        let sum = pair.wo + pair.wi;
        let flat = (sum.y.sqr() + sum.z.sqr()).sqrt();
        let some = flat.gt(R::of(1e-9));
        let scale = R::ONE / R::select(some, flat, R::ONE);
        let half = [R::select(some, sum.y * scale, R::ONE), R::select(some, sum.z * scale, R::ZERO)];
        let [s, c] = self.scales.tilt;
        let inv = R::ONE / sum.length().max(R::of(1e-9));
        let C = (s * sum.x + c * flat) * inv;
        let [along, around] = self.scales.ggx.alphas();
        let slope = ((R::ONE - C) * (R::ONE + C)).max(R::ZERO) * (around / along).sqr();
        let k = ((slope + (C * around).sqr()) / (slope + C.sqr()).max(R::of(1e-12)))
            .min(R::ONE)
            .sqrt()
            .max(around);
        // Limits of psi - psi_h, from the azimuths that viewer and light see.
        let right = R::of(FRAC_PI_2 - 1e-4);
        let to_o = turn(half, pair.o.across);
        let (mut low, mut high) = ((to_o - right).max(-right), (to_o + right).min(right));
        if value {
            let to_i = turn(half, FibreDir::new(LocalDir::new(pair.wi)).across);
            (low, high) = (low.max(to_i - right), high.min(to_i + right));
        }
        let (low, high) = (bent(low, k), bent(high, k));
        let (middle, reach) = (R::of(0.5) * (low + high), R::of(0.5) * (high - low).max(R::ZERO));
        let width = self.section.half_width(pair.o.across);
        let mut sum = R::ZERO;
        for (x, weight) in GAUSS {
            for x in [-x, x] {
                let (sin, cos) = (middle + reach * R::of(x)).sin_cos();
                let stretch = cos.sqr() + (k * sin).sqr();
                let inv = R::ONE / stretch.sqrt();
                let (sin, cos) = (k * sin * inv, cos * inv);
                let n = [half[0] * cos - half[1] * sin, half[1] * cos + half[0] * sin];
                let [q, density, cos_d] = self.scale(n).reflected(pair.wo, pair.wi);
                let one = if value { q * self.fresnel(cos_d) } else { density };
                let dh = dot(n, pair.o.across).max(R::ZERO) * self.section.radius(n) / stretch;
                sum = sum + R::of(weight) * one * dh;
            }
        }
        sum * reach * k * R::of(0.5) / width
    }
    /// Light of node `n` at the end of TT or TRT.
    #[inline(always)]
    fn arrived(&self, o: &FibreDir<R>, wo: Vec3<R>, u: [R; 5], back: bool) -> Arrived<R> {
        let h = if self.far { u[0] + u[0] - R::ONE } else { self.h };
        let (at, scale) = self.entry(o, h);
        let ray = scale.enter(wo, [u[1], u[2]]);
        let mut out = self.crossed(at, ray.w, ray.weight, R::ZERO);
        if back {
            let ray = out.1.at.turn_back(out.1.w, [u[3], u[4]]);
            out = self.crossed(out.0, ray.w, ray.weight * out.1.weight, out.1.length);
        }
        out.1
    }
    /// Light that left the point `from` of the surface along `w`, at the next point.
    #[inline(always)]
    fn crossed(&self, from: Flat<R>, w: Vec3<R>, weight: R, length: R) -> (Flat<R>, Arrived<R>) {
        let d = [w.y, w.z];
        let t = self.section.across(from, d);
        let inside = t.gt(R::ZERO);
        let t = t.only_where(inside);
        let at = [from[0] + t * d[0], from[1] + t * d[1]];
        let arrived = Arrived {
            w,
            at: self.scale(self.section.normal(at)),
            weight: weight.only_where(inside),
            length: length + t,
        };
        (at, arrived)
    }
    /// Value and density of TT or TRT.
    #[inline(always)]
    fn through(&self, pair: &Pair<R>, back: bool) -> (Spectrum<R>, R) {
        let (mut q, mut pdf) = (Spectrum::ZERO, R::ZERO);
        for n in 0..NODES {
            let u = POINTS.map(
                #[inline(always)]
                |column| R::of(f64::from(column[n])),
            );
            let light = self.arrived(&pair.o, pair.wo, u, back);
            let [value, density] = light.at.left(light.w, pair.wi);
            let some = light.weight.gt(R::ZERO);
            let value = (value * light.weight).only_where(some);
            q += self.sigma_a.map(
                #[inline(always)]
                |sigma| (-sigma * light.length).exp() * value,
            );
            pdf = pdf + density.only_where(some);
        }
        let each = R::of(1.0 / NODES as f64);
        (q * each, pdf * each)
    }
    /// Probabilities of the lobes, not normalised: what a smooth circular fibre sends by them.
    #[inline(always)]
    fn chances(&self, o: &FibreDir<R>) -> [R; N_LOBES] {
        if self.mirror {
            return [R::ONE, R::ZERO, R::ZERO, R::ZERO];
        }
        let (theta, eta) = ([o.sin, o.cos], self.scales.eta);
        let shares = if self.far {
            FarField { theta, eta, sigma_a: self.sigma_a }.shares(FEW)
        } else {
            Inside::new(theta, self.h, eta).attenuation(self.sigma_a)
        };
        let least = R::of(LEAST);
        [shares[0].average() + least, shares[1].average() + least, shares[2].average() + least, R::ZERO]
    }
    #[inline(always)]
    fn scattered(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> ([Spectrum<R>; 3], [R; 3]) {
        let pair = Pair { o: FibreDir::new(wo), wo: wo.v(), wi: wi.v() };
        let [r, density] = self.r(&pair);
        if self.mirror {
            return ([Spectrum::splat(r), Spectrum::ZERO, Spectrum::ZERO], [density, R::ZERO, R::ZERO]);
        }
        let (tt, tt_density) = self.through(&pair, false);
        let (trt, trt_density) = self.through(&pair, true);
        ([Spectrum::splat(r), tt, trt], [density, tt_density, trt_density])
    }
}

impl<R: Real> Bcsdf<R> for MicrofacetHair<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let ([r, tt, trt], density) = self.scattered(wo, wi);
        let c = self.chances(&FibreDir::new(wo));
        let pdf = (c[0] * density[0] + c[1] * density[1] + c[2] * density[2]) / (c[0] + c[1] + c[2]);
        (r + tt + trt, pdf)
    }

    #[inline(always)]
    fn lobes(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> [Spectrum<R>; N_LOBES] {
        let [r, tt, trt] = self.scattered(wo, wi).0;
        [r, tt, trt, Spectrum::ZERO]
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let o = FibreDir::new(wo);
        let c = self.chances(&o);
        let lobe = LobeChoice::new(u.lobe, c, c[0] + c[1] + c[2]);
        let h = if self.far { lobe.left + lobe.left - R::ONE } else { self.h };
        let (r, reflects) = self.entry(&o, h).1.draw_reflected(wo.v(), u.dir);
        let node = (lobe.left * R::of(NODES as f64) - R::of(0.5)).round();
        let points = [
            node.look_up(&POINTS[0]),
            node.look_up(&POINTS[1]),
            node.look_up(&POINTS[2]),
            node.look_up(&POINTS[3]),
            node.look_up(&POINTS[4]),
        ];
        let (tt, trt) = (self.arrived(&o, wo.v(), points, false), self.arrived(&o, wo.v(), points, true));
        let (first, passes) = tt.at.draw_left(tt.w, u.dir);
        let (second, comes) = trt.at.draw_left(trt.w, u.dir);
        let [leaves, comes] = [passes & tt.weight.gt(R::ZERO), comes & trt.weight.gt(R::ZERO)];
        let [inner, twice, _] = lobe.from;
        let found = (!inner & reflects) | (inner & !twice & leaves) | (twice & comes);
        let wi = Vec3::select(twice, second, Vec3::select(inner, first, r));
        let wi = Vec3::select(found, wi, vec3(R::ZERO, R::ZERO, R::ONE));
        let s = weighed(self, wo, LocalDir::new(wi.normalized()));
        BsdfSample {
            weight: s.weight.only_where(found),
            density: s.density.only_where(found),
            valid: s.valid & found,
            ..s
        }
    }
}
