//! Models held against the reference fibre, lobe by lobe: [`against`].

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use serde::Serialize;
use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::cylinder::roughness::{logistic_scale, variance};
use sparrow_models::{Bcsdf, Fibre, FibreKind, N_LOBES, ParamBlock, Uniforms};
use sparrow_spectra::{N_LAMBDA, Spectrum};
use sparrow_stats::Random;

use super::boundary::Surface;
use super::section::Section;
use super::trace::{Core, ReferenceFibre};

/// Cells along and around the fibre, of equal angle.
const CELLS: [usize; 2] = [18, 24];
/// Pieces that the samples are drawn in; each has random numbers of its own, so that threads do not matter.
const PIECES: usize = 64;
/// Index of refraction of the table.
const ETA: f64 = 1.55;
/// Absorptions of the table, per radius; the last is there to fill four values.
const SIGMAS: [f64; N_LAMBDA] = [0.0, 0.2, 1.0, 1.0];
const N_SIGMAS: usize = 3;

/// What is compared: roughness after Chiang, and the inclination of the view in degrees.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Grid {
    /// `beta_m = beta_n`
    pub beta: f64,
    /// Inclination.
    pub theta_deg: f64,
    /// The fibre has a scattering core, which fur alone knows.
    pub cored: bool,
}

/// The core of the table.
const CORE: Core = Core { kappa: 0.7, sigma_s: 3.0, sigma_a: 0.0, g: 0.4 };

/// The table's places: fibres without and with a core.
pub fn comparison_grid() -> Vec<Grid> {
    let mut places = Vec::new();
    for cored in [false, true] {
        for beta in [0.1, 0.3] {
            places.extend([0.0, 30.0, 60.0].map(|theta_deg| Grid { beta, theta_deg, cored }));
        }
    }
    places
}

/// The models that are held against the fibre of a place.
fn models_at(at: &Grid) -> Vec<FibreKind> {
    let told = FibreKind::ALL.iter().copied().filter(|k| like(*k, 0.3, 0.0).is_some());
    told.filter(|k| at.cored == (*k == FibreKind::Fur)).collect()
}

/// One lobe of one model at one place. Shares are of the light that arrives.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct LobeError {
    /// Light that the fibre sends by this lobe.
    pub truth: f64,
    /// Its standard error.
    pub truth_error: f64,
    /// Light that the model sends.
    pub model: f64,
    /// Half of the sum over cells of the difference, over `truth`: the share of the lobe that lies in the wrong place.
    pub misplaced: f64,
    /// What chance alone would show as misplaced.
    pub chance: f64,
}

/// One model at one place and absorption.
#[derive(Clone, Debug, Serialize)]
pub struct ModelError {
    /// Its name.
    pub model: &'static str,
    /// Roughness and inclination.
    #[serde(flatten)]
    pub at: Grid,
    /// Absorption per radius.
    pub sigma_a: f64,
    /// R, TT, TRT, more.
    pub lobes: [LobeError; N_LOBES],
}

/// Light by absorption, lobe and cell.
#[derive(Clone, Debug)]
struct Histogram {
    n: f64,
    sum: Vec<[[f64; N_SIGMAS]; N_LOBES]>,
    sum2: Vec<[[f64; N_SIGMAS]; N_LOBES]>,
}

impl Histogram {
    fn new() -> Histogram {
        let cells = vec![[[0.0; N_SIGMAS]; N_LOBES]; CELLS[0] * CELLS[1]];
        Histogram { n: 0.0, sum: cells.clone(), sum2: cells }
    }
    fn cell(w: LocalDir<f64>) -> usize {
        let theta = Real::asin(w.x()) / core::f64::consts::PI + 0.5;
        let phi = Real::atan2(w.z(), w.y()) / core::f64::consts::TAU + 0.5;
        let place = |x: f64, n: usize| ((x * n as f64) as usize).min(n - 1);
        place(theta, CELLS[0]) * CELLS[1] + place(phi, CELLS[1])
    }
    fn add(&mut self, w: LocalDir<f64>, lobe: usize, weight: [f64; N_LAMBDA]) {
        let cell = Histogram::cell(w);
        let (sum, sum2) = (&mut self.sum[cell][lobe], &mut self.sum2[cell][lobe]);
        for (w, (sum, sum2)) in weight.iter().zip(sum.iter_mut().zip(sum2)) {
            *sum += w;
            *sum2 += w * w;
        }
    }
    fn join(&mut self, other: &Histogram) {
        self.n += other.n;
        for (mine, theirs) in [(&mut self.sum, &other.sum), (&mut self.sum2, &other.sum2)] {
            for (a, b) in mine.iter_mut().flatten().flatten().zip(theirs.iter().flatten().flatten()) {
                *a += b;
            }
        }
    }
    /// Mean and variance of the mean of one cell.
    fn mean(&self, cell: usize, lobe: usize, k: usize) -> [f64; 2] {
        let mean = self.sum[cell][lobe][k] / self.n;
        [mean, (self.sum2[cell][lobe][k] / self.n - mean * mean).max(0.0) / self.n]
    }
}

/// The direction of an inclination in degrees, at the azimuth of the normal.
fn view(theta_deg: f64) -> LocalDir<f64> {
    let (s, c) = Real::sin_cos(theta_deg.to_radians());
    LocalDir::new(vec3(s, 0.0, c))
}

/// Standard deviations of R along and around the fibre that Chiang's roughness means, in rad.
fn widths(beta: f64) -> [f64; 2] {
    [variance(beta).sqrt(), logistic_scale(beta) * core::f64::consts::PI / 3.0_f64.sqrt()]
}

/// Slope widths of its facets along and around the fibre: a mirror turns light by twice the slope, and slopes of GGX facets count as
/// Gaussian, so that `alpha = std / sqrt(2)`.
fn facets(beta: f64) -> [f64; 2] {
    widths(beta).map(|std| std * core::f64::consts::FRAC_1_SQRT_2)
}

/// The fibre of the table.
fn fibre(at: Grid) -> ReferenceFibre {
    ReferenceFibre {
        section: Section::CIRCLE,
        surface: Surface { alpha: facets(at.beta), eta: ETA },
        tilt: 0.0,
        sigma_a: SIGMAS,
        core: at.cored.then_some(CORE),
    }
}

/// A model with the parameters that mean the fibre of the table; none for models that tell no lobes apart.
fn like(kind: FibreKind, beta: f64, h: f64) -> Option<Fibre<f64>> {
    let [alpha_m, alpha_n] = facets(beta);
    let [along, around] = widths(beta).map(f64::to_degrees);
    let reals: &[(&str, f64)] = match kind {
        FibreKind::Hair => &[("beta_m", beta), ("beta_n", beta), ("alpha", 0.0)],
        FibreKind::Fur => &[
            ("kappa", CORE.kappa),
            ("sigma_m_s", CORE.sigma_s),
            ("g", CORE.g),
            ("beta_m", beta),
            ("beta_n", beta),
            ("alpha", 0.0),
        ],
        FibreKind::ZinkeWeber | FibreKind::DEon => &[("width_m", along), ("width_n", around), ("alpha", 0.0)],
        FibreKind::EllipticalHair => {
            &[("width_m", along), ("width_n", around), ("alpha", 0.0), ("aspect", 1.0)]
        }
        FibreKind::MicrofacetHair => &[("alpha_m", alpha_m), ("alpha_n", alpha_n), ("tilt", 0.0)],
        // His width is told in the half angle.
        FibreKind::Marschner => &[("beta_r", 0.5 * along), ("alpha_r", 0.0)],
        FibreKind::KajiyaKay
        | FibreKind::BanksFibre
        | FibreKind::LambertFibre
        | FibreKind::MirrorCylinder => {
            return None;
        }
    };
    let mut p = ParamBlock { h, ..ParamBlock::<f64>::defaults(kind.params()) };
    // A core absorbs nothing here.
    (p.spectra[0], p.spectra[1]) = (Spectrum(SIGMAS), Spectrum::splat(CORE.sigma_a));
    let numbers = kind.params().iter().filter(|i| i.kind == sparrow_models::ParamKind::Real);
    for (slot, info) in p.reals.iter_mut().zip(numbers) {
        let given = reals.iter().find(|(name, _)| *name == info.name).map(|(_, v)| *v);
        *slot = match info.name {
            "eta" => ETA,
            _ => given.unwrap_or(*slot).clamp(info.range[0], info.range[1]),
        };
    }
    Some(kind.bind(&p))
}

/// What the reference fibre scatters, over its whole width.
fn truth(at: Grid, n: usize, rng: &mut Random) -> Histogram {
    let (mut out, fibre, wo) = (Histogram::new(), fibre(at), view(at.theta_deg));
    out.n = n as f64;
    for _ in 0..n {
        let h = rng.within(-1.0, 1.0);
        if let Some(p) = fibre.send(wo, h, rng) {
            out.add(p.wi, p.lobe, p.weight);
        }
    }
    out
}

/// What a model scatters, over its whole width.
fn modelled(kind: FibreKind, at: Grid, n: usize, rng: &mut Random) -> Histogram {
    let (mut out, wo) = (Histogram::new(), view(at.theta_deg));
    out.n = n as f64;
    for _ in 0..n {
        let Some(model) = like(kind, at.beta, rng.within(-1.0, 1.0)) else { break };
        let u = Uniforms { lobe: rng.uniform(), dir: [rng.uniform(), rng.uniform()] };
        let s = model.sample(wo, u);
        if !s.valid {
            continue;
        }
        for (lobe, q) in model.lobes(wo, s.wi).into_iter().enumerate() {
            out.add(s.wi, lobe, q.0.map(|v| v / s.density));
        }
    }
    out
}

/// Holds every fibre model that tells lobes apart against the reference fibre: eta 1.55, no tilt, `samples` rays at each place of
/// [`comparison_grid`]. `progress` hears how many of how many pieces are done.
pub fn against(
    samples: usize,
    seed: u64,
    threads: usize,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Vec<ModelError> {
    // Of each place, the fibre and then the models.
    let rows: Vec<(Grid, Option<FibreKind>)> = comparison_grid()
        .into_iter()
        .flat_map(|at| {
            let models = models_at(&at).into_iter().map(Some);
            std::iter::once(None).chain(models).map(move |kind| (at, kind))
        })
        .collect();
    let jobs = rows.len() * PIECES;
    let done: Vec<Mutex<Option<Histogram>>> = (0..jobs).map(|_| Mutex::new(None)).collect();
    let (next, finished) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let work = |i: usize| {
        let (piece, row) = (i % PIECES, i / PIECES);
        let (at, kind) = rows[row];
        let mut rng = Random::named(seed, &format!("fibre {row} {piece}"));
        let n = (samples / PIECES).max(1);
        match kind {
            None => truth(at, n, &mut rng),
            // A fourth of the samples: models return no more than they need.
            Some(kind) => modelled(kind, at, (n / 4).max(1), &mut rng),
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    if i >= jobs {
                        break;
                    }
                    let answer = work(i);
                    if let Ok(mut slot) = done[i].lock() {
                        *slot = Some(answer);
                    }
                    progress(finished.fetch_add(1, Ordering::Relaxed) + 1, jobs);
                }
            });
        }
    });
    let mut pieces = done.into_iter().map(|d| d.into_inner().ok().flatten());
    let (mut out, mut truth) = (Vec::new(), Histogram::new());
    for (at, kind) in rows {
        let mut all = Histogram::new();
        pieces.by_ref().take(PIECES).flatten().for_each(|h| all.join(&h));
        let Some(kind) = kind else {
            truth = all;
            continue;
        };
        for (k, sigma_a) in SIGMAS.into_iter().take(N_SIGMAS).enumerate() {
            let lobes = [0, 1, 2, 3].map(|lobe| compare(&truth, &all, lobe, k));
            out.push(ModelError { model: kind.name(), at, sigma_a, lobes });
        }
    }
    out
}

fn compare(truth: &Histogram, model: &Histogram, lobe: usize, k: usize) -> LobeError {
    let (mut sums, mut variance, mut off, mut chance) = ([0.0; 2], 0.0, 0.0, 0.0);
    for cell in 0..truth.sum.len() {
        let ([a, va], [b, vb]) = (truth.mean(cell, lobe, k), model.mean(cell, lobe, k));
        sums = [sums[0] + a, sums[1] + b];
        variance += va;
        off += 0.5 * (a - b).abs();
        // The mean of |x| of a Gaussian is sqrt(2 / pi) of its standard deviation.
        chance += 0.5 * ((va + vb) * core::f64::consts::FRAC_2_PI).sqrt();
    }
    let whole = sums[0].max(1e-300);
    LobeError {
        truth: sums[0],
        truth_error: variance.sqrt(),
        model: sums[1],
        misplaced: off / whole,
        chance: chance / whole,
    }
}
