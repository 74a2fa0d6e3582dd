//! Elementary functions in double precision, for verification and for what is computed once a scene.
//!
//! Scalar, so they branch. Coefficients after Cephes (`exp`, `sin`, `cos`) and fdlibm (`ln`, `atan`).
//! Errors below 2 units in the last place on the domains given at each function.

use crate::elementary::poly;
use core::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LOG2_E, PI};

/// Adding this to a number below 2^51 and taking it away again rounds to a whole number, halves to even (1.5 * 2^52).
/// The operation itself is a call of the C library on machines before SSE 4.1.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

#[inline(always)]
fn round(x: f64) -> f64 {
    (x + ROUNDER) - ROUNDER
}

/// A polynomial of degree 5, coefficients from the highest power down, in pairs: shorter chains than Horner's rule.
#[inline(always)]
fn poly6(z: f64, [a, b, c, d, e, f]: [f64; 6]) -> f64 {
    let z2 = z * z;
    ((a * z + b) * z2 + (c * z + d)) * z2 + (e * z + f)
}

/// `e^x`, the argument clamped to [-708, 709].
pub fn exp(x: f64) -> f64 {
    let x = x.clamp(-708.0, 709.0);
    let n = round(x * LOG2_E);
    let r = x - n * 6.931_457_519_531_25e-1;
    let r = r - n * 1.428_606_820_309_417_2e-6;
    let z = r * r;
    let p = r * poly(z, [1.261_771_930_748_105_9e-4, 3.029_944_077_074_419_6e-2, 1.0]);
    let q = poly(z, [3.001_985_051_386_644_6e-6, 2.524_483_403_496_841e-3, 2.272_655_482_081_550_3e-1, 2.0]);
    let y = 1.0 + 2.0 * p / (q - p);
    // In two factors: 2^n alone overflows at n = 1024.
    let half = round(n * 0.5);
    y * pow2(half) * pow2(n - half)
}

fn pow2(n: f64) -> f64 {
    f64::from_bits(((1023 + n as i64) as u64) << 52)
}

/// Natural logarithm of a positive normal number.
pub fn ln(x: f64) -> f64 {
    let bits = x.to_bits();
    let mut e = (bits >> 52) as i64 - 1023;
    let mut m = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) | 0x3ff0_0000_0000_0000);
    if m > core::f64::consts::SQRT_2 {
        m *= 0.5;
        e += 1;
    }
    let e = e as f64;
    let f = m - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let r = z * poly(
        z,
        [
            1.479_819_860_511_658_6e-1,
            1.531_383_769_920_937_3e-1,
            1.818_357_216_161_805e-1,
            2.222_219_843_214_978_4e-1,
            2.857_142_874_366_239e-1,
            3.999_999_999_940_942e-1,
            6.666_666_666_666_735e-1,
        ],
    );
    let hfsq = 0.5 * f * f;
    e * 6.931_471_803_691_238e-1 - ((hfsq - (s * (hfsq + r) + e * 1.908_214_929_270_587_7e-10)) - f)
}

/// Sine and cosine, `|x| < 1e6`.
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    let n = round(x * FRAC_2_PI);
    // pi/2 in three parts, the first two with 30 trailing zero bits each.
    let r = x - n * (2.0 * 7.853_981_256_484_985e-1);
    let r = r - n * (2.0 * 3.774_894_707_930_798e-8);
    let r = r - n * (2.0 * 2.695_151_429_079_059_5e-15);
    let z = r * r;
    let s = r + r
        * z
        * poly6(
            z,
            [
                1.589_623_015_765_465_7e-10,
                -2.505_074_776_285_780_7e-8,
                2.755_731_362_138_572_4e-6,
                -1.984_126_982_958_954e-4,
                8.333_333_333_322_118e-3,
                -1.666_666_666_666_663e-1,
            ],
        );
    let c = 1.0 - 0.5 * z
        + z * z
            * poly6(
                z,
                [
                    -1.135_853_652_138_768_2e-11,
                    2.087_570_084_197_473e-9,
                    -2.755_731_417_929_674e-7,
                    2.480_158_728_885_17e-5,
                    -1.388_888_888_887_305_6e-3,
                    4.166_666_666_666_659e-2,
                ],
            );
    // Quadrants follow in no order, so there are no branches: odd ones swap, the sign bits come from bit 1.
    let q = n as i64;
    let (a, b) = if q & 1 == 0 { (s, c) } else { (c, s) };
    let with_sign = |x: f64, q: i64| f64::from_bits(x.to_bits() ^ ((q as u64 & 2) << 62));
    (with_sign(a, q), with_sign(b, q + 1))
}

/// Angle of the point (`x`, `y`) in (-pi, pi]; 0 at the origin.
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    let (a, b) = (y.abs(), x.abs());
    let (num, den) = if a > b { (b, a) } else { (a, b) };
    if den == 0.0 {
        return 0.0_f64.copysign(y);
    }
    // tan(pi/8): beyond it the angle is measured from pi/4.
    let far = num > 0.414_213_562_373_095_03 * den;
    let (start, num, den) = if far { (FRAC_PI_4, num - den, num + den) } else { (0.0, num, den) };
    let mut r = start + atan_small(num / den);
    if a > b {
        r = FRAC_PI_2 - r;
    }
    if x < 0.0 {
        r = PI - r;
    }
    r.copysign(y)
}

/// Arc tangent for `|t| <= tan(pi/8)`.
#[inline(always)]
fn atan_small(t: f64) -> f64 {
    let z = t * t;
    let high = [
        1.628_582_011_536_578_2e-2,
        -3.653_157_274_421_691_6e-2,
        4.976_877_994_615_932e-2,
        -5.833_570_133_790_573_5e-2,
        6.661_073_137_387_531e-2,
    ];
    let low = [
        -7.691_876_205_044_83e-2,
        9.090_887_133_436_507e-2,
        -1.111_111_040_546_235_6e-1,
        1.428_571_427_250_346_6e-1,
        -1.999_999_999_987_648_3e-1,
        3.333_333_333_333_293e-1,
    ];
    let [a, b, c, d, e] = high;
    let z2 = z * z;
    let high = (a * z2 + (b * z + c)) * z2 + (d * z + e);
    t - t * z * (high * (z2 * z2 * z2) + poly6(z, low))
}

/// `e^-x I_0(x)` for `x >= 0`: power series below 30, asymptotic series above. [AbramowitzStegun, 9.6.12, 9.7.1]
pub fn i0e(x: f64) -> f64 {
    if x < 30.0 {
        let q = x * x / 4.0;
        let (mut term, mut sum) = (1.0, 1.0);
        for k in 1..200 {
            term *= q / f64::from(k * k);
            sum += term;
            if term < 1e-17 * sum {
                break;
            }
        }
        return sum * exp(-x);
    }
    let (mut term, mut sum) = (1.0_f64, 1.0);
    for k in 1..40 {
        let odd = f64::from(2 * k - 1);
        let next = term * odd * odd / (8.0 * f64::from(k) * x);
        if next > term || next < 1e-17 {
            break;
        }
        term = next;
        sum += term;
    }
    sum / (2.0 * PI * x).sqrt()
}
