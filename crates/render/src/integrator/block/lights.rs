//! Lights sampled at the vertices of a batch: [`LightSamples`].

use sparrow_geometry::{RoundedPoint, SampleColumns};
use sparrow_math::vec3;
use sparrow_spectra::{N_LAMBDA, Wavelengths};

use super::batch::FEW;
use super::column::{BATCH, Column, Rounded, pad, padded, put_spectrum, put_vector};
use super::groups::Groups;
use super::vertices::Vertices;
use crate::light::{LightSample, Target};
use crate::scene::Scene;

/// One light sample a vertex, in columns.
#[derive(Default)]
pub(super) struct LightSamples {
    /// Of the choice of the light.
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
    some: Box<Some>,
}

/// Some of the vertices, put together, and what is sampled there.
#[derive(Default)]
struct Some {
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
    /// Forgets all; lights are below `n_lights`, vertices below `n`.
    pub(super) fn clear(&mut self, n_lights: usize, n: usize) {
        self.by_light.clear(n_lights);
        self.pdf[..padded(n)].fill(0.0);
    }
    /// A light was chosen for a vertex.
    pub(super) fn choose(&mut self, vertex: usize, light: u32, probability: f32) {
        self.probability[vertex] = probability;
        self.by_light.push(light, 0, vertex as u32);
    }

    /// Samples the lights that were chosen, by the uniform numbers `u`. Returns how far vertices with light go.
    pub(super) fn sample(
        &mut self,
        scene: &Scene,
        lambda: &[Wavelengths],
        vertices: &Vertices,
        u: &[Column; 2],
    ) -> usize {
        self.by_light.sort(BATCH, false);
        let (lights, geometry) = (scene.lights(), scene.geometry());
        let by_light = core::mem::take(&mut self.by_light);
        let mut end = 0;
        for (light, chosen) in (0..by_light.len()).map(|i| by_light.batch(i)) {
            end = end.max(chosen.last().map_or(0, |k| *k as usize + 1));
            let lanes = chosen.len() >= FEW && lights.samples_in_lanes(geometry, light);
            if lanes && chosen.len() == vertices.len() {
                self.at_all(scene, light, vertices, u);
            } else if lanes {
                self.at_some(scene, (light, chosen), vertices, u);
            } else {
                for k in chosen.iter().map(|k| *k as usize) {
                    let (at, u) = (vertices.lit_point(k), [u[0][k], u[1][k]]);
                    let w = &lambda[vertices.path[k] as usize];
                    if let Some(s) = lights.sample(geometry, light, &at, u, w) {
                        self.put(k, &s);
                    }
                }
            }
        }
        self.by_light = by_light;
        let weighted = self.pdf.iter_mut().zip(self.probability.iter());
        weighted.take(end).for_each(|(pdf, probability)| *pdf *= probability);
        end
    }

    /// One light at all vertices.
    fn at_all(&mut self, scene: &Scene, light: u32, vertices: &Vertices, u: &[Column; 2]) {
        let n = vertices.len();
        let columns = &mut columns_of(
            padded(n),
            (&vertices.at.p, &vertices.ns, u),
            (&mut self.end.p, &mut self.end.n, &mut self.wi),
            (&mut self.some.distance, &mut self.pdf),
        );
        let (nm, radiance) = (vertices.nm.each_ref().map(|c| &c[..]), &mut self.radiance);
        let radiance = radiance.each_mut().map(|c| &mut c[..]);
        let p_error = scene.lights().sample_many(scene.geometry(), light, columns, n, nm, radiance);
        let p_error = p_error.unwrap_or_default().to_array();
        self.end.p_error.iter_mut().zip(p_error).for_each(|(column, e)| column[..n].fill(e));
        self.delta[..n].fill(0.0);
        self.endless[..n].fill(0.0);
    }

    /// One light at the vertices `chosen`.
    fn at_some(
        &mut self,
        scene: &Scene,
        (light, chosen): (u32, &[u32]),
        vertices: &Vertices,
        u: &[Column; 2],
    ) {
        let (n, some) = (chosen.len(), &mut *self.some);
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
        let p_error = scene.lights().sample_many(scene.geometry(), light, columns, n, nm, radiance);
        let p_error = p_error.unwrap_or_default().to_array();
        scatter(chosen, &some.on, &mut self.end.p);
        scatter(chosen, &some.on_n, &mut self.end.n);
        scatter(chosen, &some.wi, &mut self.wi);
        scatter(chosen, &some.radiance, &mut self.radiance);
        for (k, &pdf) in chosen.iter().map(|k| *k as usize).zip(some.pdf.iter()) {
            self.pdf[k] = pdf;
            self.end.p_error.iter_mut().zip(p_error).for_each(|(column, e)| column[k] = e);
            (self.delta[k], self.endless[k]) = (0.0, 0.0);
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
