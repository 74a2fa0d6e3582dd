//! Shapes of Sparrow, what a ray meets of them, and how to aim at them.
//!
//! [`Geometry::build`] takes shapes and puts a bounding volume hierarchy over their primitives;
//! everything else is a question asked of the result. The crate knows no materials, lights or files.
//! Everything is in world space; parametrisations, tangents and the side of normals mean what they
//! mean in pbrt-v4.

mod bvh;
mod columns;
mod curve;
mod deforming;
mod geometry;
mod instance;
mod lerp;
mod patch;
mod point;
mod progress;
mod quadric;
mod ray;
mod sample;
mod shape;
mod simd;
mod triangle;

pub use columns::{SurfaceColumns, SurfaceParts};
pub use geometry::{BuildBytes, BuildStats, Geometry, GeometryParts};
pub use instance::{Instance, MovingInstance};
pub use point::{RoundedPoint, SHADOW_END, ShapeSample, SurfacePoint};
pub use progress::{BuildObserver, BuildProgress};
pub use ray::{Hit, Ray};
pub use sample::{Balls, PdfColumns, SampleColumns, Viewpoint};
pub use shape::{BilinearMesh, CurveBasis, CurveKind, CurveSet, Shape, ShapeInstance, TriangleMesh};
