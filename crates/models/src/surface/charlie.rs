//! Charlie sheen: cloth of upright fibres that shines where one looks along it. [ContyKulla2017]
//!
//! `f = F D G / (4 cos theta_o cos theta_i)` with a power of the sine for D and Smith's masking `G = 1 / (1 + Lambda_o +
//! Lambda_i)`. `terminator "soft"` raises the light's Lambda to `1 + 2 (1 - cos theta_i)^8`, which takes the hard edge off
//! the shadow and is not reciprocal. Directions are drawn evenly: half vectors of this D mostly send light below.
//! Limits: single scattering, no base. White fibres return 0.04 of the light at normal incidence and 0.8 at grazing
//! incidence (r = 0.3); `sheen` is a model of the same thing with a base's share that is known.

use core::f64::consts::FRAC_1_PI;

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::microfacet::charlie;
use crate::opaque::{Half, Opaque};
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms, cosine_lobe};

/// Upright fibres as facets.
#[derive(Clone, Copy, Debug)]
pub struct Charlie<R> {
    color: Spectrum<R>,
    r: R,
    soft: bool,
}

impl<R: Real> Model<R> for Charlie<R> {
    const ABOUT: About = About::new("sheen of cloth: fibres as facets that lie flat", "ContyKulla2017")
        .lacks(&[Lack::reciprocity("treats the light's masking differently from the viewer's")
            .when(&[("terminator", &["soft"])])]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("color").default(0.5).doc("Share of the light that a fibre reflects, F."),
        ParamInfo::real("roughness")
            .default(0.3)
            .range(0.07, 1.0)
            .soft(0.1, 1.0)
            .doc("Width r of the sheen: narrow along the horizon, or spread upwards."),
        ParamInfo::choice("terminator", &["hard", "soft"])
            .doc("Edge of the shadow: as Smith's masking has it, or softened."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        Charlie { color: p.spectra[0], r: p.reals[0].max(R::of(0.07)), soft: p.choices[0] == 1 }
    }
}

impl<R: Real> Opaque for Charlie<R> {
    type R = R;

    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let (mu_o, mu_i) = (o.cos_theta().min(R::ONE), i.cos_theta().min(R::ONE));
        let D = charlie::d(Half::new(o, i).m, self.r);
        let Lambda_o = charlie::lambda(mu_o, self.r);
        let Lambda_i = charlie::lambda(mu_i, self.r);
        let Lambda_i = if self.soft { Lambda_i.pow(charlie::softening(mu_i)) } else { Lambda_i };
        let G = R::ONE / (R::ONE + Lambda_o + Lambda_i);
        let F = self.color;
        (F * (D * G / (R::of(4.0) * mu_o * mu_i)), R::of(0.5 * FRAC_1_PI))
    }

    #[inline(always)]
    fn draw(&self, _: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        LocalDir::new(cosine_lobe::about_z(R::ONE - u.dir[0], u.dir[1]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Bsdf;

    fn white(r: f64, soft: bool) -> Charlie<f64> {
        Charlie { color: Spectrum::ONE, r, soft }
    }

    #[test]
    fn no_white_sheen_returns_more_than_it_got() {
        // The largest albedo is at grazing views; points crowd there for the light, too.
        for soft in [false, true] {
            for r in [0.07, 0.1, 0.3, 0.6, 1.0] {
                for mu in [1e-4, 1e-3, 0.01, 0.03, 0.1, 0.5] {
                    let o = LocalDir::from_angles(Real::acos(mu), 0.0);
                    let n = 240;
                    let mut sum = 0.0;
                    for k in 0..n * n {
                        let x = (f64::from(k % n) + 0.5) / f64::from(n);
                        let phi = core::f64::consts::PI * (f64::from(k / n) + 0.5) / f64::from(n);
                        let i = LocalDir::from_angles(Real::acos(x * x), phi);
                        sum += white(r, soft).f_cos(o, i)[0] * 2.0 * x * core::f64::consts::TAU;
                    }
                    let e = sum / f64::from(n * n);
                    assert!(e < 1.0, "r {r}, cosine {mu}, soft {soft}: {e}");
                }
            }
        }
    }

    #[test]
    fn softening_changes_the_light_near_the_horizon_alone() {
        let (a, b) = (white(0.4, false), white(0.4, true));
        let at = |deg: f64, phi| LocalDir::from_angles(deg.to_radians(), phi);
        let high = (a.f(at(60.0, 0.0), at(20.0, 1.0))[0], b.f(at(60.0, 0.0), at(20.0, 1.0))[0]);
        assert!((high.0 - high.1).abs() < 1e-6 * high.0, "{high:?}");
        let low = (a.f(at(60.0, 0.0), at(85.0, 1.0))[0], b.f(at(60.0, 0.0), at(85.0, 1.0))[0]);
        assert!(low.1 < 0.5 * low.0, "{low:?}");
    }
}
