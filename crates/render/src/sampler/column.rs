//! Columns: one dimension of many pixel samples at once, equal to [`PixelSampler`]'s numbers bit for bit.
//!
//! Short loops over arrays of whole numbers, one operation each. [`in_lanes`] compiles them for the vector unit, and the
//! compiler turns each into lanes of eight.

use sparrow_math::{InLanes, Real, in_lanes};

use super::config::Randomize;
use super::hash::{GOLDEN, mix, to_unit};
use super::pixel::{PIXEL_DIMENSION, PLANE, PixelSampler, Plan, Sampler, key_step, sobol_seed};
use super::scramble::{nested, second_dimension};
use super::sobol::{self, SobolTables};

/// Pixel samples that are worked on together.
const CHUNK: usize = 64;

type Words = [u32; CHUNK];

impl Sampler {
    /// What [`PixelSampler::get_1d`] gives `offset` dimensions after where each of `paths` stands, which this sampler started.
    ///
    /// As many numbers as the shorter of both has places. Runs in lanes for the kinds `independent`, `zsobol`,
    /// `paddedsobol`, `pmj02bn` and, where neighbours stand at one dimension, `sobol` with fast Owen scrambling, else one by one.
    pub fn fill_1d(&self, paths: &[PixelSampler<'_>], offset: u32, out: &mut [f32]) {
        let mut out = out;
        for paths in self.runs(paths) {
            let (x, rest) = out.split_at_mut(paths.len().min(out.len()));
            out = rest;
            let dimension = paths[0].dimension().wrapping_add(offset);
            if !self.has_columns(dimension) {
                for (path, x) in paths.iter().zip(x) {
                    *x = path.after(offset).get_1d();
                }
                continue;
            }
            for (paths, x) in paths.chunks(CHUNK).zip(x.chunks_mut(CHUNK)) {
                in_lanes(Single(Column { sampler: self, paths, offset, dimension }, x));
            }
        }
    }

    /// What [`PixelSampler::get_2d`] gives `offset` dimensions after where each of `paths` stands, by coordinates; else as
    /// [`Sampler::fill_1d`].
    pub fn fill_2d(&self, paths: &[PixelSampler<'_>], offset: u32, out: [&mut [f32]; 2]) {
        let [mut xs, mut ys] = out;
        for paths in self.runs(paths) {
            let n = paths.len().min(xs.len()).min(ys.len());
            let ((x, more_x), (y, more_y)) = (xs.split_at_mut(n), ys.split_at_mut(n));
            (xs, ys) = (more_x, more_y);
            let dimension = paths[0].dimension().wrapping_add(offset);
            if !self.has_columns(dimension) || !self.has_columns(dimension.saturating_add(1)) {
                for ((path, x), y) in paths.iter().zip(x).zip(y) {
                    [*x, *y] = path.after(offset).get_2d();
                }
                continue;
            }
            for ((paths, x), y) in paths.chunks(CHUNK).zip(x.chunks_mut(CHUNK)).zip(y.chunks_mut(CHUNK)) {
                in_lanes(Pair(Column { sampler: self, paths, offset, dimension }, x, y));
            }
        }
    }

    /// Parts that run together: where dimensions have tables of their own, those that stand at the same.
    fn runs<'p, 's>(&self, paths: &'p [PixelSampler<'s>]) -> impl Iterator<Item = &'p [PixelSampler<'s>]> {
        let alike = !self.has_tables();
        paths.chunk_by(move |a, b| alike || a.dimension() == b.dimension())
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

    /// There is a form in lanes.
    fn has_columns(&self, dimension: u32) -> bool {
        match self.plan {
            Plan::Independent => true,
            Plan::Padded | Plan::ZOrder { .. } => self.config.randomize == Randomize::FastOwen,
            Plan::Sobol(_) => {
                self.config.randomize == Randomize::FastOwen && dimension < sobol::N_DIMENSIONS - PLANE
            }
            Plan::Stratified { .. } | Plan::Halton(_) => false,
        }
    }
}

/// One dimension of at most [`CHUNK`] pixel samples.
struct Column<'a> {
    sampler: &'a Sampler,
    paths: &'a [PixelSampler<'a>],
    /// After where each of them stands.
    offset: u32,
    /// Of the first; of all where the sampler [has tables](Sampler::has_tables).
    dimension: u32,
}

/// A column into its place.
struct Single<'a>(Column<'a>, &'a mut [f32]);
/// Two columns, of a pair, into their places.
struct Pair<'a>(Column<'a>, &'a mut [f32], &'a mut [f32]);

impl InLanes for Single<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Single(column, out) = self;
        match &column.sampler.plan {
            Plan::Sobol(tables) => store(&column.sobol(tables, 0), out),
            Plan::Independent => {
                let (mut low, mut high) = ([0; CHUNK], [0; CHUNK]);
                split(&column.keys(), &mut low, &mut high);
                store(&low, out);
            }
            Plan::Padded | Plan::ZOrder { .. } | Plan::Stratified { .. } | Plan::Halton(_) => {
                let p = column.shuffled();
                store(&scrambled(&p.index, &p.first), out);
            }
        }
    }
}

impl InLanes for Pair<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Pair(column, xs, ys) = self;
        match &column.sampler.plan {
            Plan::Sobol(tables) => {
                store(&column.sobol(tables, 0), xs);
                store(&column.sobol(tables, 1), ys);
            }
            Plan::Independent => {
                let (mut low, mut high) = ([0; CHUNK], [0; CHUNK]);
                split(&column.keys(), &mut low, &mut high);
                store(&low, xs);
                store(&high, ys);
            }
            Plan::Padded | Plan::ZOrder { .. } | Plan::Stratified { .. } | Plan::Halton(_) => {
                let mut p = column.shuffled();
                store(&scrambled(&p.index, &p.first), xs);
                for i in &mut p.index {
                    *i = second_dimension(*i);
                }
                store(&scrambled(&p.index, &p.second), ys);
            }
        }
    }
}

/// Indices of a padded dimension, shuffled, and the seeds that scramble its two coordinates.
struct Shuffled {
    index: Words,
    first: Words,
    second: Words,
}

impl Column<'_> {
    /// [`PixelSampler::key_of`] of each.
    #[inline(always)]
    fn keys(&self) -> [u64; CHUNK] {
        let mut keys = [0; CHUNK];
        for (k, path) in keys.iter_mut().zip(self.paths) {
            *k = path.key_here();
        }
        let step = key_step(self.offset);
        for k in &mut keys {
            *k = mix(k.wrapping_add(step));
        }
        keys
    }

    /// The first half of [`padded_pair`](super::scramble::padded_pair).
    #[inline(always)]
    fn shuffled(&self) -> Shuffled {
        let mut keys = self.keys();
        let (mut seed, mut first) = ([0; CHUNK], [0; CHUNK]);
        split(&keys, &mut seed, &mut first);
        for k in &mut keys {
            *k = k.wrapping_mul(GOLDEN);
        }
        let (mut block, mut second) = ([0; CHUNK], [0; CHUNK]);
        split(&keys, &mut block, &mut second);
        let mut index = [0; CHUNK];
        for (i, path) in index.iter_mut().zip(self.paths) {
            *i = path.index as u32;
        }
        for (i, s) in index.iter_mut().zip(&seed) {
            *i = nested(*i, *s).reverse_bits();
        }
        for (i, b) in index.iter_mut().zip(&block) {
            *i = self.sampler.blocks.permute(*i, *b);
        }
        Shuffled { index, first, second }
    }

    /// Coordinate `dimension + next` of the global sequence, scrambled.
    #[inline(always)]
    fn sobol(&self, tables: &SobolTables, next: u32) -> Words {
        let d = self.dimension + next + PLANE;
        let mut index = [0u64; CHUNK];
        for (i, path) in index.iter_mut().zip(self.paths) {
            *i = path.index;
        }
        let used = index.iter().fold(0, |all, i| all | i);
        let (mut low, mut high) = ([0; CHUNK], [0; CHUNK]);
        split(&index, &mut low, &mut high);
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
            for (s, path) in seeds.iter_mut().zip(self.paths) {
                *s = sobol_seed(self.sampler.seed, d, sobol::turn(path.index));
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
