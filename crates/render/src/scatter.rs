//! A reflection model at a point, in world space, one ray at a time.

use sparrow_geometry::SurfacePoint;
use sparrow_math::{Frame, Vec3};
use sparrow_models::{Bsdf, Surface, Uniforms};
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

/// A reflection model in the shading frame of a point: the one door from world to local directions.
#[derive(Clone, Copy, Debug)]
pub struct Scatter {
    frame: Frame<f32>,
    surface: Surface<f32>,
}

impl Scatter {
    /// Places a model at a point.
    #[inline]
    pub fn new(point: &SurfacePoint, surface: Surface<f32>) -> Scatter {
        Scatter { frame: Frame::from_zx(point.ns, point.tangent), surface }
    }
    /// There is a lobe that light sampling can hit.
    #[inline]
    pub fn has_smooth_lobe(&self) -> bool {
        self.surface.has_smooth_lobe()
    }
    /// With narrow lobes widened.
    #[inline]
    #[must_use]
    pub fn regularized(self) -> Scatter {
        Scatter { surface: self.surface.regularized(), ..self }
    }
    /// Value times cosine, and the density with which [`sample`](Self::sample) returns `wi`.
    #[inline]
    pub fn f_cos_pdf(&self, wo: Vec3<f32>, wi: Vec3<f32>) -> (Spectrum<f32>, f32) {
        self.surface.f_cos_pdf(self.frame.to_local(wo), self.frame.to_local(wi))
    }
    /// Draws a direction; none where the path ends.
    #[inline]
    pub fn sample(&self, wo: Vec3<f32>, lobe: f32, dir: [f32; 2]) -> Option<ScatterSample> {
        let s = self.surface.sample(self.frame.to_local(wo), Uniforms { lobe, dir });
        let finite = s.weight.is_finite() && s.density.is_finite();
        debug_assert!(finite, "{:?} returned {s:?}", self.surface);
        if !s.valid || !finite {
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
