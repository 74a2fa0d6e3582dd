//! A thin pane of glass: reflection and straight transmission, with all orders of reflection inside summed.
//!
//! With `R` and `T = 1 - R` of one boundary the pane reflects `R + T^2 R / (1 - R^2)`, the sum of the geometric series.

use sparrow_math::{LocalDir, Mask, Real, Vec3};
use sparrow_spectra::Spectrum;

use crate::{About, Bsdf, BsdfSample, Model, ParamBlock, ParamInfo, Uniforms, fresnel};

/// A pane so thin that the ray leaves where it entered.
#[derive(Clone, Copy, Debug)]
pub struct ThinDielectric<R> {
    eta: R,
}

impl<R: Real> Model<R> for ThinDielectric<R> {
    const ABOUT: About =
        About::new("a thin pane: reflection and straight transmission", "Hecht2002").transmits();
    const PARAMS: &'static [ParamInfo] = &[ParamInfo::real("eta")
        .default(1.5)
        .range(0.1, 10.0)
        .soft(1.0, 2.5)
        .doc("Index of refraction of the pane, over that of its surroundings.")];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        ThinDielectric { eta: p.reals[0] }
    }
}

impl<R: Real> Bsdf<R> for ThinDielectric<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, _wo: LocalDir<R>, _wi: LocalDir<R>) -> (Spectrum<R>, R) {
        (Spectrum::ZERO, R::ZERO)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let (boundary, _) = fresnel::dielectric(wo.abs_cos_theta().min(R::ONE), self.eta);
        let t = R::ONE - boundary;
        let partial = boundary + t * t * boundary / (R::ONE - boundary * boundary).max(R::of(1e-12));
        let reflectance = R::select(boundary.lt(R::ONE), partial, R::ONE);
        let reflects = u.lobe.lt(reflectance);
        let density = R::select(reflects, reflectance, R::ONE - reflectance);
        let v = wo.v();
        let valid = density.gt(R::ZERO) & v.z.abs().gt(R::ZERO);
        BsdfSample {
            wi: LocalDir::new(Vec3 { x: -v.x, y: -v.y, z: R::select(reflects, v.z, -v.z) }),
            weight: Spectrum::ONE.only_where(valid),
            density: density.only_where(valid),
            eta: R::ONE,
            delta: R::Mask::of(true),
            valid,
        }
    }

    #[inline(always)]
    fn has_smooth_lobe(&self) -> R::Mask {
        R::Mask::of(false)
    }
}
