//! Columns: the same dimensions of many pixel samples at once, equal to [`PixelSampler`]'s numbers bit for bit.
//!
//! Short loops over arrays of whole numbers, one operation each. [`in_lanes`] compiles them for the vector unit, and the
//! compiler turns each into lanes of eight.

use sparrow_math::{InLanes, Real, in_lanes};

use super::config::Randomize;
use super::hash::{GOLDEN, mix, to_unit};
use super::pixel::{PIXEL_DIMENSION, PLANE, PixelSampler, Plan, Sampler, key_step, sobol_seed};
use super::scramble::{nested, second_dimension, third_dimension};
use super::sobol::{self, SobolTables};

/// Pixel samples that are worked on together.
const CHUNK: usize = 64;

type Words = [u32; CHUNK];

/// Numbers of many pixel samples, so many dimensions after where each stands, and where they go, by coordinates.
pub enum Draw<'a> {
    /// What [`PixelSampler::get_1d`] gives.
    One(u32, &'a mut [f32]),
    /// What [`PixelSampler::get_2d`] gives.
    Two(u32, [&'a mut [f32]; 2]),
    /// What [`PixelSampler::get_3d`] gives.
    Three(u32, [&'a mut [f32]; 3]),
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
            chunk.gather((first..n).map(&at));
            let at = |k: usize| at(first + k);
            let places = first..first + chunk.n;
            for draw in &mut *draws {
                match draw {
                    Draw::One(offset, x) => {
                        chunk.fill(*offset, [&mut x[places.clone()]], |k| [at(k).after(*offset).get_1d()])
                    }
                    Draw::Two(offset, out) => {
                        let out = out.each_mut().map(|c| &mut c[places.clone()]);
                        chunk.fill(*offset, out, |k| at(k).after(*offset).get_2d());
                    }
                    Draw::Three(offset, out) => {
                        let out = out.each_mut().map(|c| &mut c[places.clone()]);
                        chunk.fill(*offset, out, |k| at(k).after(*offset).get_3d());
                    }
                }
            }
            first += chunk.n;
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

    /// What [`PixelSampler::get_pixel_2d`] gives for each of `paths`, by coordinates.
    pub fn fill_pixel_2d(&self, paths: &[PixelSampler<'_>], out: [&mut [f32]; 2]) {
        let at_start = paths.iter().all(|path| path.dimension() == 0);
        if at_start && !matches!(self.plan, Plan::Sobol(_) | Plan::Halton(_)) {
            return self.fill_2d(paths, PIXEL_DIMENSION, out);
        }
        let [xs, ys] = out;
        for ((path, x), y) in paths.iter().zip(xs).zip(ys) {
            [*x, *y] = path.at(0).get_pixel_2d();
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
    index: [u64; CHUNK],
}

impl<'a> Chunk<'a> {
    fn new(sampler: &'a Sampler) -> Chunk<'a> {
        Chunk { sampler, n: 0, dimension: 0, keys: [0; CHUNK], index: [0; CHUNK] }
    }

    /// Takes the first of `paths`, as many as fit.
    fn gather<'p>(&mut self, paths: impl Iterator<Item = PixelSampler<'p>>) {
        let alike = self.sampler.has_tables();
        self.n = 0;
        for path in paths.take(CHUNK) {
            if self.n == 0 {
                self.dimension = path.dimension();
            } else if alike && path.dimension() != self.dimension {
                break;
            }
            (self.keys[self.n], self.index[self.n]) = (path.key_here(), path.index);
            self.n += 1;
        }
    }

    /// Fills columns, as long as the chunk, in lanes; where there is no such form with what `one` gives for each.
    fn fill<const N: usize>(&self, offset: u32, mut out: [&mut [f32]; N], one: impl Fn(usize) -> [f32; N]) {
        if self.has_columns(offset, N as u32) {
            return in_lanes(Columns { chunk: self, offset, out });
        }
        for k in 0..self.n {
            for (column, x) in out.iter_mut().zip(one(k)) {
                column[k] = x;
            }
        }
    }

    /// There is a form in lanes for `n` dimensions.
    fn has_columns(&self, offset: u32, n: u32) -> bool {
        let fast = self.sampler.config.randomize == Randomize::FastOwen;
        match self.sampler.plan {
            Plan::Independent => true,
            Plan::Padded | Plan::ZOrder { .. } => fast,
            Plan::Sobol(_) => {
                let first = self.dimension.wrapping_add(offset);
                fast && first.saturating_add(n) <= sobol::N_DIMENSIONS - PLANE
            }
            Plan::Stratified { .. } | Plan::Halton(_) => false,
        }
    }
}

/// Coordinates of the points of a chunk, into their places.
struct Columns<'a, const N: usize> {
    chunk: &'a Chunk<'a>,
    offset: u32,
    out: [&'a mut [f32]; N],
}

impl<const N: usize> InLanes for Columns<'_, N> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Columns { chunk, offset, mut out } = self;
        if let Plan::Sobol(tables) = &chunk.sampler.plan {
            return (offset..).zip(out).for_each(|(d, out)| store(&chunk.sobol(tables, d), out));
        }
        // The first of three stands before the pair.
        let (single, pair) = out.split_at_mut(N.saturating_sub(2));
        let of_pair = offset.wrapping_add(single.len() as u32);
        let (mut low, mut high) = ([0; CHUNK], [0; CHUNK]);
        if matches!(chunk.sampler.plan, Plan::Independent) {
            for out in single {
                split(&chunk.keys(offset), &mut low, &mut high);
                store(&low, out);
            }
            split(&chunk.keys(of_pair), &mut low, &mut high);
            return pair.iter_mut().zip([&low, &high]).for_each(|(out, v)| store(v, out));
        }
        let mut keys = chunk.keys(of_pair);
        let (mut seeds, mut first) = ([0; CHUNK], [0; CHUNK]);
        split(&keys, &mut seeds, &mut first);
        times_golden(&mut keys);
        split(&keys, &mut low, &mut high);
        let index = chunk.shuffled(&seeds, &low);
        store(&scrambled(&index, &first), pair[0]);
        if let Some(out) = pair.get_mut(1) {
            store(&scrambled(&index.map(second_dimension), &high), out);
        }
        for out in single {
            times_golden(&mut keys);
            split(&keys, &mut low, &mut high);
            store(&scrambled(&index.map(third_dimension), &high), out);
        }
    }
}

impl Chunk<'_> {
    /// [`PixelSampler::key_of`] of each.
    #[inline(always)]
    fn keys(&self, offset: u32) -> [u64; CHUNK] {
        let (mut keys, step) = (self.keys, key_step(offset));
        for k in &mut keys {
            *k = mix(k.wrapping_add(step));
        }
        keys
    }

    /// [`shuffled`](super::scramble::shuffled) indices.
    #[inline(always)]
    fn shuffled(&self, seeds: &Words, blocks: &Words) -> Words {
        let mut index = [0; CHUNK];
        for (i, reversed) in index.iter_mut().zip(&self.index) {
            *i = *reversed as u32;
        }
        for (i, s) in index.iter_mut().zip(seeds) {
            *i = nested(*i, *s).reverse_bits();
        }
        for (i, b) in index.iter_mut().zip(blocks) {
            *i = self.sampler.blocks.permute(*i, *b);
        }
        index
    }

    /// A coordinate of the global sequence, scrambled.
    #[inline(always)]
    fn sobol(&self, tables: &SobolTables, offset: u32) -> Words {
        let d = self.dimension + offset + PLANE;
        let used = self.index.iter().fold(0, |all, i| all | i);
        let (mut low, mut high) = ([0; CHUNK], [0; CHUNK]);
        split(&self.index, &mut low, &mut high);
        let mut v = [0u32; CHUNK];
        for j in (0..sobol::N_COLUMNS.min(64 - used.leading_zeros() as usize)).step_by(4) {
            let columns = tables.columns(d, j);
            let bits = if j < 32 { &low } else { &high };
            for (v, bits) in v.iter_mut().zip(bits) {
                let bits = (bits >> (j & 31)) as i32;
                for (k, column) in columns.iter().enumerate() {
                    // The bit, at every place of a word.
                    *v ^= column & (bits << (31 - k) >> 31) as u32;
                }
            }
        }
        for v in &mut v {
            *v = v.reverse_bits();
        }
        let mut seeds = [sobol_seed(self.sampler.seed, d, 0); CHUNK];
        if used >> sobol::N_COLUMNS != 0 {
            for (s, index) in seeds.iter_mut().zip(&self.index) {
                *s = sobol_seed(self.sampler.seed, d, sobol::turn(*index));
            }
        }
        scrambled(&v, &seeds)
    }
}

/// Lower and upper halves.
#[inline(always)]
fn split(words: &[u64; CHUNK], low: &mut Words, high: &mut Words) {
    for ((w, l), h) in words.iter().zip(low).zip(high) {
        (*l, *h) = (*w as u32, (*w >> 32) as u32);
    }
}

/// Keys of the next coordinate.
#[inline(always)]
fn times_golden(keys: &mut [u64; CHUNK]) {
    for k in keys {
        *k = k.wrapping_mul(GOLDEN);
    }
}

/// Scrambles numbers whose lowest bit leads, each by its seed; the result leads with its highest.
#[inline(always)]
fn scrambled(index: &Words, seeds: &Words) -> Words {
    let mut v = *index;
    for (v, s) in v.iter_mut().zip(seeds) {
        *v = nested(*v, *s).reverse_bits();
    }
    v
}

/// Binary fractions as numbers, as many as there are places.
#[inline(always)]
fn store(v: &Words, out: &mut [f32]) {
    for (x, v) in out.iter_mut().zip(v) {
        *x = to_unit(*v);
    }
}
