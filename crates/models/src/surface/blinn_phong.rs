//! Blinn's highlight, `(n.h)^n` of the half vector, over a diffuse base. [Blinn1977]
//!
//! `form` chooses the factor of the lobe: `normalized`, `(n+2)(n+4) / (8 pi (n + 2^(-n/2)))`, with which a white lobe
//! returns all light of a normal view and less at any other, or `raw`, one. The popular `(n+8) / (8 pi)`
//! approximates that factor and returns up to 7 % more than arrived.
//! Limits: the lobe fades at grazing views, where a microfacet model would grow; it needs about four times the exponent of
//! `phong` for the same width.

use core::f64::consts::{FRAC_1_PI, LN_2, PI};

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::opaque::{Half, Opaque, TwoLobes};
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms, cosine_lobe};

/// A cosine-power lobe of the half vector.
#[derive(Clone, Copy, Debug)]
pub struct BlinnPhong<R> {
    diffuse: Spectrum<R>,
    specular: Spectrum<R>,
    n: R,
    normalized: bool,
}

impl<R: Real> Model<R> for BlinnPhong<R> {
    const ABOUT: About = About::new("cosine-power lobe of the half vector", "Blinn1977, Phong1975")
        .lacks(&[Lack::energy("the raw lobe's light depends on its exponent and exceeds one below n = 19")
            .when(&[("form", &["raw"])])]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("diffuse").default(0.3).doc("Share of the light that the base reflects, kd."),
        ParamInfo::albedo("specular").default(0.3).doc("Strength of the lobe, ks."),
        ParamInfo::real("exponent")
            .default(80.0)
            .range(0.0, 1e5)
            .soft(1.0, 100.0)
            .doc("Power n of the cosine between normal and half vector."),
        ParamInfo::choice("form", &["normalized", "raw"])
            .doc("Factor of the lobe: all light of a normal view is kept, or one."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        BlinnPhong {
            diffuse: p.spectra[0],
            specular: p.spectra[1],
            n: p.reals[0],
            normalized: p.choices[0] == 0,
        }
    }
}

impl<R: Real> BlinnPhong<R> {
    #[inline(always)]
    fn lobes(&self) -> TwoLobes<R> {
        TwoLobes::new(self.diffuse, self.specular)
    }
    /// What `(n.h)^n` is multiplied with.
    #[inline(always)]
    fn factor(&self) -> R {
        if !self.normalized {
            return R::ONE;
        }
        let n = self.n;
        let root = (n * R::of(-0.5 * LN_2)).exp();
        (n + R::of(2.0)) * (n + R::of(4.0)) / (R::of(8.0 * PI) * (n + root))
    }
}

impl<R: Real> Opaque for BlinnPhong<R> {
    type R = R;

    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let half = Half::new(o, i);
        let lobe = cosine_lobe::lobe(half.m.cos_theta(), half.m.sin2_theta(), self.n);
        let f = self.diffuse * R::of(FRAC_1_PI) + self.specular * (self.factor() * lobe);
        let pdf_m = (self.n + R::ONE) * R::of(0.5 * FRAC_1_PI) * lobe;
        (f, self.lobes().density(i, pdf_m * half.jacobian()))
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        let m = LocalDir::new(cosine_lobe::sample(u.dir, self.n));
        self.lobes().pick(u, o.reflect(m))
    }
}
