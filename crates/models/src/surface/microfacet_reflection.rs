//! Facets that only reflect, with every term a choice of its own: `f = F D G / (4 cos_o cos_i)`.
//!
//! The same from both sides of the surface. [CookTorrance1982] as [Walter2007, eq. 20] writes it; the paper of 1982
//! prints pi where 4 is right.
//! Light that meets a second facet is lost (`single`), or given back: by a factor [Turquin2019, eq. 16], which is not
//! reciprocal; by a diffuse lobe [KullaConty2017]; or exactly, by a random walk from facet to facet [Heitz2016], whose
//! value is noisy: right in the mean over directions, and drawn half like the diffuse lobe, half from wider facets. All are known for `ndf "ggx"` with
//! `masking "smith"`; elsewhere `energy` has no effect. With two widths the albedo of the first two is that of their
//! geometric mean.
//!
//! Errata: the slides of [KullaConty2017] print the mean reflectance of the lobe to the first power; the sum over bounces
//! needs its square.

use core::f64::consts::FRAC_1_PI;

use sparrow_math::{LocalDir, Real, Vec3, warp};
use sparrow_spectra::Spectrum;

use crate::microfacet::albedo::{self, AlbedoTable};
use crate::microfacet::walk::mirrors;
use crate::microfacet::{Facets, Masking, Ndf, NdfKind, Reflectance, ReflectanceKind, Sampling};
use crate::opaque::{Half, Opaque};
use crate::{About, Lack, Model, ParamBlock, ParamInfo, Uniforms};

/// What is done about light that meets several facets.
#[derive(Clone, Copy, Debug)]
enum Energy {
    Single,
    Turquin(&'static AlbedoTable),
    KullaConty(&'static AlbedoTable),
    Walk(&'static AlbedoTable),
}

/// Reflecting facets.
#[derive(Clone, Copy, Debug)]
pub struct MicrofacetReflection<R> {
    facets: Facets<R>,
    reflectance: Reflectance<R>,
    energy: Energy,
}

impl<R: Real> Model<R> for MicrofacetReflection<R> {
    const ABOUT: About = About::new(
        "reflecting facets: distribution, masking, Fresnel term, sampling and energy by choice",
        "CookTorrance1982, Walter2007, Heitz2014, Ribardiere2017, Heitz2016, KullaConty2017, Turquin2019",
    )
    .anisotropic()
    .lacks(&[
        Lack::energy("facets hide nothing of each other").when(&[("masking", &["none"])]),
        Lack::energy("Smith's masking is that of the nearest relative")
            .when(&[("ndf", &["blinn", "gtr"]), ("masking", &["smith", "separable"])]),
        Lack::energy("the albedo is that of the mean of two widths").when(&[
            ("ndf", &["ggx"]),
            ("masking", &["smith"]),
            ("energy", &["turquin", "kulla_conty"]),
        ]),
        Lack::reciprocity("scaled by the albedo towards the viewer alone").when(&[
            ("ndf", &["ggx"]),
            ("masking", &["smith"]),
            ("energy", &["turquin"]),
        ]),
    ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::choice("ndf", NdfKind::NAMES).doc("Distribution of the facets' normals."),
        ParamInfo::choice("masking", Masking::NAMES).doc("How facets hide each other."),
        ParamInfo::choice("fresnel", ReflectanceKind::NAMES).doc("What one facet reflects."),
        ParamInfo::choice("sampling", Sampling::NAMES)
            .doc("How normals are drawn; what a distribution cannot do, it does by the nearest way it can."),
        ParamInfo::choice("energy", &["single", "turquin", "kulla_conty", "walk"]).doc(
            "Light that meets several facets: lost, or given back by albedo or by a walk (ggx with smith masking).",
        ),
        ParamInfo::real("alpha_x")
            .default(0.2)
            .range(1e-3, 1.0)
            .soft(0.01, 0.7)
            .doc("Slope width along the grain; not used by blinn."),
        ParamInfo::real("alpha_y")
            .default(0.2)
            .range(1e-3, 1.0)
            .soft(0.01, 0.7)
            .doc("Slope width across the grain; not used by blinn."),
        ParamInfo::real("exponent")
            .default(40.0)
            .range(0.0, 1e6)
            .soft(1.0, 1000.0)
            .doc("Power of the cosine of blinn."),
        ParamInfo::real("gamma").default(2.0).range(0.2, 40.0).soft(1.6, 6.0).doc(
            "Tail of gtr (up to 6) and student_t (from 1.6): 2 is GGX, larger values have shorter tails.",
        ),
        ParamInfo::unbounded("eta").default(0.2).doc("Index of refraction of conductor and dielectric."),
        ParamInfo::unbounded("k").default(3.9).doc("Imaginary part of the index, of conductor."),
        ParamInfo::albedo("f0")
            .default(0.9)
            .doc("Reflectance at normal incidence of schlick and f82; at all angles of constant."),
        ParamInfo::albedo("f82").default(1.0).doc("Tint of f82 at 81.8 degrees, over Schlick's value there."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let kind = NdfKind::from_choice(p.choices[0]);
        let shape = if kind == NdfKind::Blinn { p.reals[2] } else { p.reals[3] };
        let masking = Masking::from_choice(p.choices[1]);
        let compensable = kind == NdfKind::Ggx && masking == Masking::Smith;
        let [eta, k, f0, f82, ..] = p.spectra;
        MicrofacetReflection {
            facets: Facets::new(
                Ndf::new(kind, p.reals[0], p.reals[1], shape),
                masking,
                Sampling::from_choice(p.choices[3]),
            ),
            reflectance: Reflectance::new(ReflectanceKind::from_choice(p.choices[2]), eta, k, f0, f82),
            energy: match p.choices[4] {
                1 if compensable => Energy::Turquin(albedo::ggx()),
                2 if compensable => Energy::KullaConty(albedo::ggx()),
                3 if compensable => Energy::Walk(albedo::ggx()),
                _ => Energy::Single,
            },
        }
    }
}

impl<R: Real> MicrofacetReflection<R> {
    /// The share of the light that single scattering keeps where nothing is absorbed: `E(mu)`.
    #[inline(always)]
    fn kept(&self, table: &AlbedoTable, mu: R) -> R {
        table.albedo(mu.min(R::ONE), self.facets.ndf().mean_width()).clamp(R::of(1e-3), R::ONE)
    }
    /// `1 + F_0 (1 - E(o)) / E(o)`. [Turquin2019, eq. 16]
    #[inline(always)]
    fn turquin(&self, table: &AlbedoTable, o: LocalDir<R>) -> Spectrum<R> {
        let e = self.kept(table, o.cos_theta());
        Spectrum::ONE + self.reflectance.at(R::ONE) * ((R::ONE - e) / e)
    }
    /// The diffuse lobe `F_ms (1 - E(o)) (1 - E(i)) / (pi (1 - E_avg))`, with
    /// `F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg))`. [KullaConty2017]
    #[inline(always)]
    fn kulla_conty(&self, table: &AlbedoTable, o: LocalDir<R>, i: LocalDir<R>) -> Spectrum<R> {
        let lost_o = R::ONE - self.kept(table, o.cos_theta());
        let lost_i = R::ONE - self.kept(table, i.cos_theta());
        let kept = table.mean(self.facets.ndf().mean_width());
        let lost = (R::ONE - kept).max(R::of(1e-6));
        let f_avg = self.reflectance.average();
        let colour = f_avg.map(
            #[inline(always)]
            |f| f.sqr() * kept / (R::ONE - f * lost),
        );
        colour * (lost_o * lost_i * R::of(FRAC_1_PI) / lost)
    }
}

impl<R: Real> Opaque for MicrofacetReflection<R> {
    type R = R;

    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let half = Half::new(o, i);
        let D = self.facets.ndf().d(half.m);
        let G = self.facets.g2_over_4cos(o, i);
        let F = self.reflectance.at(half.cos_d);
        let f = F * (D * G);
        let pdf = self.facets.mirrored_density(o, &half);
        let diffuse = warp::cosine_hemisphere_pdf(i.cos_theta());
        let (table, further, further_pdf) = match self.energy {
            Energy::Single => return (f, pdf),
            Energy::Turquin(table) => return (f * self.turquin(table, o), pdf),
            Energy::KullaConty(table) => (table, self.kulla_conty(table, o, i), diffuse),
            Energy::Walk(table) => {
                let wide = self.facets.for_further().mirrored_density(o, &half);
                let further = mirrors::further(&self.facets.ndf().ggx(), &self.reflectance, o, i);
                (table, further, R::of(0.5) * (diffuse + wide))
            }
        };
        // What is lost in single scattering is the share of the light that meets several facets.
        let lost = R::ONE - self.kept(table, o.cos_theta());
        (f + further, pdf.lerp(further_pdf, lost))
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        let mirrored = o.reflect(self.facets.sample(o, u.dir));
        let (table, diffuse) = match self.energy {
            Energy::Single | Energy::Turquin(_) => return mirrored,
            Energy::KullaConty(table) => (table, R::ONE),
            Energy::Walk(table) => (table, R::of(0.5)),
        };
        let lost = R::ONE - self.kept(table, o.cos_theta());
        let further = match self.energy {
            Energy::Walk(_) => o.reflect(self.facets.for_further().sample(o, u.dir)).v(),
            Energy::Single | Energy::Turquin(_) | Energy::KullaConty(_) => mirrored.v(),
        };
        let further = Vec3::select(u.lobe.lt(lost * diffuse), warp::cosine_hemisphere(u.dir), further);
        LocalDir::new(Vec3::select(u.lobe.lt(lost), further, mirrored.v()))
    }
}
