//! What fibre models claim beyond the questions of every model: a white fibre in uniform light is as bright as the light.

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::cylinder::roughness::{logistic_scale, variance};
use sparrow_models::{Bcsdf, FibreKind, ParamBlock, ParamKind, Uniforms};
use sparrow_spectra::Spectrum;
use sparrow_stats::{Random, Weights};

/// The models that claim it.
const WHITE: [FibreKind; 4] =
    [FibreKind::Hair, FibreKind::ZinkeWeber, FibreKind::EllipticalHair, FibreKind::Fur];

/// Parameters of that roughness, index and tilt, nothing absorbing; the rest at its default.
fn white(kind: FibreKind, beta: f64, eta: f64, alpha: f64) -> ParamBlock<f64> {
    let mut p = ParamBlock::<f64>::defaults(kind.params());
    let numbers = kind.params().iter().filter(|i| i.kind == ParamKind::Real);
    for (slot, info) in p.reals.iter_mut().zip(numbers) {
        let given = match info.name {
            "eta" => eta,
            "beta_m" | "beta_n" => beta,
            "width_m" => variance(beta).sqrt().to_degrees(),
            "width_n" => (logistic_scale(beta) * core::f64::consts::PI / 3.0_f64.sqrt()).to_degrees(),
            "alpha" => alpha,
            _ => *slot,
        };
        *slot = given.clamp(info.range[0], info.range[1]);
    }
    p.spectra = [Spectrum::ZERO; sparrow_models::MAX_SPECTRA];
    p
}

/// Weights of samples have no spread where absorption is zero: their mean is the integral to rounding.
#[test]
fn white_fibres_return_all_light_at_every_roughness_and_incidence() {
    let mut rng = Random::new(1);
    for kind in WHITE {
        for beta in [0.02, 0.05, 0.3, 0.7, 1.0] {
            for eta in [1.3, 1.55, 1.9] {
                for alpha in [0.0, 2.0, 10.0] {
                    for theta in [0.0, 30.0, 60.0, 80.0_f64] {
                        let p = ParamBlock { h: rng.within(-1.0, 1.0), ..white(kind, beta, eta, alpha) };
                        let fibre = kind.bind(&p);
                        let (s, c) = Real::sin_cos(theta.to_radians());
                        let wo = LocalDir::new(vec3(s, 0.6 * c, 0.8 * c));
                        let mut weights = Weights::default();
                        for _ in 0..200 {
                            let u = Uniforms { lobe: rng.uniform(), dir: [rng.uniform(), rng.uniform()] };
                            weights.add(fibre.sample(wo, u).weight.0[0]);
                        }
                        let mean = weights.mean();
                        assert!((mean - 1.0).abs() < 1e-3, "{kind:?} {beta} {eta} {alpha} {theta}: {mean}");
                    }
                }
            }
        }
    }
}
