//! Azimuthal terms of the far field: the mean over all offsets of the ray. [dEon2011, eq. 10]
//!
//! `N_p(phi) = 1/2 int A_p(h) D(phi - Phi_p(h)) dh` with the blur D of a rough surface. The fibre's width is cut into segments of equal
//! angle; within one, `A_p` is that of its middle and `Phi_p` runs evenly. Segments keep the integral over `phi` exactly, for any
//! width of D, and can be drawn from.

use core::f64::consts::PI;

use sparrow_math::Real;
use sparrow_spectra::Spectrum;

use super::attenuation::Inside;
use super::azimuthal::{Azimuthal, exit_azimuth, wrapped};
use crate::N_LOBES;

/// Segments across a fibre that models use. Lobes of some degrees are then off by less than one percent of their peak.
pub const SEGMENTS: usize = 16;

/// A fibre lit over its whole width, its light inside at one inclination.
#[derive(Clone, Copy, Debug)]
pub struct FarField<R> {
    /// Sine and cosine of the inclination that the light inside goes by.
    pub theta: [R; 2],
    /// Relative index of refraction.
    pub eta: R,
    /// Absorption per radius.
    pub sigma_a: Spectrum<R>,
}

/// `N_p` of R, TT, TRT and what follows, which is even around the fibre, and their integrals over the azimuth, the means of `A_p`.
#[derive(Clone, Copy, Debug)]
pub struct Around<R> {
    /// In 1/rad.
    pub n: [Spectrum<R>; N_LOBES],
    /// The mean of `A_p` over the width.
    pub shares: [Spectrum<R>; N_LOBES],
}

/// Two segments across the fibre, at either side of its axis; fields are those of the side `h > 0`.
struct Segment<R> {
    /// Share of the fibre's width.
    share: R,
    gamma_o: R,
    gamma_t: R,
    /// `A_p`
    a: [Spectrum<R>; N_LOBES],
    /// `d gamma_o`, and `d gamma_t / d gamma_o`.
    step: R,
    slope: R,
}

impl<R: Real> Segment<R> {
    /// By how much the exit of lobe `p` turns over the segment.
    #[inline(always)]
    fn turn(&self, p: u32) -> R {
        (self.step * (R::of(2.0 * f64::from(p)) * self.slope - R::of(2.0))).abs()
    }
    /// The exit of lobe `p`, from -1/2 to 1/2 along the segment.
    #[inline(always)]
    fn exit(&self, p: u32, along: R) -> R {
        exit_azimuth(p, self.gamma_o, self.gamma_t) + along * self.turn(p)
    }
    /// The mean over both sides of the blurred density around the fibre.
    #[inline(always)]
    fn density(&self, p: u32, phi: R, d: &[impl Azimuthal<R>; 3]) -> R {
        let (exit, turn) = (self.exit(p, R::ZERO), self.turn(p));
        let d = &d[p as usize];
        R::of(0.5) * (d.mean(wrapped(phi - exit), turn) + d.mean(wrapped(phi + exit), turn))
    }
}

/// Adds the shares of a segment to sums.
#[inline(always)]
fn gather<R: Real>(sum: &mut [Spectrum<R>; N_LOBES], a: &[Spectrum<R>; N_LOBES], by: [R; N_LOBES]) {
    *sum = [sum[0] + a[0] * by[0], sum[1] + a[1] * by[1], sum[2] + a[2] * by[2], sum[3] + a[3] * by[3]];
}

impl<R: Real> FarField<R> {
    /// The `k`-th pair of `segments`, from the axis.
    #[inline(always)]
    fn segment(&self, k: usize, segments: usize) -> Segment<R> {
        let step = PI / segments as f64;
        let gamma_o = R::of((k as f64 + 0.5) * step);
        let (sin, cos) = gamma_o.sin_cos();
        let inside = Inside::new(self.theta, sin, self.eta);
        Segment {
            // sin(gamma_o + step / 2) - sin(gamma_o - step / 2), of a width of 2, on both sides
            share: R::of(2.0) * cos * R::of(0.5 * step).sin(),
            gamma_o,
            gamma_t: inside.angle(),
            a: inside.attenuation(self.sigma_a),
            step: R::of(step),
            slope: cos * inside.over_eta / inside.gamma_t[1].max(R::of(1e-9)),
        }
    }
    /// The means of `A_p` over the width.
    #[inline(always)]
    pub fn shares(&self, segments: usize) -> [Spectrum<R>; N_LOBES] {
        let mut sum = [Spectrum::ZERO; N_LOBES];
        for k in 0..segments / 2 {
            let s = self.segment(k, segments);
            gather(&mut sum, &s.a, [s.share; N_LOBES]);
        }
        sum
    }
    /// All lobes at the azimuth `phi` in [-pi, pi].
    #[inline(always)]
    pub fn around(&self, phi: R, d: &[impl Azimuthal<R>; 3], segments: usize) -> Around<R> {
        let mut out = Around { n: [Spectrum::ZERO; N_LOBES], shares: [Spectrum::ZERO; N_LOBES] };
        for k in 0..segments / 2 {
            let s = self.segment(k, segments);
            gather(&mut out.shares, &s.a, [s.share; N_LOBES]);
            let (r, tt, trt) = (s.density(0, phi, d), s.density(1, phi, d), s.density(2, phi, d));
            gather(&mut out.n, &s.a, [s.share * r, s.share * tt, s.share * trt, s.share * R::of(0.5 / PI)]);
        }
        out
    }
    /// An exit azimuth of the lobe that `pick` picks, without D: segments in proportion to the mean over wavelengths of `A_p`.
    ///
    /// `u` uniform; returns the azimuth, and a uniform number that is left.
    #[inline(always)]
    pub fn draw(&self, pick: impl Fn([R; N_LOBES]) -> R, u: R, segments: usize) -> [R; 2] {
        let a = self.shares(segments);
        let total = pick([a[0].average(), a[1].average(), a[2].average(), a[3].average()]);
        let far_side = u.ge(R::of(0.5));
        let x = (u + u - R::ONE.only_where(far_side)) * total;
        let (mut below, mut azimuth, mut left) = (R::ZERO, R::ZERO, R::ZERO);
        for k in 0..segments / 2 {
            let s = self.segment(k, segments);
            let chance =
                pick([s.a[0].average(), s.a[1].average(), s.a[2].average(), s.a[3].average()]) * s.share;
            // The last segment that begins below x stays.
            let here = x.ge(below);
            let within = ((x - below) / chance.max(R::of(1e-30))).clamp(R::ZERO, R::ONE);
            // Coarse steps along the segment, which D blurs; the rest of the number is left over.
            let fine = within * R::of(STEPS);
            let whole = (fine - R::of(0.5)).round().clamp(R::ZERO, R::of(STEPS - 1.0));
            let along = (whole + R::of(0.5)) * R::of(1.0 / STEPS) - R::of(0.5);
            let at = pick([s.exit(0, along), s.exit(1, along), s.exit(2, along), R::ZERO]);
            azimuth = R::select(here, at, azimuth);
            left = R::select(here, (fine - whole).clamp(R::ZERO, R::ONE), left);
            below = below + chance;
        }
        [R::select(far_side, -azimuth, azimuth), left]
    }
}

/// Steps along a segment.
const STEPS: f64 = 256.0;
