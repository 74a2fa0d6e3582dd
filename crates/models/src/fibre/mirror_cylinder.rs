//! A smooth mirror in the shape of a fibre: parallel light leaves on a cone, `theta_o = -theta_i`. [Marschner2003]
//!
//! Near field: one direction, mirrored about the normal that the ray met. Far field: the cone, with `N(phi) = cos(phi / 2) / 4`.
//! Both are deltas, the second in one dimension: only sampling finds them.

use sparrow_math::{LocalDir, Mask, Real};
use sparrow_spectra::Spectrum;

use crate::cylinder::FibreDir;
use crate::cylinder::azimuthal::exit_azimuth;
use crate::{About, Bcsdf, BsdfSample, Model, ParamBlock, ParamInfo, Uniforms};

/// A smooth mirror cylinder.
#[derive(Clone, Copy, Debug)]
pub struct MirrorCylinder<R> {
    reflectance: Spectrum<R>,
    h: R,
    far: bool,
}

impl<R: Real> Model<R> for MirrorCylinder<R> {
    const ABOUT: About =
        About::new("smooth mirror cylinder: the cone", "Marschner2003").anisotropic().transmits();
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("reflectance").default(1.0).doc("Share of the light that is reflected."),
        ParamInfo::choice("field", &["near", "far"])
            .doc("Where the ray met the fibre, or the mean over its width."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        MirrorCylinder { reflectance: p.spectra[0], h: p.h, far: p.choices[0] != 0 }
    }
}

impl<R: Real> Bcsdf<R> for MirrorCylinder<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, _wo: LocalDir<R>, _wi: LocalDir<R>) -> (Spectrum<R>, R) {
        (Spectrum::ZERO, R::ZERO)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let o = FibreDir::new(wo);
        let h = if self.far { u.dir[0] + u.dir[0] - R::ONE } else { self.h };
        BsdfSample {
            wi: o.turned(-o.sin, exit_azimuth(0, h.asin(), R::ZERO)),
            weight: self.reflectance,
            density: R::ONE,
            eta: R::ONE,
            delta: R::Mask::of(true),
            valid: R::Mask::of(true),
        }
    }

    #[inline(always)]
    fn has_smooth_lobe(&self) -> R::Mask {
        R::Mask::of(false)
    }
}
