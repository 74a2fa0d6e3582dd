//! Probabilities, and what a pilot learns.

use sparrow_math::{Aabb, vec3};
use sparrow_spectra::Spectrum;

use super::cells::Cells;
use super::trail::Trail;
use super::*;
use crate::integrator::{Finder, Record};

const P: sparrow_math::Vec3<f32> = vec3(0.5, 0.5, 0.5);

/// Paths of one pixel that find `direct`, go on with half of what they carry, and find `found[i]` times what they carry.
fn learned(direct: f32, found: &[f32]) -> Learned {
    let cells = Cells::new(&Aabb { lo: vec3(0.0, 0.0, 0.0), hi: vec3(1.0, 1.0, 1.0) });
    let trail = |found: &f32| {
        let mut trail = Trail::default();
        trail.found(Finder::Light(0), Spectrum::splat(direct), 1.0);
        trail.goes_on(P, Spectrum::splat(0.5));
        trail.found(Finder::Bsdf(0), Spectrum::splat(0.5 * found), 1.0);
        ([0, 0], trail)
    };
    let trails: Vec<_> = found.iter().map(trail).collect();
    Learned::new(cells, [1, 1], 0, trails.iter())
}

#[test]
fn efficiency_is_that_of_the_formula() {
    // I = 1.5, C_I = 3, M = 2, C = 1, V = 0.5^2 / I^2: I is the same in both and falls out.
    let learned = learned(1.0, &[0.0, 2.0].repeat(500));
    let expected = (2.0f32 / 1.0).sqrt() * (3.0f32 / 0.25).sqrt();
    let q = learned.value([0, 0], P);
    assert!((q - expected).abs() < 1e-4 * expected, "{q} {expected}");
}

#[test]
fn no_path_is_weighted_more_than_by_throughput() {
    let learned = learned(1.0, &[0.0, 2.0].repeat(50));
    for carried in [1e-6, 1e-3, 0.01, 0.1, 0.3, 0.49, 0.6, 1.0, 7.0, f32::INFINITY, f32::NAN] {
        for eta_scale in [0.4, 1.0, 2.3] {
            let beta = Spectrum::splat(carried);
            let q = Roulette::of_pixel(Some(&learned), [0, 0]).survival(P, beta, eta_scale);
            let least = Roulette::THROUGHPUT.survival(P, beta, eta_scale);
            assert!(q >= least && (q <= 1.0 || !carried.is_finite()), "{carried} {eta_scale}: {q} {least}");
        }
    }
}

#[test]
fn nothing_found_leaves_it_to_throughput() {
    for learned in [learned(0.0, &[0.0; 9]), learned(1.0, &[0.0; 9]), learned(1.0, &[])] {
        let q = learned.value([0, 0], P);
        assert!(q == 0.0, "{q}");
    }
}
