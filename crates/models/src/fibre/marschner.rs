//! The hair model of Marschner et al.: R, TT and TRT of a dielectric cylinder, blurred along the fibre and smooth around it.
//! [Marschner2003]
//!
//! `S = sum_p M_p(theta_h) N_p(eta'(theta_d); phi) / cos^2 theta_d`, where `N_p` sums `A_p / |2 dPhi / dh|` over the true roots of `Phi_p`,
//! and the caustic of TRT gives way to two Gaussians. An elliptical section changes the index that TRT sees.
//!
//! Errata, put right in `form corrected`: `M_p` as printed has unit area over `theta_h`, which doubles the light, since
//! `d theta_i = 2 d theta_h`; the attenuation as printed has `1 + cos 2 gamma_t` where the chord is `2 cos gamma_t`; the smoothstep that
//! ends the caustic runs from 1 down to 0. Reflectance is that of the angle in space, which the paper's two indices amount to.
//!
//! Limits: what is reflected inside more than once is left out; caustics make light.

use core::f64::consts::{PI, SQRT_2};

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::bcsdf::weighed;
use crate::cylinder::attenuation::Inside;
use crate::cylinder::azimuthal::{exit_azimuth, wrapped};
use crate::cylinder::far_field::FarField;
use crate::cylinder::longitudinal::{Longitudinal, tilted};
use crate::cylinder::roots::{self, Root};
use crate::cylinder::{FibreDir, LobeChoice};
use crate::microfacet::special::gauss_quantile;
use crate::opaque::exp_neg;
use crate::{About, Bcsdf, BsdfSample, Lack, Model, N_LOBES, ParamBlock, ParamInfo, Uniforms};

/// Segments that serve to choose a lobe.
const FEW: usize = 8;
const DEGREE: f64 = PI / 180.0;

/// A fibre after Marschner et al.
#[derive(Clone, Copy, Debug)]
pub struct Marschner<R> {
    sigma_a: Spectrum<R>,
    eta: R,
    eccentricity: R,
    /// `alpha_p`, `beta_p` of R, TT, TRT in rad.
    shift: [R; 3],
    width: [R; 3],
    glint: Glint<R>,
    printed: bool,
    /// As wide as `M_p`, with heavier tails, about the shifted cone.
    around_cone: [Longitudinal<R>; 3],
    tilts: [[R; 2]; 3],
}

/// What stands for the caustic of TRT.
#[derive(Clone, Copy, Debug)]
struct Glint<R> {
    /// `k_G`
    strength: R,
    /// `w_c` in rad.
    width: R,
    /// `Delta eta'`
    fade: R,
    /// `Delta h_M`
    most: R,
}

impl<R: Real> Model<R> for Marschner<R> {
    const ABOUT: About =
        About::new("R, TT, TRT of a smooth cylinder, with caustics, far field", "Marschner2003")
            .anisotropic()
            .transmits()
            .lacks(&[Lack::energy(
                "caustics are added, and M is normalised in the angle, not the solid angle",
            )]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::unbounded("sigma_a").unit("1/radius").default(0.5).soft(0.0, 10.0).doc("Absorption."),
        ParamInfo::real("eta")
            .default(1.55)
            .range(1.1, 3.0)
            .soft(1.3, 1.9)
            .doc("Relative index of refraction."),
        ParamInfo::real("alpha_r")
            .unit("deg")
            .default(-7.5)
            .range(-20.0, 20.0)
            .soft(-10.0, -5.0)
            .doc("Shift of R, alpha_R; TT has -1/2 of it, TRT -3/2."),
        ParamInfo::real("beta_r")
            .unit("deg")
            .default(7.5)
            .range(1.0, 30.0)
            .soft(5.0, 10.0)
            .doc("Standard deviation of R, beta_R; TT has 1/2 of it, TRT twice."),
        ParamInfo::real("glint")
            .default(1.0)
            .range(0.0, 5.0)
            .soft(0.5, 5.0)
            .doc("Strength of caustics, k_G."),
        ParamInfo::real("glint_width")
            .unit("deg")
            .default(15.0)
            .range(1.0, 30.0)
            .soft(10.0, 25.0)
            .doc("Width of caustics, w_c."),
        ParamInfo::real("glint_fade")
            .default(0.3)
            .range(0.05, 1.0)
            .soft(0.2, 0.4)
            .doc("Range of index over which caustics end, Delta eta'."),
        ParamInfo::real("glint_span")
            .default(0.5)
            .soft(0.1, 0.5)
            .doc("Most offsets that a caustic gathers, Delta h_M."),
        ParamInfo::real("eccentricity")
            .default(1.0)
            .range(0.85, 1.15)
            .soft(0.85, 1.0)
            .doc("Ratio of the section's axes, a."),
        ParamInfo::choice("form", &["corrected", "printed"])
            .doc("With the slips of the paper put right, or as printed."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let (alpha, beta) = (p.reals[1] * R::of(DEGREE), p.reals[2] * R::of(DEGREE));
        let width = [beta, R::of(0.5) * beta, R::of(2.0) * beta];
        let shift = [alpha, R::of(-0.5) * alpha, R::of(-1.5) * alpha];
        // theta_h = alpha where theta_i = -(theta_o - 2 alpha); theta_i varies twice as much as theta_h.
        let (r, tt, trt) = (
            (R::of(-2.0) * shift[0]).sin_cos(),
            (R::of(-2.0) * shift[1]).sin_cos(),
            (R::of(-2.0) * shift[2]).sin_cos(),
        );
        Marschner {
            sigma_a: p.spectra[0],
            eta: p.reals[0],
            eccentricity: p.reals[7],
            shift,
            width,
            glint: Glint {
                strength: p.reals[3],
                width: p.reals[4] * R::of(DEGREE),
                fade: p.reals[5],
                most: p.reals[6],
            },
            printed: p.choices[0] != 0,
            around_cone: [
                Longitudinal::new(R::of(4.0) * width[0].sqr()),
                Longitudinal::new(R::of(4.0) * width[1].sqr()),
                Longitudinal::new(R::of(4.0) * width[2].sqr()),
            ],
            tilts: [[r.0, r.1], [tt.0, tt.1], [trt.0, trt.1]],
        }
    }
}

/// `e^(-(x / w)^2 / 2)`
#[inline(always)]
fn bell<R: Real>(x: R, w: R) -> R {
    exp_neg(R::of(0.5) * (x / w).sqr())
}

/// Unit-area Gaussian.
#[inline(always)]
fn gauss<R: Real>(x: R, w: R) -> R {
    bell(x, w) * R::of(0.398_942_280_401_432_7) / w
}

/// The index that TRT sees in an elliptical section, at the half angle `phi_h` of its cosine of twice. [Marschner2003, section 5.2.3]
#[inline(always)]
fn squeezed_index<R: Real>(eta: R, a: R, cos_2_phi_h: R) -> R {
    let of = (eta - R::ONE) * R::of(2.0);
    let (one, two) = (of * a.sqr() - eta + R::of(2.0), of / a.sqr() - eta + R::of(2.0));
    R::of(0.5) * ((one + two) + cos_2_phi_h * (one - two))
}

/// The index seen along the axis, `eta'`.
#[inline(always)]
fn along_axis<R: Real>(eta: R, [sin, cos]: [R; 2]) -> R {
    ((eta - sin) * (eta + sin)).safe_sqrt() / cos.max(R::of(1e-4))
}

/// Where the caustic lies and what it gathers, at one index along the axis.
struct Caustic<R> {
    h: R,
    phi: R,
    span: R,
    /// t: 1 where there is a caustic, fading out beyond.
    share: R,
}

impl<R: Real> Glint<R> {
    #[inline(always)]
    fn caustic(&self, eta: R) -> Caustic<R> {
        let there = eta.lt(R::of(2.0));
        let [phi, bend] = roots::caustic_azimuth(eta);
        let span = R::of(2.0) * (R::of(2.0) * self.width / bend.abs().max(R::of(1e-9))).sqrt();
        let x = ((eta - R::of(2.0)) / self.fade).clamp(R::ZERO, R::ONE);
        Caustic {
            h: roots::caustic(eta),
            phi: phi.only_where(there),
            span: R::select(there, span.min(self.most), self.most),
            share: R::ONE - x * x * (R::of(3.0) - x - x),
        }
    }
}

/// All that light and viewer decide, but for colour.
struct Between<R> {
    theta_d: [R; 2],
    phi: R,
    r: Root<R>,
    tt: Root<R>,
    trt: [Root<R>; 3],
    caustic: Caustic<R>,
    eta_trt: R,
}

impl<R: Real> Marschner<R> {
    #[inline(always)]
    fn between(&self, o: &FibreDir<R>, i: &FibreDir<R>) -> Between<R> {
        let theta_d = o.difference(i);
        let phi = o.azimuth_to(i);
        // cos(2 phi_h) = cos(phi_i + phi_o)
        let cos_2_phi_h = o.across[0] * i.across[0] - o.across[1] * i.across[1];
        let eta_trt = squeezed_index(self.eta, self.eccentricity, cos_2_phi_h).max(R::of(1.05));
        let eta_along = along_axis(eta_trt, theta_d);
        Between {
            theta_d,
            phi,
            r: roots::of_r(phi),
            tt: roots::of_tt(phi, along_axis(self.eta, theta_d)),
            trt: roots::of_trt(phi, eta_along),
            caustic: self.glint.caustic(eta_along),
            eta_trt,
        }
    }
    /// `A_p` of a root, as the form has it.
    #[inline(always)]
    fn attenuation(&self, b: &Between<R>, h: R, eta: R) -> [Spectrum<R>; N_LOBES] {
        let mut inside = Inside::new(b.theta_d, h, eta);
        if self.printed {
            inside.length = inside.length * R::of(2.0) * inside.gamma_t[1];
        }
        inside.attenuation(self.sigma_a)
    }
    /// `N_TRT` with its caustic replaced.
    #[inline(always)]
    fn trt(&self, b: &Between<R>) -> Spectrum<R> {
        let [x, y, z] = &b.trt;
        let n = (self.attenuation(b, x.h, b.eta_trt)[2] * x.density
            + self.attenuation(b, y.h, b.eta_trt)[2] * y.density)
            + self.attenuation(b, z.h, b.eta_trt)[2] * z.density;
        let c = &b.caustic;
        let [left, right] = self.glints(b);
        let kept = (R::ONE - c.share * left) * (R::ONE - c.share * right);
        let scale =
            c.share * self.glint.strength * c.span * R::of(0.398_942_280_401_432_7) / self.glint.width;
        n * kept + self.attenuation(b, c.h, b.eta_trt)[2] * (scale * (left + right))
    }
    /// The bells about both caustics.
    #[inline(always)]
    fn glints(&self, b: &Between<R>) -> [R; 2] {
        let w = self.glint.width;
        [bell(wrapped(b.phi - b.caustic.phi), w), bell(wrapped(b.phi + b.caustic.phi), w)]
    }
    /// `M_p`
    #[inline(always)]
    fn m(&self, p: usize, theta_h: R) -> R {
        let g = gauss(theta_h - self.shift[p], self.width[p]);
        if self.printed { g } else { R::of(0.5) * g }
    }
    /// `q` of R, TT and TRT.
    #[inline(always)]
    fn scattered(&self, o: &FibreDir<R>, i: &FibreDir<R>, b: &Between<R>) -> [Spectrum<R>; 3] {
        let theta_h = R::of(0.5) * (o.sin.atan2(o.cos) + i.sin.atan2(i.cos));
        let scale = i.cos / b.theta_d[1].sqr().max(R::of(1e-9));
        let r = self.attenuation(b, b.r.h, self.eta)[0] * (b.r.density * self.m(0, theta_h) * scale);
        let tt = self.attenuation(b, b.tt.h, self.eta)[1] * (b.tt.density * self.m(1, theta_h) * scale);
        [r, tt, self.trt(b) * (self.m(2, theta_h) * scale)]
    }
    /// Azimuth in a chosen lobe once the inclination is known.
    ///
    /// R and TT send light of an even offset h to `Phi_p(h)`, whose density is that of the root. TRT is drawn about its caustics, and
    /// evenly around the fibre.
    #[inline(always)]
    fn draw_azimuth(&self, o: &FibreDir<R>, sin: R, lobe: &LobeChoice<R>, u: R) -> R {
        let theta_d = o.difference(&FibreDir::new(o.turned(sin, R::ZERO)));
        let twice = u + u;
        let h = twice - R::ONE;
        let (gamma_o, gamma_t) = (h.asin(), Inside::new(theta_d, h, self.eta).angle());
        let right = u.ge(R::of(0.5));
        let phi = self.glint.caustic(along_axis(self.eta, theta_d)).phi;
        let away = R::of(SQRT_2) * self.glint.width * gauss_quantile(R::select(right, h, twice));
        let glint = R::select(right, phi, -phi) + away;
        lobe.pick([
            exit_azimuth(0, gamma_o, gamma_t),
            exit_azimuth(1, gamma_o, gamma_t),
            glint,
            R::of(PI) * h,
        ])
    }
    /// Density around the fibre of what is drawn about the caustics.
    #[inline(always)]
    fn glint_density(&self, b: &Between<R>) -> R {
        let phi = self.glint.caustic(along_axis(self.eta, b.theta_d)).phi;
        let w = self.glint.width;
        R::of(0.5) * (gauss(wrapped(b.phi - phi), w) + gauss(wrapped(b.phi + phi), w))
    }
    /// Probabilities of R, TT, and TRT about its caustics and around the fibre.
    #[inline(always)]
    fn chances(&self, o: &FibreDir<R>) -> [R; 4] {
        let theta = [o.sin, o.cos];
        let [r, tt, trt, _] = FarField { theta, eta: self.eta, sigma_a: self.sigma_a }.shares(FEW);
        let (r, tt, trt) = (r.average(), tt.average(), trt.average());
        let glints = trt * (R::of(0.5) + self.glint.strength);
        let even = R::of(0.5) * trt;
        let scale = R::ONE / ((r + tt) + (glints + even)).max(R::of(1e-30));
        [r * scale, tt * scale, glints * scale, even * scale]
    }
}

impl<R: Real> Bcsdf<R> for Marschner<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let (o, i) = (FibreDir::new(wo), FibreDir::new(wi));
        let b = self.between(&o, &i);
        let [r, tt, trt] = self.scattered(&o, &i, &b);
        let c = self.chances(&o);
        let (theta_i, theta_o) = ([i.sin, i.cos], [o.sin, o.cos]);
        let [m0, m1, m2] = &self.around_cone;
        let [t0, t1, t2] = self.tilts;
        let pdf = c[0] * m0.value(theta_i, tilted(theta_o, t0)) * b.r.density
            + c[1] * m1.value(theta_i, tilted(theta_o, t1)) * b.tt.density
            + m2.value(theta_i, tilted(theta_o, t2))
                * (c[2] * self.glint_density(&b) + c[3] * R::of(0.5 / PI));
        ((r + tt + trt).only_where(pdf.gt(R::ZERO)), pdf)
    }

    #[inline(always)]
    fn lobes(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> [Spectrum<R>; N_LOBES] {
        let (o, i) = (FibreDir::new(wo), FibreDir::new(wi));
        let [r, tt, trt] = self.scattered(&o, &i, &self.between(&o, &i));
        [r, tt, trt, Spectrum::ZERO]
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let o = FibreDir::new(wo);
        let lobe = LobeChoice::new(u.lobe, self.chances(&o), R::ONE);
        let theta_o = [o.sin, o.cos];
        let [t0, t1, t2] =
            [tilted(theta_o, self.tilts[0]), tilted(theta_o, self.tilts[1]), tilted(theta_o, self.tilts[2])];
        let [m0, m1, m2] = &self.around_cone;
        let m = Longitudinal::select(lobe.from[1], m2, &Longitudinal::select(lobe.from[0], m1, m0));
        let t = [lobe.pick([t0[0], t1[0], t2[0], t2[0]]), lobe.pick([t0[1], t1[1], t2[1], t2[1]])];
        let sin = m.sample(t, [u.dir[0], lobe.left]);
        weighed(self, wo, o.turned(sin, self.draw_azimuth(&o, sin, &lobe, u.dir[1])))
    }
}
