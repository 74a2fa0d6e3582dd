//! The microfacet model in the form the lecture derives: `F S(theta_i) S(theta_o) D / (4 cos theta_i cos theta_o)`.
//!
//! Facets are distributed as `D = cos^s alpha`, alpha between normal and facet normal: `normalized` with the factor
//! `(s+2)/(2 pi)` that makes the facets' projected area one, or `unnormalized` as printed. `masking` chooses S: one; Smith's
//! with the fit for a Gaussian surface of the same curvature at its top [Walter2007, eq. 27]; or V-grooves [Blinn1977].
//! `fresnel` chooses F: exact for a complex index (zero k is a dielectric), or the constant `reflectance`.
//!
//! Limits: single scattering. Smith's term fits narrow distributions: at an exponent of 20 it gains 0.1 % at grazing views, at 5
//! 8 %, at 0 a third. Without masking the value grows without bound towards grazing. The model as it was published
//! is `torrance_sparrow_1967`.

use core::f64::consts::FRAC_1_PI;

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::opaque::{Half, Opaque};
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms, cosine_lobe, fresnel, v_cavity};

/// Which part of a facet is seen and lit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Masking {
    None,
    Smith,
    VCavity,
}

/// Mirror facets distributed as a power of the cosine.
#[derive(Clone, Copy, Debug)]
pub struct TorranceSparrow<R> {
    s: R,
    eta: Spectrum<R>,
    k: Spectrum<R>,
    reflectance: Spectrum<R>,
    normalized: bool,
    masking: Masking,
    exact: bool,
}

impl<R: Real> Model<R> for TorranceSparrow<R> {
    const ABOUT: About = About::new(
        "microfacets as in the lecture: D = cos^s, with choices",
        "TorranceSparrow1967, Blinn1977, Walter2007",
    )
    .lacks(&[
        Lack::energy("without masking the value grows without bound at grazing angles")
            .when(&[("masking", &["none"])]),
        Lack::energy("the masking is that of a Gaussian surface, too open for exponents below 20: up to a third is gained")
            .when(&[("masking", &["smith"])]),
        Lack::energy("the facets have the wrong area").when(&[("distribution", &["unnormalized"])]),
    ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::real("exponent")
            .default(50.0)
            .range(0.0, 1e5)
            .soft(1.0, 100.0)
            .doc("Power s of the cosine; a Gaussian surface of slope width alpha has about 2 / alpha^2 - 2."),
        ParamInfo::unbounded("eta").default(0.2).doc("Real part of the index of refraction."),
        ParamInfo::unbounded("k")
            .default(3.9)
            .doc("Imaginary part of the index of refraction; 0 for dielectrics."),
        ParamInfo::albedo("reflectance").default(1.0).doc("F of every facet where `fresnel` is `constant`."),
        ParamInfo::choice("distribution", &["normalized", "unnormalized"])
            .doc("D with the factor (s+2)/(2 pi), or as printed."),
        ParamInfo::choice("masking", &["smith", "v_cavity", "none"])
            .doc("Which share of a facet is seen and lit."),
        ParamInfo::choice("fresnel", &["exact", "constant"])
            .doc("F from eta and k, or the same at all angles."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let masking = match p.choices[1] {
            0 => Masking::Smith,
            1 => Masking::VCavity,
            _ => Masking::None,
        };
        TorranceSparrow {
            s: p.reals[0],
            eta: p.spectra[0],
            k: p.spectra[1],
            reflectance: p.spectra[2],
            normalized: p.choices[0] == 0,
            masking,
            exact: p.choices[2] == 0,
        }
    }
}

impl<R: Real> TorranceSparrow<R> {
    /// `S(theta) / cos theta`, by a rational fit of Smith's integral. [Walter2007, eq. 27]
    #[inline(always)]
    fn smith_over_cos(&self, w: LocalDir<R>) -> R {
        let mu = w.cos_theta();
        let q = (self.s * R::of(0.5) + R::ONE).sqrt() / w.sin2_theta().sqrt().max(R::of(1e-9));
        let c = q * mu;
        let fit =
            (R::of(3.535) * q + R::of(2.181) * q * c) / (R::ONE + R::of(2.276) * c + R::of(2.577) * c * c);
        R::select(c.lt(R::of(1.6)), fit, R::ONE / mu)
    }

    /// `S(theta_i) S(theta_o) / (4 cos theta_i cos theta_o)`
    #[inline(always)]
    fn masking_over_4cos(&self, o: LocalDir<R>, i: LocalDir<R>, half: &Half<R>) -> R {
        match self.masking {
            Masking::None => R::of(0.25) / (o.cos_theta() * i.cos_theta()),
            Masking::Smith => R::of(0.25) * self.smith_over_cos(o) * self.smith_over_cos(i),
            Masking::VCavity => v_cavity::g_over_4cos(o, i, half),
        }
    }

    #[inline(always)]
    fn fresnel(&self, cos_d: R) -> Spectrum<R> {
        if !self.exact {
            return self.reflectance;
        }
        self.eta.zip(
            self.k,
            #[inline(always)]
            |eta, k| fresnel::conductor(cos_d, eta, k),
        )
    }
}

impl<R: Real> Opaque for TorranceSparrow<R> {
    type R = R;

    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let half = Half::new(o, i);
        let cos_alpha = half.m.cos_theta().min(R::ONE);
        let lobe = cosine_lobe::lobe(cos_alpha, half.m.sin2_theta(), self.s);
        let unit = (self.s + R::of(2.0)) * R::of(0.5 * FRAC_1_PI);
        let D = if self.normalized { unit * lobe } else { lobe };
        let SS = self.masking_over_4cos(o, i, &half);
        let F = self.fresnel(half.cos_d);
        (F * (SS * D), unit * lobe * cos_alpha * half.jacobian())
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        // The density of D cos alpha.
        o.reflect(LocalDir::new(cosine_lobe::sample(u.dir, self.s + R::ONE)))
    }
}
