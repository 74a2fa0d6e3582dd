//! The walk among facets that only reflect.

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use super::numbers::Numbers;
use super::{MAX_BOUNCES, Ray, lambda};
use crate::ggx::Ggx;
use crate::microfacet::Reflectance;
use crate::per_lane::per_lane;

/// Where a walk left the surface.
#[derive(Clone, Copy, Debug)]
pub struct WalkEnd {
    /// The direction in which it left, above.
    pub wi: LocalDir<f64>,
    /// Product of the reflectances met.
    pub weight: f64,
    /// Facets met.
    pub bounces: u32,
}

impl Ray<'_> {
    /// Is mirrored at a visible facet; returns the cosine to its normal.
    fn bounces(&mut self, u: [f64; 2]) -> f64 {
        let (m, cos) = self.facet(u);
        self.w = (-self.w).reflect(m);
        cos
    }
}

/// Sends light, or equally a view, from `wo` on a walk until it leaves. `fresnel` takes the cosine to a facet's normal,
/// `uniform` gives numbers in [0, 1).
pub fn walk(
    ggx: &Ggx<f64>,
    wo: LocalDir<f64>,
    fresnel: impl Fn(f64) -> f64,
    mut uniform: impl FnMut() -> f64,
) -> WalkEnd {
    let mut ray = Ray::entering(ggx, wo);
    let mut weight = 1.0;
    for bounces in 0..MAX_BOUNCES {
        if uniform() >= ray.advance(uniform()) {
            return WalkEnd { wi: ray.w, weight, bounces };
        }
        weight *= fresnel(ray.bounces([uniform(), uniform()]));
    }
    WalkEnd { wi: wo, weight: 0.0, bounces: MAX_BOUNCES }
}

/// One random number whose mean is what the surface sends from `wo` to `wi`, both above, by way of `least` facets or
/// more, in 1/sr.
///
/// At every facet met the walk adds what reaches `wi` from there. [Heitz2016, alg. 5]
fn value(
    ggx: &Ggx<f64>,
    wo: LocalDir<f64>,
    wi: LocalDir<f64>,
    least: u32,
    fresnel: impl Fn(f64) -> Spectrum<f64>,
    mut uniform: impl FnMut() -> f64,
) -> Spectrum<f64> {
    let mut ray = Ray::entering(ggx, wo);
    let (mut weight, mut sum) = (Spectrum::ONE, Spectrum::ZERO);
    let lambda_i = lambda(ggx, wi);
    for facet in 1..=MAX_BOUNCES {
        let chance = ray.advance(uniform());
        if facet >= least {
            let v = -ray.w;
            let m = v.half(wi);
            let phase = 0.25 * ray.visible_over_cos(m);
            if phase > 0.0 {
                let seen = chance * phase * Real::pow(ray.c, lambda_i);
                sum += weight * fresnel(v.dot(m).min(1.0)) * seen;
            }
        }
        if uniform() >= chance || weight.max_value() <= 0.0 {
            break;
        }
        weight *= fresnel(ray.bounces([uniform(), uniform()]));
    }
    sum * (1.0 / wi.z())
}

/// What the surface sends from `o` to `i` by way of two facets and more, in 1/sr; zero where one lies below.
#[inline(always)]
pub(crate) fn further<R: Real>(
    ggx: &Ggx<R>,
    reflectance: &Reflectance<R>,
    o: LocalDir<R>,
    i: LocalDir<R>,
) -> Spectrum<R> {
    let (o, i, [alpha_x, alpha_y]) = (o.v(), i.v(), ggx.alphas());
    let (kind, a, b) = reflectance.parts();
    let [a0, a1, a2, a3] = a.0;
    let [b0, b1, b2, b3] = b.0;
    let lanes = [o.x, o.y, o.z, i.x, i.y, i.z, alpha_x, alpha_y, a0, a1, a2, a3, b0, b1, b2, b3];
    Spectrum(per_lane(
        lanes,
        #[inline(always)]
        |[ox, oy, oz, ix, iy, iz, ax, ay, a0, a1, a2, a3, b0, b1, b2, b3]| {
            let reflectance =
                Reflectance::from_parts(kind, Spectrum([a0, a1, a2, a3]), Spectrum([b0, b1, b2, b3]));
            let dir = |x, y, z| LocalDir::new(sparrow_math::vec3(x, y, z));
            scalar(&Ggx::new(ax, ay), &reflectance, dir(ox, oy, oz), dir(ix, iy, iz)).0
        },
    ))
}

/// [`further`] of one pair: the walk starts where its end is seen without chance, at the more grazing direction.
#[inline(never)]
fn scalar(
    ggx: &Ggx<f64>,
    reflectance: &Reflectance<f64>,
    o: LocalDir<f64>,
    i: LocalDir<f64>,
) -> Spectrum<f64> {
    if !(o.z() > 0.0 && i.z() > 0.0) {
        return Spectrum::ZERO;
    }
    let (from, to) = super::ordered(o, i);
    let mut numbers = Numbers::of(o, i);
    value(ggx, from, to, 2, |cos| reflectance.at(cos), || numbers.next())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::vec3;

    #[test]
    fn values_of_one_bounce_are_those_of_the_formula() {
        let ggx = Ggx::new(0.4, 0.7);
        let wo = LocalDir::from_angles(0.9, 0.3);
        let wi = LocalDir::from_angles(0.6, 2.9);
        let m = wo.half(wi);
        let want = ggx.d(m) * ggx.g2_over_4cos(wo, wi);
        let mut u = Numbers::of(wo, wi);
        let n = 40_000;
        // A reflectance of 1e-6 makes the second bounce a millionth of the first.
        let sum: f64 =
            (0..n).map(|_| 1e6 * value(&ggx, wo, wi, 1, |_| Spectrum::splat(1e-6), || u.next())[0]).sum();
        let got = sum / f64::from(n);
        assert!((got - want).abs() < 0.01 * want, "{got} {want}");
    }

    #[test]
    fn values_integrate_to_all_the_light() {
        let ggx = Ggx::new(0.8, 0.8);
        let wo = LocalDir::from_angles(1.1, 0.0);
        let mut u = Numbers::of(wo, wo);
        let n = 60_000;
        let mut sum = 0.0;
        for _ in 0..n {
            let z = u.next();
            let (s, c) = Real::sin_cos(core::f64::consts::TAU * u.next());
            let r = Real::safe_sqrt(1.0 - z * z);
            let wi = LocalDir::new(vec3(r * c, r * s, z));
            sum += value(&ggx, wo, wi, 1, |_| Spectrum::ONE, || u.next())[0] * z * core::f64::consts::TAU;
        }
        let got = sum / f64::from(n);
        assert!((got - 1.0).abs() < 0.03, "{got}");
    }
}
