//! Columns: the same dimensions of many pixel samples at once, equal to [`PixelSampler`]'s numbers bit for bit.
//!
//! Short loops over arrays of whole numbers, one operation each. [`in_lanes`] compiles them for the vector unit, and the
//! compiler turns each into lanes of eight.

use core::convert::identity;
use core::ops::Range;

use sparrow_math::{InLanes, Real, in_lanes};

use super::config::Randomize;
use super::hash::{GOLDEN, mix, to_unit};
use super::pixel::{PIXEL_DIMENSION, PLANE, PixelSampler, Plan, Sampler, key_step, sobol_seed};
use super::scramble::{nested, second_dimension, third_dimension};
use super::sobol::{self, SobolTables};

/// Pixel samples that are worked on together.
const CHUNK: usize = 64;

/// Loops run over a multiple of this many, whole registers.
const STEP: usize = 16;

type Words = [u32; CHUNK];

/// Numbers of many pixel samples, so many dimensions after where each stands, and where they go, by coordinates.
pub enum Draw<'a> {
    /// What [`PixelSampler::get_1d`] gives.
    One(u32, &'a mut [f32]),
    /// What [`PixelSampler::get_2d`] gives.
    Two(u32, [&'a mut [f32]; 2]),
    /// What [`PixelSampler::get_3d`] gives.
    Three(u32, [&'a mut [f32]; 3]),
    /// What [`PixelSampler::get_pixel_2d`] gives; all stand at dimension 0.
    Pixel([&'a mut [f32]; 2]),
}

impl Sampler {
    /// Draws from `n` pixel samples, which this sampler started and `at` gives where they stand.
    ///
    /// Every place of `draws` has room for `n` numbers. Runs in lanes for the kinds `independent`, `zsobol`, `paddedsobol`,
    /// `pmj02bn` and, where neighbours stand at one dimension, `sobol` with fast Owen scrambling, else one by one.
    pub fn fill<'p>(&self, n: usize, at: impl Fn(usize) -> PixelSampler<'p>, draws: &mut [Draw<'_>]) {
        let mut chunk = Chunk::new(self);
        let mut first = 0;
        while first < n {
            chunk.gather(n - first, |k| at(first + k));
            let places = first..first + chunk.n;
            for draw in draws.iter_mut() {
                if chunk.has_columns(draw) {
                    in_lanes(Columns { chunk: &chunk, first, draw });
                } else {
                    draw.one_by_one(places.clone(), &at);
                }
            }
            first = places.end;
        }
    }

    /// [`Draw::One`] for as many of `paths` as `out` has places.
    pub fn fill_1d(&self, paths: &[PixelSampler<'_>], offset: u32, out: &mut [f32]) {
        self.fill(paths.len().min(out.len()), |i| paths[i], &mut [Draw::One(offset, out)]);
    }

    /// [`Draw::Two`] for as many of `paths` as both of `out` have places.
    pub fn fill_2d(&self, paths: &[PixelSampler<'_>], offset: u32, out: [&mut [f32]; 2]) {
        let n = paths.len().min(out[0].len()).min(out[1].len());
        self.fill(n, |i| paths[i], &mut [Draw::Two(offset, out)]);
    }

    /// Each dimension has tables of its own, so that columns are best filled from paths that stand at the same.
    pub(crate) fn has_tables(&self) -> bool {
        matches!(self.plan, Plan::Sobol(_))
    }
}

impl Draw<'_> {
    /// How many dimensions ahead it begins, and how many it takes.
    fn dimensions(&self) -> (u32, u32) {
        match self {
            Draw::One(offset, _) => (*offset, 1),
            Draw::Two(offset, _) => (*offset, 2),
            Draw::Three(offset, _) => (*offset, 3),
            Draw::Pixel(_) => (PIXEL_DIMENSION, 2),
        }
    }

    /// Draws at `places` from the pixel samples that `at` gives.
    fn one_by_one<'p>(&mut self, places: Range<usize>, at: &impl Fn(usize) -> PixelSampler<'p>) {
        for k in places {
            match self {
                Draw::One(offset, x) => x[k] = at(k).after(*offset).get_1d(),
                Draw::Two(offset, [x, y]) => [x[k], y[k]] = at(k).after(*offset).get_2d(),
                Draw::Three(offset, [x, y, z]) => [x[k], y[k], z[k]] = at(k).after(*offset).get_3d(),
                Draw::Pixel([x, y]) => [x[k], y[k]] = at(k).get_pixel_2d(),
            }
        }
    }
}

/// At most [`CHUNK`] pixel samples; where dimensions have tables of their own, all at the same dimension.
struct Chunk<'a> {
    sampler: &'a Sampler,
    n: usize,
    /// Where the first stands.
    dimension: u32,
    /// What the key of a dimension is made of, but for how far it lies ahead.
    keys: [u64; CHUNK],
    /// Lower and upper halves of the indices.
    index: [Words; 2],
}

impl<'a> Chunk<'a> {
    fn new(sampler: &'a Sampler) -> Chunk<'a> {
        Chunk { sampler, n: 0, dimension: 0, keys: [0; CHUNK], index: [[0; CHUNK]; 2] }
    }

    /// Takes the first of `n` pixel samples, as many as fit and belong together.
    fn gather<'p>(&mut self, n: usize, at: impl Fn(usize) -> PixelSampler<'p>) {
        let mut n = n.min(CHUNK);
        let [low, high] = &mut self.index;
        self.dimension = if n > 0 { at(0).dimension() } else { 0 };
        if self.sampler.has_tables() {
            n = (0..n).take_while(|k| at(*k).dimension() == self.dimension).count().min(CHUNK);
            high[..n].iter_mut().enumerate().for_each(|(k, high)| *high = (at(k).index >> 32) as u32);
        }
        for (k, (key, low)) in self.keys[..n].iter_mut().zip(&mut low[..n]).enumerate() {
            let path = at(k);
            (*key, *low) = (path.key_here(), path.index as u32);
        }
        self.n = n;
    }

    /// There is a form in lanes.
    fn has_columns(&self, draw: &Draw<'_>) -> bool {
        let fast = self.sampler.config.randomize == Randomize::FastOwen;
        match self.sampler.plan {
            Plan::Independent => true,
            Plan::Padded | Plan::ZOrder { .. } => fast,
            Plan::Sobol(_) => {
                let (offset, n) = draw.dimensions();
                let first = self.dimension.wrapping_add(offset);
                fast && first.saturating_add(n) <= sobol::N_DIMENSIONS - PLANE
            }
            Plan::Stratified { .. } | Plan::Halton(_) => false,
        }
    }
}

/// Draws from a chunk, into the places from `first` on.
struct Columns<'a, 'b, 'c> {
    chunk: &'a Chunk<'b>,
    first: usize,
    draw: &'a mut Draw<'c>,
}

impl InLanes for Columns<'_, '_, '_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Columns { chunk, first, draw } = self;
        let places = first..first + chunk.n;
        let (offset, _) = draw.dimensions();
        match draw {
            Draw::One(_, x) => chunk.fill(offset, [&mut x[places]]),
            Draw::Two(_, [x, y]) | Draw::Pixel([x, y]) => {
                chunk.fill(offset, [&mut x[places.clone()], &mut y[places]]);
            }
            Draw::Three(_, [x, y, z]) => {
                chunk.fill(offset, [&mut x[places.clone()], &mut y[places.clone()], &mut z[places]]);
            }
        }
    }
}

impl Chunk<'_> {
    /// Coordinates of the points, into their places.
    #[inline(always)]
    fn fill<const N: usize>(&self, offset: u32, mut out: [&mut [f32]; N]) {
        if let Plan::Sobol(tables) = &self.sampler.plan {
            let first = self.dimension + offset + PLANE;
            return (first..).zip(out).for_each(|(d, out)| self.sobol(tables, d, out));
        }
        let m = self.padded();
        // The first of three stands before the pair.
        let (single, pair) = out.split_at_mut(N.saturating_sub(2));
        let of_pair = offset.wrapping_add(single.len() as u32);
        let (mut keys, mut low, mut high) = ([0; CHUNK], [0; CHUNK], [0; CHUNK]);
        let (keys, low, high) = (&mut keys[..m], &mut low[..m], &mut high[..m]);
        if matches!(self.sampler.plan, Plan::Independent) {
            for out in single {
                self.keys(offset, keys);
                split(keys, low, high);
                store(low, out);
            }
            self.keys(of_pair, keys);
            split(keys, low, high);
            return pair.iter_mut().zip([low, high]).for_each(|(out, v)| store(v, out));
        }
        let (mut index, mut v) = ([0; CHUNK], [0; CHUNK]);
        let (index, v) = (&mut index[..m], &mut v[..m]);
        self.keys(of_pair, keys);
        split(keys, low, high);
        scramble(index, &self.index[0], low, identity);
        for (i, key) in index.iter_mut().zip(&*low) {
            *i = self.sampler.blocks.permute(*i, key.wrapping_mul(GOLDEN as u32));
        }
        scramble(v, index, high, identity);
        store(v, pair[0]);
        if let Some(out) = pair.get_mut(1) {
            times_golden(keys, high);
            scramble(v, index, high, second_dimension);
            store(v, out);
        }
        for out in single {
            times_golden(keys, high);
            scramble(v, index, high, third_dimension);
            store(v, out);
        }
    }

    /// Pixel samples that loops run over.
    #[inline(always)]
    fn padded(&self) -> usize {
        self.n.next_multiple_of(STEP).min(CHUNK)
    }

    /// [`PixelSampler::key_of`] of each.
    #[inline(always)]
    fn keys(&self, offset: u32, out: &mut [u64]) {
        let step = key_step(offset);
        for (out, k) in out.iter_mut().zip(&self.keys) {
            *out = mix(k.wrapping_add(step));
        }
    }

    /// Coordinate `d` of the global sequence, scrambled.
    #[inline(always)]
    fn sobol(&self, tables: &SobolTables, d: u32, out: &mut [f32]) {
        let m = self.padded();
        let [low, high] = self.index.each_ref().map(|words| &words[..m]);
        let used = low.iter().zip(high).fold(0, |all, (l, h)| all | u64::from(*l) | (u64::from(*h) << 32));
        let mut v = [0u32; CHUNK];
        let v = &mut v[..m];
        for j in (0..sobol::N_COLUMNS.min(64 - used.leading_zeros() as usize)).step_by(4) {
            let columns = tables.columns(d, j);
            let bits = if j < 32 { low } else { high };
            for (v, bits) in v.iter_mut().zip(bits) {
                let bits = (bits >> (j & 31)) as i32;
                for (k, column) in columns.iter().enumerate() {
                    // The bit, at every place of a word.
                    *v ^= column & (bits << (31 - k) >> 31) as u32;
                }
            }
        }
        let mut seeds = [sobol_seed(self.sampler.seed, d, 0); CHUNK];
        if used >> sobol::N_COLUMNS != 0 {
            for ((s, l), h) in seeds.iter_mut().zip(low).zip(high) {
                let index = u64::from(*l) | (u64::from(*h) << 32);
                *s = sobol_seed(self.sampler.seed, d, sobol::turn(index));
            }
        }
        let mut scrambled = [0; CHUNK];
        scramble(&mut scrambled[..m], v, &seeds, u32::reverse_bits);
        store(&scrambled, out);
    }
}

/// Lower and upper halves.
#[inline(always)]
fn split(words: &[u64], low: &mut [u32], high: &mut [u32]) {
    for ((w, l), h) in words.iter().zip(low).zip(high) {
        (*l, *h) = (*w as u32, (*w >> 32) as u32);
    }
}

/// Keys of the next coordinate, and their upper halves.
#[inline(always)]
fn times_golden(keys: &mut [u64], high: &mut [u32]) {
    for (k, h) in keys.iter_mut().zip(high) {
        *k = k.wrapping_mul(GOLDEN);
        *h = (*k >> 32) as u32;
    }
}

/// Scrambles coordinates of points, each by its seed. `of` makes a coordinate of an index, with the lowest bit leading; the
/// result leads with its highest.
#[inline(always)]
fn scramble(out: &mut [u32], index: &[u32], seeds: &[u32], of: impl Fn(u32) -> u32) {
    for ((out, i), s) in out.iter_mut().zip(index).zip(seeds) {
        *out = nested(of(*i), *s).reverse_bits();
    }
}

/// Binary fractions as numbers, as many as there are places.
#[inline(always)]
fn store(v: &[u32], out: &mut [f32]) {
    for (x, v) in out.iter_mut().zip(v) {
        *x = to_unit(*v);
    }
}
