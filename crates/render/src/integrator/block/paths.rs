//! The paths of a block: [`Paths`].

use sparrow_geometry::{Hit, Ray};
use sparrow_math::vec3;
use sparrow_spectra::{Spectrum, Wavelengths};

use super::fresh::Fresh;
use crate::integrator::start::FilmPlace;
use crate::integrator::{Finder, PathIntegrator, Record};
use crate::light::LitPoint;
use crate::sampler::SampleKey;
use crate::scene::{LastVertex, Scene};

/// What stands for the density of a direction that a delta lobe gave, or the camera.
pub(super) const NO_DENSITY: f64 = -1.0;

/// What a path has been through.
#[derive(Clone, Copy)]
pub(super) struct Steps {
    /// Scattering events.
    pub(super) depth: u32,
    /// Those by lobes that are no delta.
    pub(super) n_smooth: u32,
    /// Undoes the squeeze of refraction.
    pub(super) eta_scale: f32,
}

impl Steps {
    /// None yet.
    const NONE: Steps = Steps { depth: 0, n_smooth: 0, eta_scale: 1.0 };
}

/// Paths under way, a column for each thing that is known of them. What lanes of paths need together stands in rows of eight
/// numbers, which they read and write at once.
pub(super) struct Paths<R> {
    pub(super) place: Vec<FilmPlace>,
    /// Of which sample the uniform numbers are.
    pub(super) numbers: Vec<SampleKey>,
    pub(super) ray: Vec<Ray>,
    /// Light that the path has found, and the densities of its wavelengths.
    pub(super) found: Vec<[f32; 8]>,
    /// What the path carries, and its wavelengths in nm.
    pub(super) carried: Vec<[f32; 8]>,
    /// The last vertex: its place, the density of the direction taken or [`NO_DENSITY`], and its shading normal.
    pub(super) behind: Vec<[f32; 8]>,
    pub(super) steps: Vec<Steps>,
    /// Which way on from the first vertex it takes, where there are several.
    pub(super) way: Vec<u32>,
    /// Of the camera sample that it belongs to, where there are several ways.
    pub(super) family: Vec<u32>,
    pub(super) record: Vec<R>,
    /// While paths are taken away: whose places are free, and from where to where others go.
    free: Vec<bool>,
    moves: Vec<[u32; 2]>,
}

impl<R> Default for Paths<R> {
    fn default() -> Self {
        Paths {
            place: Vec::new(),
            numbers: Vec::new(),
            ray: Vec::new(),
            found: Vec::new(),
            carried: Vec::new(),
            behind: Vec::new(),
            steps: Vec::new(),
            way: Vec::new(),
            family: Vec::new(),
            record: Vec::new(),
            free: Vec::new(),
            moves: Vec::new(),
        }
    }
}

/// Moves what belongs to paths of a column from one place to another, and keeps `n`.
fn keep<T>(column: &mut Vec<T>, moves: &[[u32; 2]], n: usize) {
    moves.iter().for_each(|[from, to]| column.swap(*from as usize, *to as usize));
    column.truncate(n);
}

impl<R> Paths<R> {
    pub(super) fn len(&self) -> usize {
        self.ray.len()
    }

    /// What path `i` carries.
    #[inline(always)]
    pub(super) fn beta(&self, i: usize) -> Spectrum<f32> {
        let [a, b, c, d, ..] = self.carried[i];
        Spectrum([a, b, c, d])
    }
    /// The wavelengths of path `i`.
    #[inline(always)]
    pub(super) fn lambda(&self, i: usize) -> Wavelengths {
        let ([.., a, b, c, d], [.., p, q, r, s]) = (self.carried[i], self.found[i]);
        Wavelengths::with_pdf([a, b, c, d], [p, q, r, s])
    }
    /// Lets path `i` go on with the hero wavelength alone.
    pub(super) fn terminate_secondary(&mut self, i: usize) {
        let mut w = self.lambda(i);
        w.terminate_secondary();
        self.found[i][4..].copy_from_slice(&w.pdf);
    }
    /// Path `i` has found that light.
    #[inline(always)]
    pub(super) fn add(&mut self, i: usize, light: Spectrum<f32>) {
        self.found[i].iter_mut().zip(light.0).for_each(|(sum, l)| *sum += l);
    }
    /// What cast the ray of path `i`.
    #[inline(always)]
    pub(super) fn finder(&self, i: usize) -> Finder {
        self.steps[i].depth.checked_sub(1).map_or(Finder::Camera, Finder::Bsdf)
    }
    /// The vertex with which the direction of path `i` was drawn, unless a delta lobe gave it, or the camera.
    #[inline(always)]
    pub(super) fn last(&self, i: usize) -> Option<LastVertex> {
        let [x, y, z, pdf, nx, ny, nz, _] = self.behind[i];
        (pdf >= 0.0).then_some(LastVertex { at: LitPoint { p: vec3(x, y, z), n: vec3(nx, ny, nz) }, pdf })
    }
}

impl<R: Record + Default> Paths<R> {
    /// Paths of those families begin in those places: of paths that have ended, then behind the last.
    pub(super) fn begin(&mut self, fresh: &Fresh, places: &[u32], families: &[u32]) {
        let n = places.last().map_or(0, |i| *i as usize + 1).max(self.len());
        self.grow(n);
        fresh.put(places, Ray::rows_mut(&mut self.ray), &mut self.carried, &mut self.found);
        // As long as each other, so that one look at a place is enough.
        let (place, numbers, behind) = (&mut self.place[..n], &mut self.numbers[..n], &mut self.behind[..n]);
        let steps = &mut self.steps[..n];
        for ((&i, start), key) in places.iter().zip(fresh.places()).zip(fresh.keys()) {
            let i = i as usize;
            (place[i], numbers[i]) = (start, *key);
            (behind[i], steps[i]) = (BEGIN, Steps::NONE);
            self.record[i] = R::default();
        }
        for (&i, of) in places.iter().zip(families) {
            (self.way[i as usize], self.family[i as usize]) = (0, *of);
        }
    }

    /// Makes room for `n` paths.
    fn grow(&mut self, n: usize) {
        if n == self.len() {
            return;
        }
        self.place.resize(n, FilmPlace::default());
        self.numbers.resize(n, SampleKey::default());
        self.ray.resize(n, Ray::new(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 0.0)));
        self.found.resize(n, [0.0; 8]);
        self.carried.resize(n, [0.0; 8]);
        self.behind.resize(n, BEGIN);
        self.steps.resize(n, Steps::NONE);
        self.way.resize(n, 0);
        self.family.resize(n, 0);
        self.record.resize_with(n, R::default);
    }

    /// Another way on from the first vertex of path `i`; what the path has found up to there stays with the first.
    pub(super) fn branch(&mut self, i: usize, way: u32, numbers: SampleKey) {
        self.place.push(self.place[i]);
        self.numbers.push(numbers);
        self.ray.push(self.ray[i]);
        let [.., p, q, r, s] = self.found[i];
        self.found.push([0.0, 0.0, 0.0, 0.0, p, q, r, s]);
        self.carried.push(self.carried[i]);
        self.behind.push(self.behind[i]);
        self.steps.push(self.steps[i]);
        self.way.push(way);
        self.family.push(self.family[i]);
        self.record.push(R::default());
    }

    /// Adds the light that the ray of path `i` found, at `hit` or where it left the scene.
    pub(super) fn find(&mut self, scene: &Scene, how: &PathIntegrator, i: usize, hit: Option<&Hit>) {
        let (ray, beta, last, by) = (&self.ray[i], self.beta(i), self.last(i), self.finder(i));
        let (lambda, record) = (self.lambda(i), &mut self.record[i]);
        let point = hit.map(|hit| scene.geometry().surface(ray, hit));
        let found = |light, w| record.found(by, beta * light, w);
        let l = scene.emitted(ray, point.as_ref(), last.as_ref(), how.mis, &lambda, found);
        self.add(i, beta * l);
    }

    /// Takes away the paths that have `ended`; the last of the others go to their places.
    pub(super) fn remove(&mut self, ended: &[u32]) {
        if ended.is_empty() {
            return;
        }
        self.free.clear();
        self.free.resize(self.len(), false);
        ended.iter().for_each(|i| self.free[*i as usize] = true);
        let (all, n) = (self.len(), self.len() - ended.len());
        let last = (n..all).filter(|i| !self.free[*i]);
        let places = (0..n).filter(|i| self.free[*i]);
        let moves = &mut self.moves;
        moves.clear();
        moves.extend(last.zip(places).map(|(from, to)| [from as u32, to as u32]));
        keep(&mut self.place, moves, n);
        keep(&mut self.numbers, moves, n);
        keep(&mut self.ray, moves, n);
        keep(&mut self.found, moves, n);
        keep(&mut self.carried, moves, n);
        keep(&mut self.behind, moves, n);
        keep(&mut self.steps, moves, n);
        keep(&mut self.way, moves, n);
        keep(&mut self.family, moves, n);
        keep(&mut self.record, moves, n);
    }
}

/// What lies behind a path that begins.
const BEGIN: [f32; 8] = [0.0, 0.0, 0.0, NO_DENSITY as f32, 0.0, 0.0, 0.0, 0.0];
