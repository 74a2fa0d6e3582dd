//! An anisotropic Phong model with a diffuse base that takes what the highlight leaves. [AshikhminShirley2000]
//!
//! `exponent_x` and `exponent_y` are the paper's n_u and n_v, along the tangent and across it; F is Schlick's with the
//! reflectance `specular` at normal incidence; `diffuse` is R_d.
//! Limits: the white highlight loses light, more at grazing views (0.52 is left there); the white base returns 31/32
//! at a normal view and 0.2 at 85 degrees.

use core::f64::consts::{FRAC_1_PI, PI};

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_spectra::Spectrum;

use crate::opaque::{Half, Opaque, TwoLobes};
use crate::{About, Model, ParamBlock, ParamInfo, Uniforms, cosine_lobe};

/// An anisotropic cosine-power highlight, coupled with a diffuse base.
#[derive(Clone, Copy, Debug)]
pub struct AshikhminShirley<R> {
    diffuse: Spectrum<R>,
    specular: Spectrum<R>,
    n_u: R,
    n_v: R,
}

impl<R: Real> Model<R> for AshikhminShirley<R> {
    const ABOUT: About =
        About::new("anisotropic Phong highlight, coupled with its base", "AshikhminShirley2000")
            .anisotropic();
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("diffuse").default(0.5).doc("Reflectance R_d of the base."),
        ParamInfo::albedo("specular")
            .default(0.05)
            .doc("Reflectance R_s of the highlight at normal incidence."),
        ParamInfo::real("exponent_x")
            .default(10.0)
            .range(0.0, 1e5)
            .soft(1.0, 100.0)
            .doc("Exponent n_u along the tangent."),
        ParamInfo::real("exponent_y")
            .default(100.0)
            .range(0.0, 1e5)
            .soft(1.0, 100.0)
            .doc("Exponent n_v across the tangent."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        AshikhminShirley { diffuse: p.spectra[0], specular: p.spectra[1], n_u: p.reals[0], n_v: p.reals[1] }
    }
}

/// `1 - (1 - cos / 2)^5`
#[inline(always)]
fn base_shape<R: Real>(cos: R) -> R {
    let x = R::ONE - cos * R::of(0.5);
    R::ONE - x.sqr().sqr() * x
}

impl<R: Real> AshikhminShirley<R> {
    /// The highlight is weighted by what it reflects towards the viewer: at grazing views that is much, however dark it is.
    #[inline(always)]
    fn lobes(&self, o: LocalDir<R>) -> TwoLobes<R> {
        TwoLobes::new(self.diffuse, self.schlick(o.cos_theta().min(R::ONE)))
    }
    /// `sqrt((n_u + 1)(n_v + 1)) / (2 pi) (n.h)^e`, the density of half vectors. [AshikhminShirley2000]
    #[inline(always)]
    fn density_of_half(&self, m: LocalDir<R>) -> R {
        let sin2 = m.sin2_theta();
        let slanted = sin2.gt(R::of(1e-20));
        let across = (self.n_u * m.x().sqr() + self.n_v * m.y().sqr()) / R::select(slanted, sin2, R::ONE);
        let power = cosine_lobe::lobe(m.cos_theta(), sin2, across);
        ((self.n_u + R::ONE) * (self.n_v + R::ONE)).sqrt() * R::of(0.5 * FRAC_1_PI) * power
    }
    #[inline(always)]
    fn schlick(&self, cos_d: R) -> Spectrum<R> {
        let x = R::ONE - cos_d;
        self.specular + (Spectrum::ONE - self.specular) * (x.sqr().sqr() * x)
    }
}

impl<R: Real> Opaque for AshikhminShirley<R> {
    type R = R;

    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let half = Half::new(o, i);
        let pdf = self.density_of_half(half.m) * half.jacobian();
        let F = self.schlick(half.cos_d);
        let f_s = F * (pdf / o.cos_theta().max(i.cos_theta()));
        let shape = R::of(28.0 / (23.0 * PI)) * base_shape(o.cos_theta()) * base_shape(i.cos_theta());
        let f_d = self.diffuse * (Spectrum::ONE - self.specular) * shape;
        (f_s + f_d, self.lobes(o).density(i, pdf))
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        let (a, b) = ((self.n_v + R::ONE).sqrt(), (self.n_u + R::ONE).sqrt());
        let (c, s) = cosine_lobe::stretched_azimuth(u.dir[1], a, b);
        let n = self.n_u * c.sqr() + self.n_v * s.sqr();
        let (sin, cos) = cosine_lobe::angle(u.dir[0], n);
        self.lobes(o).pick(u, o.reflect(LocalDir::new(vec3(sin * c, sin * s, cos))))
    }
}
