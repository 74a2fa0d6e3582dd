//! A render under way: tiles over threads, until the work is done or it is told to stop.

use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::Instant;

use sparrow_scene::RouletteName;

use crate::film::Film;
use crate::integrator::{Block, CameraNumbers, CameraSample, Exposed, PathIntegrator, RayCounts};
use crate::observe::{Observer, TileObserver};
use crate::plan::RenderPlan;
use crate::render::{Progress, RenderError, RenderOptions, RenderStats};
use crate::roulette::{Learned, learn};
use crate::sampler::Sampler;
use crate::samples::Samples;
use crate::scene::Scene;

/// Pixels along the side of a tile, at least.
pub(crate) const TILE: u32 = 16;
/// Camera samples that a tile should have: where they end, blocks of paths run half empty.
const TILE_SAMPLES: u32 = 1 << 14;
/// Tiles a thread should have, so that none waits for another for long.
const TILES_PER_THREAD: u32 = 6;

/// A film with the points that fill it, and who looks on.
pub(crate) struct Exposure<'a, O = ()> {
    pub(crate) sampler: &'a Sampler,
    film: Mutex<Film>,
    observer: &'a O,
}

impl<'a> Exposure<'a> {
    pub(crate) fn new(sampler: &'a Sampler, film: Film) -> Exposure<'a> {
        Exposure::observed(sampler, film, &())
    }
}

impl<'a, O> Exposure<'a, O> {
    pub(crate) fn observed(sampler: &'a Sampler, film: Film, observer: &'a O) -> Exposure<'a, O> {
        Exposure { sampler, film: Mutex::new(film), observer }
    }
    /// Looks at the film between passes.
    pub(crate) fn film(&self) -> std::sync::MutexGuard<'_, Film> {
        lock(&self.film)
    }
    pub(crate) fn into_film(self) -> Film {
        self.film.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

/// Some samples of every pixel of one tile.
pub(crate) struct Job<'a, O = ()> {
    pub(crate) exposure: &'a Exposure<'a, O>,
    pub(crate) origin: [u32; 2],
    /// Pixels along each side.
    pub(crate) side: u32,
    pub(crate) samples: Range<u32>,
}

/// State that all threads share.
pub(crate) struct Run<'a> {
    scene: &'a Scene,
    plan: &'a RenderPlan,
    how: PathIntegrator,
    stop: &'a AtomicBool,
    watch: &'a (dyn Fn(Progress) + Sync),
    start: Instant,
    deadline: Option<Instant>,
    pool: rayon::ThreadPool,
    rays: Mutex<RayCounts>,
    samples: AtomicU64,
    samples_total: AtomicU64,
    rays_so_far: AtomicU64,
    learned: Option<Learned>,
}

impl<'a> Run<'a> {
    /// # Errors
    /// Where threads cannot be started.
    pub(crate) fn new(
        scene: &'a Scene,
        plan: &'a RenderPlan,
        how: PathIntegrator,
        options: &RenderOptions,
        stop: &'a AtomicBool,
        watch: &'a (dyn Fn(Progress) + Sync),
    ) -> Result<Run<'a>, RenderError> {
        let start = Instant::now();
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(options.threads)
            .build()
            .map_err(|e| RenderError::Threads { threads: options.threads, reason: e.to_string() })?;
        // The first bounce is not played for.
        let wanted = how.roulette == RouletteName::Efficiency && how.max_depth > 1 && how.max_smooth > 1;
        let learned = wanted.then(|| pool.install(|| learn(scene, plan)));
        Ok(Run {
            learned,
            scene,
            plan,
            how,
            stop,
            watch,
            start,
            deadline: options.time_limit.map(|t| start + t),
            pool,
            rays: Mutex::default(),
            samples: AtomicU64::new(0),
            samples_total: AtomicU64::new(0),
            rays_so_far: AtomicU64::new(0),
        })
    }

    /// The tiles of a pass that takes so many samples a pixel: the first pixel of each, and pixels along its sides. The last are small, so
    /// that threads end together.
    pub(crate) fn tiles(&self, samples: u32) -> Vec<([u32; 2], u32)> {
        let n_threads = self.pool.current_num_threads() as u32;
        let n_tiles = |side: u32| self.plan.size().map(|s| s.div_ceil(side)).iter().product::<u32>();
        let mut side = TILE;
        while side * side * samples < TILE_SAMPLES && n_tiles(2 * side) >= TILES_PER_THREAD * n_threads {
            side *= 2;
        }
        let [width, height] = self.plan.size();
        let (mut tiles, origins, half) = (Vec::new(), self.origins(side), side / 2);
        let n_large =
            if n_threads > 1 && half >= TILE { origins.len() - origins.len() / 4 } else { origins.len() };
        for (i, [x, y]) in origins.into_iter().enumerate() {
            if i < n_large {
                tiles.push(([x, y], side));
                continue;
            }
            let parts = [[x, y], [x + half, y], [x, y + half], [x + half, y + half]];
            tiles.extend(parts.into_iter().filter(|[x, y]| *x < width && *y < height).map(|at| (at, half)));
        }
        tiles
    }

    /// First pixels of all tiles of that side, row by row.
    pub(crate) fn origins(&self, side: u32) -> Vec<[u32; 2]> {
        let [width, height] = self.plan.size();
        (0..height.div_ceil(side))
            .flat_map(|y| (0..width.div_ceil(side)).map(move |x| [x * side, y * side]))
            .collect()
    }

    pub(crate) fn ended(&self) -> bool {
        self.stop.load(Ordering::Relaxed) || self.deadline.is_some_and(|d| Instant::now() >= d)
    }

    /// Camera samples taken.
    pub(crate) fn samples(&self) -> u64 {
        self.samples.load(Ordering::Relaxed)
    }

    /// Tells those who watch how many camera samples there will be.
    pub(crate) fn expect(&self, samples_total: u64) {
        self.samples_total.store(samples_total, Ordering::Relaxed);
    }

    /// Works off all jobs, in their order; false where the render was stopped within them.
    pub(crate) fn pass<'j, O: Observer>(&self, jobs: &[Job<'j, O>]) -> Result<bool, RenderError> {
        let (whole, next) = (AtomicBool::new(true), AtomicUsize::new(0));
        let done = self.pool.broadcast(|_| {
            let mut block = Block::default();
            while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                if self.ended() {
                    whole.store(false, Ordering::Relaxed);
                    break;
                }
                self.tile(job, &mut block)?;
            }
            Ok(())
        });
        done.into_iter().collect::<Result<(), RenderError>>()?;
        Ok(whole.into_inner())
    }

    /// What was done up to now.
    pub(crate) fn stats(&self) -> RenderStats {
        RenderStats {
            rays: *lock(&self.rays),
            samples: self.samples(),
            elapsed: self.start.elapsed(),
            splits: self.how.splits,
            ..RenderStats::default()
        }
    }

    /// Paths one after the other, by the readable loop.
    fn one_by_one<T: TileObserver>(
        &self,
        sampler: &Sampler,
        samples: impl Iterator<Item = ([u32; 2], u32)>,
        tile: &mut Exposed<'_, T>,
    ) -> RayCounts {
        let mut rays = RayCounts::default();
        let how = tile.how;
        let mut parts = Vec::new();
        for (pixel, sample) in samples {
            let start = |sample| sampler.start(self.plan.in_full_picture(pixel), sample);
            let numbers = CameraNumbers::new(&start(sample));
            let CameraSample { place, lambda, ray } =
                CameraSample::new(self.scene, self.plan, pixel, sample, &numbers);
            parts.clear();
            let roulette = tile.roulette(pixel);
            for way in 0..how.splits {
                let mut sampler = start(self.plan.sample_of_way(sample, way));
                let (mut lambda, mut record) = (lambda, T::Record::default());
                let l = how.radiance_of_way(
                    way,
                    self.scene,
                    ray,
                    &mut lambda,
                    &mut sampler,
                    &mut rays,
                    &mut record,
                    roulette,
                );
                if how.splits == 1 {
                    tile.take(place, l, &lambda, &record);
                } else {
                    parts.push(tile.part(l, &lambda));
                }
            }
            rays.camera += 1;
            rays.scattered -= 1;
            if how.splits > 1 {
                tile.take_parts(place, &parts);
            }
        }
        rays
    }

    fn tile<'j, O: Observer>(
        &self,
        job: &Job<'j, O>,
        block: &mut Block<<O::Tile as TileObserver>::Record>,
    ) -> Result<(), RenderError> {
        let Job { exposure, origin, side, samples } = job;
        let film = exposure.film().tile(*origin, [*side; 2]);
        let observer = exposure.observer.tile(*origin, [*side; 2]);
        let [w, h] = film.size();
        let learned = self.learned.as_ref();
        let mut tile = Exposed { plan: self.plan, how: self.how, learned, film, observer };
        let mut each = Samples::new(*origin, [w, h], samples.clone());
        let rays = if self.plan.one_by_one {
            self.one_by_one(exposure.sampler, each, &mut tile)
        } else {
            block.render(self.scene, exposure.sampler, &mut each, &mut tile)
        };
        exposure.film().absorb(&tile.film)?;
        exposure.observer.absorb(&tile.observer)?;
        *lock(&self.rays) += rays;
        let n = u64::from(w) * u64::from(h) * u64::from(samples.end - samples.start);
        let n_samples = self.samples.fetch_add(n, Ordering::Relaxed) + n;
        let n_rays = self.rays_so_far.fetch_add(rays.total(), Ordering::Relaxed) + rays.total();
        (self.watch)(Progress {
            samples: n_samples,
            samples_total: self.samples_total.load(Ordering::Relaxed),
            rays: n_rays,
            elapsed: self.start.elapsed(),
        });
        Ok(())
    }
}

/// A thread that died held no half-made sums: tiles are absorbed whole.
fn lock<T>(m: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    m.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}
