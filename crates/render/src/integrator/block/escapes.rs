//! Rays that left the scene towards one environment map, in columns: [`Escapes`].

use sparrow_spectra::{N_LAMBDA, Spectrum};

use super::column::{BATCH, Column, put_spectrum, put_vector, spectrum};
use super::paths::Paths;
use crate::integrator::{PathIntegrator, Record};
use crate::light::Environment;
use crate::scene::Scene;

/// Paths whose rays left the scene.
#[derive(Default)]
pub(super) struct Escapes {
    path: Vec<u32>,
    columns: Box<Columns>,
}

#[derive(Default)]
struct Columns {
    d: [Column; 3],
    /// Wavelengths in nm.
    nm: [Column; N_LAMBDA],
    radiance: [Column; N_LAMBDA],
    pdf: Column,
}

impl Escapes {
    /// The ray of a path left the scene.
    pub(super) fn push(&mut self, path: u32) {
        self.path.push(path);
    }

    /// Adds what these rays found of the `light` all around, and forgets them.
    pub(super) fn find<R: Record>(
        &mut self,
        scene: &Scene,
        how: &PathIntegrator,
        (light, environment): (u32, &Environment),
        paths: &mut Paths<R>,
    ) {
        let Columns { d, nm, radiance, pdf } = &mut *self.columns;
        for which in self.path.chunks(BATCH) {
            for (k, &i) in which.iter().enumerate() {
                put_vector(d, k, paths.ray[i as usize].d);
                let [.., a, b, c, d] = paths.carried[i as usize];
                put_spectrum(nm, k, Spectrum([a, b, c, d]));
            }
            environment.escaped_many(
                which.len(),
                d.each_ref().map(|c| &c[..]),
                nm.each_ref().map(|c| &c[..]),
                radiance.each_mut().map(|c| &mut c[..]),
                &mut pdf[..],
            );
            for (k, i) in which.iter().map(|i| *i as usize).enumerate() {
                let (beta, last, by) = (paths.beta(i), paths.last(i), paths.finder(i));
                let record = &mut paths.record[i];
                let found = |light, w| record.found(by, beta * light, w);
                let l = spectrum(radiance, k);
                let l = scene.weighted((light, l), last.as_ref(), how.mis, |_| pdf[k], found);
                paths.add(i, beta * l);
            }
        }
        self.path.clear();
    }
}
