//! A fibre at one offset or over its width: [`Width`].

use core::f64::consts::PI;

use sparrow_math::{LocalDir, Real};
use sparrow_models::{Bcsdf, Fibre, FibreKind, N_LOBES, ParamKind};

use crate::series::{Series, inclined};

/// A model at offsets, each with its share of the width.
pub(super) struct Width(Vec<(f64, Fibre<f64>)>);

impl Width {
    /// At the series' offset; else the model's own far field; else its mean over `n` rays that meet the surface at even angles.
    pub(super) fn new(s: &Series<FibreKind>, n: usize) -> Width {
        if let Some(h) = s.h {
            return Width(vec![(1.0, s.model_at(h))]);
        }
        let mut s = s.clone();
        let pinned = s.pins.iter().any(|(name, _)| name == "field");
        if !pinned && let Some(far) = far(s.kind) {
            s.set("field", far);
        }
        let probe =
            [-0.7, 0.3].map(|h| total(&s.model_at(h), inclined([20.0, 10.0]), inclined([-25.0, 50.0])));
        if probe[0].map(f64::to_bits) == probe[1].map(f64::to_bits) {
            return Width(vec![(1.0, s.model_at(0.0))]);
        }
        let at = |k: usize| {
            let (sin, cos) = Real::sin_cos(PI * ((k as f64 + 0.5) / n as f64 - 0.5));
            (0.5 * PI * cos / n as f64, s.model_at(sin))
        };
        Width((0..n).map(at).collect())
    }
    /// `S cos theta_i` by lobe, the mean over the wavelengths.
    pub(super) fn lobes(&self, wo: LocalDir<f64>, wi: LocalDir<f64>) -> [f64; N_LOBES] {
        let mut sum = [0.0; N_LOBES];
        for (share, model) in &self.0 {
            for (sum, q) in sum.iter_mut().zip(total(model, wo, wi)) {
                *sum += share * q;
            }
        }
        sum
    }
}

fn total(model: &Fibre<f64>, wo: LocalDir<f64>, wi: LocalDir<f64>) -> [f64; N_LOBES] {
    model.lobes(wo, wi).map(|q| q.average())
}

/// The place of `far` among the names of the choice `field`.
fn far(kind: FibreKind) -> Option<f64> {
    let names = kind.params().iter().find_map(|p| match p.kind {
        ParamKind::Choice(names) if p.name == "field" => Some(names),
        ParamKind::Real | ParamKind::Albedo | ParamKind::Unbounded | ParamKind::Choice(_) => None,
    });
    names?.iter().position(|n| *n == "far").map(|place| place as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_over_the_width_is_the_far_field() {
        let far = Series::new(FibreKind::ZinkeWeber);
        let mut near = far.clone();
        near.pins.push(("field".to_owned(), "near".to_owned()));
        let (wo, wi) = (inclined([20.0, 0.0]), inclined([-25.0, 160.0]));
        let (a, b) = (Width::new(&far, 1), Width::new(&near, 400));
        assert!(a.0.len() == 1 && b.0.len() == 400);
        // The far field is a sum over 16 segments, within one percent of a lobe's peak.
        let [tt, mean] = [&a, &b].map(|w| w.lobes(wo, wi)[1]);
        assert!((tt / mean - 1.0).abs() < 0.03, "{tt} {mean}");
    }
}
