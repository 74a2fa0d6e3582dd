//! The pilot: a few paths all over the picture, which no picture shows.

use rayon::prelude::*;

use super::cells::Cells;
use super::trail::Trail;
use super::{Learned, Roulette};
use crate::integrator::{CameraNumbers, CameraSample, RayCounts};
use crate::plan::RenderPlan;
use crate::sampler::{Sampler, SamplerConfig, SamplerKind};
use crate::scene::Scene;

/// Most paths.
const N_PATHS: u64 = 8192;
/// Fewest paths along the side of a window, whose mean stands for its pixels.
const WINDOW: u32 = 4;

/// Learns what paths find and what it costs, the same on any number of threads and for any part of the picture.
pub(crate) fn learn(scene: &Scene, plan: &RenderPlan) -> Learned {
    let config = plan.sampler.config();
    let [width, height] = config.resolution;
    let paths = |stride: u32| u64::from(width.div_ceil(stride)) * u64::from(height.div_ceil(stride));
    let stride = (1..=width.max(height)).find(|&stride| paths(stride) <= N_PATHS).unwrap_or(1);
    let kind = SamplerKind::Independent;
    let seed = config.seed ^ 0x70_69_6c_6f_74;
    let sampler = Sampler::new(&SamplerConfig { kind, seed, samples_per_pixel: 1, ..*config });
    let row = |y: u32| (0..width).step_by(stride as usize).map(move |x| [x, y]);
    let trail = |pixel: [u32; 2]| {
        let mut sampler = sampler.start(pixel, 0);
        let numbers = CameraNumbers::new(&sampler);
        let CameraSample { mut lambda, ray, .. } = CameraSample::of_picture(scene, plan, pixel, &numbers);
        let (mut rays, mut trail) = (RayCounts::default(), Trail::default());
        let how = &plan.integrator;
        how.radiance(scene, ray, &mut lambda, &mut sampler, &mut rays, &mut trail, Roulette::THROUGHPUT);
        (pixel, trail)
    };
    let rows: Vec<u32> = (0..height).step_by(stride as usize).collect();
    let trails: Vec<Vec<_>> = rows.par_iter().map(|&y| row(y).map(&trail).collect()).collect();
    let cells = Cells::new(&scene.geometry().bounds());
    let log2_side = (WINDOW * stride).next_power_of_two().trailing_zeros();
    Learned::new(cells, [width, height], log2_side, trails.iter().flatten())
}
