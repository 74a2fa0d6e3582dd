//! The walk among facets that reflect and refract. [Heitz2016, sec. 6]
//!
//! A ray that is refracted goes on in the other side's frame, in which it sees the same surface upside down: z and
//! `c` turn into `-z` and `1 - c`.

use sparrow_math::{LocalDir, Real, Vec3, vec3};

use super::numbers::Numbers;
use super::{BOTTOM, MAX_BOUNCES, Ray, lambda};
use crate::fresnel;
use crate::ggx::Ggx;
use crate::per_lane::per_lane;

/// The direction in the frame of the other side.
fn turned(w: LocalDir<f64>) -> LocalDir<f64> {
    LocalDir::new(Vec3 { z: -w.z(), ..w.v() })
}

impl Ray<'_> {
    /// Is reflected or refracted at a visible facet; says whether it went to the other side. `eta` is the index there
    /// over the one here.
    fn crosses(&mut self, eta: f64, u: [f64; 3]) -> bool {
        let (m, cos) = self.facet([u[0], u[1]]);
        let v = -self.w;
        let (reflectance, cos_t) = fresnel::dielectric(cos, eta);
        if u[2] < reflectance {
            self.w = v.reflect(m);
            return false;
        }
        let refracted = m.v() * (cos / eta - cos_t) - v.v() * (1.0 / eta);
        self.w = turned(LocalDir::new(refracted.normalized()));
        self.c = (1.0 - self.c).max(BOTTOM);
        true
    }
    /// Density with which a facet here sends the ray to `i`, above for this side and below for the other.
    fn phase(&self, i: LocalDir<f64>, eta: f64) -> f64 {
        let v = -self.w;
        let reflects = i.z() > 0.0;
        let m = (v.v() + i.v() * if reflects { 1.0 } else { eta }).normalized();
        let m = LocalDir::new(m.facing(vec3(0.0, 0.0, 1.0)));
        let (v_dot_m, i_dot_m) = (v.dot(m), i.dot(m));
        let visible = self.visible_over_cos(m);
        if visible <= 0.0 || (i_dot_m > 0.0) != reflects {
            return 0.0;
        }
        let reflectance = fresnel::dielectric(v_dot_m.min(1.0), eta).0;
        if reflects {
            0.25 * reflectance * visible // [Walter2007, eq. 14]
        } else {
            // [Walter2007, eq. 17]
            let bend = v_dot_m * -i_dot_m / (v_dot_m + eta * i_dot_m).sqr().max(1e-30);
            (1.0 - reflectance) * visible * bend * eta.sqr()
        }
    }
}

/// One random number whose mean is the density of light energy that the boundary sends from `o`, above, to `i`, on either
/// side, by way of `least` facets or more, over `|cos theta_i|`.
fn value(
    ggx: &Ggx<f64>,
    o: LocalDir<f64>,
    i: LocalDir<f64>,
    eta: f64,
    least: u32,
    mut uniform: impl FnMut() -> f64,
) -> f64 {
    let mut ray = Ray::entering(ggx, o);
    // As the ray's side sees them.
    let (mut i, mut eta, mut sum) = (i, eta, 0.0);
    for facet in 1..=MAX_BOUNCES {
        let chance = ray.advance(uniform());
        if facet >= least {
            let (height, away) = if i.z() > 0.0 { (ray.c, i) } else { (1.0 - ray.c, turned(i)) };
            sum += chance * ray.phase(i, eta) * Real::pow(height.max(BOTTOM), lambda(ggx, away));
        }
        if uniform() >= chance {
            break;
        }
        if ray.crosses(eta, [uniform(), uniform(), uniform()]) {
            (i, eta) = (turned(i), 1.0 / eta);
        }
    }
    sum / i.abs_cos_theta()
}

/// What the boundary sends by way of two facets and more, for radiance, in 1/sr: `o` above, `i` on either side, `eta` the
/// index below over that above.
#[inline(always)]
pub(crate) fn further<R: Real>(ggx: &Ggx<R>, eta: R, o: LocalDir<R>, i: LocalDir<R>) -> R {
    let (o, i, [alpha_x, alpha_y]) = (o.v(), i.v(), ggx.alphas());
    let [value] = per_lane(
        [o.x, o.y, o.z, i.x, i.y, i.z, alpha_x, alpha_y, eta],
        #[inline(always)]
        |[ox, oy, oz, ix, iy, iz, ax, ay, eta]| {
            let dir = |x, y, z| LocalDir::new(vec3(x, y, z));
            [scalar(&Ggx::new(ax, ay), eta, dir(ox, oy, oz), dir(ix, iy, iz))]
        },
    );
    value
}

/// [`further`] of one pair. Light from `i` may as well be followed: then no radiance is squeezed.
#[inline(never)]
fn scalar(ggx: &Ggx<f64>, eta: f64, o: LocalDir<f64>, i: LocalDir<f64>) -> f64 {
    if !(o.z() > 0.0 && i.abs_cos_theta() > 0.0) {
        return 0.0;
    }
    let (up, down) = (o, if i.z() > 0.0 { i } else { turned(i) });
    let mut numbers = Numbers::of(up, down);
    let mut uniform = || numbers.next();
    let through = i.z() < 0.0;
    let from_viewer = super::ordered(up, down).0.v() == up.v();
    match (from_viewer, through) {
        (true, false) => value(ggx, o, i, eta, 2, &mut uniform),
        (true, true) => value(ggx, o, i, eta, 2, &mut uniform) / eta.sqr(),
        (false, false) => value(ggx, i, o, eta, 2, &mut uniform),
        (false, true) => value(ggx, turned(i), turned(o), 1.0 / eta, 2, &mut uniform),
    }
}
