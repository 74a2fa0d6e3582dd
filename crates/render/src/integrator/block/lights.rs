//! Lights sampled at the vertices of a batch: [`LightSamples`].

use sparrow_geometry::{RoundedPoint, SampleColumns};
use sparrow_math::vec3;
use sparrow_spectra::{N_LAMBDA, Wavelengths};

use super::batch::FEW;
use super::column::{BATCH, Column, Rounded, pad, padded, put_spectrum, put_vector};
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
    /// Of that choice.
    probability: Column,
    by_light: Groups,
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
    chosen: Box<Chosen>,
}

/// Vertices that chose the same light, put together, and what is sampled there.
#[derive(Default)]
struct Chosen {
    p: [Column; 3],
    n: [Column; 3],
    u: [Column; 2],
    nm: [Column; N_LAMBDA],
    on: [Column; 3],
    on_n: [Column; 3],
    wi: [Column; 3],
    distance: Column,
    pdf: Column,
    radiance: [Column; N_LAMBDA],
}

impl LightSamples {
    /// Forgets all; there are `n` vertices.
    pub(super) fn clear(&mut self, n: usize) {
        self.asked.clear();
        self.asked.resize(n, false);
        self.pdf[..padded(n)].fill(0.0);
    }

    /// Samples a light at each vertex where it is asked, by uniform numbers for the choice and for a point of the light. Returns how far
    /// vertices with light go.
    pub(super) fn sample(
        &mut self,
        scene: &Scene,
        lambda: &[Wavelengths],
        vertices: &Vertices,
        (choice, u): (&Column, &[Column; 2]),
    ) -> usize {
        let (n, lights) = (vertices.len(), scene.lights());
        let in_lanes = |light: u32, n: usize| n >= FEW && lights.samples_in_lanes(scene.geometry(), light);
        if let Some(only) = lights.only().filter(|&light| self.asked.iter().all(|a| *a) && in_lanes(light, n))
        {
            self.at_all(scene, only, vertices, u);
            return n;
        }
        self.choose(scene, vertices, choice);
        let end = self.light.iter().rposition(|light| *light != NO_LIGHT).map_or(0, |k| k + 1);
        let first = self.light.first().copied().unwrap_or(NO_LIGHT);
        if first != NO_LIGHT && self.light.iter().all(|light| *light == first) && in_lanes(first, n) {
            self.at_all(scene, first, vertices, u);
        } else {
            self.put_together(lights.len());
            let by_light = core::mem::take(&mut self.by_light);
            for (light, chosen) in (0..by_light.len()).map(|i| by_light.batch(i)) {
                if in_lanes(light, chosen.len()) {
                    self.at_some(scene, (light, chosen), vertices, u);
                } else {
                    self.one_by_one(scene, (light, chosen), (lambda, vertices), u);
                }
            }
            self.by_light = by_light;
        }
        let weighted = self.pdf.iter_mut().zip(self.probability.iter());
        weighted.take(end).for_each(|(pdf, probability)| *pdf *= probability);
        end
    }

    /// Chooses a light for each vertex.
    fn choose(&mut self, scene: &Scene, vertices: &Vertices, u: &Column) {
        let n = vertices.len();
        self.light.clear();
        self.light.resize(n, NO_LIGHT);
        let points = LitPoints {
            p: vertices.at.p.each_ref().map(|c| &c[..padded(n)]),
            n: vertices.ns.each_ref().map(|c| &c[..padded(n)]),
            u: &u[..padded(n)],
            n_points: n,
        };
        let (light, probability) = (&mut self.light, &mut self.probability);
        scene.lights().choose_many(&points, |k, chosen| {
            if let (Some((chosen, share)), true) = (chosen, self.asked[k]) {
                (light[k], probability[k]) = (chosen, share);
            }
        });
    }
    /// Groups the vertices by light.
    fn put_together(&mut self, n_lights: usize) {
        self.by_light.clear(n_lights);
        for (k, &light) in self.light.iter().enumerate().filter(|(_, light)| **light != NO_LIGHT) {
            self.by_light.push(light, 0, k as u32);
        }
        self.by_light.sort(BATCH, false);
    }

    /// One light at the vertices `chosen`, without lanes.
    fn one_by_one(
        &mut self,
        scene: &Scene,
        (light, chosen): (u32, &[u32]),
        (lambda, vertices): (&[Wavelengths], &Vertices),
        u: &[Column; 2],
    ) {
        for k in chosen.iter().map(|k| *k as usize) {
            let (at, u) = (vertices.lit_point(k), [u[0][k], u[1][k]]);
            let w = &lambda[vertices.paths()[k] as usize];
            if let Some(s) = scene.lights().sample(scene.geometry(), light, &at, u, w) {
                self.put(k, &s);
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
            (&mut self.chosen.distance, &mut self.pdf),
        );
        let (nm, radiance) = (vertices.nm.each_ref().map(|c| &c[..]), &mut self.radiance);
        let radiance = radiance.each_mut().map(|c| &mut c[..]);
        let ends = scene.lights().sample_many(scene.geometry(), light, columns, n, nm, radiance);
        let (p_error, endless) = parts(ends);
        self.end.p_error.iter_mut().zip(p_error).for_each(|(column, e)| column[..n].fill(e));
        self.delta[..n].fill(0.0);
        self.endless[..n].fill(endless);
    }

    /// One light at the vertices `chosen`.
    fn at_some(
        &mut self,
        scene: &Scene,
        (light, chosen): (u32, &[u32]),
        vertices: &Vertices,
        u: &[Column; 2],
    ) {
        let (n, some) = (chosen.len(), &mut *self.chosen);
        gather(chosen, &vertices.at.p, &mut some.p);
        gather(chosen, &vertices.ns, &mut some.n);
        gather(chosen, u, &mut some.u);
        gather(chosen, &vertices.nm, &mut some.nm);
        let columns = &mut columns_of(
            padded(n),
            (&some.p, &some.n, &some.u),
            (&mut some.on, &mut some.on_n, &mut some.wi),
            (&mut some.distance, &mut some.pdf),
        );
        let (nm, radiance) = (some.nm.each_ref().map(|c| &c[..]), &mut some.radiance);
        let radiance = radiance.each_mut().map(|c| &mut c[..]);
        let ends = scene.lights().sample_many(scene.geometry(), light, columns, n, nm, radiance);
        let (p_error, endless) = parts(ends);
        scatter(chosen, &some.on, &mut self.end.p);
        scatter(chosen, &some.on_n, &mut self.end.n);
        scatter(chosen, &some.wi, &mut self.wi);
        scatter(chosen, &some.radiance, &mut self.radiance);
        for (k, &pdf) in chosen.iter().map(|k| *k as usize).zip(some.pdf.iter()) {
            self.pdf[k] = pdf;
            self.end.p_error.iter_mut().zip(p_error).for_each(|(column, e)| column[k] = e);
            (self.delta[k], self.endless[k]) = (0.0, endless);
        }
    }

    /// A light sample that was drawn alone.
    fn put(&mut self, k: usize, s: &LightSample) {
        put_vector(&mut self.wi, k, s.wi);
        put_spectrum(&mut self.radiance, k, s.radiance);
        self.pdf[k] = s.pdf;
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

/// The error of points where shadow rays end, and 1 where they have no end.
fn parts(ends: Option<Ends>) -> ([f32; 3], f32) {
    match ends {
        Some(Ends::OnSurface { p_error }) => (p_error.to_array(), 0.0),
        Some(Ends::Nowhere) | None => ([0.0; 3], 1.0),
    }
}

/// Columns as the geometry takes them, `n` numbers each.
fn columns_of<'a>(
    n: usize,
    (from, normals, u): (&'a [Column; 3], &'a [Column; 3], &'a [Column; 2]),
    (p, on, wi): (&'a mut [Column; 3], &'a mut [Column; 3], &'a mut [Column; 3]),
    (distance, pdf): (&'a mut Column, &'a mut Column),
) -> SampleColumns<'a> {
    SampleColumns {
        from: from.each_ref().map(|c| &c[..n]),
        n: normals.each_ref().map(|c| &c[..n]),
        u: u.each_ref().map(|c| &c[..n]),
        p: p.each_mut().map(|c| &mut c[..n]),
        on: on.each_mut().map(|c| &mut c[..n]),
        wi: wi.each_mut().map(|c| &mut c[..n]),
        distance: &mut distance[..n],
        pdf: &mut pdf[..n],
    }
}

/// Puts the numbers of the `chosen` vertices side by side.
fn gather<const N: usize>(chosen: &[u32], from: &[Column; N], to: &mut [Column; N]) {
    for (from, to) in from.iter().zip(to) {
        to.iter_mut().zip(chosen).for_each(|(x, &k)| *x = from[k as usize % BATCH]);
        pad(to, chosen.len());
    }
}

/// Puts numbers that stand side by side to the `chosen` vertices.
fn scatter<const N: usize>(chosen: &[u32], from: &[Column; N], to: &mut [Column; N]) {
    for (from, to) in from.iter().zip(to) {
        from.iter().zip(chosen).for_each(|(&x, &k)| to[k as usize % BATCH] = x);
    }
}
