//! The energy-conserving hair model of d'Eon et al.: the far field of a rough dielectric cylinder. [dEon2011]
//!
//! `q = sum_p M_p(theta_i, theta_o + shift_p) N_p(theta_d; phi)`, with `N_p` the mean over the width of `A_p` and a wrapped Gaussian
//! (`cylinder::far_field`). The light inside goes by the difference angle `theta_d = (theta_o - theta_i) / 2`, as in the paper.
//! What is reflected inside more than once, which the paper leaves out, leaves evenly around the fibre.
//!
//! Errata: the paper inherits the attenuation `e^(-2 sigma (1 + cos 2 gamma_t))`; ours has the chord `2 cos gamma_t`.

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::bcsdf::weighed;
use crate::cylinder::far_field::{Around, FarField, SEGMENTS};
use crate::cylinder::gaussian::{GaussianLobes, WIDTHS};
use crate::cylinder::{FibreDir, LobeChoice};
use crate::{About, Bcsdf, BsdfSample, Lack, Model, N_LOBES, ParamBlock, ParamInfo, Uniforms};

/// Segments that serve to choose a lobe.
const FEW: usize = 8;

/// A fibre after d'Eon et al.
#[derive(Clone, Copy, Debug)]
pub struct DEon<R> {
    sigma_a: Spectrum<R>,
    eta: R,
    lobes: GaussianLobes<R>,
}

impl<R: Real> Model<R> for DEon<R> {
    const ABOUT: About = About::new("energy-conserving hair, far field", "dEon2011, dEon2013")
        .anisotropic()
        .transmits()
        .lacks(&[
            Lack::reciprocity("the tilt of the scales is that of the viewer's inclination alone"),
            Lack::energy(
                "lobes of different widths see different angles inside: their shares do not add up to one",
            ),
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
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        DEon {
            sigma_a: p.spectra[0],
            eta: p.reals[0],
            lobes: GaussianLobes::new(p.reals[1], p.reals[2], p.reals[3]),
        }
    }
}

impl<R: Real> DEon<R> {
    #[inline(always)]
    fn far_field(&self, theta: [R; 2]) -> FarField<R> {
        FarField { theta, eta: self.eta, sigma_a: self.sigma_a }
    }
    /// Probabilities of the lobes, which the viewer's inclination decides.
    #[inline(always)]
    fn chances(&self, o: &FibreDir<R>) -> [Spectrum<R>; N_LOBES] {
        self.far_field([o.sin, o.cos]).shares(FEW)
    }
}

impl<R: Real> Bcsdf<R> for DEon<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let (o, i) = (FibreDir::new(wo), FibreDir::new(wi));
        let far = self.far_field(o.difference(&i));
        let Around { n, shares: whole } = far.around(o.azimuth_to(&i), &self.lobes.azimuthal, SEGMENTS);
        let m = self.lobes.longitudinal(&o, &i);
        let q = (n[0] * m[0] + n[1] * m[1]) + (n[2] * m[2] + n[3] * m[3]);
        // N_p over its integral is the density around the fibre.
        let chance = self.chances(&o);
        let (mut pdf, mut sum) = (R::ZERO, R::ZERO);
        for p in 0..N_LOBES {
            let c = chance[p].average();
            pdf = pdf + c * m[p] * n[p].average() / whole[p].average().max(R::of(1e-30));
            sum = sum + c;
        }
        (q, pdf / sum.max(R::of(1e-30)))
    }

    #[inline(always)]
    fn lobes(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> [Spectrum<R>; N_LOBES] {
        let (o, i) = (FibreDir::new(wo), FibreDir::new(wi));
        let far = self.far_field(o.difference(&i));
        let n = far.around(o.azimuth_to(&i), &self.lobes.azimuthal, SEGMENTS).n;
        let m = self.lobes.longitudinal(&o, &i);
        [n[0] * m[0], n[1] * m[1], n[2] * m[2], n[3] * m[3]]
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let o = FibreDir::new(wo);
        let lobe = LobeChoice::of(u.lobe, &self.chances(&o));
        // The inclination comes first, since the light inside goes by it: its second number is of fine grain.
        let [coarse, fine] = split(u.dir[1]);
        let sin = self.lobes.draw_inclination(&o, &lobe, [u.dir[0], coarse]);
        let i = FibreDir::new(o.turned(sin, R::ZERO));
        let [exit, _] = self.far_field(o.difference(&i)).draw(
            #[inline(always)]
            |v| lobe.pick(v),
            lobe.left,
            SEGMENTS,
        );
        weighed(self, wo, o.turned(sin, exit + self.lobes.draw_turn(&lobe, fine)))
    }
}

/// One uniform number as two: one of 256 steps, and what is left.
#[inline(always)]
fn split<R: Real>(u: R) -> [R; 2] {
    let scaled = u * R::of(256.0);
    let whole = (scaled - R::of(0.5)).round().clamp(R::ZERO, R::of(255.0));
    [(whole + R::of(0.5)) * R::of(1.0 / 256.0), (scaled - whole).clamp(R::ZERO, R::ONE)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_split_number_is_whole_again() {
        for u in [0.0, 0.1, 0.5, 0.999_f64] {
            let [a, b] = split(u);
            assert!((a + (b - 0.5) / 256.0 - u).abs() < 1e-12 && (0.0..=1.0).contains(&b));
        }
    }
}
