//! Time per uniform number: one by one, and in columns; and of the seven of a bounce.
//!
//! `cargo bench -p sparrow-render --bench samplers`; ns per number and per bounce, the best of many rounds, in which all take turns.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use std::hint::black_box;
use std::time::Instant;

use sparrow_render::sampler::{Draw, PixelSampler, Sampler, SamplerConfig, SamplerKind};

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
    println!(
        "{:14} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "kind", "1d", "column", "2d", "columns", "apart", "bounce"
    );
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
        let mut seven = vec![[0.0; 256]; 7];
        let mut best = [f64::INFINITY; 6];
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
                time(N, || bounce(&sampler, &paths, d, &mut seven, false)),
                time(N, || bounce(&sampler, &paths, d, &mut seven, true)),
            ];
            black_box((&x, &y, &seven));
            for (best, t) in best.iter_mut().zip(times) {
                *best = best.min(t);
            }
        }
        let [a, b, c, d, e, f] = best;
        println!("{name:14} {a:9.2} {b:9.2} {c:9.2} {d:9.2} {e:9.2} {f:9.2}");
    }
}

/// The numbers of a bounce, from one gathering of each batch of paths, or dimension by dimension.
fn bounce(sampler: &Sampler, paths: &[PixelSampler<'_>], d: u32, out: &mut [[f32; 256]], together: bool) {
    for paths in paths.chunks(256) {
        let [choice, u, v, lobe, x, y, roulette] = out else { return };
        let mut draws =
            [Draw::Three(d, [choice, u, v]), Draw::Three(d + 3, [lobe, x, y]), Draw::One(d + 6, roulette)];
        if together {
            sampler.fill(paths.len(), |i| paths[i], &mut draws);
        } else {
            draws.iter_mut().for_each(|draw| {
                sampler.fill(paths.len(), |i| paths[i], core::slice::from_mut(draw));
            });
        }
    }
}
