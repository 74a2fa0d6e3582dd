//! Reflection models of Sparrow: value, density and sampling, generic over the number type.
//!
//! No files, threads, textures or allocation. One text of a model runs as `f32`, `f64` and
//! [`Lanes`](sparrow_math::Lanes).
//!
//! # Conventions
//!
//! | thing | our choice |
//! | --- | --- |
//! | `wo` | unit, away from the point, towards the viewer; known before sampling |
//! | `wi` | unit, away from the point, towards the light; what `sample` returns |
//! | local frame | right-handed; z = shading normal, x = tangent (grain) |
//! | `theta`, `phi` | from z, and around z from x |
//! | `f` | 1/sr, without cosine, without delta lobes |
//! | `pdf` | 1/sr, over the solid angle of `wi`, matching `sample` exactly |
//! | `eta` | relative, transmitted side over incident side; as a parameter, below over above |
//! | `alpha_x`, `alpha_y` | slope widths, after any roughness remapping |
//!
//! Fibres have a frame and a cosine of their own: see [`Bcsdf`].
//!
//! # Use
//!
//! ```
//! use sparrow_math::LocalDir;
//! use sparrow_models::{Bsdf, ParamBlock, SurfaceKind, Uniforms};
//!
//! let kind = SurfaceKind::from_name("conductor").ok_or("no such model")?;
//! let mut params = ParamBlock::<f64>::defaults(kind.params());
//! params.reals[..2].copy_from_slice(&[0.3, 0.1]);
//! let metal = kind.bind(&params);
//!
//! let wo = LocalDir::from_angles(0.6, 0.2);
//! let s = metal.sample(wo, Uniforms { lobe: 0.5, dir: [0.3, 0.7] });
//! assert!((s.density - metal.pdf(wo, s.wi)).abs() < 1e-9 * s.density);
//! # Ok::<(), &str>(())
//! ```

pub mod batch;
mod bcsdf;
mod bsdf;
mod coat;
mod complex;
mod cosine_lobe;
pub mod cylinder;
mod fibre;
mod film;
pub mod fresnel;
#[cfg(test)]
mod generator;
pub mod ggx;
mod kind;
pub mod microfacet;
mod mirror_facets;
mod opaque;
mod params;
mod per_lane;
mod registry;
mod sheen_layer;
pub mod suggest;
mod summed;
mod surface;
mod table;
mod v_cavity;

pub use bcsdf::{Bcsdf, N_LOBES, fibre_cosine};
pub use bsdf::{Bsdf, BsdfSample, Uniforms};
pub use fibre::{Fibre, FibreKind};
pub use kind::ModelKind;
pub use params::{DEFAULT_NM, MAX_CHOICES, MAX_REALS, MAX_SPECTRA, ParamBlock, ParamInfo, ParamKind};
pub use registry::{About, Kind, Lack, Model, Property};
pub use surface::{Surface, SurfaceKind};
