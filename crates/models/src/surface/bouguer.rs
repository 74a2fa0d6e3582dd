//! Bouguer's idea that a matt surface is made of small mirrors, taken as far as it goes. [Bouguer1760]
//!
//! Mirror facets distributed as `D = (4 / pi) cos 2 alpha` up to 45 degrees. With F = G = 1 this is the one distribution whose
//! value is exactly `1 / pi` for light at normal incidence, and it is normalised. At any other incidence it is not constant:
//! at 60 degrees four times that in the mirror direction, nothing back towards the light. No distribution of single mirror
//! reflections can do better than half right, since D would have to equal `4 cos theta_i cos theta_o / pi` for every pair
//! with one half vector; whiteness takes several reflections, or light from within.
//!
//! `masking` is `none`, as the argument goes, or that of V-grooves, which keeps the light below one.

use core::f64::consts::{FRAC_1_PI, PI};

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_spectra::Spectrum;

use crate::opaque::{Half, Opaque};
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms, v_cavity};

/// Mirrors that look matt under a lamp at the zenith.
#[derive(Clone, Copy, Debug)]
pub struct Bouguer<R> {
    reflectance: Spectrum<R>,
    masked: bool,
}

impl<R: Real> Model<R> for Bouguer<R> {
    const ABOUT: About = About::new("mirror facets that are matt at normal incidence", "Bouguer1760")
        .lacks(&[Lack::energy("facets turned away are counted; above one beyond 70 degrees")
            .when(&[("masking", &["none"])])]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("reflectance").default(0.8).doc("Share of the light that a facet reflects."),
        ParamInfo::choice("masking", &["none", "v_cavity"]).doc("Which share of a facet is seen and lit."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        Bouguer { reflectance: p.spectra[0], masked: p.choices[0] == 1 }
    }
}

impl<R: Real> Opaque for Bouguer<R> {
    type R = R;

    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let half = Half::new(o, i);
        // cos 2 alpha, by squares that keep their digits near 45 degrees as well.
        let cos_2alpha = half.m.cos_theta().sqr() - half.m.sin2_theta();
        let D = R::of(4.0 * FRAC_1_PI) * cos_2alpha.max(R::ZERO);
        let G = if self.masked {
            v_cavity::g_over_4cos(o, i, &half)
        } else {
            R::of(0.25) / (o.cos_theta() * i.cos_theta())
        };
        (self.reflectance * (D * G), D * half.m.cos_theta() * half.jacobian())
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        // The integral of D cos alpha is sin^2 2 alpha.
        let cos_2alpha = (R::ONE - u.dir[0]).safe_sqrt();
        let cos = ((R::ONE + cos_2alpha) * R::of(0.5)).sqrt();
        let sin = (u.dir[0] * R::of(0.5) / (R::ONE + cos_2alpha)).sqrt();
        let (s, c) = (R::of(2.0 * PI) * u.dir[1]).sin_cos();
        o.reflect(LocalDir::new(vec3(sin * c, sin * s, cos)))
    }
}
