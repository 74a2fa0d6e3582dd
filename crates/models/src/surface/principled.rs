//! One surface for most materials, by layers: fuzz over a coat over a base of metal, glossy or translucent dielectric.
//!
//! Structure and names of parameters follow OpenPBR [OpenPBR2024]; the lobes are those of the other models here. With
//! `E(o)` the share that a layer sends back towards the viewer, what lies below is scaled by `1 - E(o)`:
//!
//! `f = fuzz + (1 - E_fuzz) (coat + (1 - E_coat) (m metal + (1 - m) ((1 - t) (spec + (1 - E_spec) diffuse) + t glass)))`
//!
//! | part | is |
//! | --- | --- |
//! | fuzz | the fibres of [`sheen`](super::sheen), [ZeltnerBurleyChiang2022] |
//! | coat, spec | GGX facets with Fresnel's reflectance, their albedo tabulated in [`crate::coat`] |
//! | metal | GGX facets, Schlick's reflectance with a tint at 82 degrees [KutzHasanEdmondson2021], lost light given back [Turquin2019] |
//! | diffuse | [`eon`](super::eon); what OpenPBR calls subsurface is not modelled |
//! | glass | [`dielectric`](super::dielectric) |
//!
//! The opaque parts look the same from both sides. No albedo passes one, and without absorption and glass all light leaves. The mixture
//! is sampled by the shares of its parts, and its density is exact.
//! Limits: not reciprocal, since layers are scaled by the viewer's side alone; light that leaves through coat and fuzz from within
//! the glass is not dimmed by them; a coat neither darkens nor roughens what lies below; the glass scatters once. Slope
//! widths are at least 2e-3: there are no perfect mirrors.

use sparrow_math::{LocalDir, Mask, ONE_MINUS_EPSILON, Real, Vec3};
use sparrow_spectra::Spectrum;

use super::dielectric::Dielectric;
use super::eon::Eon;
use crate::coat::Coat;
use crate::ggx::Ggx;
use crate::microfacet::albedo;
use crate::opaque::Opaque;
use crate::opaque::raised;
use crate::sheen_layer::{Fibres, SMOOTHEST};
use crate::{About, Bsdf, BsdfSample, Lack, Model, ParamBlock, ParamInfo, Uniforms, fresnel};

/// Fuzz over a coat over a base.
#[derive(Clone, Copy, Debug)]
pub struct Principled<R> {
    base_color: Spectrum<R>,
    /// Tint of metal at grazing angles.
    specular_color: Spectrum<R>,
    transmission_color: Spectrum<R>,
    /// What a coat of the given weight leaves of the colour below.
    coat_tint: Spectrum<R>,
    fuzz_color: Spectrum<R>,
    metalness: R,
    transmission: R,
    coat_weight: R,
    fuzz_weight: R,
    fuzz_roughness: R,
    facets: Ggx<R>,
    /// Geometric mean of the facets' widths.
    width: R,
    specular: Coat<R>,
    coat: Coat<R>,
    diffuse: Eon<R>,
    glass: Dielectric<R>,
}

/// Least slope width.
const NARROWEST: f64 = 2e-3;

/// Slope widths of a roughness and its anisotropy, both in 0..1. [OpenPBR2024]
#[inline(always)]
fn alphas<R: Real>(roughness: R, anisotropy: R) -> [R; 2] {
    let rest = R::ONE - anisotropy;
    let along = roughness.sqr() * (R::of(2.0) / (R::ONE + rest.sqr())).sqrt();
    let least = R::of(NARROWEST);
    [along.clamp(least, R::ONE), (along * rest).clamp(least, R::ONE)]
}

impl<R: Real> Model<R> for Principled<R> {
    const ABOUT: About = About::new(
        "fuzz over a coat over metal, glossy or translucent dielectric; parameters after OpenPBR",
        "OpenPBR2024, Walter2007, KutzHasanEdmondson2021, Turquin2019, ZeltnerBurleyChiang2022, Portsmouth2024",
    )
    .anisotropic()
    .transmits()
    .lacks(&[Lack::reciprocity("layers are scaled by what the ones above send towards the viewer alone")]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::real("specular_roughness")
            .default(0.3)
            .doc("Roughness of the base; its square is the slope width."),
        ParamInfo::real("coat_roughness").default(0.0).doc("Roughness of the coat."),
        ParamInfo::real("specular_roughness_anisotropy")
            .default(0.0)
            .soft(0.0, 0.5)
            .doc("Stretches the base's highlight across the grain."),
        ParamInfo::real("specular_ior")
            .default(1.5)
            .range(1.05, 3.0)
            .soft(1.2, 2.0)
            .doc("Index of refraction of the dielectric base, over that outside."),
        ParamInfo::real("base_weight").default(1.0).doc("Factor of base_color."),
        ParamInfo::real("base_metalness").default(0.0).doc("Share of metal in the base."),
        ParamInfo::real("base_diffuse_roughness").default(0.0).doc("Roughness of the diffuse part."),
        ParamInfo::real("transmission_weight").default(0.0).doc("Share of glass in the dielectric base."),
        ParamInfo::real("coat_weight").default(0.0).doc("Share of the surface that is coated."),
        ParamInfo::real("coat_ior")
            .default(1.6)
            .range(1.05, 3.0)
            .soft(1.2, 2.0)
            .doc("Index of refraction of the coat, over that outside."),
        ParamInfo::real("fuzz_weight").default(0.0).doc("Share of the surface that bears fibres."),
        ParamInfo::real("fuzz_roughness")
            .default(0.5)
            .range(SMOOTHEST, 1.0)
            .doc("From upright fibres to fibres without direction."),
        ParamInfo::albedo("base_color")
            .default(0.8)
            .doc("Colour of the diffuse part, and of metal at normal incidence."),
        ParamInfo::albedo("specular_color").default(1.0).doc("Tint of metal near 82 degrees."),
        ParamInfo::albedo("transmission_color")
            .default(1.0)
            .doc("Colour of light each time it passes the surface of the glass."),
        ParamInfo::albedo("coat_color").default(1.0).doc("Colour of what is seen through the coat."),
        ParamInfo::albedo("fuzz_color").default(1.0).doc("Colour of the fibres."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let [roughness, coat_roughness, anisotropy, ior, base_weight, metalness, diffuse_roughness, ..] =
            p.reals;
        let [_, _, _, _, _, _, _, transmission, coat_weight, coat_ior, fuzz_weight, fuzz_roughness] = p.reals;
        let [base, specular_color, transmission_color, coat_color, fuzz_color] = p.spectra;
        let base_color = base * base_weight;
        let widths = alphas(roughness, anisotropy);
        let facets = Ggx::new(widths[0], widths[1]);
        Principled {
            base_color,
            specular_color,
            transmission_color,
            coat_tint: coat_color * coat_weight + Spectrum::splat(R::ONE - coat_weight),
            fuzz_color,
            metalness,
            transmission,
            coat_weight,
            fuzz_weight,
            fuzz_roughness,
            facets,
            width: (widths[0] * widths[1]).sqrt(),
            specular: Coat::surface(widths, ior),
            coat: Coat::surface(alphas(coat_roughness, R::ZERO), coat_ior),
            diffuse: Eon { reflectance: base_color, r: diffuse_roughness },
            glass: Dielectric { eta: ior, ggx: facets },
        }
    }
}

/// What the layers send to one viewer, and with which probability each part is sampled.
struct View<R> {
    fibres: Fibres<R>,
    /// What passes the fuzz.
    below_fuzz: R,
    /// What passes the coat too, without its tint.
    below_coat: R,
    /// The same for the glass, which from below is not seen through the layers.
    glass: R,
    /// What passes the facets of the glossy dielectric.
    below_specular: R,
    /// Shares of fuzz, coat, facets, glass; the rest is the diffuse part's.
    shares: [R; 4],
}

impl<R: Real> Principled<R> {
    /// `o` above; `outside` says on which side the viewer really is.
    #[inline(always)]
    fn view(&self, o: LocalDir<R>, outside: R::Mask) -> View<R> {
        let mu = o.cos_theta().clamp(R::of(1e-6), R::ONE);
        let fibres = Fibres::new(o, self.fuzz_roughness);
        let fuzz = self.fuzz_weight * fibres.share;
        let below_fuzz = R::ONE - fuzz;
        let coat = self.coat_weight * self.coat.albedo(mu);
        let below_coat = below_fuzz * (R::ONE - coat);
        let specular = self.specular.albedo(mu);
        let glass = R::select(outside, below_coat, R::ONE);

        let dielectric = (R::ONE - self.metalness) * (R::ONE - self.transmission);
        let color = self.base_color.max_value();
        // Black metal reflects at grazing angles.
        let metal = self.metalness * (R::of(0.05) + R::of(0.95) * color);
        let facets = below_coat * (metal + dielectric * specular);
        let diffuse = below_coat * dielectric * (R::ONE - specular) * color;
        let through = glass * (R::ONE - self.metalness) * self.transmission;
        let (fuzz, coat) = (fuzz * self.fuzz_color.max_value(), below_fuzz * coat);
        let sum = (fuzz + coat + facets + diffuse + through).max(R::of(1e-12));
        View {
            fibres,
            below_fuzz,
            below_coat,
            glass,
            below_specular: R::ONE - specular,
            shares: [fuzz / sum, coat / sum, facets / sum, through / sum],
        }
    }

    /// `D G F / (4 cos cos)` of metal, with the light of later bounces.
    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn metal(&self, o: LocalDir<R>, i: LocalDir<R>) -> Spectrum<R> {
        let m = o.half(i);
        let DG = self.facets.d(m) * self.facets.g2_over_4cos(o, i);
        let cos_d = o.dot(m).clamp(R::ZERO, R::ONE);
        let E = albedo::ggx().albedo(o.cos_theta().min(R::ONE), self.width).clamp(R::of(1e-3), R::ONE);
        let lost = (R::ONE - E) / E;
        self.base_color.zip(
            self.specular_color,
            #[inline(always)]
            |f0, tint| fresnel::f82_tint(cos_d, f0, tint) * (R::ONE + f0 * lost) * DG,
        )
    }

    /// `f` and density of a pair on one side, both above, without the glass.
    #[inline(always)]
    fn reflected(&self, view: &View<R>, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let [p_fuzz, p_coat, p_facets, p_glass] = view.shares;
        let lobe = view.fibres.density_over_cos(i);
        let fuzz = self.fuzz_color * (self.fuzz_weight * view.fibres.share * lobe);
        let coat = Spectrum::splat(view.below_fuzz * self.coat_weight * self.coat.f(o, i));
        let (diffuse, p) = Opaque::eval(&self.diffuse, o, i);
        let glossy = Spectrum::splat(self.specular.f(o, i)) + diffuse * view.below_specular;
        let dielectric = glossy * ((R::ONE - self.metalness) * (R::ONE - self.transmission));
        let base = self.metal(o, i) * self.metalness + dielectric;
        let f = fuzz + coat + base * self.coat_tint * view.below_coat;

        let p_diffuse = (R::ONE - p_fuzz - p_coat - p_facets - p_glass).max(R::ZERO);
        let pdf = p_fuzz * lobe * i.cos_theta()
            + p_coat * self.coat.pdf(o, i)
            + p_facets * self.specular.pdf(o, i)
            + p_diffuse * p;
        (f, pdf)
    }
}

impl<R: Real> Bsdf<R> for Principled<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let outside = wo.above();
        let (o, i) = (raised(wo, wo), raised(wo, wi));
        let reflects = o.above() & i.above();
        let view = self.view(o, outside);
        let (f, pdf) = self.reflected(&view, o, i);

        let tint = Spectrum::select(wo.same_side(wi), Spectrum::ONE, self.transmission_color);
        let seen = Spectrum::select(outside, self.coat_tint, Spectrum::ONE);
        let weight = view.glass * (R::ONE - self.metalness) * self.transmission;
        let (glass, glass_pdf) = self.glass.f_cos_pdf(wo, wi);
        let f_cos = (f * wi.abs_cos_theta()).only_where(reflects) + glass * tint * seen * weight;
        (f_cos, pdf.only_where(reflects) + view.shares[3] * glass_pdf)
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let outside = wo.above();
        let o = raised(wo, wo);
        let view = self.view(o, outside);
        let [fuzz, coat, facets, glass] = view.shares;
        let after_glass = glass;
        let after_facets = after_glass + facets;
        let after_coat = after_facets + coat;
        let after_fuzz = after_coat + fuzz;

        // What the choice leaves of its number is uniform again, and chooses between reflection and refraction.
        let left = (u.lobe / glass.max(R::of(1e-12))).clamp(R::ZERO, R::of(f64::from(ONE_MINUS_EPSILON)));
        let through = self.glass.sample(wo, Uniforms { lobe: left, ..u });
        let mut i = Opaque::draw(&self.diffuse, o, u).v();
        i = Vec3::select(u.lobe.lt(after_fuzz), view.fibres.draw(u.dir).v(), i);
        i = Vec3::select(u.lobe.lt(after_coat), self.coat.sample(o, u.dir).v(), i);
        i = Vec3::select(u.lobe.lt(after_facets), self.specular.sample(o, u.dir).v(), i);
        let i = LocalDir::new(i);
        let in_glass = u.lobe.lt(after_glass);
        let wi = LocalDir::new(Vec3::select(in_glass, through.wi.v(), raised(wo, i).v()));

        let (f_cos, density) = self.f_cos_pdf(wo, wi);
        let right_side = (in_glass & through.valid) | (!in_glass & i.above());
        let valid = o.above() & right_side & density.gt(R::ZERO);
        BsdfSample {
            wi,
            weight: (f_cos / density.max(R::of(1e-30))).only_where(valid),
            density: density.only_where(valid),
            eta: R::select(in_glass, through.eta, R::ONE),
            delta: R::Mask::of(false),
            valid,
        }
    }

    #[inline(always)]
    fn regularized(self) -> Self {
        Principled {
            facets: self.facets.regularized(),
            width: crate::coat::wider(self.width),
            specular: self.specular.regularized_surface(),
            coat: self.coat.regularized_surface(),
            glass: self.glass.regularized(),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SurfaceKind;

    fn white(set: &[(&str, f64)]) -> Principled<f64> {
        let mut p = ParamBlock::defaults(Principled::<f64>::PARAMS);
        p.spectra = [Spectrum::ONE; 5];
        for (name, v) in set {
            let at = SurfaceKind::Principled.params().iter().position(|q| q.name == *name);
            p.reals[at.expect("a parameter")] = *v;
        }
        Principled::new(&p)
    }

    /// Mean weight over a grid of uniform numbers, as energy.
    fn albedo(m: &Principled<f64>, wo: LocalDir<f64>) -> f64 {
        let n = 200;
        let u = |k: usize| (k as f64 + 0.5) / n as f64;
        let mut sum = 0.0;
        for k in 0..n * n {
            let lobe = (k as f64 * 0.618_033_988_749_894_9).fract();
            let s = m.sample(wo, Uniforms { lobe, dir: [u(k % n), u(k / n)] });
            sum += if s.valid { s.weight[0] * s.eta * s.eta } else { 0.0 };
        }
        sum / (n * n) as f64
    }

    #[test]
    fn white_layers_without_glass_return_all_light_and_never_more() {
        for set in [
            &[("base_metalness", 1.0)][..],
            &[("specular_roughness", 0.8), ("base_metalness", 1.0)],
            &[("specular_roughness", 0.5), ("base_diffuse_roughness", 0.7)],
            &[("coat_weight", 1.0), ("coat_roughness", 0.4), ("specular_roughness", 0.6)],
            &[("fuzz_weight", 1.0), ("fuzz_roughness", 0.3), ("coat_weight", 0.5), ("base_metalness", 0.5)],
        ] {
            for theta in [0.0, 40.0, 70.0, 85.0] {
                let wo = LocalDir::from_angles(f64::to_radians(theta), 0.4);
                let e = albedo(&white(set), wo);
                // Tables of albedo: 0.006; the grid: 0.01.
                assert!((e - 1.0).abs() < 0.016, "{set:?} at {theta}: {e}");
            }
        }
    }

    #[test]
    fn glass_lets_light_through_from_both_sides_and_makes_none() {
        let m = white(&[("transmission_weight", 1.0), ("specular_roughness", 0.4)]);
        for (theta, least) in [(0.0, 0.97), (30.0, 0.95), (150.0, 0.9), (180.0, 0.95)] {
            let wo = LocalDir::from_angles(f64::to_radians(theta), 0.4);
            let e = albedo(&m, wo);
            assert!(e > least && e < 1.003, "{theta}: {e}");
        }
    }

    #[test]
    fn samples_fall_where_the_density_says() {
        // Every part wide enough for a grid, which random parameters seldom make them.
        let m = white(&[
            ("specular_roughness", 0.7),
            ("specular_roughness_anisotropy", 0.3),
            ("coat_roughness", 0.6),
            ("coat_weight", 0.8),
            ("fuzz_weight", 0.7),
            ("fuzz_roughness", 0.4),
            ("base_metalness", 0.2),
            ("base_diffuse_roughness", 0.5),
            ("transmission_weight", 0.4),
        ]);
        for theta in [35.0, 70.0, 140.0] {
            let wo = LocalDir::from_angles(f64::to_radians(theta), 0.4);
            // Cells of equal solid angle, 8 in height and 8 around.
            let (n, mut cells) = (300, [0.0; 64]);
            let mut add = |w: LocalDir<f64>, amount: f64| {
                let phi = Real::atan2(w.y(), w.x()) / core::f64::consts::TAU + 0.5;
                let (i, j) = ((4.0 * (w.z() + 1.0)) as usize, (8.0 * phi) as usize);
                cells[i.min(7) * 8 + j.min(7)] += amount / f64::from(n * n);
            };
            for k in 0..n * n {
                let u = [f64::from(k % n) + 0.5, f64::from(k / n) + 0.5].map(|x| x / f64::from(n));
                let z = 2.0 * u[0] - 1.0;
                let w = LocalDir::from_angles(Real::acos(z), core::f64::consts::TAU * u[1]);
                add(w, m.pdf(wo, w) * 2.0 * core::f64::consts::TAU);
                let lobe = (f64::from(k) * 0.618_033_988_749_894_9).fract();
                let s = m.sample(wo, Uniforms { lobe, dir: u });
                if s.valid {
                    add(s.wi, -1.0);
                }
            }
            let worst = cells.iter().fold(0.0, |a: f64, c| a.max(c.abs()));
            // Five standard errors of a share of 0.1 among 90 000.
            assert!(worst < 0.005, "{theta}: {worst}");
        }
    }
}
