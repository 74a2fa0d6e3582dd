//! What a column's samples add up to: [`Tally`].

use sparrow_spectra::N_LAMBDA;
use sparrow_stats::{Partition, Random, Weights};

use crate::column::{Column, Dir, Drawn};
use crate::question::ColumnName;

/// Samples asked of a column at once.
const CHUNK: usize = 4096;

/// Sums over samples.
#[derive(Clone, Debug)]
pub(crate) struct Tally {
    /// Samples per cell, from lobes with a density.
    pub(crate) counts: Vec<f64>,
    /// Samples drawn.
    pub(crate) n: f64,
    /// Samples kept, from lobes with a density.
    pub(crate) kept: f64,
    /// Energy carried by lobes with a density, and by delta lobes.
    pub(crate) smooth: Energy,
    pub(crate) delta: Energy,
    pub(crate) weights: Weights,
    /// The first sample with a number that cannot be.
    pub(crate) broken: Option<Drawn>,
}

/// Moments of energy per wavelength; samples without are zeros.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Energy {
    sum: [f64; N_LAMBDA],
    sum2: [f64; N_LAMBDA],
    largest: [f64; N_LAMBDA],
}

impl Energy {
    /// Of one sample.
    pub(crate) fn add(&mut self, energy: [f64; N_LAMBDA]) {
        for (k, w) in energy.into_iter().enumerate() {
            self.sum[k] += w;
            self.sum2[k] += w * w;
            self.largest[k] = self.largest[k].max(w);
        }
    }
    /// Mean over `n` samples and its standard error, which counts one more of the largest in.
    pub(crate) fn mean(&self, k: usize, n: f64) -> (f64, f64) {
        let mean = self.sum[k] / n;
        let variance = (self.sum2[k] / n - mean * mean).max(0.0);
        (mean, (variance / n + (self.largest[k] / n).powi(2)).sqrt())
    }
}

/// Uniform numbers as a column takes them: all bits for `f64`, those that an `f32` holds for the others.
pub(crate) fn uniforms(name: ColumnName, rng: &mut Random) -> [f64; 3] {
    match name {
        ColumnName::F64 => [rng.uniform(), rng.uniform(), rng.uniform()],
        ColumnName::F32 | ColumnName::Lanes => [rng.uniform_f32(), rng.uniform_f32(), rng.uniform_f32()],
    }
}

/// Asks for `n` samples, a chunk at a time.
pub(crate) fn stream(column: &dyn Column, wo: Dir, n: usize, rng: &mut Random, mut take: impl FnMut(&Drawn)) {
    let (mut u, mut drawn) = (Vec::with_capacity(CHUNK), Vec::with_capacity(CHUNK));
    let mut left = n;
    while left > 0 {
        let now = left.min(CHUNK);
        left -= now;
        u.clear();
        u.extend((0..now).map(|_| uniforms(column.name(), rng)));
        column.sample(wo, &u, &mut drawn);
        drawn.iter().for_each(&mut take);
    }
}

impl Tally {
    pub(crate) fn new(column: &dyn Column, wo: Dir, n: usize, cells: &Partition, rng: &mut Random) -> Tally {
        let mut t = Tally {
            counts: vec![0.0; cells.len()],
            n: n as f64,
            kept: 0.0,
            smooth: Energy::default(),
            delta: Energy::default(),
            weights: Weights::default(),
            broken: None,
        };
        stream(column, wo, n, rng, |s| {
            if !s.valid {
                t.weights.add(0.0);
                return;
            }
            if !sound(s, column.name()) {
                t.broken.get_or_insert(*s);
                return;
            }
            t.weights.add(s.weight.iter().sum::<f64>() / N_LAMBDA as f64);
            if s.delta {
                t.delta.add(s.energy());
            } else {
                t.kept += 1.0;
                t.counts[cells.locate(s.wi)] += 1.0;
                t.smooth.add(s.energy());
            }
        });
        t
    }
}

/// Every number can be: finite, not negative, a direction of unit length.
pub(crate) fn sound(s: &Drawn, name: ColumnName) -> bool {
    let tolerance = if name == ColumnName::F64 { 1e-9 } else { 1e-5 };
    let fair = |v: f64| v >= 0.0 && v.is_finite();
    s.weight.iter().all(|v| fair(*v))
        && fair(s.density)
        && s.eta > 0.0
        && s.eta.is_finite()
        && (s.wi.v().length() - 1.0).abs() < tolerance
}
