//! Questions about all samples of a view: density, samples, mean, furnace.

use sparrow_math::{LocalDir, Real};
use sparrow_models::fibre_cosine;
use sparrow_spectra::N_LAMBDA;
use sparrow_stats::cubature::Stop;
use sparrow_stats::{Cell, Partition, Random, chi_square};

use crate::column::{Column, Dir, Value};
use crate::question::{ColumnName, Question};
use crate::report::Finding;
use crate::tally::{Tally, stream};

/// Samples from which cells are made.
const SCOUTS: usize = 1 << 14;
/// Cells of the chi-square test.
const CELLS: usize = 1024;
/// Standard errors that a mean may be off by: one in two million does so by chance.
const SIGMAS: f64 = 5.0;
/// Most evaluations of an integral: six for every five samples, within these bounds, and no more than ten. Chance then hides what is
/// left.
const EVALUATIONS: [usize; 2] = [400_000, 1_200_000];
/// Single precision moves directions and densities: no cell is cut where half of its samples lie within this many
/// radians, 4000 times the rounding of a component.
const FINEST_F32: f64 = 5e-4;

/// One view of one model with its parameters bound.
pub(crate) struct View<'a> {
    pub(crate) columns: &'a [Box<dyn Column>],
    pub(crate) wo: Dir,
    /// Relative index that transmitted light crosses.
    pub(crate) eta: f64,
    /// Cosines are those of a fibre.
    pub(crate) fibre: bool,
    /// What all that is drawn depends on: seed and words of the case.
    pub(crate) seed: u64,
    pub(crate) words: &'a str,
}

impl View<'_> {
    pub(crate) fn rng(&self, purpose: &str) -> Random {
        Random::named(self.seed, &format!("{purpose} {}", self.words))
    }
    /// The cosine that radiance is received with.
    pub(crate) fn cosine(&self, w: Dir) -> f64 {
        if self.fibre { fibre_cosine(w) } else { w.abs_cos_theta() }
    }
    /// Squared index between two directions: 1 on the same side.
    pub(crate) fn squeeze(&self, wi: Dir) -> f64 {
        if self.wo.z() * wi.z() < 0.0 { self.eta * self.eta } else { 1.0 }
    }
}

/// How far numbers of a column may be off beyond chance.
struct Allowance {
    /// Relative, for what is counted per cell.
    cell: f64,
    /// For shares of one.
    share: f64,
}

impl Allowance {
    fn of(name: ColumnName) -> Allowance {
        match name {
            ColumnName::F64 => Allowance { cell: 1e-4, share: 1e-4 },
            ColumnName::F32 | ColumnName::Lanes => Allowance { cell: 2e-3, share: 1e-3 },
        }
    }
}

/// Cells, with integrals of density and energy in double precision.
struct Expected {
    cells: Partition,
    pdf: Vec<f64>,
    error: Vec<f64>,
    total: f64,
    energy: [f64; N_LAMBDA],
    total_error: f64,
}

/// Sizes of a trial.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sizes {
    pub(crate) samples: usize,
    /// p-value below which a chi-square test fails.
    pub(crate) level: f64,
}

/// Largest weight, and worth of a sample compared with one of a constant weight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spread {
    pub(crate) largest: f64,
    pub(crate) efficiency: f64,
}

pub(crate) fn ask(view: &View<'_>, sizes: Sizes, findings: &mut Vec<Finding>) -> Spread {
    let Some(double) = view.columns.first() else { return Spread { largest: 0.0, efficiency: 1.0 } };
    let mut scouts = Vec::with_capacity(SCOUTS);
    stream(&**double, view.wo, SCOUTS.min(sizes.samples), &mut view.rng("scouts"), |s| {
        if s.is_smooth() && s.wi.v().length().is_finite() {
            scouts.push(s.wi);
        }
    });
    let fine = expect(view, &**double, &scouts, 0.0, sizes.samples);
    // Made only where a column needs it.
    let mut coarse = None;
    let mut spread = Spread { largest: 0.0, efficiency: 1.0 };
    for column in view.columns {
        let name = column.name();
        let expected = match name {
            ColumnName::F64 => &fine,
            ColumnName::F32 | ColumnName::Lanes => {
                &*coarse.get_or_insert_with(|| expect(view, &**double, &scouts, FINEST_F32, sizes.samples))
            }
        };
        // Both columns of single precision take the same numbers.
        let purpose = if name == ColumnName::F64 { "samples f64" } else { "samples f32" };
        let tally = Tally::new(&**column, view.wo, sizes.samples, &expected.cells, &mut view.rng(purpose));
        judge(name, expected, &tally, sizes, findings);
        if name == ColumnName::F64 {
            let count = tally.weights.count().max(1) as f64;
            let worth =
                if tally.weights.mean() > 0.0 { tally.weights.effective_samples() / count } else { 1.0 };
            spread = Spread { largest: tally.weights.largest(), efficiency: worth };
        }
    }
    spread
}

fn expect(view: &View<'_>, column: &dyn Column, scouts: &[Dir], finest: f64, samples: usize) -> Expected {
    let mirror = Real::atan2(-view.wo.y(), -view.wo.x());
    let cells = Partition::new(scouts, CELLS, mirror, finest);
    let value = std::cell::RefCell::new(Vec::<Value>::with_capacity(1));
    let integrand = |wi: LocalDir<f64>| {
        let mut value = value.borrow_mut();
        column.eval(&[[view.wo, wi]], &mut value);
        let (v, squeeze) = (value[0], view.squeeze(wi));
        [v.pdf, v.f_cos[0] * squeeze, v.f_cos[1] * squeeze, v.f_cos[2] * squeeze, v.f_cos[3] * squeeze]
    };
    let [least, most] = EVALUATIONS;
    let evaluations = (samples / 5 * 6).clamp(least.min(10 * samples), most);
    let stop = Stop { error: 1e-5, evaluations };
    let integral = cells.integrate(integrand, stop);
    let t = integral.total();
    let mut pdf: Vec<f64> = integral.value.iter().map(|v| v[0]).collect();
    pdf.resize(cells.len(), 0.0);
    let total_error = integral.total_error();
    let mut error = integral.error;
    error.resize(cells.len(), 0.0);
    Expected { cells, pdf, error, total: t[0], energy: [t[1], t[2], t[3], t[4]], total_error }
}

fn judge(name: ColumnName, e: &Expected, t: &Tally, sizes: Sizes, findings: &mut Vec<Finding>) {
    let allow = Allowance::of(name);
    let mut add = |q, severity, measured| findings.push(Finding::new(q, name, severity, measured));
    let broken = t.broken.map_or(String::new(), |s| format!("a sample is {s:?}"));
    add(Question::Finite, if t.broken.is_some() { f64::INFINITY } else { 0.0 }, broken);

    let nothing = e.total.abs() <= 0.0 && t.kept <= 0.0;
    if !nothing {
        let kept = t.kept / t.n;
        let chance = (kept * (1.0 - kept) / t.n).sqrt() + 3.0 / t.n;
        let severity = (e.total - kept).abs() / (SIGMAS * chance + e.total_error + allow.share);
        add(Question::Density, severity, format!("integral {:.6}, share kept {kept:.6}", e.total));

        let (severity, measured) = samples_follow(e, t, &allow, sizes.level);
        add(Question::Samples, severity, measured);

        let off = |k: usize| {
            let (mean, error) = t.smooth.mean(k, t.n);
            let allowed = SIGMAS * error + e.total_error + allow.share * e.energy[k].max(mean).max(1e-3);
            ((mean - e.energy[k]).abs() / allowed, mean, k)
        };
        let (severity, mean, k) = worst((0..N_LAMBDA).map(off));
        add(Question::Mean, severity, format!("mean weight {mean:.6}, integral {:.6}", e.energy[k]));
    }
    let furnace = |k: usize| {
        let (smooth, smooth_error) = t.smooth.mean(k, t.n);
        let (delta, delta_error) = t.delta.mean(k, t.n);
        // Double precision has the integral, which is sharper.
        let (smooth, smooth_error) = match name {
            ColumnName::F64 => (e.energy[k], e.total_error),
            ColumnName::F32 | ColumnName::Lanes => (smooth, SIGMAS * smooth_error),
        };
        let allowed = smooth_error + SIGMAS * delta_error + allow.share;
        ((smooth + delta - 1.0) / allowed, smooth + delta, k)
    };
    let (severity, energy, _) = worst((0..N_LAMBDA).map(furnace));
    add(Question::Furnace, severity, format!("of 1, {energy:.6} leaves"));
}

/// The most severe of all; what is not a number comes first.
fn worst(of: impl Iterator<Item = (f64, f64, usize)>) -> (f64, f64, usize) {
    let key = |v: f64| if v.is_nan() { f64::INFINITY } else { v };
    of.max_by(|a, b| key(a.0).total_cmp(&key(b.0))).unwrap_or((0.0, 0.0, 0))
}

fn samples_follow(e: &Expected, t: &Tally, allow: &Allowance, level: f64) -> (f64, String) {
    let cell = |i: usize| {
        let expected = t.n * e.pdf[i].max(0.0);
        Cell { observed: t.counts[i], expected, slack: t.n * e.error[i] + allow.cell * expected }
    };
    let mut cells: Vec<Cell> = (0..t.counts.len()).map(cell).collect();
    // What is lost, and what delta lobes take, is a cell too.
    let rest = t.n * (1.0 - e.total).max(0.0);
    cells.push(Cell { observed: t.n - t.kept, expected: rest, slack: t.n * (e.total_error + allow.share) });
    let test = chi_square(&cells);
    // p = level counts as 1; logarithms, as strictness is.
    let severity = Real::ln(test.p.max(1e-300)) / Real::ln(level);
    let place = match test.worst {
        Some(i) if i + 1 < cells.len() => {
            format!("; worst cell holds {} of {:.1} expected", cells[i].observed, cells[i].expected)
        }
        _ => String::new(),
    };
    let measured = format!("chi2 {:.1}, {} degrees, p {:.2e}{place}", test.statistic, test.dof, test.p);
    (severity, measured)
}
