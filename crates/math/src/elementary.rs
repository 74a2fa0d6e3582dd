//! Elementary functions in single precision, one text for `f32` and lanes.
//!
//! Polynomials after Cephes (S. Moshier) and, for the Bessel function, after
//! [AbramowitzStegun, 9.8.1, 9.8.2]. Largest errors seen in the tests, in units in the last place:
//! `exp` 1.5, `ln` 1.5, `sin`, `cos` 2 on [0, 2 pi], `atan2` 3.5, `i0e` 12.

use crate::{Mask, Real};
use core::f64::consts::{FRAC_1_SQRT_2, FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LOG2_E, PI};

/// Horner's rule; coefficients from the highest power down.
#[inline(always)]
pub fn poly<R: Real, const K: usize>(x: R, c: [f64; K]) -> R {
    let mut y = R::of(c[0]);
    for k in c.iter().skip(1) {
        y = y.fma(x, R::of(*k));
    }
    y
}

/// `e^x`, at most e^88; exactly zero below -87.7, where single precision has no normal numbers left: slow denormal ones stay rare.
#[inline(always)]
pub fn exp<R: Real>(x: R) -> R {
    let x = x.clamp(R::of(-88.0), R::of(88.0));
    let n = (x * R::of(LOG2_E)).round();
    let r = n.fma(R::of(-0.693_359_375), x);
    let r = n.fma(R::of(2.121_944_4e-4), r);
    let p = poly(
        r,
        [
            1.987_569_15e-4,
            1.398_199_950_7e-3,
            8.333_451_907_3e-3,
            4.166_579_589_4e-2,
            1.666_666_545_9e-1,
            5.000_000_120_1e-1,
        ],
    );
    (p.fma(r * r, r) + R::ONE) * n.pow2()
}

/// `e^x` for `x <= 88`, with a relative error of 2e-7 and another 1e-7 for each unit of `x`: `2^y` for `y = x log2 e`, rounded once.
/// The polynomial is the best of fifth degree that is 1 at 0.
#[inline(always)]
pub fn exp_coarse<R: Real>(x: R) -> R {
    let y = (x * R::of(LOG2_E)).max(R::of(-127.0));
    let n = y.round();
    let p = poly(
        y - n,
        [
            1.326_472_724_7e-3,
            9.671_512_688_2e-3,
            5.550_733_743_6e-2,
            2.402_224_208_5e-1,
            6.931_469_776e-1,
            1.0,
        ],
    );
    p * n.pow2()
}

/// Natural logarithm of a positive normal number.
#[inline(always)]
pub fn ln<R: Real>(x: R) -> R {
    let (m, e) = x.frexp();
    let low = m.lt(R::of(FRAC_1_SQRT_2));
    let e = R::select(low, e - R::ONE, e);
    let r = R::select(low, m + m, m) - R::ONE;
    let z = r * r;
    let p = poly(
        r,
        [
            7.037_683_629_2e-2,
            -1.151_461_031_0e-1,
            1.167_699_874_0e-1,
            -1.242_014_084_6e-1,
            1.424_932_278_7e-1,
            -1.666_805_766_5e-1,
            2.000_071_476_5e-1,
            -2.499_999_399_3e-1,
            3.333_333_117_4e-1,
        ],
    );
    let y = p * r * z;
    let y = e.fma(R::of(-2.121_944_4e-4), y);
    let y = z.fma(R::of(-0.5), y);
    e.fma(R::of(0.693_359_375), r + y)
}

/// Sine and cosine, `|x| < 8000` (three-part reduction by pi/2).
#[inline(always)]
pub fn sin_cos<R: Real>(x: R) -> (R, R) {
    let n = (x * R::of(FRAC_2_PI)).round();
    let r = n.fma(R::of(-1.570_312_5), x);
    let r = n.fma(R::of(-4.837_512_969_970_703e-4), r);
    let r = n.fma(R::of(-7.549_789_954_891_88e-8), r);
    let z = r * r;
    let s = poly(z, [-1.951_529_589_1e-4, 8.332_160_873_6e-3, -1.666_665_461_1e-1]) * z * r + r;
    let c = poly(z, [2.443_315_711_809_948e-5, -1.388_731_625_493_765e-3, 4.166_664_568_298_827e-2]) * z * z
        - R::of(0.5) * z
        + R::ONE;
    // The quadrant n mod 4, as a number in [-2, 2].
    let q = n - R::of(4.0) * (n * R::of(0.25)).round();
    let swap = (q.abs() - R::ONE).abs().lt(R::of(0.5));
    let (sn, cn) = (R::select(swap, c, s), R::select(swap, s, c));
    let neg_s = q.lt(R::of(-0.5)) | q.gt(R::of(1.5));
    let neg_c = q.gt(R::of(0.5)) | q.lt(R::of(-1.5));
    (R::select(neg_s, -sn, sn), R::select(neg_c, -cn, cn))
}

/// Angle of the point (`x`, `y`) in (-pi, pi].
#[inline(always)]
pub fn atan2<R: Real>(y: R, x: R) -> R {
    let (a, b) = (y.abs(), x.abs());
    let swap = a.gt(b);
    let num = a.min(b);
    // Keeps 0/0 at zero.
    let den = a.max(b).max(R::of(1e-30));
    let big = num.gt(den * R::of(0.414_213_562_373_095));
    let t = R::select(big, num - den, num) / R::select(big, num + den, den);
    let z = t * t;
    let p = poly(z, [8.053_744_495_38e-2, -1.387_768_560_32e-1, 1.997_771_064_78e-1, -3.333_294_915_39e-1])
        * z
        * t
        + t;
    let r = R::select(big, p + R::of(FRAC_PI_4), p);
    let r = R::select(swap, R::of(FRAC_PI_2) - r, r);
    let r = R::select(x.lt(R::ZERO), R::of(PI) - r, r);
    r.copysign(y)
}

/// `e^-x I_0(x)` for `x >= 0`.
#[inline(always)]
pub fn i0e<R: Real>(x: R) -> R {
    let (m, k) = i0e_parts(x);
    m * k.exp()
}

/// `m` and `k` with `e^-x I_0(x) = m e^k` for `x >= 0`, `k` not above zero. [AbramowitzStegun, 9.8.1, 9.8.2]
#[inline(always)]
pub fn i0e_parts<R: Real>(x: R) -> (R, R) {
    let narrow = x.lt(R::of(3.75));
    let (mut small, mut large) = (R::ZERO, R::ZERO);
    if narrow.any() {
        let t = (x * R::of(1.0 / 3.75)).sqr();
        small = poly(t, [0.0045813, 0.0360768, 0.2659732, 1.2067492, 3.0899424, 3.5156229, 1.0]);
    }
    if !narrow.all() {
        let inv_sqrt = R::ONE / x.max(R::of(3.75)).sqrt();
        let t = R::of(3.75) * inv_sqrt.sqr();
        large = inv_sqrt
            * poly(
                t,
                [
                    0.00392377,
                    -0.01647633,
                    0.02635537,
                    -0.02057706,
                    0.00916281,
                    -0.00157565,
                    0.00225319,
                    0.01328592,
                    0.39894228,
                ],
            );
    }
    (R::select(narrow, small, large), (-x).only_where(narrow))
}
