//! Few lights, each weighed for every point: [`FewLights`].

use sparrow_math::{InLanes, Mask, Real, in_lanes, vec3};

use super::LitPoint;
use super::bounds::LightBounds;
use super::eight::{EIGHT, Eight};

/// Most lights for which every choice weighs each of them.
pub(super) const WEIGH_ALL: usize = 64;

/// Points that are lit, and what decides for them, in columns that are as long as their number, rounded up to whole registers.
pub(crate) struct LitPoints<'a> {
    /// Points.
    pub(crate) p: [&'a [f32]; 3],
    /// Their shading normals.
    pub(crate) n: [&'a [f32]; 3],
    /// Uniform numbers.
    pub(crate) u: &'a [f32],
    /// How many points there are.
    pub(crate) n_points: usize,
}

impl LitPoints<'_> {
    /// One of them.
    #[inline]
    pub(crate) fn get(&self, k: usize) -> LitPoint {
        let vector = |c: &[&[f32]; 3]| vec3(c[0][k], c[1][k], c[2][k]);
        LitPoint { p: vector(&self.p), n: vector(&self.n) }
    }
}

/// Few lights, each weighed for every point: exact and quick.
#[derive(Debug)]
pub(super) struct FewLights {
    lights: Vec<u32>,
    bounds: Vec<Eight>,
}

/// Weights of few lights.
type Weights<R> = [R; WEIGH_ALL];

impl FewLights {
    /// At most [`WEIGH_ALL`] lights.
    pub(super) fn new(lights: &[(u32, LightBounds)]) -> FewLights {
        let mut bounds = vec![Eight::default(); lights.len().div_ceil(EIGHT)];
        for (i, (_, b)) in lights.iter().enumerate() {
            bounds[i / EIGHT].set(i % EIGHT, b);
        }
        FewLights { lights: lights.iter().map(|l| l.0).collect(), bounds }
    }

    /// A light and its probability, by the uniform number `u`; none where nothing shines.
    pub(super) fn choose(&self, at: &LitPoint, u: f32) -> Option<(u32, f32)> {
        let mut weights = [0.0; WEIGH_ALL];
        in_lanes(Weigh(&self.bounds, at, &mut weights));
        self.chosen(pick(&weights[..self.lights.len()], u))
    }
    fn chosen(&self, (place, share): (f32, f32)) -> Option<(u32, f32)> {
        (share > 0.0).then(|| (self.lights[place as usize], share))
    }

    /// [`choose`](Self::choose) for each of `points`, to the bit, in lanes.
    pub(super) fn choose_many(&self, points: &LitPoints<'_>, put: impl FnMut(usize, Option<(u32, f32)>)) {
        in_lanes(Choose { few: self, points, put });
    }

    pub(super) fn probability(&self, at: &LitPoint, light: u32) -> f32 {
        let Some(own) = self.lights.iter().position(|&l| l == light) else { return 0.0 };
        let mut weights = [0.0; WEIGH_ALL];
        in_lanes(Weigh(&self.bounds, at, &mut weights));
        let total: f32 = weights[..self.lights.len()].iter().sum();
        if weights[own] > 0.0 { weights[own] / total } else { 0.0 }
    }
}

/// Chooses one of the weights: its place and its share, which is zero where no weight is positive.
#[inline(always)]
fn pick<R: Real>(weights: &[R], u: R) -> (R, R) {
    let mut total = R::ZERO;
    for &w in weights {
        total = total + w;
    }
    let (mut left, mut open) = (u * total, R::Mask::of(true));
    let (mut place, mut own) = (R::ZERO, R::ZERO);
    for (i, &w) in weights.iter().enumerate() {
        // Rounding may leave a little beyond the last one, which then takes it.
        let here = open & w.gt(R::ZERO);
        place = R::select(here, R::of(i as f64), place);
        own = R::select(here, w, own);
        open = open & !(here & left.lt(w));
        left = R::select(here, left - w, left);
    }
    (place, R::select(own.gt(R::ZERO), own / total, R::ZERO))
}

/// Writes the importances of all of them for one point, lights in lanes.
struct Weigh<'a>(&'a [Eight], &'a LitPoint, &'a mut Weights<f32>);

impl InLanes for Weigh<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        for (eight, out) in self.0.iter().zip(self.2.chunks_exact_mut(EIGHT)) {
            out.copy_from_slice(&eight.importances::<R>(self.1));
        }
    }
}

/// Chooses for many points, points in lanes.
struct Choose<'a, P> {
    few: &'a FewLights,
    points: &'a LitPoints<'a>,
    put: P,
}

impl<P: FnMut(usize, Option<(u32, f32)>)> InLanes for Choose<'_, P> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(mut self) {
        let (LitPoints { p, n, u, n_points }, bounds) = (self.points, &self.few.bounds);
        let n_lights = self.few.lights.len().min(WEIGH_ALL);
        let mut weights = [R::ZERO; WEIGH_ALL];
        for k in (0..*n_points).step_by(R::WIDTH) {
            let p = vec3(R::load(p[0], k), R::load(p[1], k), R::load(p[2], k));
            let n = vec3(R::load(n[0], k), R::load(n[1], k), R::load(n[2], k));
            for (i, weight) in weights[..n_lights].iter_mut().enumerate() {
                *weight = bounds[i / EIGHT].spread::<R>(i).importance(p, n);
            }
            let (place, share) = pick(&weights[..n_lights], R::load(u, k));
            let (place, share) = (place.to_doubles(), share.to_doubles());
            for j in 0..R::WIDTH.min(n_points - k) {
                (self.put)(k + j, self.few.chosen((place[j] as f32, share[j] as f32)));
            }
        }
    }
}
