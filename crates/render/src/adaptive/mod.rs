//! Rendering to a stated noise: [`render_to_noise`].
//!
//! **Noise** is the root of the relMSE that a converged picture would show, without the worst 0.1 % of the pixels, as
//! [`sparrow_image::metrics`] has it: `sqrt(mean((p - r)^2 / (r^2 + 0.01)))` over channels and all other pixels. It is estimated from two [`Halves`] with independent
//! points, since the scatter of stratified samples tells too much; see [`noise()`].
//!
//! **Pilot.** Both halves get the same number of samples everywhere, doubled until they make an eighth of what equal
//! numbers would need. **Main part.** Tiles get samples by the root of the variance that the pilot has seen in them,
//! in passes of which each about doubles the work, until the estimate is down at the target.
//!
//! **Why the mean stays.** To decide by the samples that are averaged biases a mean: where the pilot happened to miss the light,
//! it would stop early and stay dark. Here the number of samples of one half comes from the pilot of the *other*, with
//! which it is independent: given that number, half `A` is the mean of its pilot, on which the number does not depend, and
//! of fresh samples. Each half is thus unbiased in every pixel, and so is their mean, whose weights are fixed at 1/2.
//! What remains is the moment at which all ends (and the length of the pilot), two numbers for the whole picture: a pixel
//! shares in them with its part of the sum over all pixels.

mod allocation;
mod noise;

use std::sync::atomic::AtomicBool;

use self::allocation::{Allocation, Counts};
pub use self::noise::{TRIM, noise};
use crate::film::{Film, Halves};
use crate::plan::RenderPlan;
use crate::render::{Progress, RenderError, RenderOptions, RenderStats};
use crate::run::{Exposure, Job, Run, TILE};
use crate::sampler::SamplerConfig;
use crate::scene::Scene;

/// Samples of a pixel in one half before anything is estimated.
const FIRST: u32 = 8;
/// The pilot ends where this many times its samples would do, spread evenly.
const PILOT_SHARE: f64 = 8.0;
/// A seed of the second half, mixed with that of the first.
const OTHER_HALF: u64 = 0x5ba7_3c91_0e4d_2f68;

/// Renders until the noise is `target`, or every pixel has `plan.samples_per_pixel`.
///
/// As with [`crate::render()`] the picture does not depend on the number of threads, unless it is stopped.
/// The films keep variances whatever `options` say.
///
/// # Errors
/// Where threads cannot be started, or the sampler has one set of points only.
pub fn render_to_noise(
    scene: &Scene,
    plan: &RenderPlan,
    target: f64,
    options: &RenderOptions,
    stop: &AtomicBool,
    watch: &(dyn Fn(Progress) + Sync),
) -> Result<(Halves, RenderStats), RenderError> {
    let config = plan.sampler.config();
    if !config.is_random() {
        return Err(RenderError::SamePoints);
    }
    let how = plan.integrator.split(scene, plan);
    let other = SamplerConfig { seed: config.seed ^ OTHER_HALF, ..*config };
    let samplers = [config, &other].map(|config| plan.sampler_of_ways(config, how.splits));
    let [width, height] = plan.size();
    let exposures = samplers.each_ref().map(|sampler| Exposure::new(sampler, Film::new(width, height, true)));
    let run = Run::new(scene, plan, how, options, stop, watch)?;
    let mut render = Adaptive::new(&run, &exposures, plan);
    let ended = render.pilot(target)? && render.main_part(target)?;
    let (done, noise) = (render.least(), render.noise);
    let stats = run.stats();
    let halves = Halves(exposures.map(Exposure::into_film));
    let stats = RenderStats {
        samples_per_pixel: done,
        noise,
        stopped: !ended,
        rejected: halves.0[0].rejected() + halves.0[1].rejected(),
        ..stats
    };
    Ok((halves, stats))
}

/// A render to a stated noise, between two passes.
struct Adaptive<'a> {
    run: &'a Run<'a>,
    exposures: &'a [Exposure<'a>; 2],
    origins: Vec<[u32; 2]>,
    /// Pixels of each tile.
    pixels: Vec<f64>,
    /// Tiles in a row.
    columns: usize,
    /// Most samples of a pixel in one half.
    most: u32,
    counts: Counts,
    /// As estimated after the last whole pass.
    noise: Option<f64>,
}

impl<'a> Adaptive<'a> {
    fn new(run: &'a Run<'a>, exposures: &'a [Exposure<'a>; 2], plan: &RenderPlan) -> Adaptive<'a> {
        let [width, height] = plan.size();
        let origins = run.origins(TILE);
        let side = |origin: u32, end: u32| f64::from((end - origin).min(TILE));
        let pixels = origins.iter().map(|[x, y]| side(*x, width) * side(*y, height)).collect();
        let counts = [vec![0; origins.len()], vec![0; origins.len()]];
        Adaptive {
            run,
            exposures,
            pixels,
            columns: width.div_ceil(TILE) as usize,
            most: (plan.samples_per_pixel / 2).max(1),
            origins,
            counts,
            noise: None,
        }
    }

    /// Samples that every pixel has, of both halves.
    fn least(&self) -> u32 {
        self.counts.iter().map(|c| c.iter().copied().min().unwrap_or(0)).sum()
    }

    /// Renders up to these numbers of samples and estimates the noise; false where it was stopped.
    fn advance(&mut self, to: Counts) -> Result<bool, RenderError> {
        let mut jobs = Vec::new();
        for (tile, &origin) in self.origins.iter().enumerate() {
            for (h, exposure) in self.exposures.iter().enumerate() {
                let samples = self.counts[h][tile]..to[h][tile];
                if !samples.is_empty() {
                    jobs.push(Job { exposure, origin, side: TILE, samples });
                }
            }
        }
        if !self.run.pass(&jobs)? {
            return Ok(false);
        }
        drop(jobs);
        self.counts = to;
        let [a, b] = self.exposures.each_ref().map(Exposure::film);
        self.noise = Some(noise([&a, &b]));
        Ok(true)
    }

    /// There is nothing more to do.
    fn arrived(&self, target: f64) -> bool {
        self.noise.is_some_and(|n| n <= target) || self.counts.iter().flatten().all(|n| *n >= self.most)
    }

    /// Equal numbers everywhere, until they tell enough; false where it was stopped.
    fn pilot(&mut self, target: f64) -> Result<bool, RenderError> {
        let mut n = FIRST.min(self.most);
        loop {
            let to = [0, 1].map(|_: usize| vec![n; self.origins.len()]);
            if !self.advance(to)? {
                return Ok(false);
            }
            let needed = self.noise.map_or(1.0, |noise| noise * noise / (target * target));
            self.run.expect((self.run.samples() as f64 * needed) as u64);
            if self.arrived(target) || needed < PILOT_SHARE {
                return Ok(true);
            }
            n = n.saturating_mul(2).min(self.most);
        }
    }

    /// Samples where they are wanted; false where it was stopped.
    fn main_part(&mut self, target: f64) -> Result<bool, RenderError> {
        if self.arrived(target) {
            return Ok(true);
        }
        let demand = self.exposures.each_ref().map(|e| noise::demand(&e.film(), &self.origins, TILE));
        let range = [self.counts[0].first().copied().unwrap_or(0), self.most];
        let allocation = Allocation::new(demand, self.pixels.clone(), self.columns, range);
        while let Some(noise) = self.noise.filter(|_| !self.arrived(target)) {
            // Stratified samples leave less noise than independent ones would.
            let gain = noise * noise / allocation.error2(&self.counts);
            let within = |noise: f64| allocation.reach(noise * noise / gain);
            self.run.expect(allocation.total(&within(target)));
            // Half the square of the noise is about twice the work; below a few percent the estimate says little.
            let goal = target.max(noise / core::f64::consts::SQRT_2).min(0.97 * noise);
            let to = within(goal);
            let to = [0, 1].map(|h: usize| {
                to[h].iter().zip(&self.counts[h]).map(|(a, b)| *a.max(b)).collect::<Vec<u32>>()
            });
            if to == self.counts {
                break;
            }
            if !self.advance(to)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
