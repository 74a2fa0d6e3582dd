//! Numbers, vectors and frames of Sparrow.
//!
//! [`Real`] is the number type a formula is written for: `f32` (one ray at a time), `f64`
//! (verification) and [`Lanes`] (many rays side by side) run the same text.

mod bounds;
pub mod double;
pub mod elementary;
mod frame;
mod lanes;
mod mask;
mod motion;
mod real;
mod simd;
mod transform;
mod vec3;
pub mod warp;

pub use bounds::Aabb;
pub use frame::{Frame, LocalDir};
pub use lanes::{LaneMask, Lanes};
pub use mask::Mask;
pub use motion::Motion;
pub use real::{MAX_WIDTH, Real};
pub use simd::{InLanes, in_lanes, only_in_lanes, widest};
pub use transform::Transform;
pub use vec3::{Vec3, vec3};

/// Largest `f32` below one: uniform numbers lie in [0, `ONE_MINUS_EPSILON`].
pub const ONE_MINUS_EPSILON: f32 = 1.0 - f32::EPSILON / 2.0;
