//! Velvet and other downy surfaces: a thin layer that scatters once, over a diffuse base. [KoenderinkPont2003]
//!
//! `f = w p / (cos_i + cos_o) (1 - exp(-tau (1/cos_i + 1/cos_o))) + rho_d / pi exp(-tau (1/cos_i + 1/cos_o))`, with the phase
//! function p of Henyey and Greenstein. At grazing views the line of sight meets more of the layer: the rim shines.
//! `asymmetry` below zero sends light back, the ridge near the light that velvet shows; above zero it sends light on, the
//! ridge at grazing [Lu1998].
//! Limits: single scattering; the hairs stand without a preferred lean. Measured parameters are not included.

use core::f64::consts::FRAC_1_PI;

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::opaque::{Opaque, TwoLobes};
use crate::{About, Model, ParamBlock, ParamInfo, Uniforms, cosine_lobe};

/// A thin scattering layer over a diffuse base.
#[derive(Clone, Copy, Debug)]
pub struct Velvet<R> {
    down: Spectrum<R>,
    diffuse: Spectrum<R>,
    tau: R,
    g: R,
}

impl<R: Real> Model<R> for Velvet<R> {
    const ABOUT: About =
        About::new("velvet: a thin layer that scatters once, over a base", "KoenderinkPont2003, Lu1998");
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("down")
            .default(0.8)
            .doc("Share w of the light that a hair of the layer scatters on."),
        ParamInfo::albedo("diffuse").default(0.1).doc("Reflectance of the base."),
        ParamInfo::real("tau")
            .default(0.5)
            .range(0.01, 20.0)
            .soft(0.05, 3.0)
            .doc("Optical depth of the layer."),
        ParamInfo::real("asymmetry")
            .default(0.0)
            .range(-0.9, 0.9)
            .soft(-0.7, 0.7)
            .doc("Mean cosine of scattering: below zero back, above zero on."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        Velvet { down: p.spectra[0], diffuse: p.spectra[1], tau: p.reals[0], g: p.reals[1] }
    }
}

impl<R: Real> Velvet<R> {
    /// Henyey and Greenstein's function of the cosine between the ways of light before and after, over the sphere.
    #[inline(always)]
    fn phase(&self, cos: R) -> R {
        let g2 = self.g.sqr();
        let s = R::ONE + g2 - R::of(2.0) * self.g * cos;
        (R::ONE - g2) * R::of(0.25 * FRAC_1_PI) / (s * s.sqrt())
    }
    #[inline(always)]
    fn lobes(&self, o: LocalDir<R>) -> TwoLobes<R> {
        // Of two lobes that are both black the base is chosen, however few digits a number has.
        let through = (-self.tau / o.cos_theta()).exp().max(R::of(1e-30));
        TwoLobes::new(self.diffuse * through, self.down * (R::ONE - through))
    }
}

impl<R: Real> Opaque for Velvet<R> {
    type R = R;

    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let both_ways = self.tau * (R::ONE / i.cos_theta() + R::ONE / o.cos_theta());
        let through = (-both_ways).exp();
        let phase = self.phase((-o.dot(i)).clamp(-R::ONE, R::ONE));
        let layer = self.down * (phase * (R::ONE - through) / (i.cos_theta() + o.cos_theta()));
        let base = self.diffuse * (R::of(FRAC_1_PI) * through);
        (layer + base, self.lobes(o).density(i, R::of(0.5 * FRAC_1_PI)))
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        let uniform = LocalDir::new(cosine_lobe::about_z(R::ONE - u.dir[0], u.dir[1]));
        self.lobes(o).pick(u, uniform)
    }
}
