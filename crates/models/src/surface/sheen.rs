//! Sheen of a layer of upright fibres, all orders of scattering, over a diffuse base. [ZeltnerBurleyChiang2022]
//!
//! `f = color R(o) D(i) / cos theta_i + (1 - R(o)) base / pi`: the lobe of [`crate::fibres`], which white fibres of any
//! roughness fill with the share R of the light, and what they let through, spread by Lambert's law. White fibres on a white
//! base return all light.
//! Limits: not reciprocal, since lobe and share know the viewer's angle alone; against random walks through the layer the
//! lobe misplaces 5 % of its light, at most 16 % where little comes back. The fibres' colour multiplies once, whatever the number of bounces.

use core::f64::consts::FRAC_1_PI;

use sparrow_math::{LocalDir, Real};
use sparrow_spectra::Spectrum;

use crate::opaque::{Opaque, TwoLobes};
use crate::sheen_layer::{Fibres, SMOOTHEST};
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms};

/// A layer of fibres over a diffuse base.
#[derive(Clone, Copy, Debug)]
pub struct Sheen<R> {
    color: Spectrum<R>,
    base: Spectrum<R>,
    roughness: R,
}

impl<R: Real> Model<R> for Sheen<R> {
    const ABOUT: About = About::new(
        "sheen of cloth: a layer of fibres, all orders of scattering, over a diffuse base",
        "ZeltnerBurleyChiang2022, Heitz2015",
    )
    .lacks(&[Lack::reciprocity("the fitted lobe and its share depend on the viewer's angle alone")]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("color").default(0.8).doc("Colour of the fibres."),
        ParamInfo::albedo("base").default(0.1).doc("Reflectance of the diffuse base below."),
        ParamInfo::real("roughness").default(0.3).range(SMOOTHEST, 1.0).doc(
            "From fibres that stand upright, which shine at grazing views, to fibres without direction.",
        ),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        Sheen { color: p.spectra[0], base: p.spectra[1], roughness: p.reals[0] }
    }
}

impl<R: Real> Sheen<R> {
    #[inline(always)]
    fn lobes(&self, fibres: &Fibres<R>) -> TwoLobes<R> {
        TwoLobes::new(self.base * (R::ONE - fibres.share), self.color * fibres.share)
    }
}

impl<R: Real> Opaque for Sheen<R> {
    type R = R;

    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let fibres = Fibres::new(o, self.roughness);
        let lobe = fibres.density_over_cos(i);
        let f = self.color * (fibres.share * lobe) + self.base * ((R::ONE - fibres.share) * R::of(FRAC_1_PI));
        (f, self.lobes(&fibres).density(i, lobe * i.cos_theta()))
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        let fibres = Fibres::new(o, self.roughness);
        self.lobes(&fibres).pick(u, fibres.draw(u.dir))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Bsdf;

    /// `int f cos theta_i domega_i` over slopes, in which the lobe is smooth wherever it points.
    fn albedo(m: &Sheen<f64>, o: LocalDir<f64>) -> f64 {
        let fibres = Fibres::new(o, m.roughness);
        let n = 300;
        (0..n * n)
            .map(|k| {
                let u = [(f64::from(k % n) + 0.5) / f64::from(n), (f64::from(k / n) + 0.5) / f64::from(n)];
                let i = fibres.draw(u);
                m.f_cos(o, i)[0] / (fibres.density_over_cos(i) * i.z() * f64::from(n * n))
            })
            .sum()
    }

    #[test]
    fn the_white_furnace_is_white_and_bare_fibres_return_their_share() {
        for roughness in [0.1, 0.2, 0.45, 1.0] {
            for theta in [0.0, 20.0, 60.0, 80.0, 89.0] {
                let o = LocalDir::from_angles(f64::to_radians(theta), 0.7);
                let white = |base| Sheen { color: Spectrum::ONE, base: Spectrum::splat(base), roughness };
                let bare = albedo(&white(0.0), o);
                let share = Fibres::new(o, roughness).share;
                assert!((bare - share).abs() < 1e-10, "{roughness} {theta}: {bare} {share}");
                // Lambert's law, seen through points of the other lobe: the rule's error, larger where the lobe is narrow.
                let furnace = albedo(&white(1.0), o);
                assert!((furnace - 1.0).abs() < 0.02, "{roughness} {theta}: {furnace}");
            }
        }
    }
}
