//! How many ways on a camera sample gets, chosen by efficiency.
//!
//! A camera sample with its first vertex costs `c0` and leaves the variance `v0`, whatever follows; each way on costs `c1` and, alone,
//! leaves `v1`. With `n` ways a sample costs `c0 + n c1` and leaves `v0 + v1 / n`; the best `n` makes the product least. A pilot of a few
//! thousand paths measures the four, costs in rays, so that the choice is the same on every machine and with any number of threads.
//! [ArvoKirk1990], [Rath2022]

use sparrow_spectra::Spectrum;

use crate::integrator::{CameraNumbers, CameraSample, Finder, PathIntegrator, RayCounts, Record};
use crate::plan::RenderPlan;
use crate::roulette::Roulette;
use crate::sampler::{Sampler, SamplerConfig, SamplerKind};
use crate::scene::Scene;

/// Pixels of the pilot along each side of the picture, at most.
const SIDE: u32 = 32;
/// The pilot takes at most one path in so many of the render.
const PILOT_SHARE: u64 = 64;
/// Fewer pixels than this say too little.
const LEAST_PIXELS: usize = 64;
/// Ways on among which it chooses.
const CHOICES: [u32; 4] = [1, 2, 4, 8];
/// More ways are taken only where each step makes the product of cost and variance less than this: a further way costs more than its rays, and
/// what most pictures are judged by leaves out single bright pixels, to which further ways owe part of what they gain.
const WORTH: f64 = 0.87;
/// Noise is judged relative to a pixel's brightness and this part of the picture's, both squared.
const DARK: f64 = 0.1;
/// This part of the pixels, the noisiest, is left out.
const OUTLIERS: f64 = 0.02;

/// What a pilot found in a pixel.
#[derive(Clone, Copy, Default)]
struct Pixel {
    mean: f64,
    v0: f64,
    v1: f64,
}

/// Cost and variance of the first vertex and of a way on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shares {
    cost: [f64; 2],
    variance: [f64; 2],
}

impl Shares {
    fn product(&self, n: u32) -> f64 {
        let ([c0, c1], [v0, v1], n) = (self.cost, self.variance, f64::from(n));
        (c0 + n * c1) * (v0 + v1 / n)
    }
    /// The least number of ways that is nearly the best.
    fn best(&self) -> u32 {
        CHOICES.into_iter().fold(
            1,
            |best, n| {
                if self.product(n) < WORTH * self.product(best) { n } else { best }
            },
        )
    }
}

/// Light that the first vertex has, whichever way the path goes on.
#[derive(Default)]
struct OfFirstVertex(Spectrum<f32>);

impl Record for OfFirstVertex {
    fn found(&mut self, by: Finder, light: Spectrum<f32>, weight: f32) {
        if matches!(by, Finder::Camera | Finder::Light(0)) {
            self.0 += light * weight;
        }
    }
}

impl PathIntegrator {
    /// With as many ways on as are asked for, or else as are efficient.
    pub(crate) fn split(self, scene: &Scene, plan: &RenderPlan) -> PathIntegrator {
        let splits = plan.splits.unwrap_or_else(|| shares(scene, plan).map_or(1, |s| s.best()));
        PathIntegrator { splits, ..self }
    }
}

impl RenderPlan {
    /// A sampler for a render of this plan, with points for all ways on of each camera sample.
    pub(crate) fn sampler_of_ways(&self, config: &SamplerConfig, splits: u32) -> Sampler {
        let samples_per_pixel = config.samples_per_pixel.saturating_mul(splits);
        Sampler::new(&SamplerConfig { samples_per_pixel, ..*config })
    }
}

/// Two camera samples in each of a grid of pixels, with two ways on each; none where the render is too small for that.
fn shares(scene: &Scene, plan: &RenderPlan) -> Option<Shares> {
    let config = plan.sampler.config();
    let [width, height] = config.resolution;
    let paths = u64::from(width) * u64::from(height) * u64::from(plan.samples_per_pixel) / PILOT_SHARE;
    let side = ((paths / 4).isqrt() as u32).min(SIDE);
    let how = PathIntegrator { splits: 1, ..plan.integrator };
    if side * side < LEAST_PIXELS as u32 || how.max_depth < 2 || how.max_smooth < 2 {
        return None;
    }
    let sampler = Sampler::new(&SamplerConfig { kind: SamplerKind::Independent, ..*config });
    let mut cost = [0.0; 2];
    let mut pixels = Vec::new();
    for place in (0..side * side).map(|i| [i % side, i / side]) {
        let middle = |i: u32, n: u32| ((u64::from(2 * i + 1) * u64::from(n)) / u64::from(2 * side)) as u32;
        let pixel = [middle(place[0], width), middle(place[1], height)];
        let samples =
            [0, 1].map(|sample| camera_sample(scene, plan, &how, &sampler, pixel, sample, &mut cost));
        let [a, b] = samples.map(|s| s.own + 0.5 * (s.ways[0] + s.ways[1]));
        let v1 = samples.iter().map(|s| 0.25 * (s.ways[0] - s.ways[1]).powi(2)).sum::<f64>();
        pixels.push(Pixel { mean: 0.5 * (a + b), v0: 0.5 * (a - b).powi(2) - 0.5 * v1, v1 });
    }
    Some(Shares { cost, variance: variance(pixels)? })
}

/// A camera sample of the pilot: brightness from the first vertex, and by either of two ways on.
#[derive(Clone, Copy)]
struct Sample {
    own: f64,
    ways: [f64; 2],
}

fn camera_sample(
    scene: &Scene,
    plan: &RenderPlan,
    how: &PathIntegrator,
    sampler: &Sampler,
    pixel: [u32; 2],
    sample: u32,
    cost: &mut [f64; 2],
) -> Sample {
    let numbers = CameraNumbers::new(&sampler.start(pixel, sample));
    let CameraSample { lambda, ray, .. } = CameraSample::of_picture(scene, plan, pixel, &numbers);
    let mut own = 0.0;
    let brightness = |l, lambda: &_| {
        let [r, g, b] = plan.sensor.rgb(l, lambda).map(f64::from);
        let y = (r + g + b) / 3.0;
        if y.is_finite() { y } else { 0.0 }
    };
    let ways = [0, 1].map(|way| {
        let (mut lambda, mut rays) = (lambda, RayCounts::default());
        let mut sampler = sampler.start(pixel, sample + 2 * way);
        let mut first = OfFirstVertex::default();
        let l = how.radiance_of_way(
            way,
            scene,
            ray,
            &mut lambda,
            &mut sampler,
            &mut rays,
            &mut first,
            Roulette::THROUGHPUT,
        );
        // The further way counts no ray of the first vertex: what the first way has more is what that costs.
        let n = (rays.scattered + rays.shadow) as f64;
        if way == 0 {
            own = brightness(first.0, &lambda);
            cost[0] += n;
            brightness(l, &lambda) - own
        } else {
            cost[0] -= n;
            cost[1] += n;
            brightness(l, &lambda)
        }
    });
    Sample { own, ways }
}

/// Means over the pixels, each relative to what the eye sees of it; none where nothing varies.
fn variance(mut pixels: Vec<Pixel>) -> Option<[f64; 2]> {
    let n = pixels.len() as f64;
    let bright = pixels.iter().map(|p| p.mean).sum::<f64>() / n;
    let weight = |p: &Pixel| 1.0 / (p.mean * p.mean + DARK * bright * bright);
    let whole = |p: &Pixel| weight(p) * (p.v0 + p.v1).abs();
    pixels.sort_by(|a, b| whole(a).total_cmp(&whole(b)));
    pixels.truncate((n * (1.0 - OUTLIERS)) as usize);
    let sum = |v: fn(&Pixel) -> f64| pixels.iter().map(|p| weight(p) * v(p)).sum::<f64>();
    let (v0, v1) = (sum(|p| p.v0), sum(|p| p.v1));
    // Few samples may leave less than nothing for the first vertex.
    (v1 > 0.0 && v1.is_finite()).then_some([v0.max(0.01 * v1), v1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The best number is near the root of `c0 v1 / (c1 v0)`; where the first vertex leaves all the noise, it is one.
    #[test]
    fn best_numbers() {
        let shares = |v0: f64| Shares { cost: [2.0, 4.0], variance: [v0, 1.0] };
        assert_eq!([0.5, 0.1, 0.01, 0.001].map(|v0| shares(v0).best()), [1, 1, 2, 8]);
        let dear = |c0: f64| Shares { cost: [c0, 1.0], variance: [0.01, 1.0] };
        assert_eq!([0.1, 1.0, 3.0].map(|c0| dear(c0).best()), [1, 4, 8]);
        assert_eq!(shares(100.0).best(), 1);
    }
}
