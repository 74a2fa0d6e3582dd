//! A setting against the truth: means over blocks, from many renders with seeds of their own.

use std::sync::LazyLock;

use rayon::prelude::*;
use sparrow_mis::Mis;
use sparrow_render::film::Film;
use sparrow_render::{RenderOptions, RenderPlan, compile, render};
use sparrow_scene::{LightSamplerName, RouletteName, SamplerName, SceneDesc};
use sparrow_stats::special::normal_tails;
use sparrow_stats::{Mean, sidak, welch_p};

use crate::common::describe;

/// Renders of a setting; so many that Student's t is nearly normal where it is tested.
const SEEDS: u64 = 32;
/// Samples per pixel of one of them.
const SPP: u32 = 16;
/// Side of a block, in pixels of a picture of 16 x 16.
const BLOCK: u32 = 8;
/// Chance of a false alarm in all scenes together.
const LEVEL: f64 = 0.01;

/// What is varied, one thing at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting {
    pub(crate) mis: Mis,
    pub(crate) lights: LightSamplerName,
    pub(crate) sampler: SamplerName,
    pub(crate) roulette: RouletteName,
    pub(crate) splits: u32,
}

fn mis(word: &str) -> Mis {
    word.parse().unwrap_or_else(|e| panic!("{e}"))
}

/// Every heuristic, every choice of lights, every sampler, every roulette.
pub(crate) static SETTINGS: LazyLock<Vec<Setting>> = LazyLock::new(|| {
    let usual = Setting {
        mis: mis("power"),
        lights: LightSamplerName::Bvh,
        sampler: SamplerName::ZSobol,
        roulette: RouletteName::Throughput,
        splits: 1,
    };
    let heuristics = Mis::EXAMPLES.iter().map(|word| Setting { mis: mis(word), ..usual });
    let lights = all_lights().into_iter().map(|lights| Setting { lights, ..usual });
    let samplers = all_samplers().into_iter().map(|sampler| Setting { sampler, ..usual });
    let efficiency = [1, 3].map(|splits| Setting { roulette: RouletteName::Efficiency, splits, ..usual });
    let split = Mis::EXAMPLES.iter().map(|word| Setting { mis: mis(word), splits: 3, ..usual });
    heuristics.chain(lights).chain(samplers).chain(efficiency).chain(split).collect()
});

/// All but the one that every heuristic runs with. A new kind makes the `match` incomplete.
fn all_lights() -> Vec<LightSamplerName> {
    let (mut all, mut next) = (Vec::new(), Some(LightSamplerName::Uniform));
    while let Some(name) = next {
        all.push(name);
        next = match name {
            LightSamplerName::Uniform => Some(LightSamplerName::Power),
            LightSamplerName::Power => None,
            LightSamplerName::Bvh => None,
        };
    }
    all
}

/// The same for samplers.
fn all_samplers() -> Vec<SamplerName> {
    let (mut all, mut next) = (Vec::new(), Some(SamplerName::Independent));
    while let Some(name) = next {
        all.push(name);
        next = match name {
            SamplerName::Independent => Some(SamplerName::Stratified),
            SamplerName::Stratified => Some(SamplerName::Halton),
            SamplerName::Halton => Some(SamplerName::Sobol),
            SamplerName::Sobol => Some(SamplerName::PaddedSobol),
            SamplerName::PaddedSobol => Some(SamplerName::Pmj02bn),
            SamplerName::Pmj02bn | SamplerName::ZSobol => None,
        };
    }
    all
}

/// Means over blocks and over the picture, for each channel, with their scatter from seed to seed.
pub(crate) fn measure(text: &str, setting: Setting, spp: u32, first_seed: u64) -> Vec<Mean> {
    let mut desc = describe(text);
    desc.integrator.mis = setting.mis;
    desc.integrator.light_sampler = setting.lights;
    desc.integrator.splits = Some(setting.splits);
    desc.sampler.name = setting.sampler;
    desc.integrator.roulette = setting.roulette;
    desc.sampler.samples_per_pixel = spp;
    desc.sampler.strata = [spp / 4, 4];
    let plans: Vec<RenderPlan> = (0..SEEDS).map(|seed| plan(&mut desc, first_seed + seed)).collect();
    let scene = compile(desc).unwrap_or_else(|e| panic!("{e}")).scene;
    let options = RenderOptions { threads: 1, variance: false, time_limit: None };
    let pictures: Vec<Vec<f64>> = plans
        .par_iter()
        .map(|plan| {
            let stop = std::sync::atomic::AtomicBool::new(false);
            let (film, stats) =
                render(&scene, plan, &options, &stop, &|_| ()).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(stats.rejected, 0, "a sample is no number: {setting:?}");
            blocks(&film)
        })
        .collect();
    let mut means = vec![Mean::default(); pictures[0].len()];
    pictures.iter().flat_map(|p| p.iter().enumerate()).for_each(|(i, v)| means[i].add(*v));
    means
}

fn plan(desc: &mut SceneDesc, seed: u64) -> RenderPlan {
    desc.seed = seed;
    RenderPlan::new(desc).unwrap_or_else(|e| panic!("{e:?}"))
}

fn blocks(film: &Film) -> Vec<f64> {
    let columns = film.width().div_ceil(BLOCK);
    let n = (columns * film.height().div_ceil(BLOCK)) as usize;
    let mut sums = vec![[0.0; 4]; n + 1];
    for (x, y) in (0..film.height()).flat_map(|y| (0..film.width()).map(move |x| (x, y))) {
        let p = film.pixel(x, y).rgb;
        for k in [(y / BLOCK * columns + x / BLOCK) as usize, n] {
            (0..3).for_each(|c| sums[k][c] += p[c]);
            sums[k][3] += 1.0;
        }
    }
    sums.iter().flat_map(|s| [0, 1, 2].map(|c| s[c] / s[3])).collect()
}

/// The truth of a scene.
pub(crate) enum Truth {
    /// The same radiance everywhere.
    Known(f64),
    /// A longer run of a plain setting, with its own scatter.
    Long,
}

/// A setting, or all together, with its oddest mean: the probability, and how far from the truth.
#[derive(Debug)]
pub(crate) struct Verdict {
    pub(crate) setting: Option<Setting>,
    pub(crate) p: f64,
    pub(crate) ratio: f64,
}

/// All settings of a scene against the truth of the scene `true_text`, and at last their common mean.
pub(crate) fn try_all(text: &str, true_text: &str, truth: &Truth) -> Vec<Verdict> {
    let plain = Setting {
        mis: mis("balance"),
        lights: LightSamplerName::Uniform,
        sampler: SamplerName::PaddedSobol,
        roulette: RouletteName::Throughput,
        splits: 1,
    };
    let truth = match truth {
        Truth::Known(v) => {
            let mut exact = Mean::default();
            (0..2).for_each(|_| exact.add(*v));
            vec![exact]
        }
        Truth::Long => measure(true_text, plain, 8 * SPP, 1 << 32),
    };
    let seed = |i: usize| i as u64 * SEEDS;
    let measured: Vec<Vec<Mean>> =
        SETTINGS.iter().enumerate().map(|(i, setting)| measure(text, *setting, SPP, seed(i))).collect();
    let oddest = |setting, tests: &mut dyn Iterator<Item = (f64, f64)>| {
        let (p, ratio) = tests.fold((1.0, 1.0), |worst, t| if t.0 < worst.0 { t } else { worst });
        Verdict { setting, p, ratio }
    };
    let alone = SETTINGS.iter().zip(&measured).map(|(setting, means)| {
        let mut tests =
            means.iter().zip(truth.iter().cycle()).map(|(m, t)| (welch_p(m, t), m.value() / t.value()));
        oddest(Some(*setting), &mut tests)
    });
    let mut together = (0..measured[0].len()).map(|k| {
        let t = &truth[k % truth.len()];
        let (mean, variance) = common_mean(measured.iter().map(|means| &means[k]));
        let variance = variance + t.variance() / t.count();
        (normal_tails((mean - t.value()) / variance.sqrt()), mean / t.value())
    });
    alone.chain([oddest(None, &mut together)]).collect()
}

/// Mean of means, weighted by the inverse of their variances, and its variance.
fn common_mean<'a>(means: impl Iterator<Item = &'a Mean>) -> (f64, f64) {
    let (mut sum, mut weights) = (0.0, 0.0);
    for m in means {
        let w = m.count() / m.variance().max(1e-20);
        sum += w * m.value();
        weights += w;
    }
    (sum / weights, 1.0 / weights)
}

/// What a probability is to exceed, in so many scenes.
pub(crate) fn limit(n_scenes: usize) -> f64 {
    let means = 3 * ((16 / BLOCK).pow(2) + 1);
    sidak(LEVEL, n_scenes * (SETTINGS.len() + 1) * means as usize)
}
