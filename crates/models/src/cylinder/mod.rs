//! Optics of a dielectric cylinder, which the fibre models share.
//!
//! Lengths are in radii. A ray at the offset `h` from the axis meets the cylinder at the angle `gamma_o = asin h`, goes on inside at
//! `gamma_t`, and leaves by lobe `p` after `p` passages through the inside: R (0), TT (1), TRT (2).

pub mod attenuation;
pub mod azimuthal;
mod choice;
pub mod colour;
pub mod elliptic;
pub mod far_field;
pub mod gaussian;
mod inclination;
pub mod longitudinal;
pub mod medulla;
pub mod roots;
pub mod roughness;
pub mod scale;
pub mod section;

pub use choice::LobeChoice;
pub use inclination::FibreDir;
