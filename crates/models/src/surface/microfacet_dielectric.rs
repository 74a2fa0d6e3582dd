//! A boundary of facets that reflect and refract, with distribution, masking and sampling by choice.
//!
//! [Walter2007, eq. 16, 17, 20, 21]; exact Fresnel reflectance. The value is for radiance: transmission carries
//! `1 / eta^2`, with eta from the side of `wo` to the other. Masking `smith` is correlated by height: `1 / (1 +
//! Lambda_o + Lambda_i)` for reflection and `B(1 + Lambda_o, 1 + Lambda_i)` for transmission [Heitz2016, eq. 23], in
//! which the model differs from [`dielectric`](super::dielectric). Where both sides have the same index, light goes
//! straight on.
//! Light that meets a second facet is lost (`single`), or given back: by a factor `1 / E(o)` on both lobes [Turquin2019], which
//! is not reciprocal; by diffuse lobes on either side, which is [KullaConty2017]; or exactly, by a random walk from facet
//! to facet [Heitz2016], whose value is noisy: right in the mean over directions, and drawn half like the diffuse lobes, half from
//! wider facets. All are known for `ndf "ggx"` with `masking "smith"`, the first two for indices from 1/3 to 3; elsewhere `energy` has no effect, or
//! that of the nearest index.

use core::f64::consts::FRAC_1_PI;

use sparrow_math::{LocalDir, Mask, Real, Vec3, vec3, warp};
use sparrow_spectra::Spectrum;

use crate::microfacet::boundary_albedo::{self, BoundaryTable};
use crate::microfacet::walk::boundary;
use crate::microfacet::{Facets, Masking, Ndf, NdfKind, Sampling};
use crate::opaque::raised;
use crate::{About, Bsdf, BsdfSample, Lack, Model, ParamBlock, ParamInfo, Uniforms, fresnel};

/// What is done about light that meets several facets.
#[derive(Clone, Copy, Debug)]
enum Energy {
    Single,
    Turquin(&'static BoundaryTable),
    KullaConty(&'static BoundaryTable),
    Walk(&'static BoundaryTable),
}

/// Reflecting and refracting facets.
#[derive(Clone, Copy, Debug)]
pub struct MicrofacetDielectric<R> {
    eta: R,
    facets: Facets<R>,
    energy: Energy,
}

impl<R: Real> Model<R> for MicrofacetDielectric<R> {
    const ABOUT: About = About::new(
        "facets that reflect and refract: distribution, masking, sampling and energy by choice",
        "Walter2007, Heitz2014, Heitz2016, KullaConty2017, Turquin2019",
    )
    .anisotropic()
    .transmits()
    .lacks(&[
        Lack::energy("facets hide nothing of each other").when(&[("masking", &["none"])]),
        Lack::energy("compensation takes the albedo of the mean of two widths, from a table")
            .when(&[("energy", &["turquin", "kulla_conty"])]),
        Lack::reciprocity("scales by the albedo towards the viewer alone").when(&[("energy", &["turquin"])]),
    ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::real("eta")
            .default(1.5)
            .range(0.1, 10.0)
            .soft(1.0, 2.5)
            .doc("Index of refraction of the side below, over that of the side above."),
        ParamInfo::real("alpha_x")
            .default(0.2)
            .range(1e-3, 1.0)
            .soft(0.01, 0.7)
            .doc("Slope width along the grain."),
        ParamInfo::real("alpha_y")
            .default(0.2)
            .range(1e-3, 1.0)
            .soft(0.01, 0.7)
            .doc("Slope width across the grain."),
        ParamInfo::choice("ndf", &["ggx", "beckmann"]).doc("Distribution of the facets' normals."),
        ParamInfo::choice("masking", &["smith", "separable", "none"]).doc("How facets hide each other."),
        ParamInfo::choice("sampling", &["visible", "disk", "full"])
            .doc("How normals are drawn; the disk is for ggx, beckmann then draws what is visible."),
        ParamInfo::choice("energy", &["single", "turquin", "kulla_conty", "walk"]).doc(
            "Light that meets several facets: lost, or given back by albedo or by a walk (ggx with smith masking).",
        ),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let kind = if p.choices[0] == 0 { NdfKind::Ggx } else { NdfKind::Beckmann };
        let masking = match p.choices[1] {
            0 => Masking::Smith,
            1 => Masking::Separable,
            _ => Masking::None,
        };
        let compensable = kind == NdfKind::Ggx && masking == Masking::Smith;
        MicrofacetDielectric {
            eta: p.reals[0],
            energy: match p.choices[3] {
                1 if compensable => Energy::Turquin(boundary_albedo::table()),
                2 if compensable => Energy::KullaConty(boundary_albedo::table()),
                3 if compensable => Energy::Walk(boundary_albedo::table()),
                _ => Energy::Single,
            },
            facets: Facets::new(
                Ndf::new(kind, p.reals[1], p.reals[2], R::ZERO),
                masking,
                Sampling::from_choice(p.choices[2]),
            ),
        }
    }
}

/// What a sample starts from.
struct Drawn<R: Real> {
    /// A facet's normal.
    m: LocalDir<R>,
    /// The uniform number that decides whether the facet reflects.
    lobe: R,
    /// A direction of the diffuse lobes, taken instead of the facet's.
    diffuse: LocalDir<R>,
    is_diffuse: R::Mask,
}

impl<R: Real> MicrofacetDielectric<R> {
    /// Both sides have the same index.
    #[inline(always)]
    fn is_absent(&self) -> R::Mask {
        (self.eta - R::ONE).abs().lt(R::of(1e-5))
    }
    /// The relative index as met from the side of `wo`, transmitted over incident.
    #[inline(always)]
    fn eta_from(&self, wo: LocalDir<R>) -> R {
        R::select(wo.above(), self.eta, R::ONE / self.eta)
    }
    /// The facet normal that carries `o`, above, to `i` by reflection or refraction. [Walter2007, eq. 13, 16]
    #[inline(always)]
    fn normal(o: LocalDir<R>, i: LocalDir<R>, eta: R) -> LocalDir<R> {
        let h = (o.v() + i.v() * R::select(i.above(), R::ONE, eta)).normalized();
        LocalDir::new(h.facing(vec3(R::ZERO, R::ZERO, R::ONE)))
    }
    /// `1 - E`: the share of light from the cosine `mu` that single scattering loses; `eta` as met from its side.
    #[inline(always)]
    fn lost(&self, table: &BoundaryTable, mu: R, eta: R) -> R {
        table.lost(mu.min(R::ONE), self.facets.ndf().mean_width(), eta).min(R::of(0.99))
    }
    /// The diffuse lobes over `1 - E(o)`, and the share of them that goes through. [KullaConty2017]
    ///
    /// `x (1 - E(i)) / (pi (1 - E_avg))` on the viewer's side, `(1 - x) (1 - E'(i)) / (pi (1 - E'_avg) eta^2)` on the other,
    /// primes for light from there. `1 - x = T_avg min(1 - E_avg, 1 - E'_avg) / (1 - E_avg)`, T_avg the mean transmittance of a
    /// smooth boundary, makes both reciprocal, since `T_avg = eta^2 T'_avg`.
    #[inline(always)]
    fn diffuse(&self, table: &BoundaryTable, i: LocalDir<R>, eta: R) -> (R, R) {
        let dense = eta.max(R::ONE / eta);
        let enters = R::ONE
            - fresnel::average(
                #[inline(always)]
                |c| fresnel::dielectric(c, dense).0,
            );
        let t_avg = R::select(eta.ge(R::ONE), enters, enters / dense.sqr());
        let width = self.facets.ndf().mean_width();
        let here = table.mean_lost(width, eta).max(R::of(1e-6));
        let there = table.mean_lost(width, R::ONE / eta).max(R::of(1e-6));
        let through = t_avg * (here.min(there) / here);
        let reflects = i.above();
        let lost_i = self.lost(table, i.abs_cos_theta(), R::select(reflects, eta, R::ONE / eta));
        let share = R::select(reflects, (R::ONE - through) / here, through / (there * eta.sqr()));
        (share * lost_i * R::of(FRAC_1_PI), through)
    }
    /// [`single`](Self::single) with what is done about the light it loses.
    #[inline(always)]
    fn value_and_density(&self, o: LocalDir<R>, i: LocalDir<R>, m: LocalDir<R>, eta: R) -> (R, R) {
        let (f, pdf) = self.single(o, i, m, eta);
        let (Energy::Turquin(table) | Energy::KullaConty(table) | Energy::Walk(table)) = self.energy else {
            return (f, pdf);
        };
        let lost = self.lost(table, o.cos_theta(), eta);
        if matches!(self.energy, Energy::Turquin(_)) {
            return (f / (R::ONE - lost), pdf);
        }
        let (diffuse, through) = self.diffuse(table, i, eta);
        let side = R::select(i.above(), R::ONE - through, through);
        let diffuse_pdf = side * warp::cosine_hemisphere_pdf(i.abs_cos_theta());
        let (further, further_pdf) = match self.energy {
            Energy::Walk(_) => {
                let (_, wide) = self.wide().single(o, i, m, eta);
                let further = boundary::further(&self.facets.ndf().ggx(), eta, o, i);
                (further, R::of(0.5) * (diffuse_pdf + wide))
            }
            Energy::KullaConty(_) | Energy::Turquin(_) | Energy::Single => (lost * diffuse, diffuse_pdf),
        };
        let lit = o.above() & i.abs_cos_theta().gt(R::ZERO);
        (f + further.only_where(lit), (R::ONE - lost) * pdf + (lost * further_pdf).only_where(lit))
    }
    /// Chooses between facets, wider facets and diffuse lobes, and draws.
    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>, eta: R) -> Drawn<R> {
        let m = self.facets.sample(o, u.dir);
        let (table, wide, share) = match self.energy {
            Energy::Single | Energy::Turquin(_) => {
                return Drawn { m, lobe: u.lobe, diffuse: m, is_diffuse: R::Mask::of(false) };
            }
            Energy::KullaConty(table) => (table, m, R::ONE),
            Energy::Walk(table) => (table, self.wide().facets.sample(o, u.dir), R::of(0.5)),
        };
        let lost = self.lost(table, o.cos_theta(), eta);
        let to_diffuse = lost * share;
        let through = self.diffuse(table, o, eta).1;
        let up = warp::cosine_hemisphere(u.dir);
        let z = R::select(u.lobe.lt(to_diffuse * through), -up.z, up.z);
        // The rest of the number decides between reflection and refraction.
        let is_wide = u.lobe.lt(lost);
        let lobe = R::select(
            is_wide,
            (u.lobe - to_diffuse) / (lost - to_diffuse).max(R::of(1e-9)),
            (u.lobe - lost) / (R::ONE - lost),
        );
        Drawn {
            m: LocalDir::new(Vec3::select(is_wide, wide.v(), m.v())),
            lobe: lobe.clamp(R::ZERO, R::ONE),
            diffuse: LocalDir::new(Vec3 { z, ..up }),
            is_diffuse: u.lobe.lt(to_diffuse),
        }
    }
    /// The boundary that directions of further light are drawn from.
    #[inline(always)]
    fn wide(self) -> Self {
        MicrofacetDielectric { facets: self.facets.for_further(), ..self }
    }
    /// `f` and the density of `i`, for `o` above and the facet normal `m` between them; one facet only.
    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn single(&self, o: LocalDir<R>, i: LocalDir<R>, m: LocalDir<R>, eta: R) -> (R, R) {
        let reflects = i.above();
        let (o_dot_m, i_dot_m) = (o.dot(m), i.dot(m));
        let lit =
            o.above() & o_dot_m.gt(R::ZERO) & (i_dot_m * i.z()).gt(R::ZERO) & i.abs_cos_theta().gt(R::ZERO);
        let D = self.facets.ndf().d(m);
        let F = fresnel::dielectric(o_dot_m.clamp(R::ZERO, R::ONE), eta).0;
        let seen = D * self.facets.density_over_d(o, m, o_dot_m.max(R::of(1e-9)));

        let f_r = F * D * self.facets.g2_over_4cos(o, i); // [Walter2007, eq. 20]
        let p_r = F * seen * R::of(0.25); // [Walter2007, eq. 14]
        // [Walter2007, eq. 21], over eta^2 for radiance, and eq. 17.
        let bend = o_dot_m * i_dot_m.abs() / (eta * i_dot_m + o_dot_m).sqr().max(R::of(1e-30));
        let f_t = (R::ONE - F) * D * R::of(4.0) * self.facets.transmitted_g2_over_4cos(o, i) * bend;
        let p_t = (R::ONE - F) * seen * bend * eta.sqr();
        (R::select(reflects, f_r, f_t).only_where(lit), R::select(reflects, p_r, p_t).only_where(lit))
    }
}

impl<R: Real> Bsdf<R> for MicrofacetDielectric<R> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let eta = self.eta_from(wo);
        let (o, i) = (raised(wo, wo), raised(wo, wi));
        let (f, pdf) = self.value_and_density(o, i, Self::normal(o, i, eta), eta);
        let there = !self.is_absent();
        (Spectrum::splat(f * i.abs_cos_theta()).only_where(there), pdf.only_where(there))
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let eta = self.eta_from(wo);
        let o = raised(wo, wo);
        let delta = self.is_absent();
        let drawn = self.draw(o, u, eta);
        let m = LocalDir::new(Vec3::select(delta, vec3(R::ZERO, R::ZERO, R::ONE), drawn.m.v()));
        let cos_o = o.dot(m).clamp(R::ZERO, R::ONE);
        let (reflectance, cos_t) = fresnel::dielectric(cos_o, eta);
        let diffuse = drawn.is_diffuse & !delta;
        let reflects = drawn.lobe.lt(reflectance) & !delta;
        let refracted = m.v() * (cos_o / eta - cos_t) - o.v() * (R::ONE / eta);
        let bent = Vec3::select(delta, -o.v(), refracted.normalized());
        let i = Vec3::select(reflects, o.reflect(m).v(), bent);
        let i = LocalDir::new(Vec3::select(diffuse, drawn.diffuse.v(), i));
        let reflects = (reflects & !diffuse) | (diffuse & i.above());
        let m = LocalDir::new(Vec3::select(diffuse, Self::normal(o, i, eta).v(), m.v()));

        let (f, pdf) = self.value_and_density(o, i, m, eta);
        let density = R::select(delta, R::ONE, pdf);
        // A facet may send light through the macrosurface the wrong way: that light is lost.
        let right_side = R::select(reflects, i.z(), -i.z()).gt(R::ZERO);
        let valid = o.above() & right_side & density.gt(R::ZERO);
        let weight = R::select(delta, R::ONE, f * i.abs_cos_theta() / R::select(valid, density, R::ONE));
        BsdfSample {
            wi: raised(wo, i),
            weight: Spectrum::splat(weight).only_where(valid),
            density: density.only_where(valid),
            eta: R::select(reflects, R::ONE, eta),
            delta,
            valid,
        }
    }

    #[inline(always)]
    fn has_smooth_lobe(&self) -> R::Mask {
        !self.is_absent()
    }

    #[inline(always)]
    fn regularized(self) -> Self {
        MicrofacetDielectric { facets: self.facets.regularized(), ..self }
    }
}
