//! Rendering: tiles over threads, samples in passes, sums on a film.

use std::sync::atomic::AtomicBool;
use std::time::Duration;

use sparrow_mis::Mis;

use crate::film::Film;
use crate::integrator::RayCounts;
use crate::observe::{Learning, Observer, Sorting, Strategies};
use crate::plan::RenderPlan;
use crate::run::{Exposure, Job, Run};
use crate::sampler::{Sampler, SamplerConfig};
use crate::scene::Scene;

/// Most samples per pixel of one pass: between passes a render can stop with an even picture.
const MAX_PASS: u32 = 32;

/// How a render is run; nothing here changes the picture of a render that ends.
#[derive(Clone, Copy, Debug)]
pub struct RenderOptions {
    /// Number of threads; 0 for one per core.
    pub threads: usize,
    /// Keep what the variance of each pixel needs.
    pub variance: bool,
    /// Stop after this time, with what is there.
    pub time_limit: Option<Duration>,
}

/// Where a render stands.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Camera samples taken.
    pub samples: u64,
    /// Camera samples of the whole render.
    pub samples_total: u64,
    /// Rays traced.
    pub rays: u64,
    /// Time since the start.
    pub elapsed: Duration,
}

/// What a render did.
#[derive(Clone, Copy, Debug, Default)]
pub struct RenderStats {
    /// Rays by kind.
    pub rays: RayCounts,
    /// Camera samples taken.
    pub samples: u64,
    /// Samples that every pixel has from the passes that were completed.
    pub samples_per_pixel: u32,
    /// Estimate of the noise, where the render was to reach one; see [`crate::adaptive`].
    pub noise: Option<f64>,
    /// It was stopped before its end.
    pub stopped: bool,
    /// Ways on from the first vertex of each camera sample.
    pub splits: u32,
    /// Samples that were no numbers and were left out.
    pub rejected: u64,
    /// Time taken.
    pub elapsed: Duration,
}

/// A render cannot run.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The threads could not be started.
    #[error("cannot start {threads} threads: {reason}; use fewer with --threads")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the system says.
        reason: String,
    },
    /// Two renders with different seeds would take the same points, so that their difference tells nothing.
    #[error(
        "noise is estimated from two pictures with points of their own, and randomization \"none\" has one set of \
         points; use \"fastowen\" in the scene's sampler, or --spp in place of --noise"
    )]
    SamePoints,
    /// Our own mistake: a tile did not fit the film.
    #[error("a tile does not fit its film ({0}); please report this")]
    Film(#[from] crate::film::FilmError),
}

/// What those who wait for a render want to be told.
type Watch<'a> = &'a (dyn Fn(Progress) + Sync);

/// Renders a picture with the same number of samples in every pixel.
///
/// The film holds exact sums, so the picture depends on neither threads, tiles nor passes. `stop` ends the render
/// at the next tile; `watch` is told after each tile, from any thread.
///
/// # Errors
/// Where threads cannot be started.
pub fn render(
    scene: &Scene,
    plan: &RenderPlan,
    options: &RenderOptions,
    stop: &AtomicBool,
    watch: Watch<'_>,
) -> Result<(Film, RenderStats), RenderError> {
    if plan.integrator.mis == Mis::Optimal {
        return observed(scene, plan, options, stop, watch, &Learning::new(plan.size()));
    }
    observed(scene, plan, options, stop, watch, &())
}

/// [`render()`], to the same bits, with the light of each sampling technique apart. [`Mis::Optimal`] counts as balance here.
///
/// # Errors
/// Where threads cannot be started.
pub fn render_strategies(
    scene: &Scene,
    plan: &RenderPlan,
    options: &RenderOptions,
    stop: &AtomicBool,
    watch: Watch<'_>,
) -> Result<(Film, Strategies, RenderStats), RenderError> {
    let sorting = Sorting::new(plan.size(), plan.integrator.mis);
    let (film, stats) = observed(scene, plan, options, stop, watch, &sorting)?;
    Ok((film, sorting.into_films(), stats))
}

fn observed<O: Observer>(
    scene: &Scene,
    plan: &RenderPlan,
    options: &RenderOptions,
    stop: &AtomicBool,
    watch: Watch<'_>,
    observer: &O,
) -> Result<(Film, RenderStats), RenderError> {
    let how = if O::WHOLE_PATHS { plan.integrator } else { plan.integrator.split(scene, plan) };
    let points = plan.sampler_of_ways(plan.sampler.config(), how.splits);
    let run = Run::new(scene, plan, how, options, stop, watch)?;
    let [width, height] = plan.size();
    let mut film = Film::new(width, height, options.variance);
    let total = u64::from(width) * u64::from(height) * u64::from(plan.samples_per_pixel);
    run.expect(total);
    let mut done = 0;
    let mut pass = 1;
    while done < plan.samples_per_pixel && !run.ended() {
        let n = pass.min(plan.samples_per_pixel - done);
        let own = if O::LEARNS { points_of_pass(&points, done, n) } else { None };
        let (sampler, samples) = own.as_ref().map_or((&points, done..done + n), |s| (s, 0..n));
        let exposure = Exposure::observed(sampler, film, observer);
        let job = |(origin, side)| Job { exposure: &exposure, origin, side, samples: samples.clone() };
        let whole = run.pass(&run.tiles(n).into_iter().map(job).collect::<Vec<Job<'_, O>>>())?;
        film = exposure.into_film();
        if !whole {
            break; // It was stopped within the pass.
        }
        done += n;
        pass = (2 * pass).min(MAX_PASS);
    }
    let stats = run.stats();
    let stats = RenderStats {
        samples_per_pixel: done,
        stopped: stats.samples < total,
        rejected: film.rejected(),
        ..stats
    };
    Ok((film, stats))
}

/// Points of one pass, independent of those of all others; none where there is one set of points only.
fn points_of_pass(sampler: &Sampler, done: u32, n: u32) -> Option<Sampler> {
    let config = sampler.config();
    let seed = config.seed ^ u64::from(done).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    config.is_random().then(|| Sampler::new(&SamplerConfig { seed, samples_per_pixel: n, ..*config }))
}
