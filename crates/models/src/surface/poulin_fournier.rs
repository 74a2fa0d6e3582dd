//! Cloth and brushed metal as a row of parallel cylinders. [PoulinFournier1990]
//!
//! Cylinders of unit radius along the tangent x, their axes `spacing` d apart, d at most 2 so that nothing shows between
//! them. In the section across them a direction has the azimuth phi from the normal; along them the inclination theta. A facet
//! of normal angle phi_n is seen, and lit, where its neighbour does not stand in the way: exact geometry, in place
//! of the polynomials of the paper.
//!
//! Mirror share: `ks M(theta_i, theta_o) / max(cos theta_i, cos theta_o) cos((phi_o - phi_i)/2) / (2 d cos phi_i cos phi_o)`
//! where the facet between both azimuths is seen and lit, M the normalised longitudinal lobe of [dEon2011].
//! Diffuse share: `kd / (pi d cos phi_i cos phi_o)` times the integral of `cos(phi - phi_i) cos(phi - phi_o)` over what is seen and lit.
//! Limits: single reflection; mirrors lose the light that meets a second cylinder (a third at normal incidence for
//! touching cylinders).

use core::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};

use sparrow_math::{LocalDir, Real, Vec3, vec3, warp};
use sparrow_spectra::Spectrum;

use crate::opaque::Opaque;
use crate::{About, Model, ParamBlock, ParamInfo, Uniforms};

/// A row of parallel cylinders.
#[derive(Clone, Copy, Debug)]
pub struct PoulinFournier<R> {
    diffuse: Spectrum<R>,
    specular: Spectrum<R>,
    /// Distance of axes over radius.
    d: R,
    /// Variance of the longitudinal lobe.
    v: R,
}

impl<R: Real> Model<R> for PoulinFournier<R> {
    const ABOUT: About =
        About::new("a row of parallel cylinders, with exact masking", "PoulinFournier1990, dEon2011")
            .anisotropic();
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("diffuse").default(0.3).doc("Diffuse reflectance of a cylinder, kd."),
        ParamInfo::albedo("specular").default(0.5).doc("Mirror reflectance of a cylinder, ks."),
        ParamInfo::real("spacing")
            .default(2.0)
            .range(0.1, 2.0)
            .soft(0.5, 2.0)
            .doc("Distance of neighbouring axes over the radius; 2 for touching cylinders."),
        ParamInfo::real("beta")
            .unit("rad")
            .default(0.15)
            .range(0.02, 1.0)
            .soft(0.1, 0.5)
            .doc("Width of the highlight along the cylinders."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        PoulinFournier { diffuse: p.spectra[0], specular: p.spectra[1], d: p.reals[0], v: p.reals[1].sqr() }
    }
}

/// A direction in the section across the cylinders and along them.
#[derive(Clone, Copy, Debug)]
struct Section<R> {
    /// Azimuth from the normal.
    phi: R,
    cos_phi: R,
    sin_theta: R,
    cos_theta: R,
}

impl<R: Real> Section<R> {
    #[inline(always)]
    fn new(w: LocalDir<R>) -> Self {
        let across = (w.y().sqr() + w.z().sqr()).sqrt().max(R::of(1e-12));
        Section { phi: w.y().atan2(w.z()), cos_phi: w.z() / across, sin_theta: w.x(), cos_theta: across }
    }
}

impl<R: Real> PoulinFournier<R> {
    /// Normal angles seen from an azimuth: past the steepest facet the neighbour begins; where `cos phi < d / 2` the
    /// neighbour on the viewer's side also hides what lies below its tangent.
    #[inline(always)]
    fn seen(&self, w: &Section<R>) -> [R; 2] {
        let steepest = (self.d * R::of(0.5)).asin();
        let phi = w.phi.abs();
        let hidden = (self.d * w.cos_phi - R::ONE).clamp(-R::ONE, R::ONE).asin();
        let low = w.cos_phi.lt(self.d * R::of(0.5));
        let near = R::select(low, phi + hidden, steepest).min(steepest);
        let far = (phi - R::of(FRAC_PI_2)).max(-steepest);
        let right = w.phi.ge(R::ZERO);
        [R::select(right, far, -near), R::select(right, near, -far)]
    }

    /// `M(theta_i, theta_o)`: the light is mirrored to the opposite inclination. [dEon2011]
    #[inline(always)]
    fn along(&self, o: &Section<R>, i: &Section<R>) -> R {
        let (c, s) = (o.cos_theta * i.cos_theta, o.sin_theta * i.sin_theta);
        let norm = self.v * (R::ONE - (R::of(-2.0) / self.v).exp());
        let (m, k) = (c / self.v).i0e_parts();
        m * ((c - s - R::ONE) / self.v + k).exp() / norm
    }

    /// Probability of the diffuse lobe.
    #[inline(always)]
    fn diffuse_share(&self) -> R {
        let (d, s) = (self.diffuse.max_value(), self.specular.max_value());
        let some = (d + s).gt(R::ZERO);
        R::select(some, d / R::select(some, d + s, R::ONE), R::ONE)
    }
}

impl<R: Real> Opaque for PoulinFournier<R> {
    type R = R;

    #[inline(always)]
    fn eval(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let (o, i) = (Section::new(wo), Section::new(wi));
        let ([from_o, to_o], [from_i, to_i]) = (self.seen(&o), self.seen(&i));
        let (from, to) = (from_o.max(from_i), to_o.min(to_i).max(from_o.max(from_i)));
        let per_area = R::ONE / (self.d * i.cos_phi * o.cos_phi);

        // The integral of cos(phi - phi_i) cos(phi - phi_o) over what is seen and lit.
        let sum = i.phi + o.phi;
        let lit = (to - from) * (i.phi - o.phi).cos() + (to - from).sin() * (to + from - sum).cos();
        let diffuse = self.diffuse * (R::of(0.5 * FRAC_1_PI) * per_area * lit.max(R::ZERO));

        let facet = sum * R::of(0.5);
        let cos_d = ((o.phi - i.phi) * R::of(0.5)).cos();
        let along = self.along(&o, &i);
        let mirror = along / i.cos_theta.max(o.cos_theta) * cos_d * R::of(0.5) * per_area;
        let both = facet.ge(from) & facet.le(to) & to.gt(from);
        let f = diffuse + self.specular * mirror.only_where(both);

        let p = self.diffuse_share();
        let seen = facet.ge(from_o) & facet.le(to_o);
        let glossy = (along * cos_d * R::of(0.5) / (self.d * o.cos_phi)).only_where(seen);
        (f, p * warp::cosine_hemisphere_pdf(wi.cos_theta()) + (R::ONE - p) * glossy)
    }

    #[inline(always)]
    fn draw(&self, wo: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        let p = self.diffuse_share();
        let diffuse = u.lobe.lt(p);
        // What the choice leaves of its number is uniform again.
        let left = ((u.lobe - p) / (R::ONE - p).max(R::of(1e-6))).clamp(R::ZERO, R::ONE);

        // The facet, in proportion to its seen width; the widths sum to d cos phi_o.
        let o = Section::new(wo);
        let [from, _] = self.seen(&o);
        let sin = ((from - o.phi).sin() + left * self.d * o.cos_phi).clamp(-R::ONE, R::ONE);
        let phi = o.phi + R::of(2.0) * sin.asin();

        // Along: about the mirrored inclination. [dEon2013]
        let spread = u.dir[0] + (R::ONE - u.dir[0]) * (R::of(-2.0) / self.v).exp();
        let cos = (R::ONE + self.v * spread.max(R::of(1e-30)).ln()).clamp(-R::ONE, R::ONE);
        let around = (R::of(2.0 * PI) * u.dir[1]).cos();
        let out = ((R::ONE - cos) * (R::ONE + cos)).safe_sqrt() * around;
        let sin_theta = (out * o.cos_theta - cos * o.sin_theta).clamp(-R::ONE, R::ONE);
        let cos_theta = ((R::ONE - sin_theta) * (R::ONE + sin_theta)).safe_sqrt();
        let (s, c) = phi.sin_cos();
        let mirror = vec3(sin_theta, cos_theta * s, cos_theta * c);
        LocalDir::new(Vec3::select(diffuse, warp::cosine_hemisphere(u.dir), mirror))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_seen_is_what_a_scan_finds() {
        // Normal angles seen, in degrees, found by testing rays against the neighbours.
        let records: serde_json::Value =
            serde_json::from_str(include_str!("../../tests/reference/values_surfaces.json"))
                .expect("records");
        let records = records.as_array().expect("records");
        let all = |prefix: &'static str| {
            records.iter().filter(move |r| r["id"].as_str().is_some_and(|id| id.starts_with(prefix)))
        };
        let mut count = 0;
        for r in all("poulin.phimax.") {
            let model = PoulinFournier {
                diffuse: Spectrum::ONE,
                specular: Spectrum::ONE,
                d: r["inputs"]["d"].as_f64().expect("d"),
                v: 0.01,
            };
            let [_, to] = model.seen(&Section::new(LocalDir::from_angles(0.0, FRAC_PI_2)));
            assert!((to.to_degrees() - r["value"].as_f64().expect("an angle")).abs() < 1e-6, "{r}: {to}");
            count += 1;
        }
        for r in all("poulin.visible.") {
            let number = |path| r.pointer(path).and_then(serde_json::Value::as_f64).expect("a number");
            let (d, view) = (number("/inputs/d"), number("/inputs/view_deg"));
            let (from, to) = (number("/value/phi_min"), number("/value/phi_max"));
            count += 1;
            let model = PoulinFournier { diffuse: Spectrum::ONE, specular: Spectrum::ONE, d, v: 0.01 };
            for sign in [1.0f64, -1.0] {
                let w = LocalDir::from_angles(f64::to_radians(view), sign * FRAC_PI_2);
                let [a, b] = model.seen(&Section::new(w)).map(f64::to_degrees);
                let (a, b) = if sign > 0.0 { (a, b) } else { (-b, -a) };
                assert!((a - from).abs() < 0.01 && (b - to).abs() < 0.01, "{d} {view}: {a} {b}");
                // Seen widths tile the row.
                let s = Section::new(w);
                let [lo, hi] = model.seen(&s);
                let width = Real::sin(hi - s.phi) - Real::sin(lo - s.phi);
                assert!((width - d * s.cos_phi).abs() < 1e-12, "{d} {view}: {width}");
            }
        }
        assert_eq!(count, 10);
    }
}
