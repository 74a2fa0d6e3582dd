//! Fresnel's equations for unpolarised light.

use sparrow_math::Real;

/// Reflectance of a smooth dielectric boundary and the cosine on the other side.
///
/// `cos_i >= 0` is the incident cosine, `eta` the relative index, transmitted over incident side. Returns
/// (F, `cos_t >= 0`); beyond the critical angle (1, 0). [Hecht, eq. 4.34, 4.40]
#[inline(always)]
pub fn dielectric<R: Real>(cos_i: R, eta: R) -> (R, R) {
    // cos_t^2 = 1 - (1 - cos_i^2) / eta^2, without the cancellation at grazing angles and equal indices.
    let cos2_t = (cos_i * cos_i + (eta - R::ONE) * (eta + R::ONE)) / (eta * eta);
    let cos_t = cos2_t.safe_sqrt();
    // Numerators and denominators of r_p and r_s, brought to one division.
    let (p, s) = (eta * cos_i, eta * cos_t);
    let (n_p, d_p, n_s, d_s) = (p - cos_t, p + cos_t, cos_i - s, cos_i + s);
    let f = R::of(0.5) * ((n_p * d_s).sqr() + (n_s * d_p).sqr()) / (d_p * d_s).sqr();
    let total = cos2_t.le(R::ZERO);
    (R::select(total, R::ONE, f), R::select(total, R::ZERO, cos_t))
}

/// The terms of both reflectances of a conductor with the complex index `eta + i k`, relative to the outside:
/// `R_s = (t1 - t2) / (t1 + t2)` and `R_p = R_s (t3 - t4) / (t3 + t4)`. [BornWolf, sec. 14.2], arranged to need no complex
/// square root.
#[inline(always)]
fn conductor_terms<R: Real>(cos_i: R, eta: R, k: R) -> [R; 4] {
    let c2 = cos_i * cos_i;
    let s2 = R::ONE - c2;
    let t0 = eta * eta - k * k - s2;
    let ab = (t0 * t0 + R::of(4.0) * eta * eta * k * k).sqrt();
    let a = ((ab + t0) * R::of(0.5)).safe_sqrt();
    let t2 = R::of(2.0) * a * cos_i;
    // Far below any other term; makes 0 / 0 one, which is what an index of zero reflects at any angle, and any index at grazing.
    let tiny = R::of(1e-30);
    [ab + c2 + tiny, t2, c2 * ab + s2 * s2 + tiny, t2 * s2]
}

/// Reflectance of a smooth conductor with the complex index `eta + i k`, relative to the outside.
///
/// `cos_i` in [0, 1]. The mean of [`conductor_polarized`], in which both numerators of `R_p` add up.
#[inline(always)]
pub fn conductor<R: Real>(cos_i: R, eta: R, k: R) -> R {
    let [t1, t2, t3, t4] = conductor_terms(cos_i, eta, k);
    (t1 - t2) * t3 / ((t1 + t2) * (t3 + t4))
}

/// The two reflectances of [`conductor`]: electric field across the plane of incidence (s), and within it (p).
#[inline(always)]
pub fn conductor_polarized<R: Real>(cos_i: R, eta: R, k: R) -> (R, R) {
    let [t1, t2, t3, t4] = conductor_terms(cos_i, eta, k);
    let r_s = (t1 - t2) / (t1 + t2);
    (r_s, r_s * ((t3 - t4) / (t3 + t4)))
}

/// `x^5`
#[inline(always)]
fn fifth<R: Real>(x: R) -> R {
    let x2 = x * x;
    x2 * x2 * x
}

/// Schlick's approximation from the reflectance `f0` at normal incidence. [Schlick1994, eq. 15]
#[inline(always)]
pub fn schlick<R: Real>(cos_i: R, f0: R) -> R {
    f0 + (R::ONE - f0) * fifth(R::ONE - cos_i)
}

/// The mean of [`schlick`] over the hemisphere, weighted with the cosine.
#[inline(always)]
pub fn schlick_average<R: Real>(f0: R) -> R {
    f0 + (R::ONE - f0) * R::of(1.0 / 21.0)
}

/// How far [`f82_tint`] lies below Schlick, without its factor `cos (1 - cos)^6`.
#[inline(always)]
fn f82_dip<R: Real>(f0: R, tint: R) -> R {
    // (1/7) (6/7)^6
    schlick(R::of(1.0 / 7.0), f0) * (R::ONE - tint) / R::of(46_656.0 / 823_543.0)
}

/// Schlick's approximation lowered to `tint` times itself at 81.8 degrees, where cos = 1/7; not below zero.
/// [KutzHasanEdmondson2021]
#[inline(always)]
pub fn f82_tint<R: Real>(cos_i: R, f0: R, tint: R) -> R {
    let x = R::ONE - cos_i;
    (schlick(cos_i, f0) - f82_dip(f0, tint) * cos_i * (fifth(x) * x)).max(R::ZERO)
}

/// The mean of [`f82_tint`] over the hemisphere, weighted with the cosine.
#[inline(always)]
pub fn f82_average<R: Real>(f0: R, tint: R) -> R {
    schlick_average(f0) - f82_dip(f0, tint) * R::of(1.0 / 126.0)
}

/// Schlick's approximation with the absorption of a metal, base term without the fitted correction.
/// [LazanyiSzirmayKalos2005, eq. 4]
#[inline(always)]
pub fn lazanyi<R: Real>(cos_i: R, eta: R, k: R) -> R {
    let k2 = k * k;
    let x5 = fifth(R::ONE - cos_i);
    ((eta - R::ONE).sqr() + R::of(4.0) * eta * x5 + k2) / ((eta + R::ONE).sqr() + k2)
}

/// The mean of a reflectance `f(cos)` over the hemisphere, weighted with the cosine: Gauss's rule with 12 points.
#[inline(always)]
pub fn average<R: Real>(f: impl Fn(R) -> R) -> R {
    let mut sum = R::ZERO;
    for (mu, w) in GAUSS_12 {
        sum = sum + f(R::of(mu)) * R::of(2.0 * mu * w);
    }
    sum
}

/// Points in (0, 1) and weights of Gauss's rule. [AbramowitzStegun, table 25.4]
const GAUSS_12: [(f64, f64); 12] = [
    (0.009_219_682_876_640_378, 0.023_587_668_193_255_917),
    (0.047_941_371_814_762_6, 0.053_469_662_997_659_09),
    (0.115_048_662_902_847_65, 0.080_039_164_271_673_17),
    (0.206_341_022_856_691_26, 0.101_583_713_361_532_92),
    (0.316_084_250_500_909_94, 0.116_746_268_269_177_39),
    (0.437_383_295_744_265_54, 0.124_573_522_906_701_44),
    (0.562_616_704_255_734_5, 0.124_573_522_906_701_44),
    (0.683_915_749_499_090_1, 0.116_746_268_269_177_39),
    (0.793_658_977_143_308_7, 0.101_583_713_361_532_92),
    (0.884_951_337_097_152_3, 0.080_039_164_271_673_17),
    (0.952_058_628_185_237_5, 0.053_469_662_997_659_09),
    (0.990_780_317_123_359_6, 0.023_587_668_193_255_917),
];

#[cfg(test)]
mod tests {
    use super::*;

    fn at(deg: f64) -> f64 {
        Real::cos(deg.to_radians())
    }

    #[test]
    fn dielectric_matches_the_reference_sheet() {
        for (deg, want) in [(0.0, 0.04), (30.0, 0.0415226), (60.0, 0.0891867), (80.0, 0.3877044)] {
            let (f, _) = dielectric(at(deg), 1.5);
            assert!((f - want).abs() < 1e-7, "{deg} degrees: {f}");
        }
    }

    #[test]
    fn equal_indices_reflect_nothing_in_single_precision() {
        for cos in [1.0_f32, 0.3, 0.01, 1e-4] {
            assert!(dielectric(cos, 1.0).0 <= 0.0, "{cos}");
        }
    }

    #[test]
    fn beyond_the_critical_angle_everything_is_reflected() {
        // asin(1 / 1.5) = 41.81 degrees.
        assert!(dielectric(at(41.0), 1.0 / 1.5).0 < 1.0);
        assert_eq!(dielectric(at(42.0), 1.0 / 1.5), (1.0, 0.0));
    }

    #[test]
    fn reflectance_is_the_same_from_both_sides() {
        let (f, cos_t) = dielectric(at(50.0), 1.7);
        let (back, cos_i) = dielectric(cos_t, 1.0 / 1.7);
        assert!((f - back).abs() < 1e-14 && (cos_i - at(50.0)).abs() < 1e-14);
    }

    #[test]
    fn conductor_matches_the_reference_sheet() {
        for (deg, want) in [(0.0, 0.92319), (75.0, 0.88541), (85.0, 0.90047)] {
            let f = conductor(at(deg), 0.77, 6.08);
            assert!((f - want).abs() < 1e-5, "{deg} degrees: {f}");
        }
        // An index of zero reflects everything, at the normal as well.
        for cos in [1.0, 0.5, 0.0] {
            assert!((conductor(cos, 0.0, 0.0) - 1.0_f64).abs() < 1e-15);
        }
        // Without absorption a conductor is a dielectric.
        assert!((conductor(at(60.0), 1.5, 0.0) - dielectric(at(60.0), 1.5).0).abs() < 1e-12);
    }
}
