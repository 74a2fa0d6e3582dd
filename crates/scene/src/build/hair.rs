//! pbrt-v4's `Material "hair"`: absorption given as such, as the colour of a tuft, or as melanin.

use sparrow_models::FibreKind;
use sparrow_models::cylinder::colour::{EUMELANIN, PHEOMELANIN, absorption_of_melanin};
use sparrow_spectra::ColorSpace;

use super::Builder;
use super::materials::Parts;
use super::spectrum::Role;
use crate::desc::{
    FloatTexture, FloatTextureId, RealParam, SpectrumDesc, SpectrumParam, SpectrumTexture, SpectrumTextureId,
};
use crate::params::Params;

/// Places of the model's choice `absorption`.
const BY_SIGMA_A: u8 = 0;
const BY_COLOR: u8 = 1;

impl Builder {
    /// Of several ways to say the colour the first counts, in pbrt-v4's order; the others are warned of.
    pub(super) fn hair(&mut self, p: &Params) -> Parts {
        let mut parts = Parts::of(FibreKind::Hair);
        for (name, default) in [("eta", 1.55), ("beta_m", 0.3), ("beta_n", 0.3), ("alpha", 2.0)] {
            parts = parts.real(name, RealParam::Texture(self.float_param(p, name, default)));
        }
        let sigma_a = self.spectrum_param_given(p, "sigma_a", Role::Unbounded);
        let reflectance = self.spectrum_param_given(p, "reflectance", Role::Albedo);
        let color = self.spectrum_param_given(p, "color", Role::Albedo);
        let melanin = ["eumelanin", "pheomelanin"].map(|n| self.float_param_given(p, n));
        let given = [
            ("sigma_a", sigma_a.is_some()),
            ("reflectance", reflectance.is_some()),
            ("color", color.is_some()),
            ("eumelanin", melanin[0].is_some()),
            ("pheomelanin", melanin[1].is_some()),
        ];
        let first = given.iter().find(|(_, is)| *is).map(|(name, _)| *name);
        for (name, _) in given.iter().filter(|(name, is)| *is && Some(*name) != first) {
            let together = *name == "pheomelanin" && first == Some("eumelanin");
            if let Some(first) = first.filter(|_| !together) {
                let message =
                    format!("\"{name}\" is not used: \"{first}\" says how this hair absorbs; remove one");
                self.report.warn(p.place(name), message);
            }
        }
        let (name, texture, choice) = match (sigma_a, reflectance.or(color)) {
            (Some(sigma_a), _) => ("sigma_a", sigma_a, BY_SIGMA_A),
            (None, Some(color)) => ("color", color, BY_COLOR),
            (None, None) => ("sigma_a", self.melanin(melanin), BY_SIGMA_A),
        };
        let mut parts = parts.spectrum(name, SpectrumParam::Texture(texture));
        parts.choices.push(("absorption", choice));
        // Ours: pbrt-v4 knows the near field alone.
        let field = self.choice(p, "field", &[("near", 0), ("far", 1)], "near");
        parts.choices.push(("field", field.unwrap_or(0)));
        parts
    }

    /// Absorption of the melanins; without any, that of pbrt-v4's brown hair.
    fn melanin(&mut self, [eumelanin, pheomelanin]: [Option<FloatTextureId>; 2]) -> SpectrumTextureId {
        let brown = eumelanin.is_none() && pheomelanin.is_none();
        let eumelanin = eumelanin.unwrap_or_else(|| self.made.constant(if brown { 1.3 } else { 0.0 }));
        let pheomelanin = pheomelanin.unwrap_or_else(|| self.made.constant(0.0));
        if let (Some(e), Some(p)) = (self.made.value(eumelanin), self.made.value(pheomelanin)) {
            let rgb = absorption_of_melanin(f64::from(e.max(0.0)), f64::from(p.max(0.0)));
            return self.absorption(rgb);
        }
        let scaled = |builder: &mut Builder, rgb: [f64; 3], by: FloatTextureId| {
            let twice = builder.absorption(rgb.map(|v| 2.0 * v));
            builder.made.add_spectrum(SpectrumTexture::Scale(twice, by))
        };
        let a = scaled(self, EUMELANIN, eumelanin);
        let b = scaled(self, PHEOMELANIN, pheomelanin);
        let amount = self.made.constant(0.5);
        self.made.add_spectrum(SpectrumTexture::Mix { a, b, amount })
    }

    fn absorption(&mut self, rgb: [f64; 3]) -> SpectrumTextureId {
        let rgb = SpectrumDesc::Rgb(rgb.map(|v| v as f32), ColorSpace::Srgb);
        self.made.add_spectrum(SpectrumTexture::Constant(rgb))
    }
}

impl super::textures::Textures {
    /// The value of a texture that is the same everywhere.
    fn value(&self, id: FloatTextureId) -> Option<f32> {
        match self.floats.get(id.0 as usize) {
            Some(FloatTexture::Constant(v)) => Some(*v),
            _ => None,
        }
    }
}
