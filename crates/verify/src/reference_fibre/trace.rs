//! Light on its way through the fibre: [`ReferenceFibre`].

use sparrow_math::{Frame, LocalDir, Real, Vec3, vec3};
use sparrow_models::N_LOBES;
use sparrow_spectra::N_LAMBDA;
use sparrow_stats::Random;

use super::boundary::Surface;
use super::section::{Flat, Section};

/// Meetings with the surface after which light counts as lost.
const MOST_EVENTS: usize = 4000;

/// A core that scatters.
#[derive(Clone, Copy, Debug)]
pub struct Core {
    /// Its size over that of the fibre.
    pub kappa: f64,
    /// Scattering and absorption per radius.
    pub sigma_s: f64,
    /// Absorption per radius, in place of the fibre's.
    pub sigma_a: f64,
    /// Mean cosine of scattering, after Henyey and Greenstein.
    pub g: f64,
}

/// The fibre; lengths in units of its semi-axis along y.
#[derive(Clone, Copy, Debug)]
pub struct ReferenceFibre {
    /// Its section.
    pub section: Section,
    /// Its surface.
    pub surface: Surface,
    /// Tilt of the scales in rad: the normals lean towards +x.
    pub tilt: f64,
    /// Absorption per radius, one for each of the values carried.
    pub sigma_a: [f64; N_LAMBDA],
    /// What scatters inside.
    pub core: Option<Core>,
}

/// Light that left.
#[derive(Clone, Copy, Debug)]
pub struct Photon {
    /// Where it went.
    pub wi: LocalDir<f64>,
    /// Lobe: R, TT, TRT, more.
    pub lobe: usize,
    /// It was scattered in the core.
    pub scattered: bool,
    /// What is left of it, for each absorption.
    pub weight: [f64; N_LAMBDA],
}

impl ReferenceFibre {
    /// Sends light from `wo` at the offset `h` in [-1, 1] of the half width; none where it was lost, which one in a million is.
    pub fn send(&self, wo: LocalDir<f64>, h: f64, rng: &mut Random) -> Option<Photon> {
        let across = (wo.y() * wo.y() + wo.z() * wo.z()).sqrt();
        let phi = if across > 1e-12 { [wo.y() / across, wo.z() / across] } else { [1.0, 0.0] };
        // An offset above zero lies before the viewer's azimuth, as in the models.
        let mut at = self.section.entry(phi, -h);
        let mut w = -wo.v();
        let (mut inside, mut passages, mut scattered) = (false, 0usize, false);
        let mut weight = [1.0; N_LAMBDA];
        for _ in 0..MOST_EVENTS {
            let n = self.section.normal(at);
            let normal = vec3(0.0, n[0], n[1]);
            let (next, passed) = self.meet(w, normal, inside, rng)?;
            (w, inside) = (next, inside != passed);
            let outwards = w.dot(normal) > 0.0;
            match (inside, outwards) {
                (false, true) => {
                    let wi = LocalDir::new(w.normalized());
                    return Some(Photon { wi, lobe: passages.min(N_LOBES - 1), scattered, weight });
                }
                (true, false) => {
                    at = self.cross(at, &mut w, &mut weight, &mut scattered, rng)?;
                    passages += 1;
                }
                // A scale sent it where the fibre itself is in the way: it meets the next one.
                (false, false) | (true, true) => {}
            }
        }
        None
    }
    /// Meets the surface in the frame of its scales.
    fn meet(
        &self,
        w: Vec3<f64>,
        normal: Vec3<f64>,
        inside: bool,
        rng: &mut Random,
    ) -> Option<(Vec3<f64>, bool)> {
        let (sin, cos) = Real::sin_cos(self.tilt);
        let along = vec3(1.0, 0.0, 0.0);
        let leaning = along * sin + normal * cos;
        let side = if inside { -1.0 } else { 1.0 };
        // Where light comes from behind a scale, the fibre's own normal stands in.
        let z = if w.dot(leaning) * side < 0.0 { leaning * side } else { normal * side };
        let frame = Frame::from_z(z);
        let x = (along - z * z.dot(along)).normalized();
        let frame = Frame { x, y: z.cross(x), ..frame };
        let mut local = frame.to_local(w);
        if local.z() > -1e-9 {
            local = LocalDir::new(vec3(local.x(), local.y(), -1e-9).normalized());
        }
        let (out, passed) = self.surface.scatter(local, inside, rng)?;
        Some((frame.to_world(out), passed))
    }
    /// Crosses the inside to the next point of the surface, through the core if there is one.
    fn cross(
        &self,
        from: Flat,
        w: &mut Vec3<f64>,
        weight: &mut [f64; N_LAMBDA],
        scattered: &mut bool,
        rng: &mut Random,
    ) -> Option<Flat> {
        let mut at = from;
        for _ in 0..MOST_EVENTS {
            // Distances in the plane; those in space are longer by 1 / cos.
            let cos = (w.y * w.y + w.z * w.z).sqrt().max(1e-9);
            let d = [w.y / cos, w.z / cos];
            let end = self.section.crossings(at, d, 1.0)?[1].max(0.0);
            let span = self.core.and_then(|c| {
                let [a, b] = self.section.crossings(at, d, c.kappa)?;
                (b > 1e-12).then_some((c, a.max(0.0), b))
            });
            let Some((core, start, stop)) = span else {
                self.fade(weight, end / cos);
                return Some([at[0] + end * d[0], at[1] + end * d[1]]);
            };
            self.fade(weight, start / cos);
            let free = -Real::ln((1.0 - rng.uniform()).max(1e-300)) / core.sigma_s.max(1e-300) * cos;
            let walked = free.min(stop - start);
            weight.iter_mut().for_each(|v| *v *= Real::exp(-core.sigma_a * walked / cos));
            if free < stop - start {
                let t = start + walked;
                at = [at[0] + t * d[0], at[1] + t * d[1]];
                *w = henyey_greenstein(*w, core.g, rng);
                *scattered = true;
                continue;
            }
            self.fade(weight, (end - stop).max(0.0) / cos);
            return Some([at[0] + end * d[0], at[1] + end * d[1]]);
        }
        None
    }
    fn fade(&self, weight: &mut [f64; N_LAMBDA], length: f64) {
        for (v, sigma) in weight.iter_mut().zip(self.sigma_a) {
            *v *= Real::exp(-sigma * length);
        }
    }
}

/// A direction scattered from `w` with the mean cosine `g`.
fn henyey_greenstein(w: Vec3<f64>, g: f64, rng: &mut Random) -> Vec3<f64> {
    let u = rng.uniform();
    let cos = if g.abs() < 1e-3 {
        1.0 - 2.0 * u
    } else {
        let s = (1.0 - g * g) / (1.0 + g - 2.0 * g * u);
        ((1.0 + g * g - s * s) / (2.0 * g)).clamp(-1.0, 1.0)
    };
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let (s, c) = Real::sin_cos(core::f64::consts::TAU * rng.uniform());
    Frame::from_z(w.normalized()).to_world(LocalDir::new(vec3(sin * c, sin * s, cos)))
}
