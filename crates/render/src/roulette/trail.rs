//! What a path of the pilot writes down: [`Trail`].

use sparrow_math::Vec3;
use sparrow_spectra::Spectrum;

use super::mean;
use crate::integrator::{Finder, Record};

/// A vertex from which a path went on.
#[derive(Clone, Copy, Debug)]
struct Step {
    p: Vec3<f32>,
    beta: f32,
    /// What was found before.
    found: f32,
}

/// The vertices of a path, and what it found.
#[derive(Debug, Default)]
pub(super) struct Trail {
    found: f32,
    steps: Vec<Step>,
}

/// What a path found from a vertex on, over what it carried, and the rays which that took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outlook {
    pub(super) p: Vec3<f32>,
    pub(super) found: f32,
    pub(super) n_rays: f32,
}

impl Record for Trail {
    fn found(&mut self, _: Finder, light: Spectrum<f32>, weight: f32) {
        self.found += mean(light) * weight;
    }
    fn goes_on(&mut self, p: Vec3<f32>, beta: Spectrum<f32>) {
        self.steps.push(Step { p, beta: mean(beta), found: self.found });
    }
}

impl Trail {
    /// All that the path found.
    pub(super) fn total(&self) -> f32 {
        self.found
    }

    /// Its rays, if each vertex looked for a light.
    pub(super) fn n_rays(&self) -> f32 {
        n_rays(self.steps.len())
    }

    /// From each vertex on.
    pub(super) fn outlooks(&self) -> impl Iterator<Item = Outlook> {
        let left = (0..self.steps.len()).rev();
        self.steps.iter().zip(left).filter(|(s, _)| s.beta > 0.0).map(|(s, left)| Outlook {
            p: s.p,
            found: (self.found - s.found) / s.beta,
            n_rays: n_rays(left),
        })
    }
}

/// One ray, and two at each vertex: to a light, and on.
fn n_rays(n_vertices: usize) -> f32 {
    2.0 * n_vertices as f32 + 1.0
}

#[cfg(test)]
mod tests {
    use sparrow_math::vec3;

    use super::*;

    #[test]
    fn outlooks_leave_out_what_was_found_before() {
        let grey = Spectrum::<f32>::splat;
        let (a, b) = (vec3(1.0, 0.0, 0.0), vec3(2.0, 0.0, 0.0));
        let mut trail = Trail::default();
        trail.found(Finder::Camera, grey(5.0), 1.0);
        trail.goes_on(a, grey(0.5));
        trail.found(Finder::Light(1), grey(2.0), 0.5);
        trail.goes_on(b, grey(0.25));
        trail.found(Finder::Bsdf(1), grey(3.0), 1.0);
        assert_eq!((trail.total(), trail.n_rays()), (9.0, 5.0));
        let expected =
            [Outlook { p: a, found: 8.0, n_rays: 3.0 }, Outlook { p: b, found: 12.0, n_rays: 1.0 }];
        assert_eq!(trail.outlooks().collect::<Vec<_>>(), expected);
    }
}
