//! Fresnel's equations for unpolarised light.

use sparrow_math::Real;

/// Reflectance of a smooth dielectric boundary and the cosine on the other side.
///
/// `cos_i >= 0` is the incident cosine, `eta` the relative index, transmitted over incident side. Returns
/// (F, `cos_t >= 0`); beyond the critical angle (1, 0). [Hecht, eq. 4.34, 4.40]
#[inline(always)]
pub fn dielectric<R: Real>(cos_i: R, eta: R) -> (R, R) {
    let sin2_t = (R::ONE - cos_i * cos_i).max(R::ZERO) / (eta * eta);
    let cos_t = (R::ONE - sin2_t).safe_sqrt();
    let r_p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let r_s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    let f = (r_p * r_p + r_s * r_s) * R::of(0.5);
    let total = sin2_t.ge(R::ONE);
    (R::select(total, R::ONE, f), R::select(total, R::ZERO, cos_t))
}

/// Reflectance of a smooth conductor with the complex index `eta + i k`, relative to the outside.
///
/// `cos_i` in [0, 1]. [BornWolf, sec. 14.2], arranged to need no complex square root.
#[inline(always)]
pub fn conductor<R: Real>(cos_i: R, eta: R, k: R) -> R {
    let c2 = cos_i * cos_i;
    let s2 = R::ONE - c2;
    let t0 = eta * eta - k * k - s2;
    let ab = (t0 * t0 + R::of(4.0) * eta * eta * k * k).sqrt();
    let a = ((ab + t0) * R::of(0.5)).safe_sqrt();
    let t1 = ab + c2;
    let t2 = R::of(2.0) * a * cos_i;
    let r_s = (t1 - t2) / (t1 + t2);
    let t3 = c2 * ab + s2 * s2;
    let t4 = t2 * s2;
    let r_p = r_s * (t3 - t4) / (t3 + t4);
    (r_s + r_p) * R::of(0.5)
}

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
        // Without absorption a conductor is a dielectric.
        assert!((conductor(at(60.0), 1.5, 0.0) - dielectric(at(60.0), 1.5).0).abs() < 1e-12);
    }
}
