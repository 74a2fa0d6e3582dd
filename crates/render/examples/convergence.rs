//! How the error of each sampler falls with the number of samples, on functions whose integrals are known.
//!
//! `cargo run --release -p sparrow-render --example convergence`: root mean square error over 400 pixels at 1024 samples, and the slope
//! of its logarithm between 16 and 4096 samples, by least squares.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use std::f64::consts::{E, FRAC_PI_4};

use sparrow_math::Real;
use sparrow_render::sampler::{PixelSampler, Sampler, SamplerConfig, SamplerKind};

/// What it is, how its numbers are drawn, its integral over the unit cube, and a function.
type Integrand = (&'static str, fn(&mut PixelSampler<'_>) -> [f32; 4], f64, fn([f64; 4]) -> f64);

const INTEGRANDS: [Integrand; 6] = [
    ("smooth, 2 D", two_pairs, E - 0.5, |[x, y, ..]| Real::exp(x) * (1.0 + x * y)),
    ("disk, 2 D", two_pairs, FRAC_PI_4, |[x, y, ..]| f64::from(u8::from(x * x + y * y < 1.0))),
    ("smooth, 4 D", two_pairs, (E - 1.0) * (E - 1.0), |[x, y, z, w]| 4.0 * x * w * Real::exp(y + z)),
    ("ball, 4 D", two_pairs, FRAC_PI_4 * FRAC_PI_4 / 2.0, |u| {
        f64::from(u8::from(u.iter().map(|x| x * x).sum::<f64>() < 1.0))
    }),
    ("lamps, apart", |p| choice_and_point(p.get_1d(), p.get_2d()), 1.0, lamps),
    (
        "lamps, a triple",
        |p| {
            let [choice, u, v] = p.get_3d();
            choice_and_point(choice, [u, v])
        },
        1.0,
        lamps,
    ),
];

fn two_pairs(p: &mut PixelSampler<'_>) -> [f32; 4] {
    let ([x, y], [z, w]) = (p.get_2d(), p.get_2d());
    [x, y, z, w]
}

fn choice_and_point(choice: f32, [u, v]: [f32; 2]) -> [f32; 4] {
    [choice, u, v, 0.0]
}

/// One of five lamps and a point of it; all five send as much, the later from an ever smaller part.
fn lamps([choice, u, v, _]: [f64; 4]) -> f64 {
    let lamp = (5.0 * choice) as i32;
    2.0 * v * f64::from(lamp + 1) * (0..lamp).map(|_| u).product::<f64>()
}

/// Root mean square error of the means of `spp` samples over many pixels.
fn error(kind: SamplerKind, spp: u32, (_, draw, truth, f): Integrand) -> f64 {
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
            f(draw(&mut p).map(f64::from))
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
    println!("|{}", " --- |".repeat(1 + INTEGRANDS.len()));
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
