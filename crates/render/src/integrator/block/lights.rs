//! Lights drawn for the vertices of a batch: [`LightChoices`].

use sparrow_geometry::SampleColumns;
use sparrow_spectra::Wavelengths;

use super::batch::FEW;
use super::column::{BATCH, Column, pad, padded, put_vector};
use super::groups::Groups;
use crate::light::{LightSample, LitPoint};
use crate::scene::Scene;

/// A light that was chosen for a vertex.
#[derive(Clone, Copy)]
pub(super) struct LightChoice {
    /// The number of the vertex in its batch, and its path.
    pub(super) vertex: u32,
    pub(super) path: u32,
    pub(super) at: LitPoint,
    /// Uniform numbers for a point of the light.
    pub(super) u: [f32; 2],
    /// Of the choice.
    pub(super) probability: f32,
}

/// The choices of a batch, put together by light.
#[derive(Default)]
pub(super) struct LightChoices {
    all: Vec<LightChoice>,
    by_light: Groups,
    columns: Box<Columns>,
}

/// Points that are lit, uniform numbers, and points drawn on one light.
#[derive(Default)]
struct Columns {
    from: [Column; 3],
    n: [Column; 3],
    u: [Column; 2],
    p: [Column; 3],
    on: [Column; 3],
    wi: [Column; 3],
    distance: Column,
    pdf: Column,
}

impl LightChoices {
    /// Forgets all; lights are below `n_lights`.
    pub(super) fn clear(&mut self, n_lights: usize) {
        self.all.clear();
        self.by_light.clear(n_lights);
    }
    /// One more.
    pub(super) fn push(&mut self, light: u32, choice: LightChoice) {
        self.by_light.push(light, 0, self.all.len() as u32);
        self.all.push(choice);
    }
    /// Draws a direction to the light of each, whose density includes the choice; `put` is given none where the light sends nothing.
    pub(super) fn draw(
        &mut self,
        scene: &Scene,
        lambda: &[Wavelengths],
        mut put: impl FnMut(&LightChoice, Option<LightSample>),
    ) {
        self.by_light.sort(BATCH, false);
        let (lights, geometry) = (scene.lights(), scene.geometry());
        for (light, chosen) in (0..self.by_light.len()).map(|i| self.by_light.batch(i)) {
            let choice = |k: usize| &self.all[chosen[k] as usize];
            let of = |k: usize| &lambda[choice(k).path as usize];
            let mut put = |k: usize, mut s: Option<LightSample>| {
                if let Some(s) = &mut s {
                    s.pdf *= choice(k).probability;
                }
                put(choice(k), s);
            };
            let n = chosen.len();
            if n >= FEW && lights.samples_in_lanes(geometry, light) {
                let columns = &mut self.columns.of((0..n).map(choice));
                lights.sample_many(geometry, light, columns, n, of, &mut put);
                continue;
            }
            for k in 0..n {
                put(k, lights.sample(geometry, light, &choice(k).at, choice(k).u, of(k)));
            }
        }
    }
}

impl Columns {
    /// Takes over what is known of the points that are lit, at most a batch.
    fn of<'a>(&mut self, choices: impl ExactSizeIterator<Item = &'a LightChoice>) -> SampleColumns<'_> {
        let n = choices.len();
        for (k, choice) in choices.enumerate() {
            put_vector(&mut self.from, k, choice.at.p);
            put_vector(&mut self.n, k, choice.at.n);
            self.u.iter_mut().zip(choice.u).for_each(|(column, u)| column[k] = u);
        }
        self.from.iter_mut().chain(&mut self.n).chain(&mut self.u).for_each(|c| pad(c, n));
        let n = padded(n);
        SampleColumns {
            from: self.from.each_ref().map(|c| &c[..n]),
            n: self.n.each_ref().map(|c| &c[..n]),
            u: self.u.each_ref().map(|c| &c[..n]),
            p: self.p.each_mut().map(|c| &mut c[..n]),
            on: self.on.each_mut().map(|c| &mut c[..n]),
            wi: self.wi.each_mut().map(|c| &mut c[..n]),
            distance: &mut self.distance[..n],
            pdf: &mut self.pdf[..n],
        }
    }
}
