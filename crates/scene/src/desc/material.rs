//! Materials and their parameters.

use sparrow_models::ModelKind;

use super::{FloatTextureId, SpectrumDesc, SpectrumTextureId};
use crate::diagnostic::Span;

/// Where a material's number comes from.
#[derive(Clone, Debug)]
pub enum RealParam {
    /// A texture's value.
    Texture(FloatTextureId),
    /// The square root of a texture's value: pbrt's roughness, remapped to the slope width alpha.
    RoughnessToAlpha(FloatTextureId),
    /// A spectrum at the path's hero wavelength; the companions end where the light is bent (dispersion).
    Dispersive(SpectrumDesc),
}

/// Where a material's spectrum comes from.
#[derive(Clone, Debug)]
pub enum SpectrumParam {
    /// A texture's value.
    Texture(SpectrumTextureId),
    /// The absorption `k` that gives a conductor with eta = 1 this reflectance at normal incidence:
    /// `2 sqrt(r) / sqrt(1 - r)`.
    ReflectanceToK(SpectrumTextureId),
}

/// A material: a reflection model and where its parameters come from.
#[derive(Clone, Debug)]
pub struct MaterialDesc {
    /// Name, for named materials.
    pub name: Option<String>,
    /// The statement's own word, such as `conductor`.
    pub type_name: String,
    /// The model of a surface or a fibre; none for `interface`, which rays pass unchanged.
    pub model: Option<ModelKind>,
    /// One entry per `Real` parameter of the model's table, in its order.
    pub reals: Vec<RealParam>,
    /// One entry per spectral parameter of the model's table, in its order.
    pub spectra: Vec<SpectrumParam>,
    /// One entry per `Choice` parameter of the model's table, in its order: the place among the names.
    pub choices: Vec<u8>,
    /// Where the statement stands.
    pub at: Span,
}
