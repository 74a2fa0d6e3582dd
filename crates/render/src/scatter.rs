//! A reflection model at a point, in world space, one ray at a time.

use sparrow_geometry::SurfacePoint;
use sparrow_math::{Frame, LocalDir, Real, Vec3};
use sparrow_models::{Bcsdf, Bsdf, BsdfSample, Fibre, Surface, Uniforms};
use sparrow_spectra::Spectrum;

/// How likely a sampled direction was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Density {
    /// Per steradian.
    SolidAngle(f32),
    /// The direction is the only one: with this probability its lobe was chosen. It enters no MIS weight.
    Delta(f32),
}

/// A sampled direction.
#[derive(Clone, Copy, Debug)]
pub struct ScatterSample {
    /// Where the path goes on, unit.
    pub wi: Vec3<f32>,
    /// Value times cosine over density.
    pub weight: Spectrum<f32>,
    /// How likely it was.
    pub density: Density,
    /// Relative index of refraction that was crossed; 1 for reflection.
    pub eta: f32,
}

/// A model with its parameters bound: of a surface, whose cosine is that with the normal, or of a fibre, whose cosine is its own.
#[derive(Clone, Copy, Debug)]
#[allow(clippy::large_enum_variant, reason = "models live on the stack, by value")]
pub enum LocalModel {
    /// z is the shading normal, x the tangent.
    Surface(Surface<f32>),
    /// x is the fibre, z the normal where it was met.
    Fibre(Fibre<f32>),
}

impl LocalModel {
    #[inline]
    fn has_smooth_lobe(&self) -> bool {
        match self {
            LocalModel::Surface(m) => m.has_smooth_lobe(),
            LocalModel::Fibre(m) => m.has_smooth_lobe(),
        }
    }
    #[inline]
    fn regularized(self) -> LocalModel {
        match self {
            LocalModel::Surface(m) => LocalModel::Surface(m.regularized()),
            LocalModel::Fibre(m) => LocalModel::Fibre(m.regularized()),
        }
    }
    #[inline]
    fn f_cos_pdf(&self, wo: LocalDir<f32>, wi: LocalDir<f32>) -> (Spectrum<f32>, f32) {
        match self {
            LocalModel::Surface(m) => m.f_cos_pdf(wo, wi),
            LocalModel::Fibre(m) => m.f_cos_pdf(wo, wi),
        }
    }
    #[inline]
    fn sample(&self, wo: LocalDir<f32>, u: Uniforms<f32>) -> BsdfSample<f32> {
        match self {
            LocalModel::Surface(m) => m.sample(wo, u),
            LocalModel::Fibre(m) => m.sample(wo, u),
        }
    }
    /// The frame it is written for. A fibre's x is the tangent itself, whatever the shading normal.
    #[inline]
    fn frame(&self, point: &SurfacePoint) -> Frame<f32> {
        match self {
            LocalModel::Surface(_) => Frame::from_zx(point.ns, point.tangent),
            LocalModel::Fibre(_) => frame_of_fibre(point.tangent, point.ns),
        }
    }
}

/// The frame whose x is the tangent and whose z comes nearest to the normal.
#[inline(always)]
pub(crate) fn frame_of_fibre<R: Real>(tangent: Vec3<R>, normal: Vec3<R>) -> Frame<R> {
    let length2 = tangent.length2();
    let x = tangent * (R::ONE / length2.sqrt());
    // Built around x, then turned: x becomes the first axis, the normal the third.
    let f = Frame::from_zx(x, normal);
    Frame::select(length2.gt(R::of(1e-30)), Frame { x, y: -f.y, z: f.x }, Frame::from_z(normal))
}

/// A reflection model in the shading frame of a point: the one door from world to local directions.
#[derive(Clone, Copy, Debug)]
pub struct Scatter {
    frame: Frame<f32>,
    model: LocalModel,
}

impl Scatter {
    /// Places a model at a point.
    #[inline]
    pub fn new(point: &SurfacePoint, model: LocalModel) -> Scatter {
        Scatter { frame: model.frame(point), model }
    }
    /// There is a lobe that light sampling can hit.
    #[inline]
    pub fn has_smooth_lobe(&self) -> bool {
        self.model.has_smooth_lobe()
    }
    /// With narrow lobes widened.
    #[inline]
    #[must_use]
    pub fn regularized(self) -> Scatter {
        Scatter { model: self.model.regularized(), ..self }
    }
    /// Value times cosine, and the density with which [`sample`](Self::sample) returns `wi`.
    #[inline]
    pub fn f_cos_pdf(&self, wo: Vec3<f32>, wi: Vec3<f32>) -> (Spectrum<f32>, f32) {
        self.model.f_cos_pdf(self.frame.to_local(wo), self.frame.to_local(wi))
    }
    /// Draws a direction; none where the path ends.
    #[inline]
    pub fn sample(&self, wo: Vec3<f32>, lobe: f32, dir: [f32; 2]) -> Option<ScatterSample> {
        let s = self.model.sample(self.frame.to_local(wo), Uniforms { lobe, dir });
        let finite = s.weight.is_finite() && s.density.is_finite();
        debug_assert!(finite, "{:?} returned {s:?}", self.model);
        // Batches of models say by the density where a path ends.
        if !s.valid || !finite || !(s.density > 0.0) {
            return None;
        }
        let density = if s.delta { Density::Delta(s.density) } else { Density::SolidAngle(s.density) };
        Some(ScatterSample {
            wi: self.frame.to_world(s.wi).normalized(),
            weight: s.weight,
            density,
            eta: s.eta,
        })
    }
}
