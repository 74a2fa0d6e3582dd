//! What a render did, for machines and for people: [`Stats`], [`Outcome`], and how numbers are written.

use serde::Serialize;
use sparrow_geometry::BuildStats;
use sparrow_render::RayCounts;
use sparrow_scene::SceneDesc;

use crate::adaptive::NoiseReport;
use crate::args::RenderArgs;
use crate::failure::Remark;
use crate::names;
use crate::process::Usage;

/// How a render ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Status {
    /// All samples were taken.
    Done,
    /// The time limit came first.
    TimeLimit,
    /// Ctrl-C came first.
    Interrupted,
}

/// Rays by kind.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Rays {
    camera: u64,
    scattered: u64,
    shadow: u64,
    total: u64,
}

impl From<RayCounts> for Rays {
    fn from(r: RayCounts) -> Rays {
        Rays { camera: r.camera, scattered: r.scattered, shadow: r.shadow, total: r.total() }
    }
}

/// The acceleration structure.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Accelerator {
    build_seconds: f64,
    bytes: usize,
    nodes: usize,
    primitives: usize,
    dropped_primitives: usize,
}

impl From<BuildStats> for Accelerator {
    fn from(s: BuildStats) -> Accelerator {
        Accelerator {
            build_seconds: s.build_seconds,
            bytes: s.bytes,
            nodes: s.nodes,
            primitives: s.primitives,
            dropped_primitives: s.dropped,
        }
    }
}

/// Seconds by the clock.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Times {
    /// From the start of the program to the last picture written.
    pub(crate) wall_seconds: f64,
    pub(crate) read_seconds: f64,
    pub(crate) compile_seconds: f64,
    pub(crate) render_seconds: f64,
    pub(crate) write_seconds: f64,
}

/// What `--stats` writes. Times are in seconds, memory in bytes.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Stats {
    pub(crate) version: &'static str,
    pub(crate) command_line: Vec<String>,
    pub(crate) scene: String,
    pub(crate) status: Status,
    pub(crate) stopped: bool,
    /// Width and height of the whole picture.
    pub(crate) resolution: [u32; 2],
    /// The part that was rendered, `x0 x1 y0 y1`, ends excluded.
    pub(crate) pixel_bounds: [u32; 4],
    pub(crate) integrator: &'static str,
    pub(crate) max_depth: u32,
    /// Ways on from the first vertex of each camera sample.
    pub(crate) splits: u32,
    pub(crate) mis: String,
    pub(crate) light_sampler: &'static str,
    pub(crate) colour: &'static str,
    pub(crate) sampler: &'static str,
    pub(crate) seed: u64,
    pub(crate) threads: usize,
    pub(crate) samples: u64,
    /// That every pixel has got.
    pub(crate) samples_per_pixel: u32,
    pub(crate) samples_per_pixel_wanted: u32,
    /// With `--noise`.
    pub(crate) noise: Option<NoiseReport>,
    pub(crate) rejected_samples: u64,
    pub(crate) rays: Rays,
    pub(crate) samples_per_second: f64,
    pub(crate) rays_per_second: f64,
    #[serde(flatten)]
    pub(crate) times: Times,
    #[serde(flatten)]
    pub(crate) usage: Usage,
    pub(crate) acceleration_structure: Accelerator,
    pub(crate) lights: usize,
    pub(crate) materials: usize,
    /// Geometry, its hierarchy and images.
    pub(crate) scene_bytes: usize,
    pub(crate) film_bytes: usize,
    pub(crate) warnings: usize,
    pub(crate) sampler_notes: Vec<String>,
    pub(crate) notes: Vec<String>,
}

impl Stats {
    /// What is known before the scene is built; the rest is empty.
    pub(crate) fn new(args: &RenderArgs, desc: &SceneDesc, threads: usize) -> Stats {
        let integrator = &desc.integrator;
        Stats {
            version: env!("CARGO_PKG_VERSION"),
            command_line: std::env::args_os().map(|a| a.to_string_lossy().into_owned()).collect(),
            scene: args.scene.display().to_string(),
            status: Status::Done,
            stopped: false,
            resolution: desc.film.resolution,
            pixel_bounds: desc.film.pixel_bounds,
            integrator: names::integrator(integrator.name),
            max_depth: integrator.max_depth,
            splits: integrator.splits.unwrap_or(0),
            mis: integrator.mis.to_string(),
            light_sampler: names::light_sampler(integrator.light_sampler),
            colour: names::colour(desc.film.colour),
            sampler: names::sampler(desc.sampler.name),
            seed: desc.sampler.seed.unwrap_or(desc.seed),
            threads,
            samples: 0,
            samples_per_pixel: 0,
            samples_per_pixel_wanted: desc.sampler.samples_per_pixel,
            noise: None,
            rejected_samples: 0,
            rays: RayCounts::default().into(),
            samples_per_second: 0.0,
            rays_per_second: 0.0,
            times: Times::default(),
            usage: Usage::default(),
            acceleration_structure: BuildStats::default().into(),
            lights: 0,
            materials: 0,
            scene_bytes: 0,
            film_bytes: 0,
            warnings: desc.warnings.len(),
            sampler_notes: Vec::new(),
            notes: Vec::new(),
        }
    }
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
pub(crate) struct Outcome<'a> {
    pub(crate) status: Status,
    pub(crate) exit_code: u8,
    pub(crate) version: &'static str,
    /// The files that were written.
    pub(crate) outputs: &'a [String],
    pub(crate) stats: &'a Stats,
    pub(crate) warnings: &'a [Remark],
}

/// A number with a prefix for its size, followed by a blank or that prefix: `5.0 `, `1.25 M`.
pub(crate) fn si(v: f64) -> String {
    let prefixes = [(1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k")];
    match prefixes.iter().find(|(size, _)| v >= *size) {
        Some((size, prefix)) if v < 10.0 * size => format!("{:.2} {prefix}", v / size),
        Some((size, prefix)) => format!("{:.1} {prefix}", v / size),
        None => format!("{v:.1} "),
    }
}

/// Bytes, with a prefix in steps of 1024.
pub(crate) fn bytes(n: u64) -> String {
    let prefixes = [(1u64 << 40, "TiB"), (1 << 30, "GiB"), (1 << 20, "MiB"), (1 << 10, "KiB")];
    match prefixes.iter().find(|(size, _)| n >= *size) {
        Some((size, prefix)) => format!("{:.1} {prefix}", n as f64 / *size as f64),
        None => format!("{n} B"),
    }
}

/// A duration as `m:ss` or `h:mm:ss`.
pub(crate) fn clock(seconds: f64) -> String {
    let s = seconds.clamp(0.0, 1e12) as u64;
    match s {
        0..3600 => format!("{}:{:02}", s / 60, s % 60),
        _ => format!("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!([si(0.5), si(999.0), si(1250.0), si(3e7)], ["0.5 ", "999.0 ", "1.25 k", "30.0 M"]);
        assert_eq!([bytes(1023), bytes(1536), bytes(3 << 30)], ["1023 B", "1.5 KiB", "3.0 GiB"]);
        assert_eq!([clock(59.9), clock(61.0), clock(3661.0)], ["0:59", "1:01", "1:01:01"]);
    }
}
