//! The path tracer over a block of paths side by side: [`Block`].
//!
//! The steps are those of the loop in `path.rs`, each done for all paths before the next: rays go to the geometry together, and
//! the vertices of one material are scattered in lanes. Every number is computed by the same text, and each path adds up its light
//! in the same order, so that both give the same bits; a test compares them on every scene of the repository.
//!
//! Nothing is allocated for a path: a thread works with one block, whose columns are filled again and again.

mod batch;
mod chosen;
mod colours;
mod column;
mod escapes;
mod families;
mod fresh;
mod groups;
mod lamps;
mod lanes;
mod lights;
mod onward;
mod paths;
mod shadow;
mod vertices;

use sparrow_geometry::{Hit, Ray};

use self::batch::Batch;
use self::colours::Colours;
use self::column::BATCH;
pub(crate) use self::column::{Column, pad};
use self::escapes::Escapes;
use self::families::Families;
use self::fresh::Fresh;
use self::groups::{Groups, Joined};
use self::lamps::Lamps;
use self::paths::{Paths, Steps};
use self::shadow::Shadows;
use super::start::FilmPlace;
use super::{Exposed, PathIntegrator, RayCounts, Record};
use crate::observe::TileObserver;
use crate::plan::RenderPlan;
use crate::sampler::Sampler;
use crate::samples::Samples;
use crate::scene::Scene;

/// Paths under way at once: enough to fill the lanes of several materials, few enough for the second cache.
const N_PATHS: usize = 1024;
/// In a small scene, which leaves them all of the cache.
const N_PATHS_OF_ROOM: usize = 2048;

/// Most shapes for which vertices are put together by shape: fewer than there are paths, so that many meet the same.
const FEW_SHAPES: usize = 64;

/// Paths side by side, and room for what happens at their vertices.
pub(crate) struct Block<R> {
    fresh: Fresh,
    paths: Paths<R>,
    families: Families,
    colours: Colours,
    /// Places of paths that have ended.
    ended: Vec<u32>,
    /// Places of paths that begin, and their families.
    begun: [Vec<u32>; 2],
    hits: Vec<Option<Hit>>,
    lamps: Lamps,
    escapes: Escapes,
    groups: Groups,
    joined: Joined,
    batch: Batch,
    shadows: Shadows,
    rays: RayCounts,
}

impl<R: Record + Default> Default for Block<R> {
    fn default() -> Self {
        Block {
            fresh: Fresh::default(),
            paths: Paths::default(),
            families: Families::default(),
            colours: Colours::default(),
            ended: Vec::new(),
            begun: Default::default(),
            hits: Vec::new(),
            lamps: Lamps::default(),
            escapes: Escapes::default(),
            groups: Groups::default(),
            joined: Joined::default(),
            batch: Batch::default(),
            shadows: Shadows::default(),
            rays: RayCounts::default(),
        }
    }
}

impl<R: Record + Default> Block<R> {
    /// Follows a path from each of `samples` and hands its light to `tile`. Says how many rays that took.
    pub(crate) fn render<T: TileObserver<Record = R>>(
        &mut self,
        scene: &Scene,
        sampler: &Sampler,
        samples: &mut Samples,
        tile: &mut Exposed<'_, T>,
    ) -> RayCounts {
        let how = tile.how;
        self.families.begin(how.splits);
        while self.generate(scene, tile.plan, &how, sampler, samples) {
            self.intersect(scene);
            self.emitted(scene, &how);
            self.branch(scene, tile.plan, &how, sampler);
            self.group(scene, sampler, &how);
            for (key, which) in self.joined.parts(BATCH) {
                if key == batch::passes(scene) {
                    pass(scene, &mut self.paths.ray, &self.hits, which);
                    continue;
                }
                self.batch.begin(scene, &how, sampler, (&mut self.paths, &self.hits), (key, which));
                self.batch.sample_lights(scene, &how, &self.paths);
                self.batch.bind(scene, (&mut self.paths, &self.hits), key);
                self.batch.direct(&how, &mut self.shadows);
                self.rays.scattered += self.batch.scatter(
                    (scene, &how),
                    (&mut self.paths, &mut self.ended),
                    tile.learned.map(|_| |pixel| tile.roulette(pixel)),
                );
            }
            self.rays.shadow += self.shadows.trace(scene, &mut self.paths);
            self.film(tile);
        }
        self.rays.scattered -= self.rays.camera;
        core::mem::take(&mut self.rays)
    }

    /// Fills the block with new paths; false where none is under way.
    fn generate(
        &mut self,
        scene: &Scene,
        plan: &RenderPlan,
        how: &PathIntegrator,
        sampler: &Sampler,
        samples: &mut Samples,
    ) -> bool {
        let Block { fresh, paths, families, ended, begun: [places, of], rays, .. } = self;
        let most = if scene.geometry().is_small() { N_PATHS_OF_ROOM } else { N_PATHS };
        let mut taken = 0;
        let mut room = most.saturating_sub(paths.len() - ended.len()) / how.splits as usize;
        while room > 0 && fresh.draw(scene, sampler, plan, samples, room) {
            let n = fresh.len();
            places.clear();
            places.extend(ended[taken..].iter().take(n));
            taken += places.len();
            places.extend((paths.len() as u32..).take(n - places.len()));
            of.clear();
            if how.splits > 1 {
                of.extend(fresh.places().map(|place| families.push(place)));
            }
            paths.begin(fresh, places, of);
            rays.camera += n as u64;
            room -= n;
        }
        paths.remove(&ended[taken..]);
        ended.clear();
        paths.len() > 0
    }

    /// Paths at their first vertex go on in several ways.
    fn branch(&mut self, scene: &Scene, plan: &RenderPlan, how: &PathIntegrator, sampler: &Sampler) {
        if how.splits == 1 || how.max_depth == 0 || how.max_smooth == 0 {
            return;
        }
        let paths = &mut self.paths;
        for i in 0..paths.len() {
            let there = self.hits[i].filter(|hit| scene.material_of(hit.shape).is_some());
            let Some(hit) = there.filter(|_| paths.steps[i].depth == 0) else { continue };
            let FilmPlace { pixel, sample, .. } = paths.place[i];
            for way in 1..how.splits {
                let sample = plan.sample_of_way(sample, way);
                let numbers = sampler.start(plan.in_full_picture(pixel), sample).sample_key();
                paths.branch(i, way, numbers);
                self.hits.push(Some(hit));
            }
            self.families.grow(paths.family[i], how.splits - 1);
        }
    }

    /// The nearest surface of each path's ray.
    fn intersect(&mut self, scene: &Scene) {
        self.rays.scattered += self.paths.len() as u64;
        scene.intersect_many(&self.paths.ray, &mut self.hits);
    }

    /// Light that the rays found.
    fn emitted(&mut self, scene: &Scene, how: &PathIntegrator) {
        let Block { paths, hits, lamps, escapes, .. } = self;
        let lights = scene.lights();
        let (around, nothing) = (lights.only_environment(), lights.infinite().is_empty());
        lamps.clear(lights.len());
        for (i, hit) in (0..).zip(&*hits) {
            match hit {
                Some(hit) => {
                    lights.of_primitive(hit.shape, hit.prim).into_iter().for_each(|l| lamps.push(l, i));
                }
                None if nothing => {}
                None if around.is_some() => escapes.push(i),
                None => paths.find(scene, how, i as usize, None),
            }
        }
        lamps.find(scene, how, paths, hits);
        if let Some(around) = around {
            escapes.find(scene, how, around, paths);
        }
    }

    /// Paths end, pass through, or have a vertex: these are put together by material, and where shapes are few, among those by shape.
    fn group(&mut self, scene: &Scene, sampler: &Sampler, how: &PathIntegrator) {
        let Block { paths, groups, joined, ended, hits, .. } = self;
        let PathIntegrator { max_depth, max_smooth, regularize, .. } = *how;
        let deep = move |s: &Steps| (s.depth == max_depth) | (s.n_smooth == max_smooth);
        let regularized = move |s: &Steps| regularize & (s.n_smooth > 0);
        let of_material = |shape: u32, regularized: bool| {
            scene
                .material_of(shape)
                .map_or(batch::passes(scene), |material| batch::key(material, regularized))
        };
        let by_shape = scene.n_shapes() <= FEW_SHAPES && !sampler.has_tables();
        groups.clear(if by_shape { 2 * scene.n_shapes() } else { batch::passes(scene) as usize + 1 });
        for ((hit, steps), i) in hits.iter().zip(&paths.steps).zip(0..) {
            let Some(hit) = hit.as_ref().filter(|_| !deep(steps)) else {
                ended.push(i);
                continue;
            };
            let (shape, regularized) = (hit.shape, regularized(steps));
            let key =
                if by_shape { 2 * shape + u32::from(regularized) } else { of_material(shape, regularized) };
            groups.push(key, i);
        }
        if sampler.has_tables() {
            groups.sort_by_depth(|i| paths.steps[i as usize].depth);
        }
        joined.fill(groups, |key| if by_shape { of_material(key / 2, key % 2 == 1) } else { key });
    }

    /// Hands over the light of paths that have ended, whose places are free.
    fn film<T: TileObserver<Record = R>>(&mut self, tile: &mut Exposed<'_, T>) {
        let Block { paths, ended, families, colours, .. } = self;
        let (plan, place, record) = (tile.plan, &paths.place[..], &paths.record[..paths.place.len()]);
        colours.measure(
            &plan.sensor,
            paths,
            ended,
            #[inline(always)]
            |i, r, g, b| {
                if tile.how.splits == 1 {
                    tile.take_rgb(place[i], [r, g, b], || paths.lambda(i), &record[i]);
                } else if let Some((place, parts)) = families.take(paths.family[i], paths.way[i], [r, g, b]) {
                    tile.take_parts(place, parts);
                }
            },
        );
    }
}

/// Rays go on behind surfaces of no material.
fn pass(scene: &Scene, rays: &mut [Ray], hits: &[Option<Hit>], which: &[u32]) {
    for i in which.iter().map(|i| *i as usize) {
        if let (ray, Some(hit)) = (&mut rays[i], &hits[i]) {
            *ray = scene.geometry().surface(ray, hit).spawn(ray.d);
        }
    }
}
