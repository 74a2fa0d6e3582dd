//! Shading of curves, whose normals fill a plane, after Banks. [Banks1994]
//!
//! The tangent t is the frame's x. `f = kd/pi (1 - (t.i)^2)^(p/2) + ks max(0, sqrt(1-(t.i)^2) sqrt(1-(t.o)^2) - (t.i)(t.o))^n`,
//! and the surface's own cosine dims the light. p, about 4.8, makes up for the excess of brightness of codimension two.
//! Limits: a rule for shading; neither reciprocal nor bound in energy.

use core::f64::consts::FRAC_1_PI;

use sparrow_math::{LocalDir, Real, warp};
use sparrow_spectra::Spectrum;

use crate::opaque::Opaque;
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms, cosine_lobe};

/// A surface of parallel threads, shaded as curves.
#[derive(Clone, Copy, Debug)]
pub struct Banks<R> {
    diffuse: Spectrum<R>,
    specular: Spectrum<R>,
    n: R,
    p: R,
}

impl<R: Real> Model<R> for Banks<R> {
    const ABOUT: About =
        About::new("parallel threads, shaded as curves", "Banks1994").anisotropic().lacks(&[
            Lack::energy("the highlight has no normalisation"),
            Lack::reciprocity("the diffuse term knows the light's direction alone"),
        ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("diffuse").default(0.3).doc("Strength of the diffuse term, kd."),
        ParamInfo::albedo("specular").default(0.3).doc("Strength of the highlight, ks."),
        ParamInfo::real("exponent")
            .default(20.0)
            .range(0.0, 1e4)
            .soft(1.0, 100.0)
            .doc("Exponent n of the highlight."),
        ParamInfo::real("excess")
            .default(4.8)
            .range(0.0, 100.0)
            .soft(1.0, 10.0)
            .doc("Exponent p of the diffuse term."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        Banks { diffuse: p.spectra[0], specular: p.spectra[1], n: p.reals[0], p: p.reals[1] }
    }
}

/// `sqrt(1 - (t.w)^2)`
#[inline(always)]
fn across<R: Real>(w: LocalDir<R>) -> R {
    (w.y().sqr() + w.z().sqr()).sqrt()
}

impl<R: Real> Opaque for Banks<R> {
    type R = R;

    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let diffuse = cosine_lobe::power(across(i).min(R::ONE), self.p);
        let mirrored = (across(o) * across(i) - o.x() * i.x()).min(R::ONE);
        let highlight = cosine_lobe::power(mirrored, self.n);
        let f = self.diffuse * (R::of(FRAC_1_PI) * diffuse) + self.specular * highlight;
        (f, warp::cosine_hemisphere_pdf(i.cos_theta()))
    }

    #[inline(always)]
    fn draw(&self, _o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        LocalDir::new(warp::cosine_hemisphere(u.dir))
    }
}
