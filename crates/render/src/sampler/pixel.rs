//! [`Sampler`] and the state of one pixel sample, [`PixelSampler`].

use core::ops::Range;

use super::config::{Randomize, SamplerConfig, SamplerKind};
use super::halton::{self, HaltonTables};
use super::hash::{GOLDEN, join, mix, to_unit};
use super::scramble::{Blocks, padded_pair, padded_single, padded_triple, randomize};
use super::sobol::{self, SobolTables};
use super::{stratified, zorder};

/// The dimension number under which [`PixelSampler::get_pixel_2d`] draws.
pub(super) const PIXEL_DIMENSION: u32 = u32::MAX;

/// Path dimensions of the global sequences follow the two of the image plane.
pub(super) const PLANE: u32 = 2;

/// Logarithm of the block of samples that padded dimensions permute at random.
///
/// Only whole blocks are stratified, so the block divides the number of samples, unless that is large. One
/// sample per pixel: the block is four pixels.
fn log2_block(samples_per_pixel: u32) -> u32 {
    match samples_per_pixel {
        1 => 2,
        256.. => 4,
        n => n.trailing_zeros().min(4),
    }
}

/// Logarithm of how many samples have their reversed numbers in a table, at most.
const LOG2_REVERSED: u32 = 12;

/// What a dimension adds to a pixel sample's key.
#[inline(always)]
pub(super) fn key_step(dimension: u32) -> u64 {
    u64::from(dimension).wrapping_add(1).wrapping_mul(GOLDEN)
}

/// The seed that scrambles a dimension of the global Sobol sequence on its `turn`-th way through.
#[inline(always)]
pub(super) fn sobol_seed(seed: u64, dimension: u32, turn: u32) -> u32 {
    join(seed, u64::from(dimension) | (u64::from(turn) << 32)) as u32
}

/// Tables of the kinds, built once.
pub(super) enum Plan {
    Independent,
    Stratified {
        grid: [u32; 2],
        jitter: bool,
    },
    Padded,
    ZOrder {
        log2_spp: u32,
        /// Reversed numbers of the planned samples, or of the first of them.
        reversed: Vec<u32>,
    },
    Sobol(SobolTables),
    Halton(HaltonTables),
}

/// A point set over image, samples and dimensions; immutable, shared by all threads.
pub struct Sampler {
    pub(super) config: SamplerConfig,
    pub(super) plan: Plan,
    samples_per_pixel: u32,
    pub(super) blocks: Blocks,
    /// Hash of the configuration's seed: nearby seeds have unrelated keys.
    pub(super) seed: u64,
}

impl Sampler {
    /// Builds the tables: microseconds of work for the padded kinds, about a millisecond for the global ones.
    pub fn new(config: &SamplerConfig) -> Sampler {
        let seed = join(0x5eed, config.seed);
        let mut samples_per_pixel = config.samples_per_pixel.max(1);
        let plan = match config.kind {
            SamplerKind::Independent => Plan::Independent,
            SamplerKind::Stratified { x, y, jitter } => {
                let grid = [x.clamp(1, 65_535), y.clamp(1, 65_535)];
                samples_per_pixel = grid[0] * grid[1];
                Plan::Stratified { grid, jitter }
            }
            SamplerKind::PaddedSobol => Plan::Padded,
            SamplerKind::ZSobol | SamplerKind::Pmj02bn => {
                let log2_spp = 32 - (samples_per_pixel - 1).leading_zeros();
                let log2_spp = log2_spp.min(31);
                let n = 1 << log2_spp.min(LOG2_REVERSED);
                let reversed = (0..n).map(|sample| zorder::reversed_index(0, sample, log2_spp)).collect();
                Plan::ZOrder { log2_spp, reversed }
            }
            SamplerKind::Sobol => Plan::Sobol(SobolTables::new(config.resolution)),
            SamplerKind::Halton => Plan::Halton(HaltonTables::new(config.resolution, config.randomize, seed)),
        };
        let blocks = Blocks::new(log2_block(samples_per_pixel));
        Sampler { config: *config, plan, samples_per_pixel, blocks, seed }
    }

    /// Samples per pixel of the whole render: as configured, but `x * y` for the stratified kind.
    pub fn samples_per_pixel(&self) -> u32 {
        self.samples_per_pixel
    }

    /// What was built from.
    pub fn config(&self) -> &SamplerConfig {
        &self.config
    }

    /// Where the sampler departs from what was asked for, one sentence each, for the log.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let (asked, spp) = (self.config.samples_per_pixel, self.samples_per_pixel);
        let random = self.config.randomize;
        match self.config.kind {
            SamplerKind::Pmj02bn => notes.push(
                "sampler pmj02bn runs as zsobol: the same stratification of every pair and the same blue-noise \
                 error over the image, without pbrt's tables"
                    .to_owned(),
            ),
            SamplerKind::Stratified { x, y, .. } if asked != spp => {
                notes.push(format!("sampler stratified takes {x} x {y} strata: {spp} samples per pixel, not {asked}"));
            }
            SamplerKind::Halton if random == Randomize::FastOwen => {
                notes.push("sampler halton has no fast Owen scrambling; digit-wise Owen scrambling is used".to_owned());
            }
            SamplerKind::Independent
            | SamplerKind::Stratified { .. }
            | SamplerKind::Halton
            | SamplerKind::Sobol
            | SamplerKind::PaddedSobol
            | SamplerKind::ZSobol => {}
        }
        let base_two = matches!(self.plan, Plan::Padded | Plan::ZOrder { .. } | Plan::Sobol(_))
            && !spp.is_power_of_two();
        if base_two {
            notes.push(format!(
                "{spp} samples per pixel are rendered; a power of two would be better stratified"
            ));
        }
        notes
    }

    /// State of one pixel sample, at dimension 0.
    ///
    /// `pixel` counts in the full image. Samples beyond the configured number are valid and independent of
    /// the others as far as the kind allows.
    #[inline]
    pub fn start(&self, pixel: [u32; 2], sample: u32) -> PixelSampler<'_> {
        self.pixel(pixel).start(sample)
    }

    /// Goes on with a pixel sample at that dimension.
    #[inline(always)]
    pub(crate) fn resume(&self, SampleKey { key, index }: SampleKey, dimension: u32) -> PixelSampler<'_> {
        PixelSampler { sampler: self, key, index, dimension }
    }

    /// A pixel of the full image.
    #[inline]
    pub fn pixel(&self, place: [u32; 2]) -> Pixel<'_> {
        let (morton, key) = if let Plan::ZOrder { log2_spp, .. } = self.plan {
            let morton = zorder::paired_morton(place, self.seed);
            (morton, zorder::key(place, morton, 0, log2_spp, self.seed))
        } else {
            (0, join(self.seed, u64::from(place[0]) | (u64::from(place[1]) << 32)))
        };
        Pixel { sampler: self, place, morton, key }
    }
}

/// A pixel, with what all its samples have in common.
#[derive(Clone, Copy)]
pub struct Pixel<'a> {
    sampler: &'a Sampler,
    place: [u32; 2],
    /// Its place on the curve, where the kind follows one.
    morton: u32,
    /// Of the samples that were planned, for the kinds whose samples share one.
    key: u64,
}

impl<'a> Pixel<'a> {
    /// [`Sampler::start`] for a sample of this pixel.
    #[inline]
    pub fn start(&self, sample: u32) -> PixelSampler<'a> {
        let Pixel { sampler, place, morton, mut key } = *self;
        let index = match &sampler.plan {
            Plan::ZOrder { log2_spp, .. } => {
                let turn = sample >> log2_spp;
                if turn > 0 {
                    key = zorder::key(place, morton, turn, *log2_spp, sampler.seed);
                }
                u64::from(zorder::reversed_index(morton, sample, *log2_spp))
            }
            Plan::Padded => u64::from(sample.reverse_bits()),
            Plan::Independent => {
                key = join(key, u64::from(sample));
                u64::from(sample)
            }
            Plan::Stratified { .. } => u64::from(sample),
            Plan::Sobol(tables) => tables.index(place, sample),
            Plan::Halton(tables) => tables.index(place, sample),
        };
        PixelSampler { sampler, key, index, dimension: 0 }
    }

    /// What [`start`](Self::start) begins with for each of `samples`, added to `out`.
    pub(crate) fn start_all(&self, samples: Range<u32>, out: &mut Vec<SampleKey>) {
        let Pixel { sampler, morton, key, .. } = *self;
        if let Plan::ZOrder { log2_spp, reversed } = &sampler.plan
            && let Some(reversed) = reversed.get(samples.start as usize..samples.end as usize)
        {
            // All are planned, and share the pixel's key.
            let of_pixel = zorder::reversed_index(morton, 0, *log2_spp);
            let index = |of_sample: &u32| u64::from(of_pixel | of_sample);
            out.extend(reversed.iter().map(|of_sample| SampleKey { key, index: index(of_sample) }));
        } else {
            out.extend(samples.map(|sample| self.start(sample).sample_key()));
        }
    }
}

/// A pixel sample: what its numbers depend on, beside the sampler and the dimension.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SampleKey {
    key: u64,
    index: u64,
}

/// The numbers of one pixel sample, in the order of the dimensions.
///
/// A number is a function of the configuration, the pixel, the sample and the dimension alone, so two
/// stages of an integrator may each call [`Sampler::start`] and [`PixelSampler::set_dimension`].
#[derive(Clone, Copy)]
pub struct PixelSampler<'a> {
    sampler: &'a Sampler,
    /// Hash of the seed and whatever the kind scrambles by: pixel, sample, place on the curve.
    pub(super) key: u64,
    /// Index of the point; bit-reversed for the padded kinds.
    pub(super) index: u64,
    dimension: u32,
}

impl<'a> PixelSampler<'a> {
    /// The same pixel sample, at that dimension.
    #[inline]
    pub fn at(self, dimension: u32) -> PixelSampler<'a> {
        PixelSampler { dimension, ..self }
    }

    /// What [`Sampler::resume`] goes on with.
    #[inline]
    pub(crate) fn sample_key(&self) -> SampleKey {
        SampleKey { key: self.key, index: self.index }
    }

    /// The same pixel sample, so many dimensions on.
    #[inline]
    pub(super) fn after(self, offset: u32) -> PixelSampler<'a> {
        self.at(self.dimension.wrapping_add(offset))
    }

    /// What the key of a dimension is made of, but for how far it lies ahead: steps add up.
    #[inline(always)]
    pub(super) fn key_here(&self) -> u64 {
        self.key.wrapping_add(u64::from(self.dimension).wrapping_mul(GOLDEN))
    }

    /// The next dimension to be drawn.
    #[inline]
    pub fn dimension(&self) -> u32 {
        self.dimension
    }

    /// Goes to a dimension; a path may thus give each bounce a fixed range of them.
    #[inline]
    pub fn set_dimension(&mut self, dimension: u32) {
        self.dimension = dimension;
    }

    /// A uniform number; takes one dimension.
    #[inline]
    pub fn get_1d(&mut self) -> f32 {
        let d = self.dimension;
        self.dimension = d.wrapping_add(1);
        match &self.sampler.plan {
            Plan::Padded | Plan::ZOrder { .. } => to_unit(padded_single(
                self.index as u32,
                self.key_of(d),
                &self.sampler.blocks,
                self.sampler.config.randomize,
            )),
            Plan::Independent => to_unit(self.key_of(d) as u32),
            Plan::Stratified { grid, jitter } => {
                stratified::single(grid[0] * grid[1], *jitter, self.index as u32, self.key_of(d))
            }
            Plan::Sobol(tables) if d < sobol::N_DIMENSIONS - PLANE => self.sobol_value(tables, d),
            Plan::Halton(tables) if d < halton::N_DIMENSIONS - PLANE => tables.value(self.index, d + PLANE),
            Plan::Sobol(_) | Plan::Halton(_) => to_unit(padded_single(
                self.sample_reversed(),
                self.key_of(d),
                &self.sampler.blocks,
                self.padding(),
            )),
        }
    }

    /// A uniform point of the unit square, stratified as a pair; takes two dimensions.
    #[inline]
    pub fn get_2d(&mut self) -> [f32; 2] {
        let d = self.dimension;
        self.dimension = d.wrapping_add(2);
        self.pair(d)
    }

    /// A uniform point of the unit cube; takes three dimensions.
    ///
    /// The last two are what [`get_2d`](Self::get_2d) gives from the second dimension on. The padded kinds draw the first from the
    /// same point of a sequence in three dimensions, the others as [`get_1d`](Self::get_1d) does.
    #[inline]
    pub fn get_3d(&mut self) -> [f32; 3] {
        if let Plan::Padded | Plan::ZOrder { .. } = self.sampler.plan {
            let key = self.key_of(self.dimension.wrapping_add(1));
            self.dimension = self.dimension.wrapping_add(3);
            let Sampler { blocks, config, .. } = self.sampler;
            return padded_triple(self.index as u32, key, blocks, config.randomize).map(to_unit);
        }
        let first = self.get_1d();
        let [u, v] = self.get_2d();
        [first, u, v]
    }

    /// The point in the pixel, for the filter: a pair outside the dimensions, the same at each call.
    ///
    /// For the global sequences it is the place of the point in the image plane.
    #[inline]
    pub fn get_pixel_2d(&mut self) -> [f32; 2] {
        match &self.sampler.plan {
            Plan::Sobol(tables) => {
                let log2_side = tables.log2_side();
                let [x, y] = tables.plane(self.index);
                let how = self.sampler.config.randomize;
                [self.below_pixel(x, 0, log2_side, how), self.below_pixel(y, 1, log2_side, how)]
            }
            Plan::Halton(tables) => tables.offset(self.index),
            Plan::Independent | Plan::Stratified { .. } | Plan::Padded | Plan::ZOrder { .. } => {
                self.pair(PIXEL_DIMENSION)
            }
        }
    }

    #[inline]
    fn pair(&self, d: u32) -> [f32; 2] {
        match &self.sampler.plan {
            Plan::Padded | Plan::ZOrder { .. } => padded_pair(
                self.index as u32,
                self.key_of(d),
                &self.sampler.blocks,
                self.sampler.config.randomize,
            )
            .map(to_unit),
            Plan::Independent => {
                let h = self.key_of(d);
                [to_unit(h as u32), to_unit((h >> 32) as u32)]
            }
            Plan::Stratified { grid, jitter } => {
                stratified::pair(*grid, *jitter, self.index as u32, self.key_of(d))
            }
            Plan::Sobol(tables) if d < sobol::N_DIMENSIONS - PLANE - 1 => {
                [self.sobol_value(tables, d), self.sobol_value(tables, d + 1)]
            }
            Plan::Halton(tables) if d < halton::N_DIMENSIONS - PLANE - 1 => {
                [tables.value(self.index, d + PLANE), tables.value(self.index, d + PLANE + 1)]
            }
            Plan::Sobol(_) | Plan::Halton(_) => {
                padded_pair(self.sample_reversed(), self.key_of(d), &self.sampler.blocks, self.padding())
                    .map(to_unit)
            }
        }
    }

    /// Key of a dimension. A bijection of `key + dimension * odd`, so no two dimensions share one.
    #[inline(always)]
    fn key_of(&self, dimension: u32) -> u64 {
        mix(self.key.wrapping_add(key_step(dimension)))
    }

    #[inline]
    fn sobol_value(&self, tables: &SobolTables, d: u32) -> f32 {
        let v = tables.value(self.index, d + PLANE);
        let seed = sobol_seed(self.sampler.seed, d + PLANE, sobol::turn(self.index));
        to_unit(randomize(v.reverse_bits(), seed, self.sampler.config.randomize).reverse_bits())
    }

    /// Scrambles a plane coordinate below the bits that chose the pixel, and leaves those away.
    ///
    /// A nested scrambling that happens to keep the upper bits is still one. pbrt does not scramble
    /// here, so its pixel positions do not follow the seed.
    #[inline]
    fn below_pixel(&self, v: u32, axis: u32, log2_side: u32, how: Randomize) -> f32 {
        let seed = sobol_seed(self.sampler.seed, axis, sobol::turn(self.index));
        to_unit(randomize(v.reverse_bits(), seed, how).reverse_bits() << log2_side)
    }

    /// The sample number of a global sequence's point, bit-reversed, for the padded dimensions beyond its table.
    #[inline]
    fn sample_reversed(&self) -> u32 {
        let sample = match &self.sampler.plan {
            Plan::Sobol(tables) => self.index >> (2 * tables.log2_side()),
            Plan::Halton(tables) => self.index / tables.stride(),
            Plan::Independent | Plan::Stratified { .. } | Plan::Padded | Plan::ZOrder { .. } => self.index,
        };
        (sample as u32).reverse_bits()
    }

    /// Randomisation of padded dimensions beyond a table, where plain points would repeat those of the first pixel.
    #[inline]
    fn padding(&self) -> Randomize {
        match self.sampler.config.randomize {
            Randomize::Owen => Randomize::Owen,
            Randomize::None | Randomize::PermuteDigits | Randomize::FastOwen => Randomize::FastOwen,
        }
    }
}
