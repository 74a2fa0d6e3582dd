//! A film so thin that light reflected by its two faces interferes, on a base.
//!
//! Belcour and Barla sum the orders of reflection and integrate them against the response of red, green and blue
//! [BelcourBarla2017]. Here paths carry wavelengths, so the sum over all orders, Airy's, is taken at each of them and
//! nothing is approximated: `r = (r_12 + r_23 e^(2 i b)) / (1 + r_12 r_23 e^(2 i b))` with `b = 2 pi d n_2 cos theta_2 /
//! lambda`, for either polarisation. [BornWolf, sec. 1.6.4]
//! `q = n cos theta = sqrt(n^2 - sin^2 theta_1)` stands for the angle in each medium, so that absorbing and
//! evanescent waves need no case of their own.

use core::f64::consts::PI;

use sparrow_math::Real;

use crate::complex::Complex;

/// A medium by its complex index `eta + i k`, over that outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Medium<R> {
    /// `(eta + i k)^2`
    n2: Complex<R>,
}

impl<R: Real> Medium<R> {
    #[inline(always)]
    pub(crate) fn new(eta: R, k: R) -> Self {
        // An index of zero has no meaning.
        let n = Complex::new(eta.max(R::of(1e-3)), k);
        Medium { n2: n * n }
    }
    /// `n cos theta` where `sin^2` of the angle outside is `s2`.
    #[inline(always)]
    fn q(&self, s2: R) -> Complex<R> {
        (self.n2 - Complex::real(s2)).sqrt_upper()
    }
}

/// `|r|^2` of two amplitudes `a / b` and `c / d` with the phase factor between them, kept as fractions.
#[inline(always)]
fn airy<R: Real>(first: [Complex<R>; 2], second: [Complex<R>; 2], phase: Complex<R>) -> R {
    let [a, b] = first;
    let [c, d] = second;
    let cp = c * phase;
    let (top, bottom) = (a * d + cp * b, b * d + cp * a);
    (top.norm2() / bottom.norm2().max(R::of(1e-30))).min(R::ONE)
}

/// Reflectance of a `film` on a `base` for unpolarised light; `waves` is the thickness over the wavelength outside.
///
/// `cos_i` in [0, 1].
#[inline(always)]
pub(crate) fn reflectance<R: Real>(cos_i: R, film: Medium<R>, waves: R, base: Medium<R>) -> R {
    let s2 = ((R::ONE - cos_i) * (R::ONE + cos_i)).max(R::ZERO);
    let (q1, q2, q3) = (Complex::real(cos_i), film.q(s2), base.q(s2));
    let phase = (q2 * (R::of(4.0 * PI) * waves)).exp_i();
    // Electric field across the plane of incidence, and within it. [BornWolf, sec. 1.5.2]
    let s = airy([q1 - q2, q1 + q2], [q2 - q3, q2 + q3], phase);
    let (near, far) = (film.n2 * cos_i, [base.n2 * q2, film.n2 * q3]);
    let p = airy([near - q2, near + q2], [far[0] - far[1], far[0] + far[1]], phase);
    (s + p) * R::of(0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel;

    fn film(cos: f64, n: (f64, f64), waves: f64, base: (f64, f64)) -> f64 {
        reflectance(cos, Medium::new(n.0, n.1), waves, Medium::new(base.0, base.1))
    }

    #[test]
    fn no_film_is_the_base_and_a_film_of_the_base_is_too() {
        for cos in [1.0, 0.6, 0.2, 0.01] {
            let want = fresnel::conductor(cos, 0.4, 3.2);
            for got in [
                film(cos, (1.5, 0.0), 0.0, (0.4, 3.2)),
                film(cos, (0.4, 3.2), 0.7, (0.4, 3.2)),
                film(cos, (1.0, 0.0), 0.7, (0.4, 3.2)),
                film(cos, (0.4, 3.2), 50.0, (1.7, 0.3)),
            ] {
                assert!((got - want).abs() < 1e-12, "{cos}: {got}, {want}");
            }
        }
    }

    #[test]
    fn a_quarter_wave_of_the_mean_index_reflects_nothing() {
        let n: f64 = 1.3;
        assert!(film(1.0, (n, 0.0), 0.25 / n, (n * n, 0.0)) < 1e-30);
        // Half a wave is not there.
        let want = fresnel::dielectric(1.0, 1.69).0;
        assert!((film(1.0, (n, 0.0), 0.5 / n, (n * n, 0.0)) - want).abs() < 1e-14);
    }

    #[test]
    fn the_mean_over_all_phases_is_the_sum_of_intensities() {
        // Without interference: R_12 + T_12^2 R_23 / (1 - R_12 R_23), for each polarisation.
        let (cos, n, base) = (0.7, 1.45, (0.2, 3.5));
        let c2 = (1.0 - (1.0 - cos * cos) / (n * n)).sqrt();
        let (s1, p1) = fresnel::conductor_polarized(cos, n, 0.0);
        let (s2, p2) = fresnel::conductor_polarized(c2, base.0 / n, base.1 / n);
        let sum = |a: f64, b: f64| a + (1.0 - a).powi(2) * b / (1.0 - a * b);
        let want = 0.5 * (sum(s1, s2) + sum(p1, p2));
        let count = 400;
        let period = 0.5 / (n * c2);
        let got: f64 = (0..count)
            .map(|i| film(cos, (n, 0.0), period * f64::from(i) / f64::from(count), base))
            .sum::<f64>()
            / f64::from(count);
        assert!((got - want).abs() < 1e-10, "{got} {want}");
    }

    #[test]
    fn surface_admittance_gives_the_same() {
        // For the field across the plane of incidence: what the film makes of the base's admittance q_3 is
        // q_2 (q_3 - i q_2 tan b) / (q_2 - i q_3 tan b); the outside then sees one interface. [BornWolf, sec. 1.6.2]
        let (cos, n, waves, base): (f64, f64, f64, (f64, f64)) = (0.8, 1.8, 0.37, (0.9, 2.1));
        let s2 = 1.0 - cos * cos;
        let (q2, q3) = ((n * n - s2).sqrt(), Medium::new(base.0, base.1).q(s2));
        let t = Real::tan(2.0 * PI * waves * q2);
        let top = Complex::new(q3.re, q3.im - q2 * t) * q2;
        let bottom = Complex::new(q2 + q3.im * t, -q3.re * t);
        let seen = top * Complex::new(bottom.re, -bottom.im) * (1.0 / bottom.norm2());
        let want = (Complex::real(cos) - seen).norm2() / (Complex::real(cos) + seen).norm2();
        let (medium, base) = (Medium::new(n, 0.0), Medium::new(base.0, base.1));
        let (c, film_q) = (Complex::real(cos), medium.q(s2));
        let phase = (film_q * (4.0 * PI * waves)).exp_i();
        let got = airy([c - film_q, c + film_q], [film_q - base.q(s2), film_q + base.q(s2)], phase);
        assert!((got - want).abs() < 1e-12, "{got} {want}");
    }
}
