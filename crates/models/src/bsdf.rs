//! The contract of a surface reflection model.

use sparrow_math::{LocalDir, Mask, Real};
use sparrow_spectra::Spectrum;

/// The uniform numbers one sample takes, each in [0, 1).
#[derive(Clone, Copy, Debug)]
pub struct Uniforms<R> {
    /// Chooses among lobes.
    pub lobe: R,
    /// Chooses the direction within a lobe.
    pub dir: [R; 2],
}

/// A sampled direction, with its weight and density.
#[derive(Clone, Copy, Debug)]
pub struct BsdfSample<R: Real> {
    /// Towards the light.
    pub wi: LocalDir<R>,
    /// `f_cos / density`, finite for mirrors too.
    pub weight: Spectrum<R>,
    /// Density of `wi` in 1/sr; for a delta lobe the probability with which it was chosen.
    pub density: R,
    /// Relative index of refraction that was crossed, transmitted over incident side; 1 for reflection.
    pub eta: R,
    /// The sample comes from a delta lobe: no other technique can find it.
    pub delta: R::Mask,
    /// The path goes on.
    pub valid: R::Mask,
}

impl<R: Real> BsdfSample<R> {
    /// The sample that ends the path, where `valid` is to be false everywhere.
    #[inline(always)]
    pub fn none(wo: LocalDir<R>) -> Self {
        BsdfSample {
            wi: wo,
            weight: Spectrum::ZERO,
            density: R::ZERO,
            eta: R::ONE,
            delta: R::Mask::of(false),
            valid: R::Mask::of(false),
        }
    }
}

/// A surface reflection model with its parameters bound, at one point and one set of wavelengths.
///
/// Conventions of directions and measures: see the table in the crate's documentation. Nothing here
/// allocates, and nothing checks its input: directions are of unit length.
pub trait Bsdf<R: Real>: Copy {
    /// `f(wo, wi) |cos theta_i|` for radiance, and the density in 1/sr with which `sample` returns `wi`; `f` in 1/sr.
    ///
    /// Zero where nothing is scattered; without delta lobes. Never NaN.
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R);
    /// Draws `wi`; the sample's mask says where the path goes on.
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R>;
    /// Where the model has a lobe that is no delta, so that [`f`](Self::f) can be other than zero.
    #[inline(always)]
    fn has_smooth_lobe(&self) -> R::Mask {
        R::Mask::of(true)
    }
    /// A relative of the model with its narrow lobes widened, for paths that have been scattered widely before.
    #[inline(always)]
    fn regularized(self) -> Self {
        self
    }
    /// `f(wo, wi)` alone; zero for directions within the surface.
    #[inline(always)]
    fn f(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> Spectrum<R> {
        let cos = wi.abs_cos_theta();
        let some = cos.gt(R::ZERO);
        (self.f_cos(wo, wi) / R::select(some, cos, R::ONE)).only_where(some)
    }
    /// `f |cos theta_i|` alone.
    #[inline(always)]
    fn f_cos(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> Spectrum<R> {
        self.f_cos_pdf(wo, wi).0
    }
    /// The density alone.
    #[inline(always)]
    fn pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        self.f_cos_pdf(wo, wi).1
    }
}
