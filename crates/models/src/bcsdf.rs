//! The contract of a fibre's scattering model.

use sparrow_math::{LocalDir, Mask, Real};
use sparrow_spectra::Spectrum;

use crate::{BsdfSample, Uniforms};

/// Lobes a fibre's light is told apart in: R, TT, TRT, and all that is reflected inside more than once.
pub const N_LOBES: usize = 4;

/// A scattering model of a fibre with its parameters bound, at one point and one set of wavelengths.
///
/// Frame: x is the fibre's tangent, from root to tip, z the normal where the ray met it. Inclination `theta` is measured from
/// the plane across the fibre, `sin theta = w.x`; the azimuth is `phi = atan2(w.z, w.y)`. The offset `h` of the ray, in radii, is a
/// number of [`ParamBlock`](crate::ParamBlock): models of the near field read it, models of the far field are its mean over
/// -1 to 1.
///
/// The value is `q(wo, wi) = S(wo, wi) cos theta_i` with the *fibre's* cosine `sqrt(w.y^2 + w.z^2)`; no cosine with a
/// normal enters. Nothing here allocates, and nothing checks its input: directions are of unit length.
pub trait Bcsdf<R: Real>: Copy {
    /// `S cos theta_i` in 1/sr and the density in 1/sr with which `sample` returns `wi`; both without delta lobes. Never NaN.
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R);
    /// Draws `wi`; the sample's mask says where the path goes on.
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R>;
    /// `S cos theta_i` by lobe. A model that does not tell lobes apart puts all of it into the first.
    #[inline(always)]
    fn lobes(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> [Spectrum<R>; N_LOBES] {
        [self.f_cos_pdf(wo, wi).0, Spectrum::ZERO, Spectrum::ZERO, Spectrum::ZERO]
    }
    /// `S(wo, wi)` in 1/sr; zero along the fibre.
    #[inline(always)]
    fn f(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> Spectrum<R> {
        let cos = fibre_cosine(wi);
        let across = cos.gt(R::ZERO);
        (self.f_cos(wo, wi) / R::select(across, cos, R::ONE)).only_where(across)
    }
    /// Density with which `sample` returns `wi`, in 1/sr. Zero for delta lobes.
    #[inline(always)]
    fn pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        self.f_cos_pdf(wo, wi).1
    }
    /// `S cos theta_i`
    #[inline(always)]
    fn f_cos(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> Spectrum<R> {
        self.f_cos_pdf(wo, wi).0
    }
    /// Where the model has a lobe that is no delta.
    #[inline(always)]
    fn has_smooth_lobe(&self) -> R::Mask {
        R::Mask::of(true)
    }
    /// A relative of the model with its narrow lobes widened, for paths that have been scattered widely before.
    #[inline(always)]
    fn regularized(self) -> Self {
        self
    }
}

/// `cos theta`: the sine of the angle between a direction and the fibre.
#[inline(always)]
pub fn fibre_cosine<R: Real>(w: LocalDir<R>) -> R {
    (w.y().sqr() + w.z().sqr()).sqrt()
}

/// The sample that leads to `wi`, where the model's density can be had for any direction.
#[inline(always)]
pub(crate) fn weighed<R: Real, M: Bcsdf<R>>(model: &M, wo: LocalDir<R>, wi: LocalDir<R>) -> BsdfSample<R> {
    let (q, density) = model.f_cos_pdf(wo, wi);
    let valid = density.gt(R::ZERO);
    BsdfSample {
        wi,
        weight: (q / R::select(valid, density, R::ONE)).only_where(valid),
        density,
        eta: R::ONE,
        delta: R::Mask::of(false),
        valid,
    }
}
