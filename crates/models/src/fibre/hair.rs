//! Hair and fur after Chiang et al., as pbrt-v4's `Material "hair"` means it: a rough dielectric cylinder.
//! [Chiang2016]
//!
//! `q = sum_p M_p(theta_i, theta_o + shift_p) A_p(h) N_p(phi)` over R, TT, TRT and the rest, with the energy-conserving `M` of
//! [dEon2011] and a trimmed logistic `N`. The angle inside follows from the viewer's inclination alone, so that energy is kept
//! exactly; for that, viewer and light may not be exchanged. Signs as in pbrt-v4: a tilt `alpha > 0` centres R on
//! `theta_i = 2 alpha - theta_o`; `h = 2 v - 1` across the curve; `sigma_a` per radius. Near field as there; far field: its mean over h.
//!
//! Limits: one roughness for all lobes, a circular section; roughness below 0.02 counts as 0.02.
//! Errata: pbrt-v4's logarithm of I_0 takes M off by up to 2 % where its series meet; ours is that of `Real::i0e`.

use core::f64::consts::PI;

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::bcsdf::weighed;
use crate::cylinder::attenuation::Inside;
use crate::cylinder::azimuthal::{TrimmedLogistic, Turn, joined, turns_back};
use crate::cylinder::far_field::{FarField, SEGMENTS};
use crate::cylinder::longitudinal::{Longitudinal, tilted};
use crate::cylinder::roughness::{logistic_scale, variance};
use crate::cylinder::{FibreDir, LobeChoice, colour};
use crate::{About, Bcsdf, BsdfSample, Lack, Model, N_LOBES, ParamBlock, ParamInfo, Uniforms};

/// The least roughness: below it single precision runs out of digits.
const SMOOTHEST: f64 = 0.02;

/// Added to `M` and `N`, far below what a sum of lobes can hold: products of their tails would be denormal numbers, which are slow.
const FAINT: f64 = 1e-18;

/// A hair.
#[derive(Clone, Copy, Debug)]
pub struct Hair<R> {
    sigma_a: Spectrum<R>,
    eta: R,
    h: R,
    far: bool,
    /// `M` of R, TT, and of TRT and the rest.
    longitudinal: [Longitudinal<R>; 3],
    azimuthal: TrimmedLogistic<R>,
    /// Sine and cosine of the tilts of R, TT, TRT.
    tilts: [[R; 2]; 3],
}

impl<R: Real> Model<R> for Hair<R> {
    const ABOUT: About = About::new("hair as in pbrt-v4: rough dielectric cylinder, near or far field", "Chiang2016, dEon2011")
        .anisotropic()
        .transmits()
        .lacks(&[
            Lack::reciprocity("the tilt and the angle inside know the viewer's inclination alone"),
            Lack::energy("no view is brighter than uniform light, but a lamp near the axis may be given back more than it sent"),
        ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::unbounded("sigma_a").unit("1/radius").default(0.5).soft(0.0, 10.0).doc("Absorption."),
        ParamInfo::albedo("color").default(0.5).doc("Colour of a dense tuft, in place of absorption."),
        ParamInfo::real("eta")
            .default(1.55)
            .range(1.0, 3.0)
            .soft(1.3, 1.9)
            .doc("Relative index of refraction."),
        ParamInfo::real("beta_m").default(0.3).soft(0.02, 1.0).doc("Roughness along the fibre."),
        ParamInfo::real("beta_n").default(0.3).soft(0.02, 1.0).doc("Roughness around the fibre."),
        ParamInfo::real("alpha")
            .unit("deg")
            .default(2.0)
            .range(-20.0, 20.0)
            .soft(0.0, 10.0)
            .doc("Tilt of the scales, positive as in pbrt-v4."),
        ParamInfo::choice("absorption", &["sigma_a", "color"]).doc("Which of the two is meant."),
        ParamInfo::choice("field", &["near", "far"])
            .doc("Where the ray met the fibre, or the mean over its width."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let least = R::of(SMOOTHEST);
        let [eta, beta_m, beta_n, alpha] =
            [p.reals[0], p.reals[1].max(least), p.reals[2].max(least), p.reals[3]];
        let sigma_a = match p.choices[0] {
            0 => p.spectra[0],
            _ => colour::absorption_of_tuft(p.spectra[1], beta_n),
        };
        let v = variance(beta_m);
        let (sin, cos) = (alpha * R::of(PI / 180.0)).sin_cos();
        let [sin_2, cos_2] = doubled([sin, cos]);
        Hair {
            sigma_a,
            eta,
            h: p.h,
            far: p.choices[1] != 0,
            longitudinal: [
                Longitudinal::new(v),
                Longitudinal::new(R::of(0.25) * v),
                Longitudinal::new(R::of(4.0) * v),
            ],
            azimuthal: TrimmedLogistic::new(logistic_scale(beta_n)),
            tilts: [[-sin_2, cos_2], [sin, cos], doubled([sin_2, cos_2])],
        }
    }
}

/// Sine and cosine of twice the angle.
#[inline(always)]
fn doubled<R: Real>([sin, cos]: [R; 2]) -> [R; 2] {
    [R::of(2.0) * sin * cos, cos.sqr() - sin.sqr()]
}

/// The fibre as one viewer sees it.
struct Seen<R> {
    o: FibreDir<R>,
    /// From where R leaves to where the light came from, and from each lobe to that before it.
    back: [Turn<R>; 2],
    /// `A_p`
    shares: [Spectrum<R>; N_LOBES],
    /// Probabilities of the lobes, not normalised, and their sum.
    chances: [R; N_LOBES],
    sum: R,
}

impl<R: Real> Hair<R> {
    #[inline(always)]
    fn seen(&self, wo: LocalDir<R>) -> Seen<R> {
        let o = FibreDir::new(wo);
        let inside = Inside::new([o.sin, o.cos], self.h, self.eta);
        let shares =
            if self.far { self.far_field(&o).shares(SEGMENTS) } else { inside.attenuation(self.sigma_a) };
        let gamma_o = [self.h, ((R::ONE - self.h) * (R::ONE + self.h)).safe_sqrt()];
        let back = turns_back(gamma_o, inside.gamma_t);
        let chances = [shares[0].average(), shares[1].average(), shares[2].average(), shares[3].average()];
        let sum = ((chances[0] + chances[1]) + (chances[2] + chances[3])).max(R::of(1e-30));
        Seen { o, back, shares, chances, sum }
    }

    #[inline(always)]
    fn far_field(&self, o: &FibreDir<R>) -> FarField<R> {
        FarField { theta: [o.sin, o.cos], eta: self.eta, sigma_a: self.sigma_a }
    }

    /// The viewer's inclination, tilted for lobe `p`.
    #[inline(always)]
    fn tilted(&self, o: &FibreDir<R>, p: usize) -> [R; 2] {
        tilted([o.sin, o.cos], self.tilts[p])
    }

    /// `M_p` of every lobe.
    #[inline(always)]
    fn along(&self, o: &FibreDir<R>, wi: LocalDir<R>) -> [R; N_LOBES] {
        let i = FibreDir::new(wi);
        let theta_i = [i.sin, i.cos];
        let [m0, m1, m2] = &self.longitudinal;
        [
            m0.value(theta_i, self.tilted(o, 0)),
            m1.value(theta_i, self.tilted(o, 1)),
            m2.value(theta_i, self.tilted(o, 2)),
            m2.value(theta_i, [o.sin, o.cos]),
        ]
        .map(
            #[inline(always)]
            |m| m + R::of(FAINT),
        )
    }

    /// `N` at the turn from where a lobe leaves.
    #[inline(always)]
    fn around(&self, [cos, sin]: Turn<R>) -> R {
        self.azimuthal.value(sin.atan2(cos)) + R::of(FAINT)
    }

    /// `q` of every lobe.
    #[inline(always)]
    fn q(&self, seen: &Seen<R>, wo: LocalDir<R>, wi: LocalDir<R>) -> [Spectrum<R>; N_LOBES] {
        let m = self.along(&seen.o, wi);
        if self.far {
            let phi = seen.o.azimuth_to(&FibreDir::new(wi));
            let [r, tt, trt, rest] = self.far_field(&seen.o).around(phi, &[self.azimuthal; 3], SEGMENTS).n;
            return [r * m[0], tt * m[1], trt * m[2], rest * m[3]];
        }
        let [back, passage] = seen.back;
        let r = joined(FibreDir::scaled_turn(wo, wi), back);
        let tt = joined(r, passage);
        let trt = joined(tt, passage);
        let a = &seen.shares;
        [
            a[0] * (m[0] * self.around(r)),
            a[1] * (m[1] * self.around(tt)),
            a[2] * (m[2] * self.around(trt)),
            a[3] * (m[3] * R::of(0.5 / PI)),
        ]
    }
}

impl<R: Real> Bcsdf<R> for Hair<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let seen = self.seen(wo);
        let [r, tt, trt, rest] = self.q(&seen, wo, wi);
        let q = (r + tt) + (trt + rest);
        // Lobes are drawn by their means over the wavelengths.
        (q, q.average() / seen.sum)
    }

    #[inline(always)]
    fn lobes(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> [Spectrum<R>; N_LOBES] {
        self.q(&self.seen(wo), wo, wi)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let seen = self.seen(wo);
        let o = &seen.o;
        let lobe = LobeChoice::new(u.lobe, seen.chances, seen.sum);
        let [r, tt, trt] = [self.tilted(o, 0), self.tilted(o, 1), self.tilted(o, 2)];
        let theta_o = [lobe.pick([r[0], tt[0], trt[0], o.sin]), lobe.pick([r[1], tt[1], trt[1], o.cos])];
        let [m0, m1, m2] = &self.longitudinal;
        let m = Longitudinal::select(lobe.from[1], m2, &Longitudinal::select(lobe.from[0], m1, m0));
        let (back, around, left) = if self.far {
            let [exit, left] = self.far_field(o).draw(
                #[inline(always)]
                |v| lobe.pick(v),
                lobe.left,
                SEGMENTS,
            );
            ([R::ONE, R::ZERO], exit, left)
        } else {
            let [r, passage] = seen.back;
            let tt = joined(r, passage);
            let trt = joined(tt, passage);
            let back = [lobe.pick([r[0], tt[0], trt[0], R::ONE]), lobe.pick([r[1], tt[1], trt[1], R::ZERO])];
            (back, R::ZERO, lobe.left)
        };
        let away = R::select(lobe.from[2], R::of(2.0 * PI) * left, self.azimuthal.sample(left));
        let (sin, cos) = (around + away).sin_cos();
        let turn = joined([cos, sin], [back[0], -back[1]]);

        weighed(self, wo, o.turned_by(m.sample(theta_o, u.dir), turn))
    }
}
