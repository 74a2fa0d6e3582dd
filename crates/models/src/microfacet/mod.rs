//! Terms of microfacet models, each a choice of its own: the distribution of normals, masking, the Fresnel
//! reflectance, the way normals are drawn, and what is done about light that meets several facets.
//!
//! Smith's masking is used through `|cos theta| Lambda`, which stays finite at grazing angles.

pub mod albedo;
mod beckmann;
pub mod boundary_albedo;
pub mod charlie;
mod facets;
pub mod groove;
mod ndf;
mod reflectance;
mod smith;
pub mod special;
pub(crate) mod walk;

pub use beckmann::visible_slope;
pub use facets::{Facets, Masking, Sampling};
pub use ndf::{Ndf, NdfKind};
pub use reflectance::{Reflectance, ReflectanceKind};
pub use walk::{WalkEnd, walk};
