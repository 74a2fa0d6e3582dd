//! The way on from the vertices of a batch: [`Onward`].

use sparrow_math::{InLanes, Mask, Real};
use sparrow_spectra::{N_LAMBDA, Spectrum};

use super::column::{Column, load, spectrum, store_spectrum, store_vector, vector};
use super::paths::NO_DENSITY;
use super::vertices::Vertices;
use crate::integrator::path::carried;
use crate::light::Emitters;
use crate::roulette::by_throughput;

/// Directions that were drawn, and what they say of them.
#[derive(Default)]
pub(super) struct Directions {
    /// In the world.
    pub(super) wi: [Column; 3],
    /// Value times cosine over density.
    pub(super) weight: [Column; N_LAMBDA],
    /// Per steradian, or the probability of a delta lobe; zero where the path ends.
    pub(super) density: Column,
    /// Relative index that was crossed.
    pub(super) eta: Column,
    /// 1 for delta lobes, else 0.
    pub(super) delta: Column,
}

/// Where paths go on, and what they carry.
#[derive(Default)]
pub(super) struct Next {
    /// Origins of the rays.
    pub(super) o: [Column; 3],
    pub(super) beta: [Column; N_LAMBDA],
    pub(super) eta_scale: Column,
    /// Probability to go on.
    pub(super) survival: Column,
    /// 1 where a path goes on, else 0.
    pub(super) goes_on: Column,
    /// 1 where it would, but for a last ray that can meet no light, else 0; not looked at where no ray is the last.
    pub(super) blind: Column,
}

/// Takes `n` paths from their vertices along the directions that were drawn.
pub(super) struct Onward<'a> {
    pub(super) n: usize,
    pub(super) vertices: &'a Vertices,
    pub(super) drawn: &'a Directions,
    pub(super) next: &'a mut Next,
}

impl InLanes for Onward<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Onward { n, vertices, drawn, next } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let (weight, density) = (spectrum::<R>(&drawn.weight, k), load::<R>(&drawn.density, k));
            let finite = density.lt(R::of(f64::INFINITY)) & weight.is_finite();
            let (ways, eta) = (load::<R>(&vertices.ways, k), load::<R>(&drawn.eta, k));
            let before: (Spectrum<R>, R) = (spectrum(&vertices.beta, k), load(&vertices.eta_scale, k));
            let (beta, eta_scale) = carried(before, weight, eta, ways);
            let origin = vertices.at.get::<R>(k).towards(vector(&drawn.wi, k));
            store_vector(origin, &mut next.o, k);
            store_spectrum(beta, &mut next.beta, k);
            eta_scale.store(&mut next.eta_scale[..], k);
            by_throughput((beta * eta_scale).max_value()).store(&mut next.survival[..], k);
            R::ONE.only_where(density.gt(R::ZERO) & finite).store(&mut next.goes_on[..], k);
        }
    }
}

/// Ends paths behind their first vertex by roulette, and lets the others carry more.
pub(super) struct Decide<'a> {
    pub(super) n: usize,
    pub(super) depth: &'a Column,
    /// Uniform numbers.
    pub(super) u: &'a Column,
    pub(super) next: &'a mut Next,
}

impl InLanes for Decide<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Decide { n, depth, u, next } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let (survival, beta) = (load::<R>(&next.survival, k), spectrum::<R>(&next.beta, k));
            let asked = survival.lt(R::ONE) & load::<R>(depth, k).gt(R::ZERO);
            let ends = asked & load::<R>(u, k).ge(survival);
            store_spectrum(Spectrum::select(asked, beta * (R::ONE / survival), beta), &mut next.beta, k);
            load::<R>(&next.goes_on, k).only_where(!ends).store(&mut next.goes_on[..], k);
        }
    }
}

/// Ends paths whose last ray can meet no light.
pub(super) struct Blind<'a> {
    pub(super) n: usize,
    pub(super) emitters: &'a Emitters,
    /// Most scattering events.
    pub(super) max_depth: u32,
    pub(super) depth: &'a Column,
    pub(super) drawn: &'a Directions,
    pub(super) next: &'a mut Next,
}

impl InLanes for Blind<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Blind { n, emitters, max_depth, depth, drawn, next } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let last = (load::<R>(depth, k) + R::ONE).ge(R::of(max_depth.into()));
            let met = emitters.may_be_met::<R>(vector(&next.o, k), vector(&drawn.wi, k));
            let (goes_on, blind) = (load::<R>(&next.goes_on, k), last & !met);
            goes_on.only_where(blind).store(&mut next.blind[..], k);
            goes_on.only_where(!blind).store(&mut next.goes_on[..], k);
        }
    }
}

/// Puts what paths take with them from their vertices to the paths. Those that end may take it along for nothing.
pub(super) struct Leave<'a> {
    pub(super) vertices: &'a Vertices,
    pub(super) looks: &'a Column,
    pub(super) drawn: &'a Directions,
    pub(super) next: &'a Next,
    pub(super) rays: &'a mut [[f32; 8]],
    pub(super) carried: &'a mut [[f32; 8]],
    pub(super) behind: &'a mut [[f32; 8]],
}

impl InLanes for Leave<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Leave { vertices, looks, drawn, next, rays, carried, behind } = self;
        let end = R::of(f64::INFINITY);
        for (k, at) in (0..).step_by(R::WIDTH).zip(vertices.paths().chunks(R::WIDTH)) {
            if !load::<R>(&next.goes_on, k).gt(R::ZERO).any() {
                continue;
            }
            let (o, d) = (vector::<R>(&next.o, k), vector::<R>(&drawn.wi, k));
            R::scatter_rows([o.x, o.y, o.z, d.x, d.y, d.z, end, load(&vertices.time, k)], rays, at);

            let ([a, b, c, d], nm) = (spectrum::<R>(&next.beta, k).0, spectrum::<R>(&vertices.nm, k).0);
            R::scatter_rows([a, b, c, d, nm[0], nm[1], nm[2], nm[3]], carried, at);

            let looks = load::<R>(looks, k).gt(R::ZERO);
            let density = (load::<R>(&vertices.ways, k) * load(&drawn.density, k)).only_where(looks);
            let delta = load::<R>(&drawn.delta, k).gt(R::ZERO);
            let density = R::select(delta, R::of(NO_DENSITY), density);
            let (p, n) = (vector::<R>(&vertices.at.p, k), vector::<R>(&vertices.ns, k));
            R::scatter_rows([p.x, p.y, p.z, density, n.x, n.y, n.z, R::ZERO], behind, at);
        }
    }
}
