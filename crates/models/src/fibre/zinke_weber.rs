//! The rough dielectric fibre as a scattering function of the near or the far field, with Gaussian lobes around the fibre.
//! [ZinkeWeber2007]
//!
//! Near field: `q = sum_p M_p(theta_i, theta_o + shift_p) A_p(h) D(phi - Phi_p(h))`, where the deltas of the smooth cylinder became
//! `M` of [dEon2011] and wrapped Gaussians. Far field: its mean over h. The light inside goes by the viewer's inclination, which
//! keeps energy exactly. What is reflected inside more than once leaves evenly around the fibre.

use core::f64::consts::PI;

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::bcsdf::weighed;
use crate::cylinder::attenuation::Inside;
use crate::cylinder::azimuthal::{exit_azimuth, wrapped};
use crate::cylinder::far_field::{Around, FarField, SEGMENTS};
use crate::cylinder::gaussian::{GaussianLobes, WIDTHS};
use crate::cylinder::{FibreDir, LobeChoice};
use crate::{About, Bcsdf, BsdfSample, Lack, Model, N_LOBES, ParamBlock, ParamInfo, Uniforms};

/// A fibre after Zinke and Weber.
#[derive(Clone, Copy, Debug)]
pub struct ZinkeWeber<R> {
    sigma_a: Spectrum<R>,
    eta: R,
    lobes: GaussianLobes<R>,
    h: R,
    far: bool,
}

impl<R: Real> Model<R> for ZinkeWeber<R> {
    const ABOUT: About = About::new("rough dielectric cylinder, near or far field, Gaussian lobes", "ZinkeWeber2007, dEon2011")
        .anisotropic()
        .transmits()
        .lacks(&[
            Lack::reciprocity("the tilt and the angle inside know the viewer's inclination alone"),
            Lack::energy("no view is brighter than uniform light, but a lamp near the axis may be given back more than it sent"),
        ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::unbounded("sigma_a").unit("1/radius").default(0.5).soft(0.0, 10.0).doc("Absorption."),
        ParamInfo::real("eta")
            .default(1.55)
            .range(1.0, 3.0)
            .soft(1.3, 1.9)
            .doc("Relative index of refraction."),
        WIDTHS[0],
        WIDTHS[1],
        WIDTHS[2],
        ParamInfo::choice("field", &["near", "far"])
            .doc("Where the ray met the fibre, or the mean over its width."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let lobes = GaussianLobes::new(p.reals[1], p.reals[2], p.reals[3]);
        ZinkeWeber { sigma_a: p.spectra[0], eta: p.reals[0], lobes, h: p.h, far: p.choices[0] != 0 }
    }
}

impl<R: Real> ZinkeWeber<R> {
    #[inline(always)]
    fn far_field(&self, o: &FibreDir<R>) -> FarField<R> {
        FarField { theta: [o.sin, o.cos], eta: self.eta, sigma_a: self.sigma_a }
    }
    #[inline(always)]
    fn inside(&self, o: &FibreDir<R>) -> Inside<R> {
        Inside::new([o.sin, o.cos], self.h, self.eta)
    }
    /// The means of `A_p`, over the width or at the offset.
    #[inline(always)]
    fn shares(&self, o: &FibreDir<R>) -> [Spectrum<R>; N_LOBES] {
        if self.far { self.far_field(o).shares(SEGMENTS) } else { self.inside(o).attenuation(self.sigma_a) }
    }
    /// `A_p N_p`, and `A_p`.
    #[inline(always)]
    fn around(&self, o: &FibreDir<R>, phi: R) -> Around<R> {
        if self.far {
            return self.far_field(o).around(phi, &self.lobes.azimuthal, SEGMENTS);
        }
        let inside = self.inside(o);
        let shares = inside.attenuation(self.sigma_a);
        let [r, tt, trt, rest] = shares;
        let (gamma_o, gamma_t) = (self.h.asin(), inside.angle());
        let [a, b, c] = &self.lobes.azimuthal;
        let n = [
            r * a.value(wrapped(phi - exit_azimuth(0, gamma_o, gamma_t))),
            tt * b.value(wrapped(phi - exit_azimuth(1, gamma_o, gamma_t))),
            trt * c.value(wrapped(phi - exit_azimuth(2, gamma_o, gamma_t))),
            rest * R::of(0.5 / PI),
        ];
        Around { n, shares }
    }
    /// `q` of every lobe, and `A_p`.
    #[inline(always)]
    fn scattered(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> Around<R> {
        let (o, i) = (FibreDir::new(wo), FibreDir::new(wi));
        let Around { n, shares } = self.around(&o, o.azimuth_to(&i));
        let m = self.lobes.longitudinal(&o, &i);
        Around { n: [n[0] * m[0], n[1] * m[1], n[2] * m[2], n[3] * m[3]], shares }
    }
}

impl<R: Real> Bcsdf<R> for ZinkeWeber<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let Around { n: [r, tt, trt, rest], shares: [a, b, c, d] } = self.scattered(wo, wi);
        let q = (r + tt) + (trt + rest);
        (q, q.average() / ((a + b) + (c + d)).average().max(R::of(1e-30)))
    }

    #[inline(always)]
    fn lobes(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> [Spectrum<R>; N_LOBES] {
        self.scattered(wo, wi).n
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let o = FibreDir::new(wo);
        let lobe = LobeChoice::of(u.lobe, &self.shares(&o));
        let (exit, turn) = if self.far {
            let [exit, left] = self.far_field(&o).draw(
                #[inline(always)]
                |v| lobe.pick(v),
                lobe.left,
                SEGMENTS,
            );
            (exit, left)
        } else {
            let (gamma_o, gamma_t) = (self.h.asin(), self.inside(&o).angle());
            let (r, tt) = (exit_azimuth(0, gamma_o, gamma_t), exit_azimuth(1, gamma_o, gamma_t));
            let trt = exit_azimuth(2, gamma_o, gamma_t);
            (lobe.pick([r, tt, trt, R::ZERO]), lobe.left)
        };
        weighed(self, wo, self.lobes.draw(&o, &lobe, exit, [u.dir[0], turn, u.dir[1]]))
    }
}
