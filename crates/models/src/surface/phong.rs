//! Phong's lobe about the mirrored direction, `cos^n a`, over a diffuse base.
//!
//! `form` chooses how the rule for shading becomes a reflection model; a is the angle between the light and the mirror
//! image of the viewer:
//!
//! | form | f | light |
//! | --- | --- | --- |
//! | `modified` | `kd/pi + ks (n+2)/(2 pi) cos^n a` | kept, reciprocal [LafortuneWillems1994] |
//! | `normalized` | `kd/pi + ks (n+1)/(2 pi) cos^n a / cos theta_i` | not reciprocal |
//! | `phong` | `kd/pi + ks cos^n a / cos theta_i` | not reciprocal, depends on n [Phong1975] |
//!
//! Phong writes radiance without the cosine of the light; the division puts that rule into a value that is multiplied by the
//! cosine again. The light a surface returns to one viewer then stays below `2 pi ks / (n+1)`, but what it makes
//! of one light grows as `1 / cos theta_i` towards grazing.
//! Limits: `modified` darkens at grazing views by about cos theta; the lobe is cut off at the horizon.

use core::f64::consts::{FRAC_1_PI, PI};

use sparrow_math::{Frame, LocalDir, Real, vec3};
use sparrow_spectra::Spectrum;

use crate::opaque::{Opaque, TwoLobes};
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms, cosine_lobe};

/// Which factor the lobe gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Modified,
    Normalized,
    Phong,
}

/// A cosine-power lobe about the mirrored direction.
#[derive(Clone, Copy, Debug)]
pub struct Phong<R> {
    diffuse: Spectrum<R>,
    specular: Spectrum<R>,
    n: R,
    form: Form,
}

impl<R: Real> Model<R> for Phong<R> {
    const ABOUT: About =
        About::new("cosine-power lobe about the mirrored direction", "Phong1975, LafortuneWillems1994")
            .lacks(&[
                Lack::energy("a grazing light is multiplied by 1 / cos theta_i")
                    .when(&[("form", &["normalized", "phong"])]),
                Lack::reciprocity("the value is divided by the light's cosine alone")
                    .when(&[("form", &["normalized", "phong"])]),
            ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("diffuse").default(0.3).doc("Share of the light that the base reflects, kd."),
        ParamInfo::albedo("specular").default(0.3).doc("Strength of the lobe, ks."),
        ParamInfo::real("exponent")
            .default(20.0)
            .range(0.0, 2e4)
            .soft(1.0, 100.0)
            .doc("Power n of the cosine: large for narrow lobes."),
        ParamInfo::choice("form", &["modified", "normalized", "phong"]).doc(
            "Factor of the lobe: that of Lafortune and Willems, (n+1)/(2 pi cos), or Phong's rule of 1975.",
        ),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let form = match p.choices[0] {
            0 => Form::Modified,
            1 => Form::Normalized,
            _ => Form::Phong,
        };
        Phong { diffuse: p.spectra[0], specular: p.spectra[1], n: p.reals[0], form }
    }
}

impl<R: Real> Phong<R> {
    #[inline(always)]
    fn lobes(&self) -> TwoLobes<R> {
        TwoLobes::new(self.diffuse, self.specular)
    }
    /// What `cos^n a` is multiplied with.
    #[inline(always)]
    fn factor(&self, i: LocalDir<R>) -> R {
        match self.form {
            Form::Modified => (self.n + R::of(2.0)) * R::of(0.5 * FRAC_1_PI),
            Form::Normalized => (self.n + R::ONE) * R::of(0.5 * FRAC_1_PI) / i.cos_theta(),
            Form::Phong => R::ONE / i.cos_theta(),
        }
    }
}

/// The mirror image about the normal.
#[inline(always)]
fn mirrored<R: Real>(w: LocalDir<R>) -> LocalDir<R> {
    LocalDir::new(vec3(-w.x(), -w.y(), w.z()))
}

impl<R: Real> Opaque for Phong<R> {
    type R = R;

    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let mirror = mirrored(o);
        // sin^2 a by the distance of both, which keeps the digits of narrow lobes.
        let d2 = (mirror.v() - i.v()).length2();
        let lobe = cosine_lobe::lobe(mirror.dot(i), d2 * (R::ONE - R::of(0.25) * d2), self.n);
        let f = self.diffuse * R::of(FRAC_1_PI) + self.specular * (self.factor(i) * lobe);
        let pdf = (self.n + R::ONE) / R::of(2.0 * PI) * lobe;
        (f, self.lobes().density(i, pdf))
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        let about = Frame::from_z(mirrored(o).v());
        let glossy = about.to_world(LocalDir::new(cosine_lobe::sample(u.dir, self.n)));
        self.lobes().pick(u, LocalDir::new(glossy))
    }
}
