//! Light through a smooth fibre of elliptical section: [`Elliptic`]. [KhungurnMarschner2017]
//!
//! Seen along the axis, a ray is refracted with the index `eta'` of its inclination (Bravais), and its reflectance at either surface
//! is that of the angle in space. Unlike in a circle, each surface is met at another angle, beyond the critical one too.

use core::f64::consts::PI;

use sparrow_math::Real;
use sparrow_spectra::Spectrum;

use super::azimuthal::{WrappedGauss, wrapped};
use super::choice::LobeChoice;
use super::far_field::{Around, gather};
use super::section::{Flat, Section, dot, turn};
use crate::{N_LOBES, fresnel};

/// Segments across a fibre of the far field.
pub const SEGMENTS: usize = 32;

/// A fibre with its light at one inclination.
#[derive(Clone, Copy, Debug)]
pub struct Elliptic<R> {
    /// Its section.
    pub section: Section<R>,
    /// Sine and cosine of the inclination.
    pub theta: [R; 2],
    /// Relative index of refraction.
    pub eta: R,
    /// Absorption per semi-axis along y.
    pub sigma_a: Spectrum<R>,
}

/// Where one ray goes.
#[derive(Clone, Copy, Debug)]
pub struct Exits<R> {
    /// Direction across the fibre in which R, TT, TRT leave.
    pub directions: [Flat<R>; 3],
    /// Length of the way inside of TT and TRT, seen along the axis.
    pub chords: [R; 2],
    /// `A_p`; their sum is 1 where nothing is absorbed.
    pub a: [Spectrum<R>; N_LOBES],
}

/// One end of a segment across the fibre.
struct End<R> {
    exits: [R; 3],
    a: [Spectrum<R>; N_LOBES],
}

impl<R: Real> End<R> {
    /// By how much the exit of lobe `p` turns to the other end.
    #[inline(always)]
    fn turn(&self, other: &Self, p: usize) -> R {
        wrapped(other.exits[p] - self.exits[p])
    }
    /// The blurred density of lobe `p` at `phi`, its exit running evenly to the other end.
    #[inline(always)]
    fn spread(&self, other: &Self, p: usize, phi: R, d: &[WrappedGauss<R>; 3]) -> R {
        let turn = self.turn(other, p);
        d[p].mean(wrapped(phi - self.exits[p] - R::of(0.5) * turn), turn.abs())
    }
}

/// The mean light of both ends times the share of the width.
#[inline(always)]
fn mean<R: Real>(a: &End<R>, b: &End<R>, share: R) -> [Spectrum<R>; N_LOBES] {
    let half = R::of(0.5) * share;
    [(a.a[0] + b.a[0]) * half, (a.a[1] + b.a[1]) * half, (a.a[2] + b.a[2]) * half, (a.a[3] + b.a[3]) * half]
}

/// Offset of the `k`-th end of a segment: dense at the rims.
#[inline(always)]
fn offset(k: usize) -> f64 {
    let x = 2.0 * k as f64 / SEGMENTS as f64 - 1.0;
    0.5 * x * (3.0 - x * x)
}

impl<R: Real> Elliptic<R> {
    /// The ray from the azimuth `phi` at the offset `h` of the half width.
    #[inline(always)]
    pub fn exits(&self, phi: Flat<R>, h: R) -> Exits<R> {
        let [sin, cos] = self.theta;
        // eta cos theta_t
        let across = ((self.eta - sin) * (self.eta + sin)).safe_sqrt().max(R::of(1e-12));
        let over = cos / across;
        let p = self.section.entry(phi, h);
        let n = self.section.normal(p);
        let c = dot(n, phi).clamp(R::ZERO, R::ONE);
        let r = [n[0] * (c + c) - phi[0], n[1] * (c + c) - phi[1]];
        let f0 = fresnel::dielectric(cos * c, self.eta).0;
        let c_t = (R::ONE - over.sqr() * (R::ONE - c * c)).safe_sqrt();
        let bend = c * over - c_t;
        let d = [n[0] * bend - phi[0] * over, n[1] * bend - phi[1] * over];
        let (q, first) = self.crossed(p, d);
        let (tt, back, f1) = self.leaves(q, d, across);
        let (s, second) = self.crossed(q, back);
        let (trt, _, f2) = self.leaves(s, back, across);
        // In space a way is longer by 1 / cos theta_t.
        let longer = self.eta / across;
        let (t1, t2) = (self.left(first * longer), self.left(second * longer));
        let trapped = t1 * t2 * ((R::ONE - f0) * f1 * f2);
        // What is reflected ever again, as if each way were like the second; not more than nine in ten stay.
        let f = f2.min(R::of(0.9));
        let rest = trapped.zip(
            t2,
            #[inline(always)]
            |rest, t| rest * (R::ONE - f) * t / (R::ONE - f * t),
        );
        Exits {
            directions: [r, tt, trt],
            chords: [first, first + second],
            a: [
                Spectrum::splat(f0),
                t1 * ((R::ONE - f0) * (R::ONE - f1)),
                t1 * t2 * ((R::ONE - f0) * f1 * (R::ONE - f2)),
                rest,
            ],
        }
    }
    /// What absorption leaves over a length.
    #[inline(always)]
    fn left(&self, length: R) -> Spectrum<R> {
        self.sigma_a.map(
            #[inline(always)]
            |sigma| (-sigma * length).exp(),
        )
    }
    #[inline(always)]
    fn crossed(&self, p: Flat<R>, d: Flat<R>) -> (Flat<R>, R) {
        let t = self.section.across(p, d).max(R::ZERO);
        ([p[0] + t * d[0], p[1] + t * d[1]], t)
    }
    /// Light that travels along `d` inside at the point `p`: the direction in which it leaves, that of its reflection, and the reflectance.
    #[inline(always)]
    fn leaves(&self, p: Flat<R>, d: Flat<R>, across: R) -> (Flat<R>, Flat<R>, R) {
        let n = self.section.normal(p);
        let c = dot(n, d).clamp(R::ZERO, R::ONE);
        let cos = self.theta[1].max(R::of(1e-9));
        let eta = across / cos;
        let f = fresnel::dielectric(across * c / self.eta, R::ONE / self.eta).0;
        let c_t = (R::ONE - eta.sqr() * (R::ONE - c * c)).safe_sqrt();
        let bend = c_t - eta * c;
        let out = [d[0] * eta + n[0] * bend, d[1] * eta + n[1] * bend];
        (out, [d[0] - n[0] * (c + c), d[1] - n[1] * (c + c)], f)
    }
    #[inline(always)]
    fn end(&self, phi: Flat<R>, h: R) -> End<R> {
        let e = self.exits(phi, h);
        let [r, tt, trt] = e.directions;
        End { exits: [turn(phi, r), turn(phi, tt), turn(phi, trt)], a: e.a }
    }
    /// `A_p N_p` and `A_p` at the offset `h`, at the azimuth `phi` from that of the viewer, `from`.
    #[inline(always)]
    pub fn near(&self, from: Flat<R>, h: R, phi: R, d: &[WrappedGauss<R>; 3]) -> Around<R> {
        let end = self.end(from, h);
        let [r, tt, trt, rest] = end.a;
        let n = [
            r * d[0].value(wrapped(phi - end.exits[0])),
            tt * d[1].value(wrapped(phi - end.exits[1])),
            trt * d[2].value(wrapped(phi - end.exits[2])),
            rest * R::of(0.5 / PI),
        ];
        Around { n, shares: end.a }
    }
    /// The exit azimuths, and `A_p`, at the offset `h`.
    #[inline(always)]
    pub fn at(&self, from: Flat<R>, h: R) -> ([R; 3], [Spectrum<R>; N_LOBES]) {
        let end = self.end(from, h);
        (end.exits, end.a)
    }
    /// `f(share, from, to)` of every segment across the width.
    #[inline(always)]
    fn segments(&self, from: Flat<R>, mut f: impl FnMut(R, &End<R>, &End<R>)) {
        let mut last = self.end(from, -R::ONE);
        for k in 0..SEGMENTS {
            let next = self.end(from, R::of(offset(k + 1)));
            f(R::of(0.5 * (offset(k + 1) - offset(k))), &last, &next);
            last = next;
        }
    }
    /// All lobes of the far field at the azimuth `phi` from that of the viewer.
    #[inline(always)]
    pub fn far(&self, from: Flat<R>, phi: R, d: &[WrappedGauss<R>; 3]) -> Around<R> {
        let mut out = Around { n: [Spectrum::ZERO; N_LOBES], shares: [Spectrum::ZERO; N_LOBES] };
        self.segments(
            from,
            #[inline(always)]
            |share, a, b| {
                let light = mean(a, b, share);
                let around =
                    [a.spread(b, 0, phi, d), a.spread(b, 1, phi, d), a.spread(b, 2, phi, d), R::of(0.5 / PI)];
                gather(&mut out.shares, &light, [R::ONE; N_LOBES]);
                gather(&mut out.n, &light, around);
            },
        );
        out
    }
    /// The means of `A_p` over the width.
    #[inline(always)]
    pub fn shares(&self, from: Flat<R>) -> [Spectrum<R>; N_LOBES] {
        let mut sum = [Spectrum::ZERO; N_LOBES];
        self.segments(
            from,
            #[inline(always)]
            |share, a, b| gather(&mut sum, &mean(a, b, share), [R::ONE; N_LOBES]),
        );
        sum
    }
    /// An exit azimuth of the chosen lobe, whose mean over the width is `total`, and a uniform number that is left.
    #[inline(always)]
    pub fn draw(&self, from: Flat<R>, lobe: &LobeChoice<R>, total: R) -> [R; 2] {
        let x = lobe.left * total;
        let (mut below, mut azimuth, mut left) = (R::ZERO, R::ZERO, R::ZERO);
        self.segments(
            from,
            #[inline(always)]
            |share, a, b| {
                let [r, tt, trt, rest] = mean(a, b, share);
                let chance = lobe.pick([r.average(), tt.average(), trt.average(), rest.average()]);
                // The last segment that begins below x stays.
                let here = x.ge(below);
                let within = ((x - below) / chance.max(R::of(1e-30))).clamp(R::ZERO, R::ONE);
                // Coarse steps along the segment, which D blurs; the rest of the number is left over.
                let fine = within * R::of(STEPS);
                let whole = (fine - R::of(0.5)).round().clamp(R::ZERO, R::of(STEPS - 1.0));
                let along = (whole + R::of(0.5)) * R::of(1.0 / STEPS);
                let exit = lobe.pick([a.exits[0], a.exits[1], a.exits[2], R::ZERO]);
                let turn = lobe.pick([a.turn(b, 0), a.turn(b, 1), a.turn(b, 2), R::ZERO]);
                azimuth = R::select(here, exit + along * turn, azimuth);
                left = R::select(here, (fine - whole).clamp(R::ZERO, R::ONE), left);
                below = below + chance;
            },
        );
        [azimuth, left]
    }
}

/// Steps along a segment.
const STEPS: f64 = 256.0;
