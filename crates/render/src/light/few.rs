//! Few lights, each weighed for every point: [`FewLights`].

use sparrow_math::{InLanes, MAX_WIDTH, Mask, Real, in_lanes, vec3};

use super::bounds::LightBounds;
use super::eight::{EIGHT, Eight};
use super::{LitPoint, NO_LIGHT};

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
    /// The bits of their numbers, and behind them of [`NO_LIGHT`], as lanes look them up.
    labels: Vec<f32>,
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
        let lights: Vec<u32> = lights.iter().map(|l| l.0).collect();
        let labels = lights.iter().copied().chain([NO_LIGHT]).map(f32::from_bits).collect();
        FewLights { lights, labels, bounds }
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

    /// [`choose`](Self::choose) for each of `points`, to the bit, in lanes; [`NO_LIGHT`] where nothing shines. The columns are as long as
    /// those of the points.
    pub(super) fn choose_many(&self, points: &LitPoints<'_>, light: &mut [u32], probability: &mut [f32]) {
        in_lanes(Choose { few: self, points, light, probability });
    }

    /// [`probability`](Self::probability) for each of `points`, to the bit, in lanes. The column is as long as theirs.
    pub(super) fn probability_many(&self, points: &LitPoints<'_>, light: u32, out: &mut [f32]) {
        match self.lights.iter().position(|&l| l == light) {
            Some(own) => in_lanes(Shares { few: self, points, own, out }),
            None => out[..points.n_points].fill(0.0),
        }
    }

    pub(super) fn probability(&self, at: &LitPoint, light: u32) -> f32 {
        let Some(own) = self.lights.iter().position(|&l| l == light) else { return 0.0 };
        let mut weights = [0.0; WEIGH_ALL];
        in_lanes(Weigh(&self.bounds, at, &mut weights));
        let total: f32 = weights[..self.lights.len()].iter().sum();
        if weights[own] > 0.0 { weights[own] / total } else { 0.0 }
    }
}

/// Chooses one of the weights: its place and its share; where no weight is positive the place behind the last, and zero.
#[inline(always)]
fn pick<R: Real>(weights: &[R], u: R) -> (R, R) {
    let mut total = R::ZERO;
    for &w in weights {
        total = total + w;
    }
    let (mut left, mut open) = (u * total, R::Mask::of(true));
    let (mut i, mut place, mut own) = (R::ZERO, R::of(weights.len() as f64), R::ZERO);
    for &w in weights {
        // Rounding may leave a little beyond the last one, which then takes it.
        let here = open & w.gt(R::ZERO);
        place = R::select(here, i, place);
        i = i + R::ONE;
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

impl FewLights {
    /// Weighs all of them for lanes of points.
    #[inline(always)]
    fn weigh<R: Real>(&self, LitPoints { p, n, .. }: &LitPoints<'_>, k: usize, weights: &mut [R]) {
        let p = vec3(R::load(p[0], k), R::load(p[1], k), R::load(p[2], k));
        let n = vec3(R::load(n[0], k), R::load(n[1], k), R::load(n[2], k));
        for (i, weight) in weights.iter_mut().enumerate() {
            *weight = self.bounds[i / EIGHT].spread::<R>(i).importance(p, n);
        }
    }
}

/// The share of one of them for many points, points in lanes.
struct Shares<'a> {
    few: &'a FewLights,
    points: &'a LitPoints<'a>,
    own: usize,
    out: &'a mut [f32],
}

impl InLanes for Shares<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Shares { few, points, own, out } = self;
        let mut weights = [R::ZERO; WEIGH_ALL];
        let weights = &mut weights[..few.lights.len().min(WEIGH_ALL)];
        for k in (0..points.n_points).step_by(R::WIDTH) {
            few.weigh(points, k, weights);
            let total = weights.iter().fold(
                R::ZERO,
                #[inline(always)]
                |sum, &w| sum + w,
            );
            let own = weights[own];
            R::select(own.gt(R::ZERO), own / total, R::ZERO).store(out, k);
        }
    }
}

/// Chooses for many points, points in lanes.
struct Choose<'a> {
    few: &'a FewLights,
    points: &'a LitPoints<'a>,
    light: &'a mut [u32],
    probability: &'a mut [f32],
}

impl InLanes for Choose<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let (points, few) = (self.points, self.few);
        let mut weights = [R::ZERO; WEIGH_ALL];
        let weights = &mut weights[..few.lights.len().min(WEIGH_ALL)];
        let mut chosen = [0.0; MAX_WIDTH];
        for k in (0..points.n_points).step_by(R::WIDTH) {
            few.weigh(points, k, weights);
            let (place, share) = pick(weights, R::load(points.u, k));
            share.store(self.probability, k);
            place.look_up(&few.labels).store(&mut chosen, 0);
            let chosen = chosen[..R::WIDTH].iter().map(|label| label.to_bits());
            self.light[k..].iter_mut().zip(chosen).for_each(|(light, chosen)| *light = chosen);
        }
    }
}
