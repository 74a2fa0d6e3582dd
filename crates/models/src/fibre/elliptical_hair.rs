//! Hair of elliptical section: Gaussian lobes about the rays through a smooth ellipse, near or far field. [KhungurnMarschner2017]
//!
//! `q = sum_p M_p(theta_i, theta_o + shift_p) A_p(h) D(phi - Phi_p(h))` as in [`zinke_weber`](super::zinke_weber), with `A_p` and `Phi_p` of
//! rays traced through the ellipse (`cylinder::elliptic`); far field: the mean over h. The section has the semi-axes 1 along y and `aspect`
//! along z of the fibre's frame: turning the frame along the fibre turns its glints. The light inside goes by the viewer's inclination,
//! which keeps energy exactly. Where the ellipse holds TRT back by total reflection, it joins what leaves evenly around the fibre.
//!
//! The paper finds the rays of a pair of directions by adaptive quadrature; ours are 32 segments of the width, within which `A_p` and
//! `Phi_p` run evenly.

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::bcsdf::weighed;
use crate::cylinder::elliptic::Elliptic;
use crate::cylinder::far_field::Around;
use crate::cylinder::gaussian::{GaussianLobes, WIDTHS};
use crate::cylinder::section::Section;
use crate::cylinder::{FibreDir, LobeChoice};
use crate::{About, Bcsdf, BsdfSample, Lack, Model, N_LOBES, ParamBlock, ParamInfo, Uniforms};

/// A hair of elliptical section.
#[derive(Clone, Copy, Debug)]
pub struct EllipticalHair<R> {
    sigma_a: Spectrum<R>,
    eta: R,
    lobes: GaussianLobes<R>,
    section: Section<R>,
    h: R,
    far: bool,
}

impl<R: Real> Model<R> for EllipticalHair<R> {
    const ABOUT: About = About::new("dielectric fibre of elliptical section, Gaussian lobes, near or far field", "KhungurnMarschner2017, dEon2011")
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
        ParamInfo::real("aspect")
            .default(0.7)
            .range(0.3, 2.0)
            .soft(0.5, 1.0)
            .doc("Semi-axis of the section along z of the frame over that along y."),
        ParamInfo::choice("field", &["near", "far"])
            .doc("Where the ray met the fibre, or the mean over its width."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        EllipticalHair {
            sigma_a: p.spectra[0],
            eta: p.reals[0],
            lobes: GaussianLobes::new(p.reals[1], p.reals[2], p.reals[3]),
            section: Section { b: p.reals[4] },
            h: p.h,
            far: p.choices[0] != 0,
        }
    }
}

impl<R: Real> EllipticalHair<R> {
    #[inline(always)]
    fn elliptic(&self, o: &FibreDir<R>) -> Elliptic<R> {
        Elliptic { section: self.section, theta: [o.sin, o.cos], eta: self.eta, sigma_a: self.sigma_a }
    }
    /// `q` of every lobe, and `A_p`.
    #[inline(always)]
    fn scattered(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> Around<R> {
        let (o, i) = (FibreDir::new(wo), FibreDir::new(wi));
        let (rays, phi, d) = (self.elliptic(&o), o.azimuth_to(&i), &self.lobes.azimuthal);
        let Around { n, shares } =
            if self.far { rays.far(o.across, phi, d) } else { rays.near(o.across, self.h, phi, d) };
        let m = self.lobes.longitudinal(&o, &i);
        Around { n: [n[0] * m[0], n[1] * m[1], n[2] * m[2], n[3] * m[3]], shares }
    }
}

impl<R: Real> Bcsdf<R> for EllipticalHair<R> {
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
        let rays = self.elliptic(&o);
        if !self.far {
            let (exits, shares) = rays.at(o.across, self.h);
            let lobe = LobeChoice::of(u.lobe, &shares);
            let exit = lobe.pick([exits[0], exits[1], exits[2], R::ZERO]);
            return weighed(self, wo, self.lobes.draw(&o, &lobe, exit, [u.dir[0], lobe.left, u.dir[1]]));
        }
        let shares = rays.shares(o.across);
        let lobe = LobeChoice::of(u.lobe, &shares);
        let [a, b, c, d] = shares;
        let total = lobe.pick([a.average(), b.average(), c.average(), d.average()]);
        let [exit, left] = rays.draw(o.across, &lobe, total);
        weighed(self, wo, self.lobes.draw(&o, &lobe, exit, [u.dir[0], left, u.dir[1]]))
    }
}
