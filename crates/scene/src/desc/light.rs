//! Lights, and how one of many is chosen.

use std::path::PathBuf;

use sparrow_math::Transform;
use sparrow_math::Vec3;
use sparrow_spectra::ColorSpace;

use super::Emission;
use crate::diagnostic::Span;

/// A light that is no shape.
#[derive(Clone, Debug)]
pub struct LightDesc {
    /// What kind.
    pub kind: LightKind,
    /// Light to world.
    pub to_world: Transform,
    /// Corners of the rectangle, in world space, through which an infinite light comes in; it serves sampling alone.
    pub portal: Option<[Vec3<f64>; 4]>,
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
