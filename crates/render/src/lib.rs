//! The renderer of Sparrow: a scene description in, a film out.
//!
//! ```text
//! SceneDesc ──compile──▶ Scene ──render──▶ Film
//! ```
//!
//! [`compile()`] turns a description into an immutable [`Scene`]; [`RenderPlan`] holds how the picture is taken; [`render()`]
//! distributes tiles over threads,
//! [`render_to_noise()`] with samples where the noise is. The light transport itself is one page: [`PathIntegrator::radiance`].

pub mod adaptive;
pub mod camera;
mod colour;
pub mod compile;
pub mod distribution;
pub mod film;
pub mod filter;
mod integrator;
pub mod light;
mod material;
mod observe;
mod plan;
mod render;
mod roulette;
mod run;
pub mod sampler;
mod samples;
mod scatter;
mod scene;
mod spectrum;
mod splitting;
mod texture;

pub use adaptive::render_to_noise;
pub use compile::{CompileError, Compiled, compile, compile_observed};
pub use integrator::{Finder, PathIntegrator, RayCounts, Record};
pub use observe::{Strategies, Technique};
pub use plan::{FilmSensor, RenderPlan};
pub use render::{Progress, RenderError, RenderOptions, RenderStats, render, render_strategies};
pub use roulette::Roulette;
pub use scatter::{Density, Scatter, ScatterSample};
pub use scene::{LastVertex, Scene};
