//! Drawing a cell of an environment map: cumulative tables with guides against an alias table.
//!
//! `cargo bench -p sparrow-render --bench environment`; ns per draw, the best of many rounds, in which both take turns. The alias table draws
//! a cell in constant time, but neighbouring numbers draw cells anywhere, so that stratified numbers lose what they are worth.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use std::hint::black_box;
use std::time::Instant;

use sparrow_render::distribution::Piecewise2;
use sparrow_render::sampler::{Sampler, SamplerConfig, SamplerKind};

/// Draws of one round.
const N: usize = 4096;
const ROUNDS: usize = 300;

/// One item per bin: how likely it keeps what falls on it, and who takes the rest.
struct Alias(Vec<(f32, u32)>);

impl Alias {
    fn new(weights: &[f32]) -> Alias {
        let n = weights.len();
        let mean = weights.iter().map(|&w| f64::from(w)).sum::<f64>() / n as f64;
        let mut left: Vec<f64> = weights.iter().map(|&w| f64::from(w) / mean).collect();
        let mut bins = vec![(1.0, 0); n];
        let (mut poor, mut rich): (Vec<usize>, Vec<usize>) = (0..n).partition(|&i| left[i] < 1.0);
        while let (Some(a), Some(&b)) = (poor.pop(), rich.last()) {
            bins[a] = (left[a] as f32, b as u32);
            left[b] -= 1.0 - left[a];
            if left[b] < 1.0 {
                rich.pop();
                poor.push(b);
            }
        }
        Alias(bins)
    }
    /// The cell, and what is left of `u`.
    fn sample(&self, u: [f32; 2]) -> u32 {
        let i = ((u[0] * self.0.len() as f32) as usize).min(self.0.len() - 1);
        let (keep, other) = self.0[i];
        if u[1] < keep { i as u32 } else { other }
    }
}

/// Variance of the mean of 16 samples of a function that changes slowly over the cells, by a draw.
fn variance(sampler: &Sampler, draw: &dyn Fn([f32; 2]) -> f64) -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    let n = 2000;
    for pixel in 0..n {
        let value = |i| draw(sampler.start([pixel % 50, pixel / 50], i).at(4).get_2d());
        let mean = (0..16).map(value).sum::<f64>() / 16.0;
        sum += mean;
        squares += mean * mean;
    }
    let n = f64::from(n);
    squares / n - (sum / n) * (sum / n)
}

fn main() {
    println!("{:>6} {:>8} {:>8} {:>22}", "side", "tables", "alias", "variance, alias/tables");
    let sampler = Sampler::new(&SamplerConfig {
        kind: SamplerKind::ZSobol,
        randomize: SamplerKind::ZSobol.default_randomize(),
        samples_per_pixel: 16,
        seed: 0,
        resolution: [64, 64],
    });
    for side in [256usize, 1024, 2048] {
        // A sky that brightens upwards, with a sun.
        let weight = |i: usize| {
            let (x, y) = ((i % side) as f32 / side as f32, (i / side) as f32 / side as f32);
            let sun = if (x - 0.3).abs() < 0.01 && (y - 0.7).abs() < 0.01 { 2000.0 } else { 0.0 };
            0.2 + y * y + sun
        };
        let weights: Vec<f32> = (0..side * side).map(weight).collect();
        let (tables, alias) = (Piecewise2::new(&weights, side, side), Alias::new(&weights));
        let numbers: Vec<[f32; 2]> =
            (0..N as u32).map(|i| sampler.start([i % 64, i / 64 % 64], i % 16).at(8).get_2d()).collect();
        let mut best = [f64::INFINITY; 2];
        for _ in 0..ROUNDS {
            let start = Instant::now();
            numbers.iter().for_each(|u| _ = black_box(tables.sample(*u)));
            best[0] = best[0].min(start.elapsed().as_secs_f64() * 1e9 / N as f64);
            let start = Instant::now();
            numbers.iter().for_each(|u| _ = black_box(alias.sample(*u)));
            best[1] = best[1].min(start.elapsed().as_secs_f64() * 1e9 / N as f64);
        }
        let height = |y: usize| y as f64 / side as f64;
        let by_tables = variance(&sampler, &|u| height(tables.sample(u).index[1]));
        let by_alias = variance(&sampler, &|u| height(alias.sample(u) as usize / side));
        println!("{side:>6} {:>8.1} {:>8.1} {:>22.1}", best[0], best[1], by_alias / by_tables);
    }
}
