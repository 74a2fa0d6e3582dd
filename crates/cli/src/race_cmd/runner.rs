//! Renders a setting again and again: [`Runner`].

use std::sync::atomic::Ordering;
use std::time::Instant;

use sparrow_render::film::Picture;
use sparrow_render::sampler::{Sampler, SamplerConfig, SamplerKind};
use sparrow_render::{
    Compiled, RenderOptions, RenderPlan, RenderStats, Scene, compile, render, render_to_noise,
};

use super::options::Setting;
use crate::failure::{Failure, Remark};
use crate::process::Usage;
use crate::{interrupt, overrides};

/// One picture of a setting.
pub(super) struct Run {
    pub(super) rgb: Vec<[f32; 3]>,
    /// Of rendering alone, all threads together.
    pub(super) cpu_seconds: f64,
    /// Mean over the pixels.
    pub(super) samples_per_pixel: f64,
}

/// A scene that is built, with its setting.
pub(super) struct Runner {
    scene: Scene,
    plan: RenderPlan,
    noise: Option<f64>,
    threads: usize,
    /// Of each run, unless the setting says how many samples it takes.
    cpu_time: Option<f64>,
}

impl Runner {
    /// Reads and builds the scene.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(super) fn new(setting: &Setting, cpu_time: f64, log: &dyn Fn(&str)) -> Result<Runner, Failure> {
        let args = &setting.args;
        let mut desc = sparrow_scene::read_with_materials(&args.scene, &args.material)
            .map_err(|e| Failure::scene(&e))?;
        overrides::apply(args, &mut desc);
        let refused = |faults: Vec<String>| {
            Failure::inputs(faults.iter().map(|f| Remark::in_file(&args.scene, f)).collect())
        };
        let plan = RenderPlan::new(&desc).map_err(refused)?;
        if !plan.sampler.config().is_random() {
            return Err(Failure::input(format!(
                "{}: the sampler has randomization \"none\", so that all seeds give one picture; use \"fastowen\"",
                args.scene.display()
            )));
        }
        let Compiled { scene, notes } = compile(desc).map_err(|e| refused(e.0))?;
        notes.iter().for_each(|n| log(&format!("note: {}: {n}", setting.name)));
        let fixed = args.spp.is_some() || args.noise.is_some();
        let threads = args.threads.unwrap_or(0) as usize;
        Ok(Runner { scene, plan, noise: args.noise, threads, cpu_time: (!fixed).then_some(cpu_time) })
    }

    /// The part of the picture that is rendered, within the whole.
    pub(super) fn bounds(&self) -> ([u32; 4], [u32; 2]) {
        (self.plan.bounds, self.plan.sampler.config().resolution)
    }

    pub(super) fn size(&self) -> [usize; 2] {
        self.plan.size().map(|v| v as usize)
    }

    /// Fills the caches, and finds the number of samples for the time of a run.
    ///
    /// Up to 16 it is a power of two, beyond a multiple of 16: blocks that the samplers stratify.
    pub(super) fn warm_up(&mut self) -> Result<(), Failure> {
        let Some(cpu_time) = self.cpu_time else { return Ok(()) };
        let mut spp = 1;
        let seconds = loop {
            self.set(u64::MAX, spp);
            let seconds = self.take()?.1;
            if seconds > 0.1 * cpu_time || spp >= 1 << 20 {
                break seconds;
            }
            spp *= 2;
        };
        let wanted = (f64::from(spp) * cpu_time / seconds.max(1e-9)).clamp(1.0, 1e6) as u32;
        let spp = if wanted < 32 { 1 << wanted.ilog2() } else { wanted / 16 * 16 };
        self.set(0, spp);
        Ok(())
    }

    /// A picture with this seed.
    pub(super) fn run(&mut self, seed: u64) -> Result<Run, Failure> {
        self.set(seed, self.plan.samples_per_pixel);
        let (picture, cpu_seconds, stats) = self.take()?;
        let [width, height] = self.plan.size();
        let at = |(x, y)| picture.pixel(x, y).rgb.map(|v| v as f32);
        Ok(Run {
            rgb: (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(at).collect(),
            cpu_seconds,
            samples_per_pixel: stats.samples as f64 / (f64::from(width) * f64::from(height)),
        })
    }

    fn set(&mut self, seed: u64, samples_per_pixel: u32) {
        let old = *self.plan.sampler.config();
        let mut kind = old.kind;
        if let SamplerKind::Stratified { x, y, .. } = &mut kind {
            [*x, *y] = overrides::strata(samples_per_pixel);
        }
        self.plan.sampler = Sampler::new(&SamplerConfig { kind, seed, samples_per_pixel, ..old });
        self.plan.samples_per_pixel = samples_per_pixel;
    }

    fn take(&self) -> Result<(Box<dyn Picture>, f64, RenderStats), Failure> {
        let options = RenderOptions { threads: self.threads, variance: false, time_limit: None };
        let (stop, watch) = (interrupt::stop(), |_| ());
        let (start, before) = (Instant::now(), Usage::now().cpu_seconds);
        let done = match self.noise {
            None => render(&self.scene, &self.plan, &options, stop, &watch)
                .map(|(film, did)| (Box::new(film) as Box<dyn Picture>, did)),
            Some(target) => render_to_noise(&self.scene, &self.plan, target, &options, stop, &watch)
                .map(|(halves, did)| (Box::new(halves) as _, did)),
        };
        let (picture, did) = done.map_err(|e| Failure::input(e.to_string()))?;
        if stop.load(Ordering::SeqCst) {
            return Err(Failure::interrupted("interrupted; there is no verdict"));
        }
        let cpu = match (before, Usage::now().cpu_seconds) {
            (Some(before), Some(after)) => after - before,
            // A system that does not tell: the clock, which is as good where nothing else runs.
            _ => start.elapsed().as_secs_f64(),
        };
        Ok((picture, cpu.max(1e-6), did))
    }
}
