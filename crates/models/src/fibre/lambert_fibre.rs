//! A fibre whose surface is matt. [Marschner2003] speaks of it as the diffuse component; the law is [Lambert1760].
//!
//! Near field: `S cos theta_i = rho / pi max(0, n.i)` at the normal n that the ray met. Far field, the mean over the fibre's width:
//! `S = rho ((pi - |phi|) cos phi + sin |phi|) / (4 pi)`.

use core::f64::consts::FRAC_1_PI;

use sparrow_math::{LocalDir, Real, Vec3, vec3, warp};
use sparrow_spectra::Spectrum;

use crate::bcsdf::weighed;
use crate::cylinder::FibreDir;
use crate::{About, Bcsdf, BsdfSample, Lack, Model, ParamBlock, ParamInfo, Uniforms};

/// A matt cylinder.
#[derive(Clone, Copy, Debug)]
pub struct LambertFibre<R> {
    reflectance: Spectrum<R>,
    h: R,
    far: bool,
}

impl<R: Real> Model<R> for LambertFibre<R> {
    const ABOUT: About = About::new("matt cylinder", "Lambert1760, Marschner2003")
        .anisotropic()
        .transmits()
        .lacks(&[Lack::reciprocity("the ray met one normal, which another viewer does not share")
            .when(&[("field", &["near"])])]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("reflectance").default(0.5).doc("Share of the light that is reflected."),
        ParamInfo::choice("field", &["near", "far"])
            .doc("Where the ray met the fibre, or the mean over its width."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        LambertFibre { reflectance: p.spectra[0], h: p.h, far: p.choices[0] != 0 }
    }
}

/// `((pi - |phi|) cos phi + sin |phi|) / 8`, which integrates to 1 over the azimuth; from cosine and sine.
#[inline(always)]
fn azimuthal<R: Real>([cos, sin]: [R; 2]) -> R {
    let sin = sin.abs();
    // Backlit, both terms cancel; their difference falls with the third power.
    ((sin.atan2(-cos) * cos + sin) * R::of(0.125)).max(R::ZERO)
}

/// The normal of the offset `h`: `asin h` before the viewer's azimuth.
#[inline(always)]
fn normal<R: Real>(o: &FibreDir<R>, h: R) -> [R; 2] {
    let (cos, [c, s]) = (((R::ONE - h) * (R::ONE + h)).safe_sqrt(), o.across);
    [c * cos + s * h, s * cos - c * h]
}

impl<R: Real> Bcsdf<R> for LambertFibre<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let (o, i) = (FibreDir::new(wo), FibreDir::new(wi));
        let pdf = if self.far {
            azimuthal(o.turn_to(&i)) * i.cos * R::of(2.0 * FRAC_1_PI)
        } else {
            let [y, z] = normal(&o, self.h);
            (y * wi.y() + z * wi.z()).max(R::ZERO) * R::of(FRAC_1_PI)
        };
        (self.reflectance * pdf, pdf)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let o = FibreDir::new(wo);
        let h = if self.far { u.lobe + u.lobe - R::ONE } else { self.h };
        let [y, z] = normal(&o, h);
        let d = warp::cosine_hemisphere(u.dir);
        let wi: Vec3<R> = vec3(d.x, y * d.z - z * d.y, z * d.z + y * d.y);
        weighed(self, wo, LocalDir::new(wi))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backlight_falls_with_the_third_power() {
        let x = 1e-3;
        let n = azimuthal([-Real::cos(x), Real::sin(x)]);
        assert!((n / (x * x * x / 24.0) - 1.0).abs() < 1e-5, "{n}");
    }
}
