//! Questions about single samples and pairs of directions: pdf, weight, reciprocity, agreement.

use sparrow_spectra::N_LAMBDA;

use crate::column::{Column, Dir, Drawn, Value};
use crate::comparison::{Comparison, Precision, conditioning, fair, show};
use crate::integrals::View;
use crate::question::{ColumnName, Question};
use crate::report::Finding;
use crate::tally::uniforms;

/// Samples looked at one by one.
const SAMPLES: usize = 4096;
/// Pairs looked at one by one.
const PAIRS: usize = 512;

pub(crate) fn ask(view: &View<'_>, findings: &mut Vec<Finding>) {
    let mut values = Worst::default();
    for column in view.columns {
        let drawn = draw(view, &**column);
        samples(view, &**column, &drawn, findings);
        let pairs = pairs(view, &drawn);
        exchange(view, &**column, &pairs, &mut values, findings);
    }
    agreement(view, findings);
    for (name, severity, measured) in values.0 {
        findings.push(Finding::new(Question::Finite, name, severity, measured));
    }
}

/// Per column the first value that cannot be.
#[derive(Default)]
struct Worst(Vec<(ColumnName, f64, String)>);

impl Worst {
    fn look(&mut self, name: ColumnName, pairs: &[[Dir; 2]], values: &[Value]) {
        let bad = pairs.iter().zip(values).find(|(_, v)| !fair(v));
        let entry = match bad {
            Some((p, v)) => (name, f64::INFINITY, format!("{v:?} at wo {}, wi {}", show(p[0]), show(p[1]))),
            None => (name, 0.0, String::new()),
        };
        self.0.push(entry);
    }
}

fn draw(view: &View<'_>, column: &dyn Column) -> Vec<Drawn> {
    let mut rng = view.rng(if column.name() == ColumnName::F64 { "points f64" } else { "points f32" });
    let u: Vec<[f64; 3]> = (0..SAMPLES).map(|_| uniforms(column.name(), &mut rng)).collect();
    let mut drawn = Vec::new();
    column.sample(view.wo, &u, &mut drawn);
    drawn
}

/// Density against `pdf`, weight against value over density.
fn samples(view: &View<'_>, column: &dyn Column, drawn: &[Drawn], findings: &mut Vec<Finding>) {
    let name = column.name();
    let p = Precision::of(name);
    let smooth: Vec<&Drawn> = drawn.iter().filter(|s| s.is_smooth()).collect();
    if smooth.is_empty() {
        return;
    }
    let pairs: Vec<[Dir; 2]> = smooth.iter().map(|s| [view.wo, s.wi]).collect();
    let mut values = Vec::new();
    column.eval(&pairs, &mut values);
    let (mut density, mut weight) = (Comparison::new(), Comparison::new());
    for ((s, v), pair) in smooth.iter().zip(&values).zip(&pairs) {
        let place = || format!("wi {}", show(s.wi));
        let allowed = p.relative * s.density.max(v.pdf) + p.floor;
        let more = || 4.0 * conditioning(column, *pair, v, p.nudge)[0];
        density.add(s.density, v.pdf, allowed, more, place);
        for k in 0..N_LAMBDA {
            // Against the density of the sample, so that a wrong one is not blamed on the weight.
            let (a, b) = (s.weight[k] * s.density, v.f_cos[k]);
            let allowed = p.relative * a.max(b) + p.floor;
            let more = || {
                let c = conditioning(column, *pair, v, p.nudge);
                4.0 * (c[k + 1] + s.weight[k] * c[0])
            };
            weight.add(a, b, allowed, more, place);
        }
    }
    findings.push(density.finding(Question::Pdf, name));
    findings.push(weight.finding(Question::Weight, name));
}

/// Pairs near the lobes, and anywhere.
fn pairs(view: &View<'_>, drawn: &[Drawn]) -> Vec<[Dir; 2]> {
    let mut rng = view.rng("pairs");
    let near = drawn.iter().filter(|s| s.is_smooth()).take(PAIRS / 2).map(|s| [view.wo, s.wi]);
    let near: Vec<_> = near.collect();
    let far = (near.len()..PAIRS).map(|_| [view.wo, rng.direction()]);
    near.iter().copied().chain(far).collect()
}

/// Viewer and light exchanged; the values met on the way are looked at too.
fn exchange(
    view: &View<'_>,
    column: &dyn Column,
    pairs: &[[Dir; 2]],
    values: &mut Worst,
    findings: &mut Vec<Finding>,
) {
    let name = column.name();
    let p = Precision::of(name);
    let swapped: Vec<[Dir; 2]> = pairs.iter().map(|[a, b]| [*b, *a]).collect();
    let (mut there, mut back) = (Vec::new(), Vec::new());
    column.eval(pairs, &mut there);
    values.look(name, pairs, &there);
    column.eval(&swapped, &mut back);
    values.look(name, &swapped, &back);
    if there.iter().chain(&back).all(|v| v.f_cos.iter().all(|f| f.abs() <= 0.0)) {
        return;
    }
    let mut worst = Comparison::new();
    for (i, [wo, wi]) in pairs.iter().enumerate() {
        let (co, ci) = (view.cosine(*wo), view.cosine(*wi));
        let squeeze = view.squeeze(*wi);
        for k in 0..N_LAMBDA {
            // Both sides with both cosines: nothing is divided by one that may be zero.
            let (a, b) = (squeeze * there[i].f_cos[k] * co, back[i].f_cos[k] * ci);
            let allowed = p.relative * a.max(b) + p.floor * co.min(ci);
            let more = || {
                let c = conditioning(column, [*wo, *wi], &there[i], p.nudge)[k + 1];
                let d = conditioning(column, [*wi, *wo], &back[i], p.nudge)[k + 1];
                4.0 * (c * squeeze * co + d * ci)
            };
            let place = || format!("wi {}, with both cosines", show(*wi));
            worst.add(a, b, allowed, more, place);
        }
    }
    findings.push(worst.finding(Question::Reciprocity, name));
}

/// `f32` against `f64`, and lanes against `f32` bit for bit.
fn agreement(view: &View<'_>, findings: &mut Vec<Finding>) {
    let of = |name| view.columns.iter().find(|c| c.name() == name).map(|c| &**c);
    let (Some(double), Some(single)) = (of(ColumnName::F64), of(ColumnName::F32)) else { return };
    let drawn = draw(view, single);
    let pairs = pairs(view, &drawn);
    let (mut fine, mut coarse) = (Vec::new(), Vec::new());
    double.eval(&pairs, &mut fine);
    single.eval(&pairs, &mut coarse);
    let p = Precision { relative: 2e-4, ..Precision::of(ColumnName::F32) };
    let mut worst = Comparison::new();
    for (i, pair) in pairs.iter().enumerate() {
        let place = || format!("wi {}", show(pair[1]));
        let all = |v: &Value| [v.pdf, v.f_cos[0], v.f_cos[1], v.f_cos[2], v.f_cos[3]];
        for (k, (a, b)) in all(&coarse[i]).into_iter().zip(all(&fine[i])).enumerate() {
            let more = || {
                let exact = conditioning(double, *pair, &fine[i], p.nudge)[k];
                4.0 * (exact + conditioning(single, *pair, &coarse[i], p.nudge)[k])
            };
            worst.add(a, b, p.relative * a.max(b) + p.floor, more, place);
        }
    }
    findings.push(worst.finding(Question::Agreement, ColumnName::F32));
    if let Some(lanes) = of(ColumnName::Lanes) {
        findings.push(
            same_bits(view, lanes, &pairs, &coarse, &drawn).finding(Question::Agreement, ColumnName::Lanes),
        );
    }
}

fn same_bits(
    view: &View<'_>,
    lanes: &dyn Column,
    pairs: &[[Dir; 2]],
    values: &[Value],
    drawn: &[Drawn],
) -> Comparison {
    // Numbers so small that a vector unit may flush them count as zero.
    const TINY: f64 = 1e-37;
    let mut worst = Comparison::new();
    let mut again = Vec::new();
    lanes.eval(pairs, &mut again);
    for ((pair, a), b) in pairs.iter().zip(values).zip(&again) {
        let place = || format!("wi {}", show(pair[1]));
        worst.add(b.pdf, a.pdf, TINY, || 0.0, place);
        for k in 0..N_LAMBDA {
            worst.add(b.f_cos[k], a.f_cos[k], TINY, || 0.0, place);
        }
    }
    let other = draw(view, lanes);
    for (i, (a, b)) in drawn.iter().zip(&other).enumerate() {
        let place = || format!("sample {i}, wi {}", show(a.wi));
        let (keep_a, keep_b) = (f64::from(u8::from(a.valid)), f64::from(u8::from(b.valid)));
        worst.add(keep_b, keep_a, TINY, || 0.0, place);
        if a.valid && b.valid {
            worst.add(b.density, a.density, TINY, || 0.0, place);
            worst.add(b.wi.z(), a.wi.z(), TINY, || 0.0, place);
            worst.add(b.wi.x(), a.wi.x(), TINY, || 0.0, place);
            worst.add(b.weight[0], a.weight[0], TINY, || 0.0, place);
        }
    }
    worst
}
