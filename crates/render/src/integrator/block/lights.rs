//! Lights sampled at the vertices of a batch: [`LightSamples`].

use sparrow_geometry::RoundedPoint;
use sparrow_math::{InLanes, Real, in_lanes, vec3};
use sparrow_spectra::{N_LAMBDA, Wavelengths};

use super::batch::FEW;
use super::chosen::{Chosen, Found, columns_of};
use super::column::{BATCH, Column, Rounded, load, padded, put_spectrum, put_vector};
use super::groups::Groups;
use super::vertices::Vertices;
use crate::light::{Ends, LightSample, LitPoints, NO_LIGHT, Target};
use crate::scene::Scene;

/// One light sample a vertex, in columns.
#[derive(Default)]
pub(super) struct LightSamples {
    /// A light is to be sampled at the vertex.
    pub(super) asked: Vec<bool>,
    /// 1 where the direction that the BSDF gives looks for lights, else 0.
    pub(super) looks: Column,
    /// The light that was chosen, or [`NO_LIGHT`].
    light: Vec<u32>,
    /// Of that choice; zero where there is none.
    probability: Column,
    groups: Groups,
    /// Vertices for which a light was chosen, those of one light together but for bulbs.
    pub(super) order: Vec<u32>,
    /// To the light, unit.
    pub(super) wi: [Column; 3],
    /// In 1/sr, with the choice; zero where no light is sampled, or one that sends nothing.
    pub(super) pdf: Column,
    /// 1 where no direction finds the light by chance, else 0.
    pub(super) delta: Column,
    pub(super) radiance: [Column; N_LAMBDA],
    /// Where the shadow ray ends.
    pub(super) end: Rounded,
    /// 1 where it has no end, else 0.
    pub(super) endless: Column,
    distance: Column,
    chosen: Chosen,
}

impl LightSamples {
    /// Forgets all; there are `n` vertices.
    pub(super) fn clear(&mut self, n: usize) {
        self.asked.clear();
        self.asked.resize(n, false);
        self.pdf[..padded(n)].fill(0.0);
        self.delta[..padded(n)].fill(0.0);
    }

    /// Samples a light at each vertex where it is asked, by uniform numbers for the choice and for a point of the light.
    pub(super) fn sample(
        &mut self,
        scene: &Scene,
        lambda: impl Fn(u32) -> Wavelengths,
        vertices: &Vertices,
        (choice, u): (&Column, &[Column; 2]),
    ) {
        let (n, lights) = (vertices.len(), scene.lights());
        let has_lanes = |light: u32, n: usize| n >= FEW && lights.samples_in_lanes(scene.geometry(), light);
        if let Some(only) =
            lights.only().filter(|&light| self.asked.iter().all(|a| *a) && has_lanes(light, n))
        {
            self.at_all(scene, only, vertices, u);
            self.order.clear();
            self.order.extend(0..n as u32);
            return;
        }
        self.choose(scene, vertices, choice);
        if n >= FEW && self.light.iter().all(|&light| lights.is_bulb(light)) {
            self.bulbs_at_all(scene, vertices, u);
            return;
        }
        // Bulbs go together.
        let bulbs = lights.len() as u32;
        let mut groups = core::mem::take(&mut self.groups);
        groups.clear(lights.len() + 1);
        for (&light, k) in self.light.iter().zip(0..).filter(|(light, _)| **light != NO_LIGHT) {
            groups.push(if lights.is_bulb(light) { bulbs } else { light }, k);
        }
        let beside = |(key, which): &(u32, &[u32])| {
            if *key == bulbs { which.len() >= FEW } else { has_lanes(*key, which.len()) }
        };
        if groups.parts(BATCH).any(|part| beside(&part)) {
            self.chosen.take(vertices, u);
            for (key, which) in groups.parts(BATCH).filter(beside) {
                if key == bulbs {
                    let end = &mut self.end.p_error;
                    self.chosen.sample_bulbs(scene, (&self.light, which), end);
                    which.iter().for_each(|k| self.endless[*k as usize % BATCH] = 0.0);
                } else {
                    let (p_error, endless) = self.chosen.sample(scene, key, which);
                    self.ends(which, p_error, endless);
                }
            }
            let LightSamples { end, wi, radiance, probability, pdf, .. } = self;
            self.chosen.hand_over(n, Found { end, wi, radiance, probability, pdf });
        }
        for (_, which) in groups.parts(BATCH).filter(|part| !beside(part)) {
            self.one_by_one(scene, which, (&lambda, vertices), u);
        }
        self.order.clear();
        groups.parts(BATCH).for_each(|(_, which)| self.order.extend_from_slice(which));
        self.groups = groups;
    }

    /// Chooses a light for each vertex.
    fn choose(&mut self, scene: &Scene, vertices: &Vertices, u: &Column) {
        let n = vertices.len();
        let points = LitPoints {
            p: vertices.at.p.each_ref().map(|c| &c[..padded(n)]),
            n: vertices.ns.each_ref().map(|c| &c[..padded(n)]),
            u: &u[..padded(n)],
            n_points: n,
        };
        self.light.clear();
        self.light.resize(n, NO_LIGHT);
        scene.lights().choose_many(&points, &mut self.light, &mut self.probability[..]);
        for (k, _) in self.asked.iter().enumerate().filter(|(_, asked)| !**asked) {
            (self.light[k], self.probability[k]) = (NO_LIGHT, 0.0);
        }
    }

    /// The lights that the vertices `which` chose, without lanes.
    fn one_by_one(
        &mut self,
        scene: &Scene,
        which: &[u32],
        (lambda, vertices): (&impl Fn(u32) -> Wavelengths, &Vertices),
        u: &[Column; 2],
    ) {
        for k in which.iter().map(|k| *k as usize) {
            let (at, u) = (vertices.lit_point(k), [u[0][k], u[1][k]]);
            let w = &lambda(vertices.paths()[k]);
            match scene.lights().sample(scene.geometry(), self.light[k], &at, u, w) {
                Some(s) => self.put(k, &s),
                None => self.pdf[k] = 0.0,
            }
        }
    }

    /// One light at all vertices.
    fn at_all(&mut self, scene: &Scene, light: u32, vertices: &Vertices, u: &[Column; 2]) {
        let n = vertices.len();
        let columns = &mut columns_of(
            padded(n),
            (&vertices.at.p, &vertices.ns, u),
            (&mut self.end.p, &mut self.end.n, &mut self.wi),
            (&mut self.distance, &mut self.pdf),
        );
        let (nm, radiance) = (vertices.nm.each_ref().map(|c| &c[..]), &mut self.radiance);
        let radiance = radiance.each_mut().map(|c| &mut c[..]);
        let ends = scene.lights().sample_many(scene.geometry(), light, columns, n, nm, radiance);
        let (p_error, endless) = parts(ends);
        self.end.p_error.iter_mut().zip(p_error).for_each(|(column, e)| column[..n].fill(e));
        self.endless[..n].fill(endless);
    }

    /// At each vertex the bulb that was chosen there.
    fn bulbs_at_all(&mut self, scene: &Scene, vertices: &Vertices, u: &[Column; 2]) {
        let n = vertices.len();
        let last = self.light[n - 1];
        self.light.resize(padded(n), last);
        let columns = &mut columns_of(
            padded(n),
            (&vertices.at.p, &vertices.ns, u),
            (&mut self.end.p, &mut self.end.n, &mut self.wi),
            (&mut self.distance, &mut self.pdf),
        );
        let (nm, radiance) = (vertices.nm.each_ref().map(|c| &c[..]), &mut self.radiance);
        let radiance = radiance.each_mut().map(|c| &mut c[..]);
        let p_error = self.end.p_error.each_mut().map(|c| &mut c[..]);
        scene.lights().sample_bulbs(&self.light, columns, p_error, padded(n), nm, radiance);
        in_lanes(Chance { n: padded(n), probability: &self.probability, pdf: &mut self.pdf });
        self.endless[..n].fill(0.0);
        self.order.clear();
        self.order.extend(0..n as u32);
    }

    /// What all points of a light have in common.
    fn ends(&mut self, which: &[u32], p_error: [f32; 3], endless: f32) {
        let [x, y, z] = &mut self.end.p_error;
        for k in which.iter().map(|k| *k as usize % BATCH) {
            [x[k], y[k], z[k]] = p_error;
            self.endless[k] = endless;
        }
    }

    /// A light sample that was drawn alone.
    fn put(&mut self, k: usize, s: &LightSample) {
        put_vector(&mut self.wi, k, s.wi);
        put_spectrum(&mut self.radiance, k, s.radiance);
        self.pdf[k] = s.pdf * self.probability[k];
        self.delta[k] = f32::from(u8::from(s.delta));
        self.endless[k] = f32::from(u8::from(matches!(s.target, Target::Infinity)));
        let end = match &s.target {
            Target::Surface(on) => RoundedPoint { p: on.p, p_error: on.p_error, n: on.n },
            Target::Point(p) => RoundedPoint::exact(*p),
            Target::Infinity => RoundedPoint::exact(vec3(0.0, 0.0, 0.0)),
        };
        self.end.put(k, &end);
    }
}

/// Takes the choice of a light into the density.
struct Chance<'a> {
    n: usize,
    probability: &'a Column,
    pdf: &'a mut Column,
}

impl InLanes for Chance<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Chance { n, probability, pdf } = self;
        for k in (0..n).step_by(R::WIDTH) {
            (load::<R>(pdf, k) * load(probability, k)).store(&mut pdf[..], k);
        }
    }
}

/// The error of points where shadow rays end, and 1 where they have no end.
pub(super) fn parts(ends: Option<Ends>) -> ([f32; 3], f32) {
    match ends {
        Some(Ends::OnSurface { p_error }) => (p_error.to_array(), 0.0),
        Some(Ends::Nowhere) | None => ([0.0; 3], 1.0),
    }
}
