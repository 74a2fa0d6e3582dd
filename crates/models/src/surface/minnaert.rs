//! Minnaert's law of the moon: diffuse reflection that darkens towards the rim. [Minnaert1941]
//!
//! `f = rho (k + 1) / (2 pi) (cos_o cos_i)^(k - 1)`; k = 1 is Lambert's law. Reciprocal by construction.
//! Limits: isotropic; darkening only. Exponents below one, which brighten the rim, return more than arrives there.

use core::f64::consts::PI;

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::opaque::Opaque;
use crate::{About, Model, ParamBlock, ParamInfo, Uniforms, cosine_lobe};

/// Minnaert's law.
#[derive(Clone, Copy, Debug)]
pub struct Minnaert<R> {
    reflectance: Spectrum<R>,
    k: R,
}

impl<R: Real> Model<R> for Minnaert<R> {
    const ABOUT: About = About::new("the moon: diffuse reflection, darker at the rim", "Minnaert1941");
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("reflectance")
            .default(0.5)
            .doc("Share of light along the normal that is reflected."),
        ParamInfo::real("darkening").default(1.3).range(1.0, 10.0).soft(1.0, 3.0).doc("Exponent k."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        Minnaert { reflectance: p.spectra[0], k: p.reals[0] }
    }
}

impl<R: Real> Opaque for Minnaert<R> {
    type R = R;

    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let norm = (self.k + R::ONE) * R::of(0.5 / PI);
        let rim = cosine_lobe::power(o.cos_theta() * i.cos_theta(), self.k - R::ONE);
        (self.reflectance * (norm * rim), norm * cosine_lobe::power(i.cos_theta(), self.k))
    }

    #[inline(always)]
    fn draw(&self, _: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        LocalDir::new(cosine_lobe::sample(u.dir, self.k))
    }
}
