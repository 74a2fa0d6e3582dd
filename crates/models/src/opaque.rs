//! What models that only reflect have in common: they are written for a viewer and a light above.
//!
//! [`Opaque`] asks for the value and the density of one pair of directions and for a way to draw; the contract
//! [`Bsdf`] follows from that, with both sides of the surface alike: seen from below, such a model shows the mirror
//! image of what it shows from above.

use sparrow_math::{LocalDir, Mask, Real, Vec3, warp};
use sparrow_spectra::Spectrum;

use crate::{Bsdf, BsdfSample, Uniforms};

/// A model that only reflects, written for directions above the surface.
pub(crate) trait Opaque: Copy {
    /// The number type.
    type R: Real;
    /// `f(o, i)`, and the density in 1/sr with which [`draw`](Self::draw) returns `i`.
    fn eval(&self, o: LocalDir<Self::R>, i: LocalDir<Self::R>) -> (Spectrum<Self::R>, Self::R);
    /// Draws a direction; one below the horizon ends the path.
    fn draw(&self, o: LocalDir<Self::R>, u: Uniforms<Self::R>) -> LocalDir<Self::R>;
}

/// Mirrors `w` with the viewer `wo`, so that the viewer is above.
#[inline(always)]
pub(crate) fn raised<R: Real>(wo: LocalDir<R>, w: LocalDir<R>) -> LocalDir<R> {
    LocalDir::new(Vec3 { z: R::select(wo.above(), w.z(), -w.z()), ..w.v() })
}

/// Value and density, zero where a direction is not on the viewer's side.
#[inline(always)]
fn eval_both_sides<R: Real, M: Opaque<R = R>>(
    model: &M,
    wo: LocalDir<R>,
    wi: LocalDir<R>,
) -> (Spectrum<R>, R) {
    let (o, i) = (raised(wo, wo), raised(wo, wi));
    let lit = o.above() & i.above();
    let (f, pdf) = model.eval(o, i);
    (f.only_where(lit), pdf.only_where(lit))
}

impl<R: Real, M: Opaque<R = R>> Bsdf<R> for M {
    #[inline(always)]
    fn f(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> Spectrum<R> {
        eval_both_sides(self, wo, wi).0
    }

    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let (f, pdf) = eval_both_sides(self, wo, wi);
        (f * wi.abs_cos_theta(), pdf)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let wi = raised(wo, self.draw(raised(wo, wo), u));
        let (f_cos, density) = self.f_cos_pdf(wo, wi);
        let valid = density.gt(R::ZERO);
        BsdfSample {
            wi,
            weight: (f_cos / density).only_where(valid),
            density,
            eta: R::ONE,
            delta: R::Mask::of(false),
            valid,
        }
    }
}

/// A diffuse and a glossy lobe, chosen between by their weights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TwoLobes<R> {
    diffuse: R,
}

impl<R: Real> TwoLobes<R> {
    /// Chooses in proportion to the largest value of each; both must not depend on the light.
    #[inline(always)]
    pub(crate) fn new(diffuse: Spectrum<R>, glossy: Spectrum<R>) -> Self {
        let (d, g) = (diffuse.max_value(), glossy.max_value());
        let sum = d + g;
        let some = sum.gt(R::ZERO);
        TwoLobes { diffuse: R::select(some, d / R::select(some, sum, R::ONE), R::of(0.5)) }
    }
    /// Density of the mixture at `i`, the diffuse lobe following the cosine.
    #[inline(always)]
    pub(crate) fn density(self, i: LocalDir<R>, glossy: R) -> R {
        let diffuse = warp::cosine_hemisphere_pdf(i.cos_theta());
        self.diffuse * diffuse + (R::ONE - self.diffuse) * glossy
    }
    /// The cosine lobe's direction or the `glossy` one.
    #[inline(always)]
    pub(crate) fn pick(self, u: Uniforms<R>, glossy: LocalDir<R>) -> LocalDir<R> {
        let diffuse = warp::cosine_hemisphere(u.dir);
        LocalDir::new(Vec3::select(u.lobe.lt(self.diffuse), diffuse, glossy.v()))
    }
}

/// The half vector of two directions above, and its cosine with either. [TorranceSparrow1967]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Half<R> {
    /// The facet normal that mirrors one into the other.
    pub(crate) m: LocalDir<R>,
    /// `o.m = i.m`, above zero.
    pub(crate) cos_d: R,
}

impl<R: Real> Half<R> {
    #[inline(always)]
    pub(crate) fn new(o: LocalDir<R>, i: LocalDir<R>) -> Self {
        let m = o.half(i);
        Half { m, cos_d: o.dot(m).clamp(R::of(1e-9), R::ONE) }
    }
    /// `dw_m / dw_i = 1 / (4 o.m)`, which carries densities of normals to those of directions.
    #[inline(always)]
    pub(crate) fn jacobian(&self) -> R {
        R::of(0.25) / self.cos_d
    }
}

/// `e^-x` for `x >= 0`, and zero past 80, where single precision ends: what follows may divide by small cosines.
#[inline(always)]
pub(crate) fn exp_neg<R: Real>(x: R) -> R {
    (-x).exp().only_where(x.lt(R::of(80.0)))
}
