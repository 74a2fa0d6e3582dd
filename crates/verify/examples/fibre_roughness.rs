//! Which facets stand for a model's roughness? TT of the reference fibre against that of a smooth one, and the width of R, for
//! several ratios of the facets' slope width to the standard deviation of R; the table in `docs/verification.md`.
//!
//! `cargo run --release -p sparrow-verify --example fibre_roughness`

#![allow(clippy::print_stdout, reason = "a program of the command line")]

use core::f64::consts::PI;

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::cylinder::far_field::FarField;
use sparrow_models::cylinder::roughness::{logistic_scale, variance};
use sparrow_spectra::Spectrum;
use sparrow_stats::Random;
use sparrow_verify::reference_fibre::{ReferenceFibre, Section, Surface};

const ETA: f64 = 1.55;
/// Per radius, at four wavelengths; the second is looked at.
const SIGMA_A: [f64; 4] = [0.0, 0.2, 1.0, 1.0];
const RAYS: u32 = 60_000;

/// The second wavelength's light by TT, and the median of `|theta_i + theta_o|` over R in degrees.
fn traced(alpha: [f64; 2], theta: f64) -> (f64, f64) {
    let fibre = ReferenceFibre {
        section: Section::CIRCLE,
        surface: Surface { alpha, eta: ETA },
        tilt: 0.0,
        sigma_a: SIGMA_A,
        core: None,
    };
    let (sin, cos) = Real::sin_cos(theta);
    let wo = LocalDir::new(vec3(sin, 0.0, cos));
    let mut rng = Random::new(7);
    let (mut tt, mut off) = (0.0, Vec::new());
    for _ in 0..RAYS {
        let h = rng.within(-1.0, 1.0);
        let Some(path) = fibre.send(wo, h, &mut rng) else { continue };
        match path.lobe {
            0 => off.push((Real::asin(path.wi.x()) + theta).abs().to_degrees()),
            1 => tt += path.weight[1] / f64::from(RAYS),
            _ => {}
        }
    }
    off.sort_by(f64::total_cmp);
    (tt, off.get(off.len() / 2).copied().unwrap_or(0.0))
}

fn main() {
    println!("alpha/std  beta  theta   TT of the smooth fibre over that of the rough   median of R, degrees");
    for beta in [0.1, 0.3] {
        let std = [variance(beta).sqrt(), logistic_scale(beta) * PI / 3f64.sqrt()];
        for theta in [0.0, 60.0] {
            let (sin, cos) = Real::sin_cos(f64::to_radians(theta));
            let smooth = FarField { theta: [sin, cos], eta: ETA, sigma_a: Spectrum(SIGMA_A) }.shares(256);
            for ratio in [0.05, 0.2, 0.35, 0.5, core::f64::consts::FRAC_1_SQRT_2, 1.0] {
                let (tt, median) = traced(std.map(|s| s * ratio), f64::to_radians(theta));
                let excess = 100.0 * (smooth[1].0[1] / tt - 1.0);
                println!("{ratio:9.2} {beta:5} {theta:6} {excess:+47.1} % {median:22.1}");
            }
        }
    }
}
