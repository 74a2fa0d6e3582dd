//! How the error of each sampler falls with the number of samples, on functions whose integrals are known.
//!
//! `cargo run --release -p sparrow-render --example convergence`: root mean square error over 400 pixels at 1024 samples, and the slope
//! of its logarithm between 16 and 4096 samples, by least squares.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use std::f64::consts::{E, FRAC_PI_4};

use sparrow_math::Real;
use sparrow_render::sampler::{Sampler, SamplerConfig, SamplerKind};

/// A function of the unit cube of four dimensions, its integral, and what it is.
type Integrand = (&'static str, f64, fn([f64; 4]) -> f64);

const INTEGRANDS: [Integrand; 4] = [
    ("smooth, 2 D", E - 0.5, |[x, y, ..]| Real::exp(x) * (1.0 + x * y)),
    ("disk, 2 D", FRAC_PI_4, |[x, y, ..]| f64::from(u8::from(x * x + y * y < 1.0))),
    ("smooth, 4 D", (E - 1.0) * (E - 1.0), |[x, y, z, w]| 4.0 * x * w * Real::exp(y + z)),
    ("ball, 4 D", FRAC_PI_4 * FRAC_PI_4 / 2.0, |u| {
        f64::from(u8::from(u.iter().map(|x| x * x).sum::<f64>() < 1.0))
    }),
];

/// Root mean square error of the means of `spp` samples over many pixels.
fn error(kind: SamplerKind, spp: u32, (_, truth, f): Integrand) -> f64 {
    let kind = match kind {
        SamplerKind::Stratified { jitter, .. } => {
            let x = 1 << (spp.trailing_zeros() / 2);
            SamplerKind::Stratified { x, y: spp / x, jitter }
        }
        SamplerKind::Independent
        | SamplerKind::Halton
        | SamplerKind::Sobol
        | SamplerKind::PaddedSobol
        | SamplerKind::ZSobol
        | SamplerKind::Pmj02bn => kind,
    };
    let randomize = kind.default_randomize();
    let s = Sampler::new(&SamplerConfig {
        kind,
        randomize,
        samples_per_pixel: spp,
        seed: 7,
        resolution: [60, 60],
    });
    let mut sum = 0.0;
    for pixel in 0..400 {
        let value = |i| {
            let mut p = s.start([pixel % 20 * 3, pixel / 20 * 3], i).at(4);
            let ([x, y], [z, w]) = (p.get_2d(), p.get_2d());
            f([x, y, z, w].map(f64::from))
        };
        sum += ((0..spp).map(value).sum::<f64>() / f64::from(spp) - truth).sqr();
    }
    (sum / 400.0).sqrt()
}

fn main() {
    let kinds = [
        ("independent", SamplerKind::Independent),
        ("stratified", SamplerKind::Stratified { x: 1, y: 1, jitter: true }),
        ("halton", SamplerKind::Halton),
        ("sobol", SamplerKind::Sobol),
        ("paddedsobol", SamplerKind::PaddedSobol),
        ("zsobol, pmj02bn", SamplerKind::ZSobol),
    ];
    println!("| sampler | {} |", INTEGRANDS.map(|i| i.0).join(" | "));
    println!("| --- | --- | --- | --- | --- |");
    for (name, kind) in kinds {
        let cells = INTEGRANDS.map(|integrand| {
            let logs: Vec<[f64; 2]> = (4..=12)
                .map(|k| [f64::from(k), Real::ln(error(kind, 1 << k, integrand)) / core::f64::consts::LN_2])
                .collect();
            let n = logs.len() as f64;
            let mean = |k: usize| logs.iter().map(|l| l[k]).sum::<f64>() / n;
            let (mx, my) = (mean(0), mean(1));
            let slope = logs.iter().map(|l| (l[0] - mx) * (l[1] - my)).sum::<f64>()
                / logs.iter().map(|l| (l[0] - mx).sqr()).sum::<f64>();
            format!("{:.1e}, {slope:.2}", error(kind, 1024, integrand))
        });
        println!("| {name} | {} |", cells.join(" | "));
    }
}
