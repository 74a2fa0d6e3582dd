//! Banks's shading of curves, whose normals fill a plane, with the cosine of the fibre. [Banks1994]
//!
//! `q = kd cos^p theta_i + ks max(0, cos(theta_i + theta_o))^n`: the light nearest to the eye among all normals decides. p, about 4.8,
//! makes up for the excess of brightness of a line's diffuse term. On surfaces of threads see `banks`.
//! Limits: a rule for shading; neither reciprocal nor bound in energy.

use core::f64::consts::{FRAC_1_PI, PI};

use sparrow_math::{LocalDir, Real, Vec3, warp};
use sparrow_spectra::Spectrum;

use crate::bcsdf::weighed;
use crate::cylinder::FibreDir;
use crate::cylinder::longitudinal::Longitudinal;
use crate::{About, Bcsdf, BsdfSample, Lack, Model, ParamBlock, ParamInfo, Uniforms, cosine_lobe};

/// A curve after Banks.
#[derive(Clone, Copy, Debug)]
pub struct BanksFibre<R> {
    diffuse: Spectrum<R>,
    specular: Spectrum<R>,
    n: R,
    p: R,
    /// As narrow as the highlight, with the heavier tails.
    around_cone: Longitudinal<R>,
}

impl<R: Real> Model<R> for BanksFibre<R> {
    const ABOUT: About = About::new("a curve, shaded by the best of its normals", "Banks1994")
        .anisotropic()
        .transmits()
        .lacks(&[
            Lack::energy("no term has a normalisation"),
            Lack::reciprocity("the diffuse term knows the light's direction alone"),
        ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("diffuse").default(0.3).doc("Strength of the diffuse term, kd."),
        ParamInfo::albedo("specular").default(0.3).doc("Strength of the highlight, ks."),
        ParamInfo::real("exponent")
            .default(20.0)
            .range(0.0, 1e4)
            .soft(1.0, 100.0)
            .doc("Exponent n of the highlight."),
        ParamInfo::real("excess")
            .default(4.8)
            .range(0.0, 100.0)
            .soft(1.0, 10.0)
            .doc("Exponent p of the diffuse term."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let n = p.reals[0];
        BanksFibre {
            diffuse: p.spectra[0],
            specular: p.spectra[1],
            n,
            p: p.reals[1],
            around_cone: Longitudinal::new(R::ONE / n.max(R::of(0.1))),
        }
    }
}

impl<R: Real> Bcsdf<R> for BanksFibre<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let (o, i) = (FibreDir::new(wo), FibreDir::new(wi));
        let cos = (i.cos * o.cos - i.sin * o.sin).min(R::ONE);
        let sin = i.sin * o.cos + i.cos * o.sin;
        let diffuse = cosine_lobe::lobe(i.cos.min(R::ONE), i.sin.sqr(), self.p);
        let highlight = cosine_lobe::lobe(cos, sin.sqr(), self.n);
        let cone = self.around_cone.value([i.sin, i.cos], [o.sin, o.cos]);
        let pdf = R::of(0.125 * FRAC_1_PI) + R::of(0.25 * FRAC_1_PI) * cone;
        (self.diffuse * diffuse + self.specular * highlight, pdf)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let o = FibreDir::new(wo);
        let twice = u.lobe + u.lobe;
        let around =
            o.turned(self.around_cone.sample([o.sin, o.cos], u.dir), R::of(2.0 * PI) * (twice - R::ONE));
        let anywhere = warp::uniform_sphere(u.dir);
        weighed(self, wo, LocalDir::new(Vec3::select(twice.lt(R::ONE), anywhere, around.v())))
    }
}
