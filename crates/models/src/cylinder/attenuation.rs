//! What is left of the light on its way through a cylinder.

use sparrow_math::Real;
use sparrow_spectra::Spectrum;

use crate::{N_LOBES, fresnel};

/// The refracted ray inside a cylinder, seen along the axis and from the side.
#[derive(Clone, Copy, Debug)]
pub struct Inside<R> {
    /// Sine and cosine of `gamma_t`, the azimuth of the refracted ray from the inward normal.
    pub gamma_t: [R; 2],
    /// `1 / eta'`
    pub over_eta: R,
    /// Length of one passage, in radii.
    pub length: R,
    /// Fresnel reflectance of the surface.
    pub fresnel: R,
}

impl<R: Real> Inside<R> {
    /// Of a ray with that inclination and offset `h` in [-1, 1]; `eta >= 1`.
    ///
    /// Seen along the axis, the index is `eta' = sqrt(eta^2 - sin^2 theta) / cos theta` (Bravais), so that
    /// `sin gamma_t = h / eta'`. [Marschner2003, appendix B]
    #[inline(always)]
    pub fn new([sin, cos]: [R; 2], h: R, eta: R) -> Self {
        // eta cos theta_t
        let across = ((eta - sin) * (eta + sin)).safe_sqrt().max(R::of(1e-15));
        let over_eta = cos / across;
        let sin_gamma = (h * over_eta).clamp(-R::ONE, R::ONE);
        let cos_gamma = ((R::ONE - sin_gamma) * (R::ONE + sin_gamma)).sqrt();
        // [Marschner2003] prints twice the angle where the chord of a circle has the angle.
        let length = R::of(2.0) * cos_gamma * eta / across;
        let cos_i = cos * ((R::ONE - h) * (R::ONE + h)).safe_sqrt();
        Inside {
            gamma_t: [sin_gamma, cos_gamma],
            over_eta,
            length,
            fresnel: fresnel::dielectric(cos_i, eta).0,
        }
    }
    /// `gamma_t`
    #[inline(always)]
    pub fn angle(&self) -> R {
        self.gamma_t[0].atan2(self.gamma_t[1])
    }
    /// The shares `A_p` of every lobe, the last for all that follow: `F`, `(1-F)^2 T`, `(1-F)^2 F T^2`,
    /// `(1-F)^2 F^2 T^3 / (1 - F T)`, with `T = e^(-sigma_a length)`. Their sum is 1 where nothing is absorbed.
    /// [Chiang2016, eq. 12, 13]
    #[inline(always)]
    pub fn attenuation(&self, sigma_a: Spectrum<R>) -> [Spectrum<R>; N_LOBES] {
        let f = self.fresnel;
        let t = sigma_a.map(
            #[inline(always)]
            |sigma| (-sigma * self.length).exp_coarse(),
        );
        let tt = t * (R::ONE - f).sqr();
        let trt = tt * t * f;
        let rest = trt.zip(
            t * f,
            #[inline(always)]
            |trt, ft| trt * ft / (R::ONE - ft).max(R::of(1e-30)),
        );
        [Spectrum::splat(f), tt, trt, rest]
    }
}
