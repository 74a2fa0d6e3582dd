//! Who looks on while a path finds light: [`Record`].

use sparrow_math::Vec3;
use sparrow_spectra::Spectrum;

/// How a path found light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finder {
    /// The camera sees it.
    Camera,
    /// Light sampling at a vertex, counted from 0 at the first that the camera sees.
    Light(u32),
    /// The direction that the BSDF gave at a vertex; a delta lobe's too.
    Bsdf(u32),
}

/// Whoever wants to know where the light of a path comes from. `()` does not.
pub trait Record {
    /// The path found light: what it adds to the radiance before its MIS weight, and that weight.
    fn found(&mut self, by: Finder, light: Spectrum<f32>, weight: f32);
    /// The path goes on from a vertex at `p`, and what it will find counts `beta` times.
    #[inline(always)]
    fn goes_on(&mut self, p: Vec3<f32>, beta: Spectrum<f32>) {
        let _ = (p, beta);
    }
}

impl Record for () {
    #[inline(always)]
    fn found(&mut self, _: Finder, _: Spectrum<f32>, _: f32) {}
}
