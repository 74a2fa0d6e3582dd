//! The longitudinal term `M`, which spreads light around the cone of mirror reflection and conserves energy. [dEon2011, eq. 7]

use core::f64::consts::PI;

use sparrow_math::Real;

/// `M(theta_i, theta_o) = exp(-sin sin / v) I_0(cos cos / v) csch(1 / v) / (2 v)`: unit `1/rad`, `int M cos theta_i dtheta_i = 1`
/// for every `theta_o` and every variance `v`.
///
/// Written as `e^(-(1 - cos(theta_i + theta_o)) / v) (e^-a I_0(a)) / (v (1 - e^(-2 / v)))` with `a = cos cos / v`: no factor overflows, and
/// the first keeps its digits in narrow lobes.
#[derive(Clone, Copy, Debug)]
pub struct Longitudinal<R> {
    v: R,
    inv_v: R,
    /// `e^(-2 / v)`
    tail: R,
    /// `1 / (v (1 - e^(-2 / v)))`
    scale: R,
}

impl<R: Real> Longitudinal<R> {
    /// Of the variance `v` in rad^2, above zero.
    #[inline(always)]
    pub fn new(v: R) -> Self {
        let inv_v = R::ONE / v;
        let tail = (R::of(-2.0) * inv_v).exp();
        Longitudinal { v, inv_v, tail, scale: inv_v / (R::ONE - tail) }
    }
    /// `a` where the mask is true, else `b`.
    #[inline(always)]
    pub fn select(m: R::Mask, a: &Self, b: &Self) -> Self {
        Longitudinal {
            v: R::select(m, a.v, b.v),
            inv_v: R::select(m, a.inv_v, b.inv_v),
            tail: R::select(m, a.tail, b.tail),
            scale: R::select(m, a.scale, b.scale),
        }
    }
    /// `M` from sines and cosines of both inclinations.
    #[inline(always)]
    pub fn value(&self, [sin_i, cos_i]: [R; 2], [sin_o, cos_o]: [R; 2]) -> R {
        let apart = R::of(0.5) * ((cos_i - cos_o).sqr() + (sin_i + sin_o).sqr());
        let (m, k) = (cos_i * cos_o * self.inv_v).i0e_parts();
        m * (k - apart * self.inv_v).exp_coarse() * self.scale
    }
    /// Draws `sin theta_i` with density `M cos theta_i`. [dEon2013]
    #[inline(always)]
    pub fn sample(&self, [sin_o, cos_o]: [R; 2], u: [R; 2]) -> R {
        // 1 - cos of the angle to the mirror cone's axis.
        let t = -self.v * (u[0] + (R::ONE - u[0]) * self.tail).ln();
        let t = t.clamp(R::ZERO, R::of(2.0));
        let sin = (t * (R::of(2.0) - t)).safe_sqrt();
        (t - R::ONE) * sin_o + sin * (R::of(2.0 * PI) * u[1]).cos() * cos_o
    }
}

/// Sine and cosine of `theta + shift`; the cosine's magnitude where the shift leads past the fibre's end. [Chiang2016]
#[inline(always)]
pub fn tilted<R: Real>([sin, cos]: [R; 2], [sin_shift, cos_shift]: [R; 2]) -> [R; 2] {
    [sin * cos_shift + cos * sin_shift, (cos * cos_shift - sin * sin_shift).abs()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_precision_keeps_the_peak_of_narrow_lobes() {
        for v in [1e-5, 1e-3, 0.1] {
            let (s, c) = Real::sin_cos(0.7_f64);
            let (t, d) = Real::sin_cos(-0.7 + 0.5 * f64::sqrt(v));
            let want = Longitudinal::new(v).value([t, d], [s, c]);
            let n = |x: f64| x as f32;
            let got = Longitudinal::new(n(v)).value([n(t), n(d)], [n(s), n(c)]);
            assert!((f64::from(got) / want - 1.0).abs() < 1e-4, "{v}: {got} {want}");
        }
    }

    #[test]
    fn a_tilt_past_the_end_of_the_fibre_comes_down_on_the_other_side() {
        let [s, c] = tilted([1.0_f64, 0.0], Real::sin_cos(0.1).into());
        assert!((s - Real::cos(0.1)).abs() < 1e-15 && (c - Real::sin(0.1)).abs() < 1e-15);
    }
}
