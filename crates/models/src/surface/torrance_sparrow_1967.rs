//! The microfacet model as it was published. [TorranceSparrow1967]
//!
//! `f = k F G exp(-c^2 alpha^2) / (4 cos psi cos theta) + rho_d / pi`, from the paper's radiance over the irradiance
//! `N_i cos psi domega`. Mirror facets in symmetric V-grooves (G), a Gaussian in the *angle* alpha of the facet, Fresnel's
//! equations for a complex index, and a Lambertian term for what is reflected more than once or from within.
//! psi is the angle of incidence, theta that of reflection, c in 1/degree as in the paper.
//!
//! `scale` says what k is, facet area times facets per area and solid angle: `normalized` sets it so that the facets'
//! projected area is one; `given` takes it from the parameter, as the paper's fits do. The comparison plots of the paper divide
//! by the value in the mirror direction, so that k drops out.
//! Limits: single scattering; the Lambertian term is added whatever the facets reflect.

use core::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_spectra::Spectrum;

use crate::opaque::{Half, Opaque, TwoLobes, exp_neg};
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms, fresnel, v_cavity};

/// Gaussian V-groove facets over a Lambertian base.
#[derive(Clone, Copy, Debug)]
pub struct TorranceSparrow1967<R> {
    /// In 1/rad.
    c: R,
    k_facets: R,
    eta: Spectrum<R>,
    k: Spectrum<R>,
    diffuse: Spectrum<R>,
    exact: bool,
}

impl<R: Real> Model<R> for TorranceSparrow1967<R> {
    const ABOUT: About = About::new(
        "Torrance and Sparrow as published: Gaussian V-grooves and a diffuse term",
        "TorranceSparrow1967",
    )
    .lacks(&[Lack::energy("the diffuse term is added to what the facets reflect; a `given` scale is free")]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::real("c_per_deg")
            .unit("1/deg")
            .default(0.05)
            .range(0.01, 1.0)
            .soft(0.02, 0.1)
            .doc("Decay c of the facets' distribution exp(-c^2 alpha^2)."),
        ParamInfo::real("facets")
            .unit("1/sr")
            .default(2.8)
            .range(0.0, 1e4)
            .soft(0.0, 3.0)
            .doc("Scale k where `scale` is `given`."),
        ParamInfo::unbounded("eta").default(0.77).doc("Real part of the index of refraction."),
        ParamInfo::unbounded("k")
            .default(6.08)
            .doc("Imaginary part of the index of refraction; 0 for dielectrics."),
        ParamInfo::albedo("diffuse").default(0.0).doc("Reflectance of the Lambertian term, rho_d."),
        ParamInfo::choice("scale", &["normalized", "given"]).doc("Projected facet area one, or k as given."),
        ParamInfo::choice("fresnel", &["exact", "one"]).doc("F from eta and k, or 1."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let c = p.reals[0] * R::of(180.0 * FRAC_1_PI);
        TorranceSparrow1967 {
            c,
            k_facets: if p.choices[0] == 0 { normalized_facets(c) } else { p.reals[1] },
            eta: p.spectra[0],
            k: p.spectra[1],
            diffuse: p.spectra[2],
            exact: p.choices[1] == 0,
        }
    }
}

/// Nodes above zero and weights of the Gauss-Legendre rule with 16 points on [-1, 1]. [AbramowitzStegun, table 25.4]
const GAUSS: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_095),
];

/// `1 / (pi integral_0^(pi/2) exp(-c^2 alpha^2) sin(2 alpha) dalpha)`, c in 1/rad.
///
/// There is no closed form with the upper limit; the sum is good to nine digits for c from 0.5 on.
#[inline(always)]
fn normalized_facets<R: Real>(c: R) -> R {
    let end = R::of(FRAC_PI_2).min(R::of(6.0) / c);
    let mut sum = R::ZERO;
    for (x, w) in GAUSS {
        for at in [0.5 - 0.5 * x, 0.5 + 0.5 * x] {
            let alpha = end * R::of(at);
            let value = exp_neg((c * alpha).sqr()) * (alpha + alpha).sin();
            sum = sum + R::of(0.5 * w) * value;
        }
    }
    R::ONE / (R::of(PI) * end * sum)
}

impl<R: Real> TorranceSparrow1967<R> {
    #[inline(always)]
    fn fresnel(&self, cos_d: R) -> Spectrum<R> {
        if !self.exact {
            return Spectrum::ONE;
        }
        self.eta.zip(
            self.k,
            #[inline(always)]
            |eta, k| fresnel::conductor(cos_d, eta, k),
        )
    }
    /// The facets' lobe is weighted by what they reflect of a light from the viewer.
    #[inline(always)]
    fn lobes(&self, o: LocalDir<R>) -> TwoLobes<R> {
        TwoLobes::new(self.diffuse, self.fresnel(o.cos_theta().min(R::ONE)))
    }
    /// Share of `2 c^2 alpha exp(-c^2 alpha^2)` within a quarter turn.
    #[inline(always)]
    fn kept(&self) -> R {
        R::ONE - exp_neg((self.c * R::of(FRAC_PI_2)).sqr())
    }
}

impl<R: Real> Opaque for TorranceSparrow1967<R> {
    type R = R;

    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let half = Half::new(o, i);
        let sin_alpha = half.m.sin2_theta().sqrt();
        let alpha = sin_alpha.atan2(half.m.cos_theta());
        let P = exp_neg((self.c * alpha).sqr());
        let G = v_cavity::g_over_4cos(o, i, &half);
        let F = self.fresnel(half.cos_d);
        let f = F * (self.k_facets * G * P) + self.diffuse * R::of(FRAC_1_PI);

        let wide = sin_alpha.gt(R::of(1e-6));
        let per_solid_angle = R::select(wide, alpha / R::select(wide, sin_alpha, R::ONE), R::ONE);
        let pdf_m = self.c.sqr() * R::of(FRAC_1_PI) / self.kept() * P * per_solid_angle;
        (f, self.lobes(o).density(i, pdf_m * half.jacobian()))
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        // alpha with the density alpha exp(-c^2 alpha^2), which is nearly that of the facets over the sphere.
        let inside = (R::ONE - u.dir[0] * self.kept()).max(R::of(1e-30));
        let alpha = ((-inside.ln()).safe_sqrt() / self.c).min(R::of(FRAC_PI_2));
        let (sin, cos) = alpha.sin_cos();
        let (s, c) = (R::of(2.0 * PI) * u.dir[1]).sin_cos();
        let m = LocalDir::new(vec3(sin * c, sin * s, cos));
        self.lobes(o).pick(u, o.reflect(m))
    }
}
