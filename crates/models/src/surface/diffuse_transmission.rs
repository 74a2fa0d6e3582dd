//! Diffuse reflection and diffuse transmission: a thin sheet that scatters light equally to each side.
//!
//! Lossless where reflectance and transmittance sum to one; where they sum to more, it makes light, as the file asked.

use sparrow_math::{LocalDir, Mask, Real, Vec3, warp};
use sparrow_spectra::Spectrum;

use crate::{About, Bsdf, BsdfSample, Model, ParamBlock, ParamInfo, Uniforms};

/// Lambert's law on both sides, with a reflectance and a transmittance.
#[derive(Clone, Copy, Debug)]
pub struct DiffuseTransmission<R> {
    reflectance: Spectrum<R>,
    transmittance: Spectrum<R>,
}

impl<R: Real> Model<R> for DiffuseTransmission<R> {
    const ABOUT: About =
        About::new("diffuse reflection and transmission of a thin sheet", "Lambert1760").transmits();
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("reflectance").default(0.25).doc("Share of the light that is reflected."),
        ParamInfo::albedo("transmittance").default(0.25).doc("Share of the light that passes through."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        DiffuseTransmission { reflectance: p.spectra[0], transmittance: p.spectra[1] }
    }
}

impl<R: Real> DiffuseTransmission<R> {
    /// Probability of choosing reflection: its share of the larger components.
    #[inline(always)]
    fn reflect_probability(&self) -> R {
        let (r, t) = (self.reflectance.max_value(), self.transmittance.max_value());
        let sum = r + t;
        R::select(sum.gt(R::ZERO), r / R::select(sum.gt(R::ZERO), sum, R::ONE), R::of(0.5))
    }
}

impl<R: Real> Bsdf<R> for DiffuseTransmission<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let reflects = wo.same_side(wi);
        let p = self.reflect_probability();
        let diffuse = warp::cosine_hemisphere_pdf(wi.abs_cos_theta());
        let albedo = Spectrum::select(reflects, self.reflectance, self.transmittance);
        (albedo * diffuse, R::select(reflects, p, R::ONE - p) * diffuse)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let p = self.reflect_probability();
        let reflects = u.lobe.lt(p);
        let up = LocalDir::new(warp::cosine_hemisphere(u.dir)).flip_to(wo);
        let wi = LocalDir::new(Vec3 { z: R::select(reflects, up.z(), -up.z()), ..up.v() });
        let chosen = R::select(reflects, p, R::ONE - p);
        let density = chosen * warp::cosine_hemisphere_pdf(wi.abs_cos_theta());
        BsdfSample {
            wi,
            weight: Spectrum::select(reflects, self.reflectance, self.transmittance)
                / chosen.max(R::of(1e-20)),
            density,
            eta: R::ONE,
            delta: R::Mask::of(false),
            valid: density.gt(R::ZERO),
        }
    }
}
