//! The model of 1982: `f = d rho / pi + s F D G / (pi cos theta_i cos theta_o)`. [CookTorrance1982]
//!
//! D is Beckmann's distribution with the rms slope m (`alpha`), G that of V-grooves. s is `specular`, d = 1 - s.
//!
//! `form` is `printed` or `normalized`.
//! Errata: the paper divides by pi where 4 is right, and prints Beckmann's distribution without the 1/pi that makes the facets'
//! projected area one. Together the printed lobe is four times too strong; `normalized` has both right.

use core::f64::consts::{FRAC_1_PI, PI};

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_spectra::Spectrum;

use crate::opaque::{Half, Opaque, TwoLobes, exp_neg};
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms, fresnel, v_cavity};

/// Narrowest slope width the formulas are evaluated with.
const ALPHA_MIN: f64 = 1e-3;

/// Beckmann facets in V-grooves over a diffuse base.
#[derive(Clone, Copy, Debug)]
pub struct CookTorrance<R> {
    alpha: R,
    s: R,
    eta: Spectrum<R>,
    k: Spectrum<R>,
    diffuse: Spectrum<R>,
    printed: bool,
}

impl<R: Real> Model<R> for CookTorrance<R> {
    const ABOUT: About =
        About::new("Beckmann facets in V-grooves, as printed or put right", "CookTorrance1982").lacks(&[
            Lack::energy("the printed lobe is four times too strong").when(&[("form", &["printed"])]),
        ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::real("alpha").default(0.3).soft(0.01, 0.7).doc("Root mean square slope m of the facets."),
        ParamInfo::real("specular").default(1.0).doc("Share s of the facets; the diffuse base has 1 - s."),
        ParamInfo::unbounded("eta").default(0.2).doc("Real part of the index of refraction."),
        ParamInfo::unbounded("k")
            .default(3.9)
            .doc("Imaginary part of the index of refraction; 0 for dielectrics."),
        ParamInfo::albedo("diffuse").default(0.5).doc("Reflectance of the diffuse base."),
        ParamInfo::choice("form", &["normalized", "printed"])
            .doc("With 4 and a normalised D, or as printed."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        CookTorrance {
            alpha: p.reals[0].max(R::of(ALPHA_MIN)),
            s: p.reals[1],
            eta: p.spectra[0],
            k: p.spectra[1],
            diffuse: p.spectra[2],
            printed: p.choices[0] == 1,
        }
    }
}

impl<R: Real> CookTorrance<R> {
    #[inline(always)]
    fn fresnel(&self, cos_d: R) -> Spectrum<R> {
        self.eta.zip(
            self.k,
            #[inline(always)]
            |eta, k| fresnel::conductor(cos_d, eta, k),
        )
    }
    /// `exp(-tan^2 alpha / m^2) / (m^2 cos^4 alpha)`, as printed: pi times the normalised distribution.
    #[inline(always)]
    fn beckmann(&self, m: LocalDir<R>) -> R {
        let cos2 = m.cos_theta().sqr().max(R::of(1e-9));
        let a2 = self.alpha.sqr();
        exp_neg(m.sin2_theta() / (cos2 * a2)) / (a2 * cos2 * cos2)
    }
    #[inline(always)]
    fn lobes(&self, o: LocalDir<R>) -> TwoLobes<R> {
        let glossy = self.fresnel(o.cos_theta().min(R::ONE)) * self.s;
        TwoLobes::new(self.diffuse * (R::ONE - self.s), glossy)
    }
}

impl<R: Real> Opaque for CookTorrance<R> {
    type R = R;

    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let half = Half::new(o, i);
        let D = self.beckmann(half.m);
        let G = v_cavity::g_over_4cos(o, i, &half);
        let F = self.fresnel(half.cos_d);
        // G comes over 4 cos cos; as printed it is to be over pi cos cos, with D as it stands.
        let factor = if self.printed { R::of(4.0 * FRAC_1_PI) } else { R::of(FRAC_1_PI) };
        let d = self.diffuse * (R::ONE - self.s);
        let f = F * (self.s * factor * D * G) + d * R::of(FRAC_1_PI);
        let pdf_m = D * R::of(FRAC_1_PI) * half.m.cos_theta();
        (f, self.lobes(o).density(i, pdf_m * half.jacobian()))
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        let tan2 = -self.alpha.sqr() * (R::ONE - u.dir[0]).max(R::of(1e-30)).ln();
        // The sine by the tangent: by a cosine that rounds to one, narrow lobes would be drawn in steps.
        let cos = R::ONE / (R::ONE + tan2).sqrt();
        let sin = tan2.safe_sqrt() * cos;
        let (s, c) = (R::of(2.0 * PI) * u.dir[1]).sin_cos();
        self.lobes(o).pick(u, o.reflect(LocalDir::new(vec3(sin * c, sin * s, cos))))
    }
}
