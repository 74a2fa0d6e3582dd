//! Metal or another opaque base under a film as thin as a wavelength: soap, oil, oxide on steel. [BelcourBarla2017]
//!
//! GGX facets as those of [`conductor`](super::conductor), with the reflectance of a film on a base in place of
//! Fresnel's. Airy's sum over all orders is taken exactly at every wavelength of the path and for both polarisations
//! ([`crate::film`]); no colour is integrated beforehand. Film and base may absorb; a base with `k = 0` is a dielectric whose
//! transmitted light is lost.
//! Limits: single scattering; the film is as thick everywhere on a facet, and light stays coherent within it.

use sparrow_math::Real;
use sparrow_spectra::Spectrum;

use crate::film::{Medium, reflectance};
use crate::ggx::Ggx;
use crate::mirror_facets::{FacetReflectance, MirrorFacets};
use crate::{About, Model, ParamBlock, ParamInfo};

/// Rough or smooth facets under a film.
pub(super) type ThinFilm<R> = MirrorFacets<R, Film<R>>;

/// A film and the base under it.
#[derive(Clone, Copy, Debug)]
pub struct Film<R> {
    /// Thickness over wavelength.
    waves: Spectrum<R>,
    film: [Spectrum<R>; 2],
    base: [Spectrum<R>; 2],
}

impl<R: Real> Model<R> for ThinFilm<R> {
    const ABOUT: About = About::new(
        "a thin film on metal or glass: GGX facets, interference per wavelength",
        "BelcourBarla2017, BornWolf, Heitz2014",
    )
    .anisotropic();
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::real("alpha_x").default(0.0).soft(0.0, 0.7).doc("Slope width along the grain."),
        ParamInfo::real("alpha_y").default(0.0).soft(0.0, 0.7).doc("Slope width across the grain."),
        ParamInfo::real("film_thickness")
            .unit("nm")
            .default(400.0)
            .range(0.0, 10_000.0)
            .soft(0.0, 1500.0)
            .doc("Thickness of the film."),
        ParamInfo::unbounded("film_eta").default(1.33).doc("Real part of the film's index of refraction."),
        ParamInfo::unbounded("film_k").default(0.0).doc("Imaginary part of the film's index of refraction."),
        ParamInfo::unbounded("eta").default(0.2).doc("Real part of the base's index of refraction."),
        ParamInfo::unbounded("k").default(3.9).doc("Imaginary part of the base's index of refraction."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let [film_eta, film_k, eta, k, ..] = p.spectra;
        let thickness = p.reals[2];
        let reflectance = Film {
            waves: p.lambda.map(
                #[inline(always)]
                |nm| thickness / nm,
            ),
            film: [film_eta, film_k],
            base: [eta, k],
        };
        MirrorFacets { ggx: Ggx::new(p.reals[0], p.reals[1]), reflectance }
    }
}

impl<R: Real> FacetReflectance<R> for Film<R> {
    #[inline(always)]
    fn at(&self, cos_d: R) -> Spectrum<R> {
        let mut out = Spectrum::ZERO;
        for i in 0..out.0.len() {
            let film = Medium::new(self.film[0].0[i], self.film[1].0[i]);
            let base = Medium::new(self.base[0].0[i], self.base[1].0[i]);
            out.0[i] = reflectance(cos_d, film, self.waves.0[i], base);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use sparrow_math::LocalDir;

    use super::*;
    use crate::{Bsdf, SurfaceKind, Uniforms};

    /// The weights of a mirror with a film on glass, at four wavelengths.
    fn mirror(thickness: f64, lambda: [f64; 4]) -> [f64; 4] {
        let mut p = ParamBlock::defaults(SurfaceKind::ThinFilm.params());
        p.reals[2] = thickness;
        p.spectra = [1.3, 0.0, 1.69, 0.0, 0.0].map(Spectrum::splat);
        p.lambda = Spectrum(lambda);
        let up = LocalDir::from_angles(0.0, 0.0);
        let s = ThinFilm::new(&p).sample(up, Uniforms { lobe: 0.5, dir: [0.5; 2] });
        s.weight.0
    }

    #[test]
    fn each_wavelength_has_its_own_reflectance() {
        // A quarter of 520 nm in the film, half of 260 nm, an eighth of 1040 nm.
        let w = mirror(100.0, [520.0, 260.0, 1040.0, 520.0]);
        let bare = (0.69f64 / 2.69).powi(2);
        assert!(w[0] < 1e-20 && w[3] < 1e-20, "{w:?}");
        assert!((w[1] - bare).abs() < 1e-12 && w[2] > 0.1 * bare && w[2] < bare, "{w:?}");
    }
}
