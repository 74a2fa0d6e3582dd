//! The scene description: what a scene file says, checked and resolved, before anything is built from it.
//!
//! A [`SceneDesc`] knows no bounding volume hierarchy, no pixels of a texture and no renderer. Statements have
//! been read, names looked up, units converted, transforms multiplied out; meshes are loaded, because
//! a file that is missing or broken is the scene's fault. Textures and environment maps are named by path.

use std::path::PathBuf;
use std::sync::Arc;

use sparrow_math::{Transform, Vec3};
use sparrow_models::SurfaceKind;
use sparrow_spectra::ColorSpace;

use crate::diagnostic::{Diagnostic, Span};

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
    /// All shapes, instances flattened, in file order.
    pub shapes: Vec<ShapeDesc>,
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
/// Index into [`SceneDesc::area_lights`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AreaLightId(pub u32);

/// A spectrum as the file gives it. What RGB means is decided by where it is used.
#[derive(Clone, Debug, PartialEq)]
pub enum SpectrumDesc {
    /// The same value at every wavelength.
    Constant(f32),
    /// Linear RGB in a colour space.
    Rgb([f32; 3], ColorSpace),
    /// Planck's law at a temperature in kelvin, its maximum scaled to one.
    Blackbody(f32),
    /// A spectrum known by name, such as `metal-Cu-eta`; the name has been checked.
    Named(String),
    /// Wavelength in nm and value, ascending; linear between, zero outside.
    Samples(Arc<[(f32, f32)]>),
}

/// How a light's colour is given.
///
/// Scales in pbrt's light statements act on light spectra that are divided by their photometric integral,
/// so that an RGB of (1, 1, 1) is as bright as any illuminant.
#[derive(Clone, Debug, PartialEq)]
pub struct Emission {
    /// Colour; for [`SpectrumDesc::Rgb`] an illuminant of the colour space is meant.
    pub spectrum: SpectrumDesc,
    /// The statement's `scale`, 1 unless given.
    pub scale: f32,
}

/// Triangle and patch vertices, in object space.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Positions.
    pub p: Vec<[f32; 3]>,
    /// Normals, one per position, or none.
    pub n: Vec<[f32; 3]>,
    /// Tangents, one per position, or none.
    pub s: Vec<[f32; 3]>,
    /// Texture coordinates, one per position, or none.
    pub uv: Vec<[f32; 2]>,
    /// Corners of triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Corners of bilinear patches, in the order p00, p10, p01, p11.
    pub patches: Vec<[u32; 4]>,
}

/// The form of a shape in its own space; angles in degrees as in the file.
#[derive(Clone, Debug)]
pub enum ShapeKind {
    /// Triangles and bilinear patches.
    Mesh(Arc<Mesh>),
    /// A sphere or part of one, about the z axis.
    Sphere {
        /// Radius.
        radius: f32,
        /// Cut below this height.
        z_min: f32,
        /// Cut above this height.
        z_max: f32,
        /// Sweep, in degrees.
        phi_max: f32,
    },
    /// A disk or ring at right angles to z.
    Disk {
        /// Place along z.
        height: f32,
        /// Outer radius.
        radius: f32,
        /// Inner radius.
        inner_radius: f32,
        /// Sweep, in degrees.
        phi_max: f32,
    },
    /// An open cylinder about z.
    Cylinder {
        /// Radius.
        radius: f32,
        /// Lower end.
        z_min: f32,
        /// Upper end.
        z_max: f32,
        /// Sweep, in degrees.
        phi_max: f32,
    },
}

/// A shape in the scene.
#[derive(Clone, Debug)]
pub struct ShapeDesc {
    /// Its form.
    pub kind: ShapeKind,
    /// Object to world.
    pub to_world: Transform,
    /// `ReverseOrientation` was in force.
    pub reverse_orientation: bool,
    /// What it is made of.
    pub material: MaterialId,
    /// What it emits.
    pub area_light: Option<AreaLightId>,
    /// Cut-out: the surface is there with this probability.
    pub alpha: Option<FloatTextureId>,
    /// Where the statement stands.
    pub at: Span,
}

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
    /// The reflection model; none for `interface`, which rays pass unchanged.
    pub model: Option<SurfaceKind>,
    /// One entry per `Real` parameter of the model's table, in its order.
    pub reals: Vec<RealParam>,
    /// One entry per spectral parameter of the model's table, in its order.
    pub spectra: Vec<SpectrumParam>,
    /// One entry per `Choice` parameter of the model's table, in its order: the place among the names.
    pub choices: Vec<u8>,
    /// Where the statement stands.
    pub at: Span,
}

/// How texture coordinates are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mapping {
    /// `(scale_u u + delta_u, scale_v v + delta_v)`
    Uv {
        /// Factors of u and v.
        scale: [f32; 2],
        /// Offsets of u and v.
        delta: [f32; 2],
    },
    /// Direction from the origin of texture space, as polar angle and azimuth.
    Spherical(Transform),
    /// Azimuth and height in texture space.
    Cylindrical(Transform),
    /// Two planes in texture space.
    Planar {
        /// World to texture space.
        to_texture: Transform,
        /// Vector whose scalar product with the point gives u.
        vs: [f32; 3],
        /// Vector whose scalar product with the point gives v.
        vt: [f32; 3],
        /// Offsets.
        delta: [f32; 2],
    },
}

/// What lies beyond the edges of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WrapMode {
    /// The image again.
    Repeat,
    /// Black.
    Black,
    /// The pixel at the edge.
    Clamp,
    /// Equal-area octahedral continuation.
    Octahedral,
}

/// How an image is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureFilter {
    /// Nearest pixel.
    Point,
    /// Four neighbours of the finest level.
    Bilinear,
    /// Eight neighbours of two levels of the pyramid.
    Trilinear,
    /// Elliptically weighted average.
    Ewa,
}

/// How 8-bit values become linear ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TextureEncoding {
    /// By the file: sRGB for 8 bits, linear for floating point.
    Default,
    /// Already linear.
    Linear,
    /// The sRGB curve.
    Srgb,
    /// A power.
    Gamma(f32),
}

/// An image as a texture.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageMap {
    /// The file, resolved against the scene file's folder; it was there when the scene was read.
    pub path: PathBuf,
    /// Lookup.
    pub filter: TextureFilter,
    /// Edges.
    pub wrap: WrapMode,
    /// Largest anisotropy of [`TextureFilter::Ewa`].
    pub max_anisotropy: f32,
    /// 8-bit encoding.
    pub encoding: TextureEncoding,
    /// Factor on the value.
    pub scale: f32,
    /// `1 - value` instead of the value.
    pub invert: bool,
    /// Texture coordinates.
    pub mapping: Mapping,
    /// Where the statement stands.
    pub at: Span,
}

/// A scalar texture.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "a scene holds few textures; mappings carry a transform")]
pub enum FloatTexture {
    /// The same everywhere.
    Constant(f32),
    /// A product.
    Scale(FloatTextureId, FloatTextureId),
    /// `(1 - amount) a + amount b`
    Mix {
        /// Value at amount 0.
        a: FloatTextureId,
        /// Value at amount 1.
        b: FloatTextureId,
        /// Share of `b`.
        amount: FloatTextureId,
    },
    /// One channel (or the mean of RGB) of an image.
    Image(ImageMap),
    /// Two alternating textures, in the plane or in space.
    Checkerboard {
        /// 2 or 3.
        dimension: u32,
        /// Coordinates, for dimension 2.
        mapping: Mapping,
        /// World to texture space, for dimension 3.
        to_texture: Transform,
        /// First and second texture.
        tex: [FloatTextureId; 2],
    },
}

/// A spectral texture.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "a scene holds few textures; mappings carry a transform")]
pub enum SpectrumTexture {
    /// The same everywhere.
    Constant(SpectrumDesc),
    /// A product with a scalar texture.
    Scale(SpectrumTextureId, FloatTextureId),
    /// `(1 - amount) a + amount b`
    Mix {
        /// Value at amount 0.
        a: SpectrumTextureId,
        /// Value at amount 1.
        b: SpectrumTextureId,
        /// Share of `b`.
        amount: FloatTextureId,
    },
    /// An image; its RGB values are in this colour space unless the file says otherwise.
    Image(ImageMap, ColorSpace),
    /// Two alternating textures, in the plane or in space.
    Checkerboard {
        /// 2 or 3.
        dimension: u32,
        /// Coordinates, for dimension 2.
        mapping: Mapping,
        /// World to texture space, for dimension 3.
        to_texture: Transform,
        /// First and second texture.
        tex: [SpectrumTextureId; 2],
    },
}

/// A light that is no shape.
#[derive(Clone, Debug)]
pub struct LightDesc {
    /// What kind.
    pub kind: LightKind,
    /// Light to world.
    pub to_world: Transform,
    /// Where the statement stands.
    pub at: Span,
}

/// The kinds of light that are no shape.
#[derive(Clone, Debug)]
pub enum LightKind {
    /// From a point, the same in all directions.
    Point {
        /// Intensity.
        intensity: Emission,
        /// Radiant power instead of intensity.
        power: Option<f32>,
        /// Place, in light space.
        from: Vec3<f64>,
    },
    /// A cone of light.
    Spot {
        /// Intensity on the axis.
        intensity: Emission,
        /// Radiant power instead of intensity.
        power: Option<f32>,
        /// Place, in light space.
        from: Vec3<f64>,
        /// The axis passes through this point.
        to: Vec3<f64>,
        /// Half angle of the cone, in degrees.
        cone_angle: f32,
        /// Width of the smooth edge inside it, in degrees.
        cone_delta: f32,
    },
    /// Parallel light.
    Distant {
        /// Radiance.
        radiance: Emission,
        /// Illuminance on a surface that faces it, instead of radiance.
        illuminance: Option<f32>,
        /// The light goes from here
        from: Vec3<f64>,
        /// to here.
        to: Vec3<f64>,
    },
    /// From all around, one radiance.
    Infinite {
        /// Radiance.
        radiance: Emission,
        /// Illuminance on a surface, instead of radiance.
        illuminance: Option<f32>,
    },
    /// From all around, by an image: square equal-area octahedral (pbrt-v4) or, twice as wide as high, latitude-longitude.
    InfiniteImage {
        /// The file; it was there when the scene was read.
        path: PathBuf,
        /// Factor on the image's radiance.
        scale: f32,
        /// Illuminance on a surface, instead of the image's own.
        illuminance: Option<f32>,
        /// Colour space of the image where its file names none.
        color_space: ColorSpace,
    },
}

/// Diffuse emission of a shape's surface.
#[derive(Clone, Debug)]
pub struct AreaLightDesc {
    /// Radiance.
    pub radiance: Emission,
    /// Radiant power of each shape instead of radiance.
    pub power: Option<f32>,
    /// Emits on both sides.
    pub two_sided: bool,
    /// Where the statement stands.
    pub at: Span,
}

/// Projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Central; the field of view, in degrees, spans the shorter side of the picture.
    Perspective {
        /// Field of view, in degrees.
        fov: f32,
    },
    /// Parallel.
    Orthographic,
}

/// A camera.
#[derive(Clone, Debug)]
pub struct CameraDesc {
    /// Projection.
    pub projection: Projection,
    /// Camera space to world: camera x right, y up, z ahead, left-handed as in pbrt-v4.
    pub to_world: Transform,
    /// `x0 x1 y0 y1` on the image plane; from the picture's aspect unless given.
    pub screen_window: Option<[f32; 4]>,
    /// Width over height; from the resolution unless given.
    pub frame_aspect: Option<f32>,
    /// Radius of the lens; 0 for a pinhole.
    pub lens_radius: f32,
    /// Distance of the plane in focus.
    pub focal_distance: f32,
    /// Shutter opens and closes, in scene time.
    pub shutter: [f32; 2],
}

/// A film.
#[derive(Clone, Debug)]
pub struct FilmDesc {
    /// Width and height of the whole picture, in pixels.
    pub resolution: [u32; 2],
    /// The part that is rendered, `x0 x1 y0 y1` in pixels, ends excluded; from `pixelbounds` or `cropwindow`.
    pub pixel_bounds: [u32; 4],
    /// Output file named in the scene.
    pub filename: Option<PathBuf>,
    /// Half floats in the output.
    pub save_fp16: bool,
    /// Sensor name; `cie1931` unless given.
    pub sensor: String,
    /// Sensitivity.
    pub iso: f32,
    /// Exposure time, in seconds.
    pub exposure_time: f32,
    /// Colour temperature of the white point, in kelvin; none for no white balance.
    pub white_balance: Option<f32>,
    /// Samples are scaled down so that no component exceeds this.
    pub max_component_value: f32,
    /// Diagonal of the sensor, in millimetres.
    pub diagonal: f32,
    /// Colour space of the output.
    pub color_space: ColorSpace,
}

/// A pixel filter, with its radius in pixels along x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FilterDesc {
    /// Constant.
    Box {
        /// Half widths.
        radius: [f32; 2],
    },
    /// Falls linearly to the edge.
    Triangle {
        /// Half widths.
        radius: [f32; 2],
    },
    /// A Gaussian, lowered to zero at the edge.
    Gaussian {
        /// Half widths.
        radius: [f32; 2],
        /// Standard deviation, in pixels.
        sigma: f32,
    },
    /// Mitchell and Netravali's cubic.
    Mitchell {
        /// Half widths.
        radius: [f32; 2],
        /// Blur.
        b: f32,
        /// Ringing.
        c: f32,
    },
    /// Sinc, windowed by the central lobe of a wider sinc.
    Sinc {
        /// Half widths.
        radius: [f32; 2],
        /// Cycles before the window ends.
        tau: f32,
    },
}

/// Names of samplers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SamplerName {
    /// Uncorrelated numbers.
    Independent,
    /// One sample per cell of a grid.
    Stratified,
    /// Halton sequence.
    Halton,
    /// Sobol sequence over the whole picture.
    Sobol,
    /// Two-dimensional Sobol points, shuffled per dimension.
    PaddedSobol,
    /// Sobol points along a Morton curve: blue-noise error on the screen.
    ZSobol,
    /// Progressive multi-jittered points.
    Pmj02bn,
}

/// How a sequence is randomised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RandomizeName {
    /// Not at all.
    None,
    /// Digits are permuted.
    PermuteDigits,
    /// Hashed Owen scrambling.
    FastOwen,
    /// Owen scrambling.
    Owen,
}

/// A sampler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SamplerDesc {
    /// Which.
    pub name: SamplerName,
    /// Samples per pixel.
    pub samples_per_pixel: u32,
    /// Cells of [`SamplerName::Stratified`] along x and y.
    pub strata: [u32; 2],
    /// Jittered within cells.
    pub jitter: bool,
    /// Randomisation.
    pub randomize: RandomizeName,
    /// The sampler's own seed; overrides the scene's.
    pub seed: Option<u64>,
}

/// How lights are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightSamplerName {
    /// All alike.
    Uniform,
    /// In proportion to power.
    Power,
    /// By a hierarchy over the lights.
    Bvh,
}

/// An integrator.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegratorDesc {
    /// `path` or `directlighting`, after aliases are resolved.
    pub name: IntegratorName,
    /// Most scattering events of a path.
    pub max_depth: u32,
    /// Light sampler.
    pub light_sampler: LightSamplerName,
    /// Widens narrow lobes after the first rough one.
    pub regularize: bool,
    /// MIS heuristic, as written: `balance`, `power`.
    pub mis: String,
    /// Next-event estimation is used.
    pub sample_lights: bool,
    /// Directions drawn from the BSDF find lights.
    pub sample_bsdf: bool,
    /// MIS compensation of environment lights.
    pub mis_compensation: bool,
}

/// Names of integrators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntegratorName {
    /// The path tracer.
    Path,
    /// Paths with one bounce of light, and specular chains.
    DirectLighting,
}
