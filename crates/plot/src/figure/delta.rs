//! Delta lobes: what `f` and `pdf` do not show, found by sampling.

use sparrow_math::LocalDir;
use sparrow_models::{Bsdf, Surface, Uniforms};

/// A direction into which a share of the light goes, all of it.
#[derive(Clone, Copy, Debug)]
pub struct Delta {
    /// The direction.
    pub wi: LocalDir<f64>,
    /// The share of the light, from 0 to 1. Of transmitted light the power counts: without the factor `1 / eta^2` of
    /// radiance.
    pub share: f64,
}

/// Lobes that are chosen less often than this may be missed.
const STRATA: usize = 1024;

/// The delta lobes seen from `wo`, in the order in which the model chooses among its lobes.
pub fn deltas(model: &Surface<f64>, wo: LocalDir<f64>) -> Vec<Delta> {
    let mut found: Vec<Delta> = Vec::new();
    for i in 0..STRATA {
        let lobe = (i as f64 + 0.5) / STRATA as f64;
        let s = model.sample(wo, Uniforms { lobe, dir: [0.5, 0.5] });
        if !(s.valid && s.delta) || found.iter().any(|d| d.wi.dot(s.wi) > 1.0 - 1e-9) {
            continue;
        }
        let through = wo.z() * s.wi.z() < 0.0;
        let power = if through { s.eta * s.eta } else { 1.0 };
        found.push(Delta { wi: s.wi, share: s.weight.average() * s.density * power });
    }
    found.retain(|d| d.share > 0.0);
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::Series;
    use sparrow_models::SurfaceKind;

    #[test]
    fn glass_reflects_and_refracts_all_light() {
        let s = Series::new(SurfaceKind::Dielectric);
        let found = deltas(&s.model(), s.wo());
        assert_eq!(found.len(), 2, "{found:?}");
        assert!((found.iter().map(|d| d.share).sum::<f64>() - 1.0).abs() < 1e-12, "{found:?}");
        // Fresnel's reflectance of 1.5 at 45 degrees, by hand: (0.30334^2 + 0.09201^2) / 2.
        let up = found.iter().find(|d| d.wi.z() > 0.0).unwrap();
        assert!((up.share - 0.05024).abs() < 1e-4, "{up:?}");
        assert!(deltas(&Series::new(SurfaceKind::Lambert).model(), s.wo()).is_empty());
    }
}
