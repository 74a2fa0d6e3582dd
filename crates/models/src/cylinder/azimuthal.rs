//! Azimuthal lobes, and where a smooth cylinder sends light around itself.

use core::f64::consts::PI;

use sparrow_math::{Mask, Real};

use crate::microfacet::special::{erfcx, gauss_quantile};
use crate::opaque::exp_neg;

/// `x` in [-pi, pi] up to whole turns.
#[inline(always)]
pub fn wrapped<R: Real>(x: R) -> R {
    x - R::of(2.0 * PI) * (x * R::of(0.5 / PI)).round()
}

/// The azimuth `Phi_p = 2 p gamma_t - 2 gamma_o + p pi` at which lobe `p` leaves, from the azimuth it came from, up to whole turns.
/// [Marschner2003, eq. 3]
#[inline(always)]
pub fn exit_azimuth<R: Real>(p: u32, gamma_o: R, gamma_t: R) -> R {
    R::of(2.0 * f64::from(p)) * gamma_t - R::of(2.0) * gamma_o + R::of(f64::from(p % 2) * PI)
}

/// A direction around the fibre as a complex number `e^(i phi)`, in any scale: angles are added without finding them.
pub type Turn<R> = [R; 2];

/// Two turns one after the other.
#[inline(always)]
pub fn joined<R: Real>([a, b]: Turn<R>, [c, d]: Turn<R>) -> Turn<R> {
    [a * c - b * d, a * d + b * c]
}

/// From where R leaves to where the light came from, `e^(2 i gamma_o)`; and from where one lobe leaves to where that before it
/// did, `e^(-i (2 gamma_t + pi))`. Sines and cosines of both angles.
#[inline(always)]
pub fn turns_back<R: Real>([sin_o, cos_o]: [R; 2], [sin_t, cos_t]: [R; 2]) -> [Turn<R>; 2] {
    let two = R::of(2.0);
    [
        [(cos_o - sin_o) * (cos_o + sin_o), two * sin_o * cos_o],
        [(sin_t - cos_t) * (sin_t + cos_t), two * sin_t * cos_t],
    ]
}

/// A density around the fibre.
pub trait Azimuthal<R> {
    /// The mean of the density, in 1/rad, over an interval of that width in rad around `x` in [-pi, pi].
    fn mean(&self, x: R, width: R) -> R;
}

/// A logistic density, trimmed to [-pi, pi]. [Chiang2016]
#[derive(Clone, Copy, Debug)]
pub struct TrimmedLogistic<R> {
    s: R,
    inv_s: R,
    /// `1 / (s (F(pi) - F(-pi)))`
    scale: R,
    /// `F(-pi)`
    below: R,
}

impl<R: Real> TrimmedLogistic<R> {
    /// Of the scale `s` in rad, above zero.
    #[inline(always)]
    pub fn new(s: R) -> Self {
        let inv_s = R::ONE / s;
        let below = (R::of(-PI) * inv_s).exp();
        let below = below / (R::ONE + below);
        TrimmedLogistic { s, inv_s, scale: inv_s / (R::ONE - below - below), below }
    }
    /// Density in 1/rad at `x` in [-pi, pi].
    #[inline(always)]
    pub fn value(&self, x: R) -> R {
        let e = (-x.abs() * self.inv_s).exp_coarse();
        self.scale * e / (R::ONE + e).sqr()
    }
    /// Draws `x`.
    #[inline(always)]
    pub fn sample(&self, u: R) -> R {
        let within = R::ONE - self.below - self.below;
        let (low, high) = (self.below + u * within, self.below + (R::ONE - u) * within);
        (self.s * (low / high).ln()).clamp(R::of(-PI), R::of(PI))
    }
    /// `P(X > |x|)` before it was trimmed.
    #[inline(always)]
    fn tail(&self, x: R) -> R {
        let e = (-x.abs() * self.inv_s).exp_coarse();
        e / (R::ONE + e)
    }
    /// Share of the interval from `a` to `b >= a`, as far as it lies within [-pi, pi].
    #[inline(always)]
    fn between(&self, a: R, b: R) -> R {
        let [a, b] = [a, b].map(
            #[inline(always)]
            |x| x.clamp(R::of(-PI), R::of(PI)),
        );
        let (p, q) = (self.tail(a), self.tail(b));
        let apart = a.lt(R::ZERO) & b.gt(R::ZERO);
        R::select(apart, R::ONE - p - q, (p - q).abs()) * self.scale * self.s
    }
}

impl<R: Real> Azimuthal<R> for TrimmedLogistic<R> {
    #[inline(always)]
    fn mean(&self, x: R, width: R) -> R {
        let half = R::of(0.5) * width;
        let turn = R::select(x.lt(R::ZERO), R::of(2.0 * PI), R::of(-2.0 * PI));
        // What reaches over the far side of the fibre comes in again at the other end.
        let whole = self.between(x - half, x + half) + self.between(x + turn - half, x + turn + half);
        // Narrow intervals would lose the digits that their ends share.
        let wide = width.gt(R::of(0.02) * self.s);
        R::select(wide, whole / R::select(wide, width, R::ONE), self.value(x))
    }
}

/// A Gaussian density around a circle, its standard deviation at most about one radian.
#[derive(Clone, Copy, Debug)]
pub struct WrappedGauss<R> {
    std: R,
    inv_std: R,
}

impl<R: Real> WrappedGauss<R> {
    /// Of the standard deviation in rad, above zero.
    #[inline(always)]
    pub fn new(std: R) -> Self {
        WrappedGauss { std, inv_std: R::ONE / std }
    }
    #[inline(always)]
    fn line(&self, x: R) -> R {
        exp_neg(R::of(0.5) * (x * self.inv_std).sqr()) * self.inv_std * R::of(0.398_942_280_401_432_7)
    }
    /// `P(|X| > |x|) / 2` on the line.
    #[inline(always)]
    fn tail(&self, x: R) -> R {
        let y = x.abs() * self.inv_std * R::of(core::f64::consts::FRAC_1_SQRT_2);
        R::of(0.5) * exp_neg(y * y) * erfcx(y)
    }
    /// Share of the line from `a` to `b >= a`.
    #[inline(always)]
    fn between(&self, a: R, b: R) -> R {
        let (p, q) = (self.tail(a), self.tail(b));
        let apart = a.lt(R::ZERO) & b.gt(R::ZERO);
        R::select(apart, R::ONE - p - q, (p - q).abs())
    }
    /// Density in 1/rad at `x` in [-pi, pi]; of the images those within a turn count.
    #[inline(always)]
    pub fn value(&self, x: R) -> R {
        self.line(x) + self.line(x.abs() - R::of(2.0 * PI))
    }
    #[inline(always)]
    fn mean_on_line(&self, x: R, width: R) -> R {
        let half = R::of(0.5) * width;
        let (a, b) = (x - half, x + half);
        // Where the density hardly bends, Simpson's rule loses no digits.
        let flat = (self.line(a) + R::of(4.0) * self.line(x) + self.line(b)) * R::of(1.0 / 6.0);
        let steep = width.gt(R::of(0.2) * self.std);
        R::select(steep, self.between(a, b) / R::select(steep, width, R::ONE), flat)
    }
    /// Draws `x`.
    #[inline(always)]
    pub fn sample(&self, u: R) -> R {
        R::of(core::f64::consts::SQRT_2) * self.std * gauss_quantile(u)
    }
}

impl<R: Real> Azimuthal<R> for WrappedGauss<R> {
    /// Zero where the interval is seven standard deviations away.
    #[inline(always)]
    fn mean(&self, x: R, width: R) -> R {
        let reach = R::of(7.1) * self.std + R::of(0.5) * width;
        let image = x.abs() - R::of(2.0 * PI);
        let (near, wraps) = (x.abs().lt(reach), image.abs().lt(reach));
        // Lanes that need neither cost nothing, and the sum is the same whoever else is in the batch.
        let mut sum = R::ZERO;
        if near.any() {
            sum = self.mean_on_line(x, width).only_where(near);
        }
        if wraps.any() {
            sum = sum + self.mean_on_line(image, width).only_where(wraps);
        }
        sum
    }
}

/// A Cauchy density around a circle.
#[derive(Clone, Copy, Debug)]
pub struct WrappedCauchy {
    /// The mean of the cosine, from 0 to below 1.
    pub mean_cosine: f64,
}

impl WrappedCauchy {
    /// Draws `x` in [-pi, pi].
    pub fn sample(&self, u: f64) -> f64 {
        let (sin, cos) = Real::sin_cos(PI * (u - 0.5));
        2.0 * Real::atan2((1.0 - self.mean_cosine) * sin, (1.0 + self.mean_cosine) * cos)
    }
}

impl Azimuthal<f64> for WrappedCauchy {
    fn mean(&self, x: f64, width: f64) -> f64 {
        let r = self.mean_cosine;
        if width < 1e-6 {
            return (1.0 - r) * (1.0 + r) * (0.5 / PI) / (1.0 + r * r - 2.0 * r * Real::cos(x));
        }
        // The share below an angle: the tangent of half of it, stretched, is that of half a uniform angle; turns count one each.
        let below = |x: f64| {
            let y = wrapped(x);
            let (sin, cos) = Real::sin_cos(0.5 * y);
            Real::atan2((1.0 + r) * sin, (1.0 - r) * cos) / PI + (x - y) * (0.5 / PI)
        };
        (below(x + 0.5 * width) - below(x - 0.5 * width)) / width
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means over an interval, by many values.
    fn mean_of(d: &impl Azimuthal<f64>, x: f64, width: f64) -> f64 {
        let n = 20_000;
        let at = |k: i32| d.mean(wrapped(x + ((f64::from(k) + 0.5) / f64::from(n) - 0.5) * width), 0.0);
        (0..n).map(at).sum::<f64>() / f64::from(n)
    }

    #[test]
    fn turns_lead_from_where_lobes_leave() {
        for (gamma_o, gamma_t) in [(0.4, 0.25), (-1.5, -0.7), (1.2, 0.6), (0.0, 0.0)] {
            let [(s_o, c_o), (s_t, c_t)] = [gamma_o, gamma_t].map(|x: f64| Real::sin_cos(x));
            let [mut back, passage] = turns_back([s_o, c_o], [s_t, c_t]);
            for p in 0..3 {
                let apart = wrapped(exit_azimuth(p, gamma_o, gamma_t) + Real::atan2(back[1], back[0]));
                assert!(apart.abs() < 1e-14, "lobe {p} of {gamma_o} {gamma_t}: {apart}");
                back = joined(back, passage);
            }
        }
    }

    #[test]
    fn means_over_intervals_are_means_of_values() {
        for width in [1e-3, 0.05, 0.4, 2.0] {
            for x in [0.0, 0.3, -1.5, 3.0, -3.1, PI] {
                for s in [0.05, 0.4, 3.0] {
                    let d = TrimmedLogistic::<f64>::new(s);
                    let (mean, values) = (d.mean(x, width), mean_of(&d, x, width));
                    // Narrow intervals take the value at their middle: at the kink on the far side it is the lowest.
                    let kink = if width > 0.02 * s { 0.0 } else { width / (4.0 * s) };
                    assert!(
                        (mean - values).abs() < (1e-4 + kink) * values + 1e-9,
                        "logistic {s} {x} {width}: {mean} {values}"
                    );
                }
                for mean_cosine in [0.0, 0.5, 0.95] {
                    let d = WrappedCauchy { mean_cosine };
                    let (mean, values) = (d.mean(x, width), mean_of(&d, x, width));
                    assert!(
                        (mean - values).abs() < 1e-4 * values,
                        "Cauchy {mean_cosine} {x} {width}: {mean} {values}"
                    );
                }
            }
        }
    }
}
