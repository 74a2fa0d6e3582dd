//! Lamps of four sizes over surfaces of four roughnesses (`scenes/mis`): the variance of one sample of direct light, by rendering
//! and by quadrature.

use std::path::Path;

use sparrow_math::Real;
use sparrow_mis::{Heuristic, Mis, PairMoments};
use sparrow_render::{Finder, RayCounts, Record, RenderPlan, Roulette, compile};
use sparrow_spectra::{Spectrum, Wavelengths};
use sparrow_stats::Mean;

pub const RADII: [(f64, &str); 4] = [(0.03333, "0.03333"), (0.1, "0.1"), (0.3, "0.3"), (0.9, "0.9")];
pub const ALPHAS: [(f64, &str); 4] = [(0.005, "0.005"), (0.02, "0.02"), (0.05, "0.05"), (0.1, "0.1")];
/// Ways to join the techniques, under the names of the records.
pub const COLUMNS: [(&str, Mis); 6] = [
    ("V1", Mis::LightOnly),
    ("V2", Mis::BsdfOnly),
    ("V_balance", Mis::Both(Heuristic::Balance)),
    ("V_power2", Mis::Both(Heuristic::Power(2.0))),
    ("V_maximum", Mis::Both(Heuristic::Maximum)),
    ("V_optimal", Mis::Optimal),
];

/// Exponent of the lobe of a surface of that roughness.
pub fn exponent(alpha: f64) -> f64 {
    (0.5 / (alpha * alpha)).round()
}

/// A relative variance `V / I^2` with its standard error, and the mean `I`.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    pub mean: f64,
    pub variance: f64,
    pub error: f64,
}

/// `Z` of the first vertex.
#[derive(Default)]
struct Control(f64);

impl Record for Control {
    fn found(&mut self, by: Finder, light: Spectrum<f32>, weight: f32) {
        match by {
            Finder::Light(0) if !light.is_black() => self.0 += f64::from(1.0 - weight),
            Finder::Bsdf(0) if !light.is_black() => self.0 -= f64::from(1.0 - weight),
            Finder::Camera | Finder::Light(_) | Finder::Bsdf(_) => {}
        }
    }
}

/// Follows `n` paths along one ray at one wavelength, so that nothing but the two techniques varies.
///
/// With [`Mis::Optimal`] a tenth as many are followed before, to learn from.
///
/// # Errors
/// Where the scene cannot be read.
pub fn measure(scenes: &Path, radius: &str, alpha: f64, mis: Mis, n: u32) -> Result<Measured, String> {
    let surface = format!(
        r#""surface" "string type" "phong" "rgb diffuse" [ 0 0 0 ] "rgb specular" [ 1 1 1 ]
        "string form" "normalized" "float exponent" {}"#,
        exponent(alpha)
    );
    let file = scenes.join(format!("mis/lamp-{radius}.pbrt"));
    let desc = sparrow_scene::read_with_materials(&file, &[surface]).map_err(|e| e.to_string())?;
    let mut plan = RenderPlan::new(&desc).map_err(|e| e.join(", "))?;
    plan.integrator.mis = mis;
    let scene = compile(desc).map_err(|e| e.to_string())?.scene;
    let ray = scene.camera().ray([16.0; 2], [0.5; 2], 0.0);
    let one = |sample: u32| {
        let mut lambda = Wavelengths::with_pdf([550.0; 4], [1.0; 4]);
        let mut sampler = plan.sampler.start([0, 0], sample);
        let (mut rays, mut control) = (RayCounts::default(), Control::default());
        let l = plan.integrator.radiance(
            &scene,
            ray,
            &mut lambda,
            &mut sampler,
            &mut rays,
            &mut control,
            Roulette::THROUGHPUT,
        );
        (f64::from(l.0[0]), control.0)
    };
    let mut moments = PairMoments::<1>::default();
    if mis == Mis::Optimal {
        (n..n + n / 10).map(one).for_each(|(l, z)| moments.add([l], z));
    }
    let [c] = moments.slope();
    Ok(summary(&(0..n).map(one).map(|(l, z)| l - c * z).collect::<Vec<f64>>()))
}

/// Mean, relative variance, and its error by the fourth moment.
fn summary(values: &[f64]) -> Measured {
    let mut mean = Mean::default();
    values.iter().for_each(|v| mean.add(*v));
    let (i, n) = (mean.value(), values.len() as f64);
    let (mut second, mut fourth) = (0.0, 0.0);
    for v in values {
        let d = (v / i - 1.0).powi(2);
        second += d / n;
        fourth += d * d / n;
    }
    let error = ((fourth - second * second).max(0.0) / n).sqrt();
    Measured { mean: i, variance: second, error }
}

/// `V_opt / I^2` by quadrature: the pair A, b of [Kondapaneni2019] in `u = 1 - cos`, where the directions of the lobe that miss the
/// lamp are places that it alone can find.
pub fn optimal_variance(radius: f64, alpha: f64) -> f64 {
    let (n, s2) = (exponent(alpha), (radius / 4.0).powi(2));
    let cap = s2 / (1.0 + (1.0 - s2).sqrt());
    let pdf = |u: f64| [1.0 / cap, (n + 1.0) * Real::exp(n * Real::ln(1.0 - u))];
    // Half-way points of many cells, fine where the lobe is.
    let end = cap.min(60.0 / n);
    let cells = 400_000;
    let integral = |f: &dyn Fn([f64; 2]) -> f64| {
        let part = |from: f64, to: f64| {
            let h = (to - from) / f64::from(cells);
            (0..cells).map(|k| h * f(pdf(from + h * (f64::from(k) + 0.5)))).sum::<f64>()
        };
        part(0.0, end) + if end < cap { part(end, cap) } else { 0.0 }
    };
    // The integrand is p2 itself.
    let missed = 1.0 - integral(&|p| p[1]);
    let a = |i: usize, j: usize| integral(&|p| p[i] * p[j] / (p[0] + p[1]));
    let (a11, a12, a22) = (a(0, 0), a(0, 1), a(1, 1) + missed);
    let (b1, b2) = (a12, a(1, 1));
    let det = a11 * a22 - a12 * a12;
    let alpha = [(b1 * a22 - b2 * a12) / det, (a11 * b2 - a12 * b1) / det];
    let rest = integral(&|p| (p[1] - alpha[0] * p[0] - alpha[1] * p[1]).powi(2) / (p[0] + p[1]));
    (rest + alpha[1] * alpha[1] * missed) / (1.0 - missed).powi(2)
}
