//! How much light leaves: [`albedo`].

use sparrow_math::{LocalDir, Real};
use sparrow_models::{Bsdf, Surface, Uniforms};
use sparrow_stats::cubature::Stop;
use sparrow_stats::{Partition, Random};

use super::delta::deltas;

/// Samples that show where lobes are and where light passes.
const SAMPLES: usize = 1024;

/// The directional albedo: the share of the light from `wo` that leaves again, to both sides and in delta lobes.
///
/// The integral of `f |cos theta_i|` over the sphere, by adaptive cubature of its value; sampling says only where to look
/// first. Of transmitted light the power counts: without the factor `1 / eta^2` of radiance. Error about 1e-4.
pub fn albedo(model: &Surface<f64>, wo: LocalDir<f64>) -> f64 {
    let mirrored: f64 = deltas(model, wo).iter().map(|d| d.share).sum();
    if !model.has_smooth_lobe() {
        return mirrored;
    }
    let mut random = Random::named(0, "albedo");
    let (mut seen, mut power_below) = (Vec::with_capacity(SAMPLES), 1.0);
    for _ in 0..SAMPLES {
        let (lobe, dir) = (random.uniform(), [random.uniform(), random.uniform()]);
        let s = model.sample(wo, Uniforms { lobe, dir });
        if s.valid && !s.delta {
            seen.push(s.wi);
            if s.wi.z() * wo.z() < 0.0 {
                power_below = s.eta * s.eta;
            }
        }
    }
    let azimuth = Real::atan2(-wo.y(), -wo.x());
    let value = |wi: LocalDir<f64>| {
        let power = if wi.z() * wo.z() < 0.0 { power_below } else { 1.0 };
        [model.f_cos(wo, wi).average() * power]
    };
    let stop = Stop { error: 1e-4, evaluations: 60_000 };
    mirrored + Partition::new(&seen, 16, azimuth, 0.0).integrate(value, stop).total()[0]
}
