//! The inverse of the exit azimuth: all offsets `h` at which a ray leaves at a given azimuth. [Marschner2003, section 5.2]
//!
//! The paper approximates `Phi_p` by a cubic, which misplaces the caustic of TRT by two degrees; these are the roots of `Phi_p` itself.

use core::f64::consts::PI;

use sparrow_math::Real;

use super::azimuthal::{exit_azimuth, wrapped};

/// An offset, and the density `1 / (2 |d Phi / dh|)` in 1/rad with which light of all offsets leaves there; zero where there is no root.
#[derive(Clone, Copy, Debug)]
pub struct Root<R> {
    /// Offset of the ray, -1 to 1.
    pub h: R,
    /// Density in 1/rad.
    pub density: R,
}

/// The offset at which R leaves at `phi` in [-pi, pi].
#[inline(always)]
pub fn of_r<R: Real>(phi: R) -> Root<R> {
    let (sin, cos) = (R::of(0.5) * phi).sin_cos();
    Root { h: -sin, density: R::of(0.25) * cos.max(R::ZERO) }
}

/// The offset at which TT leaves at `phi` in [-pi, pi]; `eta` is the index seen along the axis, above 1.
///
/// `gamma_o - gamma_t = (pi - |phi|) / 2` is the angle by which either surface bends the ray, so that
/// `tan gamma_t = sin / (eta' - cos)` of that angle.
#[inline(always)]
pub fn of_tt<R: Real>(phi: R, eta: R) -> Root<R> {
    let (sin, cos) = (R::of(0.5) * (R::of(PI) - phi.abs()).max(R::ZERO)).sin_cos();
    let (y, x) = (sin, eta - cos);
    let scale = R::ONE / (x * x + y * y).sqrt();
    let (sin_t, cos_t) = (y * scale, x * scale);
    // cos gamma_o = cos(gamma_t + bend)
    let cos_o = cos_t * cos - sin_t * sin;
    let density = R::of(0.25) * cos_o * eta * cos_t / (eta * cos_t - cos_o);
    Root { h: (eta * sin_t).min(R::ONE).copysign(phi), density: density.only_where(cos_o.gt(R::ZERO)) }
}

/// The offset of the caustic of TRT, where `d Phi / dh = 0`; 0 for `eta >= 2`, which has none.
#[inline(always)]
pub fn caustic<R: Real>(eta: R) -> R {
    ((R::of(4.0) - eta * eta) * R::of(1.0 / 3.0)).safe_sqrt().min(R::ONE)
}

/// Bracketed steps of Newton's rule: as many as single precision can use near a caustic, where they only halve.
const STEPS: usize = 24;

/// The offsets at which TRT leaves at `phi` in [-pi, pi]: between the caustics, and on either side of them.
#[inline(always)]
pub fn of_trt<R: Real>(phi: R, eta: R) -> [Root<R>; 3] {
    let edge = caustic(eta).asin();
    let half = R::of(0.5 * PI);
    [
        trt_between(phi, eta, -half, -edge),
        trt_between(phi, eta, -edge, edge),
        trt_between(phi, eta, edge, half),
    ]
}

/// `Phi_2 - phi` and its slope by `gamma_o`.
#[inline(always)]
fn trt<R: Real>(gamma: R, phi: R, eta: R) -> [R; 2] {
    let (sin, cos) = gamma.sin_cos();
    let sin_t = sin / eta;
    let cos_t = ((R::ONE - sin_t) * (R::ONE + sin_t)).safe_sqrt().max(R::of(1e-9));
    let value = exit_azimuth(2, gamma, sin_t.atan2(cos_t)) - phi;
    [value, R::of(4.0) * cos / (eta * cos_t) - R::of(2.0)]
}

/// The root in an interval over which `Phi_2` is monotone and spans less than a turn.
#[inline(always)]
fn trt_between<R: Real>(phi: R, eta: R, low: R, high: R) -> Root<R> {
    let (at_low, at_high) = (trt(low, phi, eta)[0], trt(high, phi, eta)[0]);
    // An end that two intervals share counts once.
    let (from, to) = (at_low.gt(R::ZERO), at_high.gt(R::ZERO));
    let some = ((from & !to) | (to & !from)) & low.lt(high);
    let rising = R::select(at_high.gt(at_low), R::ONE, -R::ONE);
    let (mut low, mut high) = (low, high);
    let mut gamma = R::of(0.5) * (low + high);
    for _ in 0..STEPS {
        let [value, slope] = trt(gamma, phi, eta);
        let below = (value * rising).le(R::ZERO);
        low = R::select(below, gamma, low);
        high = R::select(below, high, gamma);
        let next = gamma - value / R::select(slope.abs().gt(R::of(1e-12)), slope, R::of(1e-12));
        let inside = next.ge(low) & next.le(high);
        gamma = R::select(inside, next, R::of(0.5) * (low + high));
    }
    let [_, slope] = trt(gamma, phi, eta);
    let (sin, cos) = gamma.sin_cos();
    // dh = cos gamma dgamma
    let density = R::of(0.5) * cos.max(R::ZERO) / slope.abs().max(R::of(1e-6));
    Root { h: sin, density: density.only_where(some) }
}

/// Azimuth of the caustic, and `d^2 Phi / dh^2` there.
#[inline(always)]
pub fn caustic_azimuth<R: Real>(eta: R) -> [R; 2] {
    let h = caustic(eta);
    let exit = exit_azimuth(2, h.asin(), (h / eta).asin());
    let (inner, outer) = ((eta - h) * (eta + h), ((R::ONE - h) * (R::ONE + h)).max(R::of(1e-12)));
    let bend = R::of(4.0) * h / (inner * inner.sqrt()) - R::of(2.0) * h / (outer * outer.sqrt());
    [wrapped(exit), bend]
}
