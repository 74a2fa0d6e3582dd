//! Light through a smooth fibre of elliptical section: [`Elliptic`]. [KhungurnMarschner2017]
//!
//! Seen along the axis, a ray is refracted with the index `eta'` of its inclination (Bravais), and its reflectance at either surface
//! is that of the angle in space. Unlike in a circle, each surface is met at another angle, beyond the critical one too.

use sparrow_math::Real;
use sparrow_spectra::Spectrum;

use super::section::{Flat, Section, dot, turn};
use crate::{N_LOBES, fresnel};

/// A fibre with its light at one inclination.
#[derive(Clone, Copy, Debug)]
pub struct Elliptic {
    /// Its section.
    pub section: Section<f64>,
    /// Sine and cosine of the inclination.
    pub theta: [f64; 2],
    /// Relative index of refraction.
    pub eta: f64,
    /// Absorption per semi-axis along y.
    pub sigma_a: Spectrum<f64>,
}

/// Where one ray goes.
#[derive(Clone, Copy, Debug)]
pub struct Exits {
    /// Direction across the fibre in which R, TT, TRT leave.
    pub directions: [Flat<f64>; 3],
    /// Length of the way inside of TT and TRT, seen along the axis.
    pub chords: [f64; 2],
    /// `A_p`; their sum is 1 where nothing is absorbed.
    pub a: [Spectrum<f64>; N_LOBES],
}

impl Exits {
    /// The azimuths of R, TT, TRT from the viewer's.
    pub fn azimuths(&self, from: Flat<f64>) -> [f64; 3] {
        self.directions.map(|d| turn(from, d))
    }
}

impl Elliptic {
    /// The ray from the azimuth `phi` at the offset `h` of the half width.
    pub fn exits(&self, phi: Flat<f64>, h: f64) -> Exits {
        let [sin, cos] = self.theta;
        // eta cos theta_t
        let across = ((self.eta - sin) * (self.eta + sin)).safe_sqrt().max(1e-12);
        let over = cos / across;
        let p = self.section.entry(phi, h);
        let n = self.section.normal(p);
        let c = dot(n, phi).clamp(0.0, 1.0);
        let r = [2.0 * c * n[0] - phi[0], 2.0 * c * n[1] - phi[1]];
        let f0 = fresnel::dielectric(cos * c, self.eta).0;
        let c_t = (1.0 - over.sqr() * (1.0 - c * c)).safe_sqrt();
        let bend = c * over - c_t;
        let d = [n[0] * bend - phi[0] * over, n[1] * bend - phi[1] * over];
        let (q, first) = self.crossed(p, d);
        let (tt, back, f1) = self.leaves(q, d, across);
        let (s, second) = self.crossed(q, back);
        let (trt, _, f2) = self.leaves(s, back, across);
        // In space a way is longer by 1 / cos theta_t.
        let longer = self.eta / across;
        let (t1, t2) = (self.left(first * longer), self.left(second * longer));
        let trapped = t1 * t2 * ((1.0 - f0) * f1 * f2);
        // What is reflected ever again, as if each way were like the second; not more than nine in ten stay.
        let f = f2.min(0.9);
        let rest = trapped.zip(t2, |rest, t| rest * (1.0 - f) * t / (1.0 - f * t));
        Exits {
            directions: [r, tt, trt],
            chords: [first, first + second],
            a: [
                Spectrum::splat(f0),
                t1 * ((1.0 - f0) * (1.0 - f1)),
                t1 * t2 * ((1.0 - f0) * f1 * (1.0 - f2)),
                rest,
            ],
        }
    }
    /// What absorption leaves over a length.
    fn left(&self, length: f64) -> Spectrum<f64> {
        self.sigma_a.map(|sigma| Real::exp(-sigma * length))
    }
    fn crossed(&self, p: Flat<f64>, d: Flat<f64>) -> (Flat<f64>, f64) {
        let t = self.section.across(p, d).max(0.0);
        ([p[0] + t * d[0], p[1] + t * d[1]], t)
    }
    /// Light that travels along `d` inside at the point `p`: the direction in which it leaves, that of its reflection, and the reflectance.
    fn leaves(&self, p: Flat<f64>, d: Flat<f64>, across: f64) -> (Flat<f64>, Flat<f64>, f64) {
        let n = self.section.normal(p);
        let c = dot(n, d).clamp(0.0, 1.0);
        let cos = self.theta[1].max(1e-9);
        let eta = across / cos;
        let f = fresnel::dielectric(across * c / self.eta, 1.0 / self.eta).0;
        let c_t = (1.0 - eta.sqr() * (1.0 - c * c)).safe_sqrt();
        let bend = c_t - eta * c;
        let out = [d[0] * eta + n[0] * bend, d[1] * eta + n[1] * bend];
        (out, [d[0] - 2.0 * c * n[0], d[1] - 2.0 * c * n[1]], f)
    }
}
