//! Rendering: tiles over threads, samples in passes, sums on a film.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use rayon::prelude::*;
use sparrow_spectra::Wavelengths;

use crate::film::{Film, FilmTile};
use crate::integrator::RayCounts;
use crate::plan::RenderPlan;
use crate::scene::Scene;

/// Pixels along the side of a tile.
const TILE: u32 = 16;
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
    /// Samples per pixel of the passes that were completed.
    pub samples_per_pixel: u32,
    /// It was stopped before its end.
    pub stopped: bool,
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
    /// Our own mistake: a tile did not fit the film.
    #[error("a tile does not fit its film ({0}); please report this")]
    Film(#[from] crate::film::FilmError),
}

/// State that all threads share.
struct Shared<'a> {
    scene: &'a Scene,
    plan: &'a RenderPlan,
    film: Mutex<Film>,
    rays: Mutex<RayCounts>,
    samples: AtomicU64,
    rays_so_far: AtomicU64,
    stop: &'a AtomicBool,
    deadline: Option<Instant>,
}

/// Renders a picture.
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
    watch: &(dyn Fn(Progress) + Sync),
) -> Result<(Film, RenderStats), RenderError> {
    let start = Instant::now();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build()
        .map_err(|e| RenderError::Threads { threads: options.threads, reason: e.to_string() })?;
    let [width, height] = plan.size();
    let film = Film::new(width, height, options.variance);
    let shared = Shared {
        scene,
        plan,
        film: Mutex::new(film),
        rays: Mutex::default(),
        samples: AtomicU64::new(0),
        rays_so_far: AtomicU64::new(0),
        stop,
        deadline: options.time_limit.map(|t| start + t),
    };
    let origins: Vec<[u32; 2]> = (0..height.div_ceil(TILE))
        .flat_map(|y| (0..width.div_ceil(TILE)).map(move |x| [x * TILE, y * TILE]))
        .collect();
    let samples_of = |per_pixel: u32| u64::from(width) * u64::from(height) * u64::from(per_pixel);
    let total = samples_of(plan.samples_per_pixel);
    let mut done = 0;
    let mut pass = 1;
    while done < plan.samples_per_pixel && !shared.ended() {
        let n = pass.min(plan.samples_per_pixel - done);
        pool.install(|| {
            origins.par_iter().try_for_each(|&origin| {
                shared.tile(origin, done..done + n, |rays, samples| {
                    watch(Progress { samples, samples_total: total, rays, elapsed: start.elapsed() });
                })
            })
        })?;
        if shared.samples.load(Ordering::Relaxed) < samples_of(done + n) {
            break; // It was stopped within the pass.
        }
        done += n;
        pass = (2 * pass).min(MAX_PASS);
    }
    let rays = *lock(&shared.rays);
    let samples = shared.samples.load(Ordering::Relaxed);
    let film = shared.film.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    let stats = RenderStats {
        rays,
        samples,
        samples_per_pixel: done,
        stopped: samples < total,
        rejected: film.rejected(),
        elapsed: start.elapsed(),
    };
    Ok((film, stats))
}

/// A thread that died held no half-made sums: tiles are absorbed whole.
fn lock<T>(m: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    m.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

impl Shared<'_> {
    fn ended(&self) -> bool {
        self.stop.load(Ordering::Relaxed) || self.deadline.is_some_and(|d| Instant::now() >= d)
    }

    /// Renders some samples of one tile, unless the render is to stop.
    fn tile(
        &self,
        origin: [u32; 2],
        samples: std::ops::Range<u32>,
        watch: impl Fn(u64, u64),
    ) -> Result<(), RenderError> {
        if self.ended() {
            return Ok(());
        }
        let mut tile = lock(&self.film).tile(origin, [TILE, TILE]);
        let mut rays = RayCounts::default();
        let [w, h] = tile.size();
        for y in origin[1]..origin[1] + h {
            for x in origin[0]..origin[0] + w {
                for sample in samples.clone() {
                    self.sample([x, y], sample, &mut tile, &mut rays);
                }
            }
        }
        lock(&self.film).absorb(&tile)?;
        *lock(&self.rays) += rays;
        let n = u64::from(w) * u64::from(h) * u64::from(samples.end - samples.start);
        let n_samples = self.samples.fetch_add(n, Ordering::Relaxed) + n;
        let n_rays = self.rays_so_far.fetch_add(rays.total(), Ordering::Relaxed) + rays.total();
        watch(n_rays, n_samples);
        Ok(())
    }

    /// One camera sample: wavelengths, time, place on film and lens, radiance, film.
    #[inline]
    fn sample(&self, pixel: [u32; 2], sample: u32, tile: &mut FilmTile, rays: &mut RayCounts) {
        let plan = self.plan;
        let [x, y] = [pixel[0] + plan.bounds[0], pixel[1] + plan.bounds[2]];
        let mut sampler = plan.sampler.start([x, y], sample);
        let mut lambda = Wavelengths::sample_visible(sampler.get_1d());
        let time = if self.scene.moves { self.scene.camera.time(sampler.get_1d()) } else { 0.0 };
        let f = plan.filter.sample(sampler.get_pixel_2d());
        sampler.set_dimension(2);
        let lens = sampler.get_2d();
        let film = [x as f32 + 0.5 + f.offset[0], y as f32 + 0.5 + f.offset[1]];
        let ray = self.scene.camera.ray(film, lens, time);
        let l = plan.integrator.radiance(self.scene, ray, &mut lambda, &mut sampler, rays);
        rays.camera += 1;
        rays.scattered -= 1;
        tile.add(pixel[0], pixel[1], plan.sensor.rgb(l, &lambda), f.weight);
    }
}
