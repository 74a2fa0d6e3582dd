//! Masking and shadowing in symmetric V-grooves of mirrors. [TorranceSparrow1967]
//!
//! In Blinn's vector form, `G = min(1, 2 (n.m)(n.o) / (o.m), 2 (n.m)(n.i) / (i.m))`: the longer expression of the
//! paper, in angles projected on the plane across the groove, reduces to it. [Blinn1977]

use sparrow_math::{LocalDir, Real};

use crate::opaque::Half;

/// `G`
#[cfg(test)]
fn g<R: Real>(o: LocalDir<R>, i: LocalDir<R>, half: &Half<R>) -> R {
    let lower = o.cos_theta().min(i.cos_theta());
    (R::of(2.0) * half.m.cos_theta() * lower / half.cos_d).min(R::ONE)
}

/// `G / (4 cos theta_o cos theta_i)`, which does not overflow at grazing angles.
#[inline(always)]
pub(crate) fn g_over_4cos<R: Real>(o: LocalDir<R>, i: LocalDir<R>, half: &Half<R>) -> R {
    let (lower, upper) = (o.cos_theta().min(i.cos_theta()), o.cos_theta().max(i.cos_theta()));
    let open = R::of(0.25) / (lower * upper);
    open.min(R::of(0.5) * half.m.cos_theta() / (half.cos_d * upper))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(psi: f64, theta: f64) -> (LocalDir<f64>, LocalDir<f64>) {
        // Theta counts positive on the mirror side.
        let i = LocalDir::from_angles(psi.to_radians(), 0.0);
        let t = theta.to_radians();
        (LocalDir::new(sparrow_math::vec3(-Real::sin(t), 0.0, Real::cos(t))), i)
    }

    #[test]
    fn masking_begins_a_third_of_the_way() {
        // In the plane of incidence G = 1 up to theta = (180 + psi) / 3 degrees.
        for psi in [0.0, 15.0, 30.0, 45.0, 60.0, 75.0] {
            let kink = (180.0 + psi) / 3.0;
            for (theta, open) in [(kink - 0.01, true), (kink + 0.01, false)] {
                let (o, i) = pair(psi, theta);
                let g = g(o, i, &Half::new(o, i));
                assert_eq!(g >= 1.0, open, "psi {psi}, theta {theta}: G {g}");
            }
        }
    }

    #[test]
    fn both_forms_agree() {
        for (psi, theta) in [(10.0, 20.0), (60.0, -50.0), (80.0, 85.0), (89.9, -89.9)] {
            let (o, i) = pair(psi, theta);
            let half = Half::new(o, i);
            let want = g(o, i, &half) / (4.0 * o.z() * i.z());
            assert!((g_over_4cos(o, i, &half) - want).abs() < 1e-12 * want);
        }
    }
}
