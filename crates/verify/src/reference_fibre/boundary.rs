//! The rough surface between air and fibre: [`Surface`].

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::fresnel;
use sparrow_models::ggx::Ggx;
use sparrow_stats::Random;

/// Facets met after which light counts as lost.
const MOST_FACETS: usize = 4000;

/// A surface of GGX facets, smooth where both widths are zero.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Slope widths along and around the fibre.
    pub alpha: [f64; 2],
    /// Index inside over index outside.
    pub eta: f64,
}

/// `Lambda` of a direction of travel, `-1 - Lambda(-w)` downwards. [Heitz2016, eq. 10]
fn lambda(ggx: &Ggx<f64>, w: LocalDir<f64>) -> f64 {
    let up = 0.5 * (ggx.stretched(w) / w.z().abs().max(1e-300) - 1.0);
    if w.z() > 0.0 { up } else { -1.0 - up }
}

/// The same direction, seen from the other side of the surface.
fn turned_over(w: LocalDir<f64>) -> LocalDir<f64> {
    LocalDir::new(vec3(w.x(), w.y(), -w.z()))
}

impl Surface {
    fn is_smooth(&self) -> bool {
        self.alpha[0].max(self.alpha[1]) <= 0.0
    }
    /// Light that travels along `w`, downwards on its own side, meets the surface; returns the direction in which it leaves, seen from
    /// the side where it came from, and whether it passed to the other. None for light that is lost among the facets.
    ///
    /// A walk among Smith's facets, heights uniform: refraction turns the landscape over. [Heitz2016, alg. 3 and section 5.3]
    pub(crate) fn scatter(
        &self,
        w: LocalDir<f64>,
        from_inside: bool,
        rng: &mut Random,
    ) -> Option<(LocalDir<f64>, bool)> {
        let eta = if from_inside { 1.0 / self.eta } else { self.eta };
        if self.is_smooth() {
            let (w, passed) = self.facet(w, LocalDir::new(vec3(0.0, 0.0, 1.0)), eta, rng);
            return Some((w, passed));
        }
        let ggx = Ggx::new(self.alpha[0], self.alpha[1]);
        // c is the share of the surface below the light, on the side where it is.
        let (mut w, mut c, mut passed) = (w, 1.0_f64, false);
        for _ in 0..MOST_FACETS {
            let (l, u) = (lambda(&ggx, w), rng.uniform().max(1e-300));
            if w.z() > 0.0 && u < Real::pow(c, l) {
                return Some((if passed { turned_over(w) } else { w }, passed));
            }
            c = (c / Real::pow(u, 1.0 / l)).clamp(1e-300, 1.0);
            let m = ggx.sample_visible(-w, [rng.uniform(), rng.uniform()]);
            let here = if passed { 1.0 / eta } else { eta };
            let (next, through) = self.facet(w, m, here, rng);
            w = next;
            if through {
                (w, c, passed) = (turned_over(w), (1.0 - c).max(1e-300), !passed);
            }
        }
        None
    }
    /// Reflects at, or refracts through, the facet `m`; `eta` is the index beyond over that of the light's side.
    fn facet(&self, w: LocalDir<f64>, m: LocalDir<f64>, eta: f64, rng: &mut Random) -> (LocalDir<f64>, bool) {
        let v = -w;
        let cos = v.dot(m).clamp(0.0, 1.0);
        let (f, cos_t) = fresnel::dielectric(cos, eta);
        if rng.uniform() < f {
            return (v.reflect(m), false);
        }
        // t = -v / eta + (cos / eta - cos_t) m
        let t = v.v() * (-1.0 / eta) + m.v() * (cos / eta - cos_t);
        (LocalDir::new(t.normalized()), true)
    }
}
