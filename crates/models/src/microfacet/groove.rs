//! Light in a symmetric V-groove of mirrors, through all its bounces, in the section across it.
//!
//! Unfolded at its walls, the groove becomes a fan of chords of a circle about its bottom: a ray that enters through chord 0,
//! between the angles -g and g, runs straight on and leaves through chord k, between (2k - 1) g and (2k + 1) g, after k
//! bounces. Seen along the ray a corner at the angle t lies at `sin(t - psi)`, so that the share of the light that bounces k
//! times is the overlap of two intervals. [XieHanrahan2018], [LeeEtAl2018]
//!
//! `psi` is the angle of the ray from the normal, positive to the right; g is half the opening angle, the complement of the walls'
//! tilt. What is said of the right wall holds for the left one with `psi` and the exit angle mirrored.

use core::f64::consts::PI;

use sparrow_math::Real;

/// The width, seen along the ray, of the light that meets the right wall first and leaves after `k` bounces; the circle has
/// radius one. `met` is told the cosine between ray and wall at every bounce.
///
/// Takes sine and cosine of `psi` and g, for which the exit lies above: see [`opening`].
#[inline(always)]
pub(crate) fn width<R: Real>(psi: [R; 2], g: [R; 2], k: u32, mut met: impl FnMut(R)) -> R {
    let ([sin_psi, cos_psi], [sin_g, cos_g]) = (psi, g);
    // Corner j at the angle (2 j - 1) g - psi; each next one by a turn of 2 g.
    let (sin_2g, cos_2g) = (R::of(2.0) * sin_g * cos_g, (cos_g - sin_g) * (cos_g + sin_g));
    let mut sin = -(sin_g * cos_psi + cos_g * sin_psi);
    let mut cos = cos_g * cos_psi - sin_g * sin_psi;
    let entry_low = sin;
    let mut entry_high = sin;
    let mut last = sin;
    for j in 0..=k {
        last = sin;
        (sin, cos) = (sin * cos_2g + cos * sin_2g, cos * cos_2g - sin * sin_2g);
        if j == 0 {
            entry_high = sin;
        }
        if j < k {
            met(sin.abs().min(R::ONE));
        }
    }
    let low = entry_low.max(R::ZERO).max(last.min(sin));
    let high = entry_high.min(last.max(sin));
    (high - low).max(R::ZERO)
}

/// The share of the light that meets the right wall first and leaves after `k` bounces.
#[inline(always)]
pub fn share<R: Real>(psi: R, g: R, k: u32) -> R {
    let (sin_psi, cos_psi) = psi.sin_cos();
    let (sin_g, cos_g) = g.sin_cos();
    let leaves_above = (exit(psi, g, k).abs()).lt(R::of(0.5 * PI));
    let width = width([sin_psi, cos_psi], [sin_g, cos_g], k, |_| ());
    (width / (R::of(2.0) * sin_g * cos_psi)).only_where(leaves_above)
}

/// The angle at which light leaves after `k` bounces, the first at the right wall; above if less than a quarter turn.
#[inline(always)]
pub fn exit<R: Real>(psi: R, g: R, k: u32) -> R {
    let straight = psi + R::of(PI) - R::of(f64::from(2 * k)) * g;
    if k % 2 == 1 { -straight } else { straight }
}

/// Half the opening angle of the groove that sends light from `psi` to the angle `exit` in `k` bounces, the first at the right wall; such
/// a groove exists where it lies between zero and a quarter turn.
#[inline(always)]
pub(crate) fn opening<R: Real>(psi: R, exit: R, k: u32) -> R {
    let straight = if k % 2 == 1 { -exit } else { exit };
    (psi + R::of(PI) - straight) * R::of(0.5 / f64::from(k))
}

/// Follows a ray that enters at `u` of the groove's width: bounces and exit angle.
#[inline(always)]
pub(crate) fn follow<R: Real>(psi: R, g: R, u: R) -> (R, R) {
    let at = (-(g + psi).sin()).lerp((g - psi).sin(), u);
    let right = at.ge(R::ZERO);
    let psi = R::select(right, psi, -psi);
    // It leaves the circle at this angle, and through the chord that spans it.
    let out = psi + R::of(PI) - at.abs().min(R::ONE).asin();
    let k = (out / (g + g)).round();
    let straight = psi + R::of(PI) - (k + k) * g;
    let half = k * R::of(0.5);
    let odd = (half - half.round()).abs().gt(R::of(0.25));
    let exit = R::select(odd, -straight, straight);
    (k, R::select(right, exit, -exit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_add_up_and_agree_with_rays() {
        for (beta, psi) in [(20.0, 0.0), (35.0, 50.0), (45.0, -30.0), (60.0, 10.0), (72.0, 80.0)] {
            let (g, psi) = (f64::to_radians(90.0 - beta), f64::to_radians(psi));
            let n = 20_000;
            let mut counts = [[0.0; 2]; 16];
            for i in 0..n {
                let (k, exit) = follow(psi, g, (f64::from(i) + 0.5) / f64::from(n));
                let right = (exit - super::exit(psi, g, k as u32)).abs() < 1e-9;
                counts[k as usize][usize::from(right)] += 1.0 / f64::from(n);
                assert!(exit.abs() < 0.5 * PI + 1e-9, "beta {beta}: {exit}");
            }
            let mut sum = 0.0;
            for k in 1..16 {
                let (right, left) = (share(psi, g, k), share(-psi, g, k));
                sum += right + left;
                let both = counts[k as usize][0] + counts[k as usize][1];
                assert!(
                    (right + left - both).abs() < 2e-4,
                    "beta {beta}, {k} bounces: {right} {left} {both}"
                );
            }
            assert!((sum - 1.0).abs() < 1e-12, "beta {beta}: {sum}");
        }
    }

    #[test]
    fn the_opening_is_that_which_leads_there() {
        for k in 1..6 {
            let (psi, g) = (0.3, 0.5 * PI - 0.9);
            assert!((opening(psi, exit(psi, g, k), k) - g).abs() < 1e-14_f64);
        }
    }
}
