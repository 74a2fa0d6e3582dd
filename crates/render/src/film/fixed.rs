//! Rounding of one term to the film's grids.

/// Bits after the binary point of the sums of values.
pub(crate) const VALUE_BITS: i32 = 64;
/// Bits after the binary point of the sums of weights.
pub(crate) const WEIGHT_BITS: i32 = 32;

/// Largest magnitude of one term, 2^40.
const TERM_MAX: f64 = 1_099_511_627_776.0;
/// Largest magnitude of a weight.
const WEIGHT_MAX: f32 = 256.0;

/// Step of the value grid.
pub(crate) const VALUE_STEP: f64 = 1.0 / 18_446_744_073_709_551_616.0;
/// Step of the weight grid.
pub(crate) const WEIGHT_STEP: f64 = 1.0 / 4_294_967_296.0;

/// `|x| * 2^64` as a whole number, rounded to the nearest, halves to even. `x` finite and below 2^63 in magnitude.
///
/// Written out because a multiplication and a cast would round towards zero and call into a library.
#[inline(always)]
fn magnitude(x: f64) -> u128 {
    let bits = x.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32;
    // Below 2^-66 everything rounds to zero, denormal numbers among it.
    let mantissa = (bits & 0x000f_ffff_ffff_ffff) | 0x0010_0000_0000_0000;
    let shift = exponent - 1075 + VALUE_BITS;
    if shift >= 0 {
        return u128::from(mantissa) << shift.min(74);
    }
    let down = -shift;
    if down > 54 {
        return 0;
    }
    let whole = mantissa >> down;
    let rest = mantissa & ((1 << down) - 1);
    let half = 1u64 << (down - 1);
    u128::from(whole + u64::from(rest > half || (rest == half && whole & 1 == 1)))
}

/// Added to a number below 2^51 in magnitude, leaves it in the lowest bits, rounded to the nearest, halves to even.
const ROUND: f64 = 1.5 * 4_503_599_627_370_496.0;

/// Terms below this in magnitude, 2^27, have [`parts`].
pub(crate) const PARTS_MAX: f64 = 134_217_728.0;

/// A term in two parts, of steps of 2^-24 and 2^-64, of which there are up to 2^51 and 2^39.
#[inline(always)]
pub(crate) fn parts(x: f64) -> [i64; 2] {
    let scaled = x * 16_777_216.0;
    let upper = scaled + ROUND;
    // What the first leaves is exact.
    let lower = (scaled - (upper - ROUND)) * 1_099_511_627_776.0 + ROUND;
    [upper, lower].map(|rounded| (rounded.to_bits() as i64).wrapping_sub(ROUND.to_bits() as i64))
}

/// The sum of terms whose [`parts`] have those sums.
#[inline(always)]
pub(crate) fn whole([upper, lower]: [i64; 2]) -> i128 {
    (i128::from(upper) << 40) + i128::from(lower)
}

/// A term of a signed sum, cut at ±2^40.
#[inline(always)]
pub(crate) fn value(x: f64) -> i128 {
    if x.abs() < PARTS_MAX {
        return whole(parts(x));
    }
    let m = magnitude(x.clamp(-TERM_MAX, TERM_MAX)) as i128;
    if x < 0.0 { -m } else { m }
}

/// A term of a sum of squares; the largest number where it does not fit.
#[inline(always)]
pub(crate) fn square(x: f64) -> u128 {
    if x < 9.2e18 { magnitude(x) } else { u128::MAX }
}

/// A weight in steps of 2^-32, cut at ±256, halves away from zero.
#[inline(always)]
pub(crate) fn weight(w: f32) -> i64 {
    let scaled = f64::from(w.clamp(-WEIGHT_MAX, WEIGHT_MAX)) * 4_294_967_296.0;
    (scaled + f64::copysign(0.5, scaled)) as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_round_to_the_nearest_step() {
        let one = 1i128 << VALUE_BITS;
        for (x, want) in [
            (0.0, 0),
            (1.0, one),
            (-1.0, -one),
            (0.75 * VALUE_STEP, 1),
            (0.5 * VALUE_STEP, 0),
            (1.5 * VALUE_STEP, 2),
            (2.5 * VALUE_STEP, 2),
            (-1.5 * VALUE_STEP, -2),
            (0.49 * VALUE_STEP, 0),
            (f64::MIN_POSITIVE, 0),
            (5e-324, 0),
            (1e12, 1_000_000_000_000 * one),
            (1e30, one << 40),
            (f64::MIN, -(one << 40)),
            (134_217_727.999_999_98, (one << 27) - (one >> 26)),
            (-134_217_728.0, -(one << 27)),
            (0.5 / 16_777_216.0, one >> 25),
        ] {
            assert_eq!(value(x), want, "{x}");
        }
    }

    fn magnitude_of(x: f64) -> i128 {
        magnitude(x) as i128
    }

    #[test]
    fn terms_agree_with_plain_casts() {
        let mut x = 3.3e-16;
        while x < 1e11 {
            // From 2^-12 on the product is a whole number, and the cast is exact.
            let scaled = x / VALUE_STEP;
            assert_eq!(value(x), scaled.round_ties_even() as i128, "{x}");
            assert_eq!(value(-x), -magnitude_of(x), "{x}");
            x *= 1.37;
        }
    }

    #[test]
    fn weights_and_squares_round_too() {
        assert_eq!(weight(1.0), 1 << 32);
        assert_eq!(weight(-0.25), -(1 << 30));
        assert_eq!(weight(1e20), 256 << 32);
        assert_eq!(square(1e30), u128::MAX);
        assert_eq!(square(4.0), 4 << VALUE_BITS);
    }
}
