//! Models that are wrong on purpose: metal that reflects everything, with one classic mistake each.

use std::f64::consts::FRAC_1_PI;

use sparrow_math::{LocalDir, Mask, Real, Vec3, warp};
use sparrow_models::ggx::Ggx;
use sparrow_models::{About, Bsdf, BsdfSample, ParamBlock, ParamInfo, Uniforms};
use sparrow_spectra::Spectrum;
use sparrow_verify::{Column, Question, Scalar, Subject, narrow};

macro_rules! faults {
    ($($Fault:ident, $name:literal, $question:ident;)*) => {
        /// The mistake.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Fault { $($Fault),* }

        /// Every mistake, with the question that has to find it.
        pub(crate) const FAULTS: &[(Fault, Question)] = &[$((Fault::$Fault, Question::$question)),*];

        impl Fault {
            fn name(self) -> &'static str {
                match self { $(Fault::$Fault => $name),* }
            }
        }
    };
}

faults! {
    PdfBelowHorizon, "pdf_below_horizon", Density;
    PdfOfNormals, "pdf_of_normals", Density;
    WrongJacobian, "wrong_jacobian", Samples;
    SwappedWidths, "swapped_widths", Samples;
    MixtureTwiceOne, "mixture_twice_one", Density;
    DensityOfChosenLobe, "density_of_chosen_lobe", Pdf;
    WeightTooLarge, "weight_too_large", Weight;
    CosineTwice, "cosine_twice", Weight;
    HalfOfTheSphere, "half_of_the_sphere", Mean;
    OneSidedMasking, "one_sided_masking", Reciprocity;
    LeansToTheViewer, "leans_to_the_viewer", Reciprocity;
    IndexForgotten, "index_forgotten", Reciprocity;
    EnergyGain, "energy_gain", Furnace;
    NanAtGrazing, "nan_at_grazing", Finite;
    Negative, "negative", Finite;
    SinglePrecision, "single_precision", Agreement;
    SmallDrift, "small_drift", Samples;
}

/// What is tried: a fault, or none.
#[derive(Debug)]
pub(crate) struct Planted(pub(crate) Option<Fault>);

const PARAMS: &[ParamInfo] = &[
    ParamInfo::real("alpha_x").default(0.3).range(1e-3, 1.0).doc("Slope width along the grain."),
    ParamInfo::real("alpha_y").default(0.1).range(1e-3, 1.0).doc("Slope width across the grain."),
];

impl Subject for Planted {
    fn name(&self) -> &'static str {
        self.0.map_or("sound", Fault::name)
    }
    fn params(&self) -> &'static [ParamInfo] {
        PARAMS
    }
    fn about(&self) -> About {
        About::new("planted", "Walter2007").anisotropic()
    }
    fn columns(&self, p: &ParamBlock<f64>) -> Vec<Box<dyn Column>> {
        vec![
            Box::new(Scalar::double(Metal::new(self.0, p))),
            Box::new(Scalar::single(Metal::new(self.0, &narrow(p)))),
        ]
    }
}

#[derive(Clone, Copy, Debug)]
struct Metal<R> {
    fault: Option<Fault>,
    ggx: Ggx<R>,
    swapped: Ggx<R>,
}

impl<R: Real<Mask = bool>> Metal<R> {
    fn new(fault: Option<Fault>, p: &ParamBlock<R>) -> Self {
        let [x, y] = [p.reals[0], p.reals[1]];
        Metal { fault, ggx: Ggx::new(x, y), swapped: Ggx::new(y, x) }
    }
    fn has(&self, fault: Fault) -> bool {
        self.fault == Some(fault)
    }
    /// Half of the samples come from Lambert's law.
    fn is_mixture(&self) -> bool {
        self.has(Fault::MixtureTwiceOne) || self.has(Fault::DensityOfChosenLobe)
    }
    /// Lambert's law alone.
    fn is_diffuse(&self) -> bool {
        self.has(Fault::IndexForgotten) || self.has(Fault::HalfOfTheSphere)
    }
    fn gain(&self, wo: LocalDir<R>) -> R {
        match self.fault {
            Some(Fault::EnergyGain) => R::of(1.3),
            Some(Fault::LeansToTheViewer) => R::of(0.5) + R::of(0.5) * wo.abs_cos_theta(),
            Some(Fault::NanAtGrazing) => (wo.abs_cos_theta() - R::of(2e-4)).sqrt(),
            // Only a number of few digits cannot hold the difference.
            Some(Fault::SinglePrecision) => {
                R::select((R::of(1.0 + 1e-9) - R::ONE).gt(R::ZERO), R::ONE, R::of(0.99))
            }
            _ => R::ONE,
        }
    }
    fn lobe_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        let m = wo.half(wi);
        let visible = self.ggx.visible_over_cos(wo, m);
        match self.fault {
            Some(Fault::PdfOfNormals) => visible * wo.dot(m).abs(),
            Some(Fault::WrongJacobian) => {
                visible * R::of(0.25) * wo.dot(m).abs() / wi.abs_cos_theta().max(R::of(1e-3))
            }
            // Five in a hundred too narrow: no eye would see it.
            Some(Fault::SmallDrift) => {
                let d = self.ggx.d(m) * R::of(core::f64::consts::PI * 1e-3);
                visible * R::of(0.25) * (R::of(0.97) + R::of(0.06) * d / (d + R::ONE))
            }
            _ => visible * R::of(0.25),
        }
    }
    /// Density where both directions lie above.
    fn upper_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        let diffuse = warp::cosine_hemisphere_pdf(wi.abs_cos_theta());
        if self.is_diffuse() {
            let twice = self.has(Fault::HalfOfTheSphere);
            return if twice { (diffuse + diffuse).only_where(wi.x().ge(R::ZERO)) } else { diffuse };
        }
        let lobe = self.lobe_pdf(wo, wi);
        if !self.is_mixture() {
            return lobe;
        }
        let share = if self.has(Fault::MixtureTwiceOne) { 1.0 } else { 0.5 };
        (lobe + diffuse) * R::of(share)
    }
    fn reflected(&self, wo: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        if self.is_diffuse() || self.is_mixture() && u.lobe.lt(R::of(0.5)) {
            let w = warp::cosine_hemisphere(u.dir);
            let x = if self.has(Fault::HalfOfTheSphere) { w.x.abs() } else { w.x };
            return LocalDir::new(Vec3 { x, ..w });
        }
        let ggx = if self.has(Fault::SwappedWidths) { &self.swapped } else { &self.ggx };
        wo.reflect(ggx.sample_visible(wo, u.dir))
    }
}

fn raised<R: Real<Mask = bool>>(by: LocalDir<R>, w: LocalDir<R>) -> LocalDir<R> {
    LocalDir::new(Vec3 { z: R::select(by.above(), w.z(), -w.z()), ..w.v() })
}

impl<R: Real<Mask = bool>> Bsdf<R> for Metal<R> {
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        (self.f(wo, wi) * wi.abs_cos_theta(), self.pdf(wo, wi))
    }

    fn f(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> Spectrum<R> {
        if self.has(Fault::IndexForgotten) {
            return Spectrum::splat(R::of(0.4 * FRAC_1_PI));
        }
        let (o, i) = (raised(wo, wo), raised(wo, wi));
        let m = o.half(i);
        let mut f = self.ggx.d(m) * self.ggx.g2_over_4cos(o, i);
        if self.has(Fault::HalfOfTheSphere) {
            f = R::of(FRAC_1_PI);
        }
        if self.has(Fault::OneSidedMasking) {
            // G1(wo) alone, over 4 cos cos.
            f = self.ggx.visible_over_cos(o, m) * R::of(0.25) / i.abs_cos_theta().max(R::of(1e-6));
        }
        if self.has(Fault::Negative) {
            f = f - R::of(1e-3);
        }
        if self.has(Fault::CosineTwice) {
            f = f * wi.abs_cos_theta();
        }
        Spectrum::splat(f * self.gain(o)).only_where(o.above() & i.above())
    }

    fn pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        let (o, i) = (raised(wo, wo), raised(wo, wi));
        if self.has(Fault::IndexForgotten) {
            return R::of(0.5) * warp::cosine_hemisphere_pdf(wi.abs_cos_theta());
        }
        let lit = if self.has(Fault::PdfBelowHorizon) {
            o.v().dot(i.v()).abs().lt(R::of(0.999))
        } else {
            i.above()
        };
        self.upper_pdf(o, i).only_where(o.above() & lit)
    }

    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let o = raised(wo, wo);
        let mut i = self.reflected(o, u);
        let mut eta = R::ONE;
        if self.has(Fault::IndexForgotten) && u.lobe.lt(R::of(0.5)) {
            i = LocalDir::new(Vec3 { z: -i.z(), ..i.v() });
            eta = if wo.above() { R::of(1.5) } else { R::of(1.0 / 1.5) };
        }
        let wi = raised(wo, i);
        let mut density = self.pdf(wo, wi);
        let valid = o.above() & (i.above() | self.has(Fault::IndexForgotten)) & density.gt(R::ZERO);
        let mut weight = self.f_cos(wo, wi) / density.max(R::of(1e-30));
        if self.has(Fault::CosineTwice) {
            weight = weight / wi.abs_cos_theta().max(R::of(1e-9));
        }
        if self.has(Fault::WeightTooLarge) {
            weight *= R::of(1.02);
        }
        if self.has(Fault::DensityOfChosenLobe) {
            let lobe = self.lobe_pdf(o, i);
            density = if u.lobe.lt(R::of(0.5)) { density - lobe * R::of(0.5) } else { lobe * R::of(0.5) };
        }
        let weight = weight.only_where(valid);
        BsdfSample { wi, weight, density: density.only_where(valid), eta, delta: bool::of(false), valid }
    }
}
