//! What fibre models claim beyond the questions of every model: a white fibre in uniform light is as bright as the light.

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::{Bcsdf, FibreKind, ParamBlock, Uniforms};
use sparrow_spectra::Spectrum;
use sparrow_stats::{Random, Weights};

/// Weights of samples have no spread where absorption is zero: their mean is the integral to rounding.
#[test]
fn white_fibres_return_all_light_at_every_roughness_and_incidence() {
    let mut rng = Random::new(1);
    for beta in [0.02, 0.05, 0.3, 0.7, 1.0] {
        for eta in [1.3, 1.55, 1.9] {
            for alpha in [0.0, 2.0, 10.0] {
                for theta in [0.0, 30.0, 60.0, 80.0_f64] {
                    let mut p = ParamBlock::<f64>::defaults(FibreKind::Hair.params());
                    (p.reals[0], p.reals[1], p.reals[2], p.reals[3]) = (eta, beta, beta, alpha);
                    p.spectra[0] = Spectrum::ZERO;
                    p.h = rng.within(-1.0, 1.0);
                    let hair = FibreKind::Hair.bind(&p);
                    let (s, c) = Real::sin_cos(theta.to_radians());
                    let mut weights = Weights::default();
                    for _ in 0..200 {
                        let u = Uniforms { lobe: rng.uniform(), dir: [rng.uniform(), rng.uniform()] };
                        weights.add(hair.sample(LocalDir::new(vec3(s, 0.6 * c, 0.8 * c)), u).weight.0[0]);
                    }
                    assert!(
                        (weights.mean() - 1.0).abs() < 1e-3,
                        "{beta} {eta} {alpha} {theta}: {}",
                        weights.mean()
                    );
                }
            }
        }
    }
}
