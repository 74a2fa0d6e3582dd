//! Textures: images, their mapping and look-up, and how textures are combined.

use std::path::PathBuf;

use sparrow_math::Transform;
use sparrow_spectra::ColorSpace;

use super::{FloatTextureId, SpectrumDesc, SpectrumTextureId};
use crate::diagnostic::Span;

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
