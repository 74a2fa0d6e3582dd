//! Integrators: radiance along camera rays, one path at a time or many side by side.

mod block;
mod path;
mod record;
mod start;

pub(crate) use block::{Block, Column, pad};
pub use path::PathIntegrator;
pub use record::{Finder, Record};
pub(crate) use start::{CameraNumbers, CameraSample, Exposed};

/// Rays traced, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// From the camera.
    pub camera: u64,
    /// Further ones that look for the nearest surface, or, as the last of their path, for light alone.
    pub scattered: u64,
    /// That ask whether a light is seen.
    pub shadow: u64,
}

impl RayCounts {
    /// All rays.
    pub fn total(&self) -> u64 {
        self.camera + self.scattered + self.shadow
    }
}

impl core::ops::AddAssign for RayCounts {
    fn add_assign(&mut self, o: Self) {
        self.camera += o.camera;
        self.scattered += o.scattered;
        self.shadow += o.shadow;
    }
}
