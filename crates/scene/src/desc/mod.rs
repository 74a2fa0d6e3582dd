//! The scene description: what a scene file says, checked and resolved, before anything is built from it.
//!
//! A [`SceneDesc`] knows no bounding volume hierarchy, no pixels of a texture and no renderer. Statements have
//! been read, names looked up, units converted, transforms multiplied out; meshes are loaded, because
//! a file that is missing or broken is the scene's fault. Textures and environment maps are named by path.

mod curves;
mod instance;
mod light;
mod material;
mod sampling;
mod shape;
mod spectrum;
mod texture;
mod view;

use std::path::PathBuf;

use crate::diagnostic::Diagnostic;

pub(crate) use curves::MAX_POINTS;
pub use curves::{CurveBasis, CurveKind, Curves};
pub use instance::{InstanceDesc, PrototypeDesc};
pub use light::{AreaLightDesc, LightDesc, LightKind, LightSamplerName};
pub use material::{MaterialDesc, RealParam, SpectrumParam};
pub use sampling::{IntegratorDesc, IntegratorName, RandomizeName, RouletteName, SamplerDesc, SamplerName};
pub use shape::{Mesh, ShapeDesc, ShapeKind};
pub use spectrum::{Emission, SpectrumDesc};
pub use texture::{
    FloatTexture, ImageMap, Mapping, SpectrumTexture, TextureEncoding, TextureFilter, WrapMode,
};
pub use view::{CameraDesc, ColourMode, FilmDesc, FilterDesc, Projection};

/// A whole scene.
#[derive(Clone, Debug)]
pub struct SceneDesc {
    /// Where rays start.
    pub camera: CameraDesc,
    /// What they are recorded on.
    pub film: FilmDesc,
    /// How samples are weighted in a pixel's neighbourhood.
    pub filter: FilterDesc,
    /// Where the uniform numbers come from.
    pub sampler: SamplerDesc,
    /// How light is transported.
    pub integrator: IntegratorDesc,
    /// `Option "seed"`, 0 unless given.
    pub seed: u64,
    /// All shapes outside of objects, in file order.
    pub shapes: Vec<ShapeDesc>,
    /// All objects, in file order, also those that are never placed.
    pub prototypes: Vec<PrototypeDesc>,
    /// Where they stand, in file order.
    pub instances: Vec<InstanceDesc>,
    /// All materials; index 0 is pbrt's default, diffuse with reflectance 0.5.
    pub materials: Vec<MaterialDesc>,
    /// All light sources but area lights.
    pub lights: Vec<LightDesc>,
    /// All emission profiles that shapes refer to.
    pub area_lights: Vec<AreaLightDesc>,
    /// Scalar textures, constants included.
    pub float_textures: Vec<FloatTexture>,
    /// Spectral textures, constants included.
    pub spectrum_textures: Vec<SpectrumTexture>,
    /// What was understood but is not supported yet, with its place.
    pub warnings: Vec<Diagnostic>,
    /// Every file that was read, the scene file first.
    pub files: Vec<PathBuf>,
    /// How often each statement occurs, for `sparrow info`.
    pub statements: Vec<(String, usize)>,
}

/// Index into [`SceneDesc::float_textures`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FloatTextureId(pub u32);
/// Index into [`SceneDesc::spectrum_textures`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SpectrumTextureId(pub u32);
/// Index into [`SceneDesc::materials`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId(pub u32);
/// Index into [`SceneDesc::prototypes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PrototypeId(pub u32);
/// Index into [`SceneDesc::area_lights`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AreaLightId(pub u32);
