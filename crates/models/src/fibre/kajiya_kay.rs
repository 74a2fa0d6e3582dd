//! The first model of hair: a thin cylinder, matt all around, with a highlight on the cone of mirror reflection. [KajiyaKay1989]
//!
//! As in lectures, `q = kd cos theta_i + ks cos^s(theta_i + theta_o)`, where the light is multiplied by q itself. Normalised (ours),
//! `S = kd / pi^2 + ks cos^s(theta_i + theta_o) / (2 pi B((s + 3) / 2, 1 / 2))`: the highlight returns `ks` at `theta_o = 0`, less elsewhere.
//!
//! Errata: with both directions pointing away from the fibre, `cos(theta_E - theta_L)` of the paper peaks where the eye is beside the light;
//! `sign literal` does that, `sign physical` puts the highlight on the cone `theta_o = -theta_i`.

use core::f64::consts::{FRAC_1_PI, PI};

use sparrow_math::{LocalDir, Real, Vec3, warp};
use sparrow_spectra::Spectrum;

use crate::bcsdf::weighed;
use crate::cylinder::FibreDir;
use crate::cylinder::longitudinal::Longitudinal;
use crate::microfacet::special::gamma_ratio;
use crate::{About, Bcsdf, BsdfSample, Lack, Model, ParamBlock, ParamInfo, Uniforms, cosine_lobe};

/// A fibre after Kajiya and Kay.
#[derive(Clone, Copy, Debug)]
pub struct KajiyaKay<R> {
    diffuse: Spectrum<R>,
    specular: Spectrum<R>,
    exponent: R,
    form: Form,
    /// `cos(theta_o - theta_i)` instead of `cos(theta_o + theta_i)`.
    literal: bool,
    /// As narrow as the highlight, with the heavier tails.
    around_cone: Longitudinal<R>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Normalised,
    Lecture,
}

impl<R: Real> Model<R> for KajiyaKay<R> {
    const ABOUT: About = About::new("matt fibre with a highlight on the mirror cone", "KajiyaKay1989")
        .anisotropic()
        .transmits()
        .lacks(&[
            Lack::energy("neither term of the lecture's form is normalised").when(&[("form", &["lecture"])]),
            Lack::reciprocity("the lecture's highlight has no cosine of the light")
                .when(&[("form", &["lecture"])]),
        ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("diffuse").default(0.3).doc("Strength of the matt term, kd."),
        ParamInfo::albedo("specular").default(0.3).doc("Strength of the highlight, ks."),
        ParamInfo::real("exponent")
            .default(20.0)
            .range(0.0, 1e4)
            .soft(1.0, 100.0)
            .doc("Exponent s of the highlight."),
        ParamInfo::choice("form", &["normalised", "lecture"]).doc("Normalised, or as in lectures."),
        ParamInfo::choice("sign", &["physical", "literal"])
            .doc("Where the highlight lies: on the mirror cone, or beside the light."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let exponent = p.reals[0];
        KajiyaKay {
            diffuse: p.spectra[0],
            specular: p.spectra[1],
            exponent,
            form: if p.choices[0] == 0 { Form::Normalised } else { Form::Lecture },
            literal: p.choices[1] != 0,
            // cos^s x <= e^(-s (1 - cos x)): weights stay bounded.
            around_cone: Longitudinal::new(R::ONE / exponent.max(R::of(0.1))),
        }
    }
}

/// `1 / (2 pi B((s + 3) / 2, 1 / 2))`, `s >= 0`.
#[inline(always)]
fn highlight_scale<R: Real>(s: R) -> R {
    // B(x, 1/2) = sqrt(pi) Gamma(x) / Gamma(x + 1/2)
    let x = (s + R::of(3.0)) * R::of(0.5);
    R::of(0.5 * FRAC_1_PI / 1.772_453_850_905_516) / gamma_ratio(x + R::of(0.5))
}

impl<R: Real> KajiyaKay<R> {
    /// Sine and cosine of the viewer's inclination, turned over where the highlight lies beside the light.
    #[inline(always)]
    fn seen(&self, o: &FibreDir<R>) -> [R; 2] {
        [if self.literal { -o.sin } else { o.sin }, o.cos]
    }
    /// Probability of the matt lobe.
    #[inline(always)]
    fn matt(&self) -> R {
        let (d, s) = (self.diffuse.max_value(), self.specular.max_value());
        let some = (d + s).gt(R::ZERO);
        R::select(some, d / R::select(some, d + s, R::ONE), R::of(0.5)).max(R::of(0.1))
    }
}

impl<R: Real> Bcsdf<R> for KajiyaKay<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let (o, i) = (FibreDir::new(wo), FibreDir::new(wi));
        let theta_o = self.seen(&o);
        // cos and sin^2 of theta_i + theta_o
        let cos = i.cos * theta_o[1] - i.sin * theta_o[0];
        let sin = i.sin * theta_o[1] + i.cos * theta_o[0];
        let highlight = cosine_lobe::lobe(cos.min(R::ONE), sin.sqr(), self.exponent);
        let q = match self.form {
            Form::Lecture => self.diffuse * i.cos + self.specular * highlight,
            Form::Normalised => {
                let scale = highlight_scale(self.exponent) * i.cos;
                self.diffuse * (R::of(FRAC_1_PI * FRAC_1_PI) * i.cos) + self.specular * (highlight * scale)
            }
        };
        let matt = self.matt();
        let cone = self.around_cone.value([i.sin, i.cos], theta_o) * R::of(0.5 * FRAC_1_PI);
        (q, matt * R::of(0.25 * FRAC_1_PI) + (R::ONE - matt) * cone)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let o = FibreDir::new(wo);
        let matt = self.matt();
        let is_matt = u.lobe.lt(matt);
        let left = ((u.lobe - matt) / (R::ONE - matt).max(R::of(1e-30))).clamp(R::ZERO, R::ONE);
        let around = o.turned(self.around_cone.sample(self.seen(&o), u.dir), R::of(2.0 * PI) * left);
        let anywhere = warp::uniform_sphere(u.dir);
        let wi = LocalDir::new(Vec3::select(is_matt, anywhere, around.v()));
        weighed(self, wo, wi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_that_of_the_beta_function() {
        // 1 / (2 pi B((s + 3) / 2, 1 / 2)) for whole (s + 3) / 2: B(2, 1/2) = 4 / 3, B(3, 1/2) = 16 / 15.
        for (s, beta) in [(1.0_f64, 4.0 / 3.0), (3.0, 16.0 / 15.0), (0.0, PI / 2.0)] {
            let want = 1.0 / (2.0 * PI * beta);
            assert!((highlight_scale(s) / want - 1.0).abs() < 1e-9, "{s}: {} {want}", highlight_scale(s));
        }
    }
}
