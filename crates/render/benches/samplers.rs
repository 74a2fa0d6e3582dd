//! Time per uniform number: one by one, and in columns.
//!
//! `cargo bench -p sparrow-render --bench samplers`; ns per number, the best of many rounds, in which both take turns.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use std::hint::black_box;
use std::time::Instant;

use sparrow_render::sampler::{PixelSampler, Sampler, SamplerConfig, SamplerKind};

/// Paths of one block.
const N: usize = 1024;
const ROUNDS: usize = 400;

/// Nanoseconds per number that `work` takes, if it makes `numbers` of them.
fn time(numbers: usize, mut work: impl FnMut()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64() * 1e9 / numbers as f64
}

fn main() {
    println!("{:14} {:>9} {:>9} {:>9} {:>9}", "kind", "1d", "column", "2d", "columns");
    for (name, kind) in [
        ("independent", SamplerKind::Independent),
        ("zsobol", SamplerKind::ZSobol),
        ("paddedsobol", SamplerKind::PaddedSobol),
        ("sobol", SamplerKind::Sobol),
        ("halton", SamplerKind::Halton),
    ] {
        let sampler = Sampler::new(&SamplerConfig {
            kind,
            randomize: kind.default_randomize(),
            samples_per_pixel: 64,
            seed: 0,
            resolution: [1024, 768],
        });
        let start = |i: usize| sampler.start([i as u32 % 32, i as u32 / 32], i as u32 % 64);
        let paths: Vec<PixelSampler<'_>> = (0..N).map(start).collect();
        let (mut x, mut y) = (vec![0.0; N], vec![0.0; N]);
        let mut best = [f64::INFINITY; 4];
        for round in 0..ROUNDS {
            let d = 4 + round as u32 % 40;
            let times = [
                time(N, || {
                    for (x, p) in x.iter_mut().zip(&paths) {
                        *x = p.at(d).get_1d();
                    }
                }),
                time(N, || sampler.fill_1d(black_box(&paths), d, &mut x)),
                time(2 * N, || {
                    for ((x, y), p) in x.iter_mut().zip(&mut y).zip(&paths) {
                        [*x, *y] = p.at(d).get_2d();
                    }
                }),
                time(2 * N, || sampler.fill_2d(black_box(&paths), d, [&mut x, &mut y])),
            ];
            black_box((&x, &y));
            for (best, t) in best.iter_mut().zip(times) {
                *best = best.min(t);
            }
        }
        let [a, b, c, d] = best;
        println!("{name:14} {a:9.2} {b:9.2} {c:9.2} {d:9.2}");
    }
}
