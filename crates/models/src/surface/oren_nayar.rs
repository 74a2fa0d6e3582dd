//! Rough diffuse reflection by Lambertian V-grooves. [OrenNayar1994]
//!
//! `form` chooses the short qualitative model of the paper or the full one with one
//! interreflection. sigma is the standard deviation of the facets' slope angle; a and b are
//! the larger and the smaller of the two polar angles, phi the difference of azimuths.
//!
//! Limits: the fits hold for sigma up to about 0.7 rad; light is lost at large sigma, and up to 5 % more than arrived
//! is returned at grazing views where sigma is small. The qualitative form has a dark ring towards the rim.
//! Errata: the full form goes below zero for large sigma at opposed grazing directions; we clamp it there.

use core::f64::consts::{FRAC_1_PI, FRAC_2_PI};

use sparrow_math::{LocalDir, Real, warp};
use sparrow_spectra::Spectrum;

use crate::opaque::Opaque;
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms};

/// Diffuse reflection from rough surfaces, as fitted in 1994.
#[derive(Clone, Copy, Debug)]
pub struct OrenNayar<R> {
    reflectance: Spectrum<R>,
    /// sigma^2
    s2: R,
    full: bool,
}

impl<R: Real> Model<R> for OrenNayar<R> {
    const ABOUT: About =
        About::new("rough diffuse reflection: Lambertian grooves", "OrenNayar1994").lacks(&[Lack::energy(
            "at grazing views the fits return up to 1.5 % (`qualitative`) and 5 % (`full`) more than arrived",
        )]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("reflectance").default(0.5).doc("Share of the light that a facet reflects."),
        ParamInfo::real("sigma")
            .unit("rad")
            .default(0.35)
            .range(0.0, 1.6)
            .soft(0.0, 0.7)
            .doc("Standard deviation of the facets' slope angle."),
        ParamInfo::choice("form", &["qualitative", "full"])
            .doc("The short form, or the full one with interreflection."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        OrenNayar { reflectance: p.spectra[0], s2: p.reals[0].sqr(), full: p.choices[0] == 1 }
    }
}

impl<R: Real> OrenNayar<R> {
    /// `x s^2 / (s^2 + y)`, the shape of all fits.
    #[inline(always)]
    fn fit(&self, x: f64, y: f64) -> R {
        R::of(x) * self.s2 / (self.s2 + R::of(y))
    }

    /// `A + B max(0, cos phi) sin a tan b`, over pi. [OrenNayar1994]
    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn qualitative(&self, o: LocalDir<R>, i: LocalDir<R>) -> Spectrum<R> {
        let A = R::ONE - self.fit(0.5, 0.33);
        let B = self.fit(0.45, 0.09);
        // cos phi sin a sin b is the product of the parts in the plane, cos b the larger cosine.
        let s = o.x() * i.x() + o.y() * i.y();
        let lobe = s.max(R::ZERO) / o.cos_theta().max(i.cos_theta());
        self.reflectance * (R::of(FRAC_1_PI) * (A + B * lobe))
    }

    /// Direct light and one interreflection. [OrenNayar1994]
    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn full(&self, o: LocalDir<R>, i: LocalDir<R>) -> Spectrum<R> {
        let (cos_a, cos_b) = (o.cos_theta().min(i.cos_theta()), o.cos_theta().max(i.cos_theta()));
        let (sin_o, sin_i) = (o.sin2_theta().sqrt(), i.sin2_theta().sqrt());
        let (sin_a, sin_b) = (sin_o.max(sin_i), sin_o.min(sin_i));
        let (a, b) = (sin_a.atan2(cos_a), sin_b.atan2(cos_b));
        let both = sin_o * sin_i;
        let slanted = both.gt(R::of(1e-12));
        let s = o.x() * i.x() + o.y() * i.y();
        let cos_phi = (s / R::select(slanted, both, R::ONE)).clamp(-R::ONE, R::ONE).only_where(slanted);

        let b_share = R::of(FRAC_2_PI) * b;
        let towards = cos_phi.ge(R::ZERO);
        let C1 = R::ONE - self.fit(0.5, 0.33);
        let C2 = self.fit(0.45, 0.09) * (sin_a - (b_share * b_share.sqr()).only_where(!towards));
        let C3 = self.fit(0.125, 0.09) * (R::of(FRAC_2_PI) * a * b_share).sqr();
        // tan((a + b) / 2), by sums of sines and cosines.
        let tan_mean = (sin_a + sin_b) / (cos_a + cos_b);
        let direct = C1 + cos_phi * C2 * sin_b / cos_b + (R::ONE - cos_phi.abs()) * C3 * tan_mean;
        let again = self.fit(0.17, 0.13) * (R::ONE - cos_phi * b_share.sqr());

        let rho = self.reflectance;
        (rho * direct.max(R::ZERO) + rho * rho * again) * R::of(FRAC_1_PI)
    }
}

impl<R: Real> Opaque for OrenNayar<R> {
    type R = R;

    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let f = if self.full { self.full(o, i) } else { self.qualitative(o, i) };
        (f, warp::cosine_hemisphere_pdf(i.cos_theta()))
    }

    #[inline(always)]
    fn draw(&self, _o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        LocalDir::new(warp::cosine_hemisphere(u.dir))
    }
}
