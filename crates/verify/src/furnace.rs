//! Energy by samples alone, which every case can pay for: light that the viewer sees, and light that one lamp sends.
//!
//! For a reciprocal model both are the same. For one that is not, a lamp may be given back more than it sent although no view
//! of uniform light is brighter than the light.

use sparrow_spectra::N_LAMBDA;

use crate::column::{Drawn, Value};
use crate::integrals::View;
use crate::question::{ColumnName, Question};
use crate::report::Finding;
use crate::tally::{Energy, stream};

/// Samples of each estimate.
const SAMPLES: usize = 1 << 16;
/// Standard errors that a mean may be off by, as for integrals.
const SIGMAS: f64 = 5.0;
/// Beyond chance: what doubles round.
const ROUNDING: f64 = 1e-6;

pub(crate) fn ask(view: &View<'_>, findings: &mut Vec<Finding>) {
    let Some(double) = view.columns.iter().find(|c| c.name() == ColumnName::F64) else { return };
    let (mut seen, mut sent) = (Energy::default(), Energy::default());
    let mut smooth: Vec<Drawn> = Vec::with_capacity(SAMPLES);
    stream(&**double, view.wo, SAMPLES, &mut view.rng("furnace"), |s| {
        if s.valid {
            seen.add(s.energy());
        }
        if s.is_smooth() && s.density > 0.0 {
            smooth.push(*s);
        }
    });
    // The same directions, with the lamp where the viewer was: what leaves is weighted by the cosine of where it goes.
    let pairs: Vec<_> = smooth.iter().map(|s| [s.wi, view.wo]).collect();
    let mut values: Vec<Value> = Vec::with_capacity(pairs.len());
    double.eval(&pairs, &mut values);
    for (s, v) in smooth.iter().zip(&values) {
        let scale = view.cosine(s.wi) / (view.cosine(view.wo) * s.density);
        sent.add(v.f_cos.map(|f| f * scale));
    }
    for (energy, what) in [(seen, "of light from all sides"), (sent, "of what one lamp sends")] {
        let judged = (0..N_LAMBDA).map(|k| {
            let (mean, error) = energy.mean(k, SAMPLES as f64);
            ((mean - 1.0) / (SIGMAS * error + ROUNDING), mean, error)
        });
        let worst =
            judged.fold((f64::NEG_INFINITY, 0.0, 0.0), |a, b| if b.0 > a.0 || b.0.is_nan() { b } else { a });
        let measured = format!("{what}, {:.5} +- {:.5} leaves", worst.1, worst.2);
        findings.push(Finding::new(Question::Furnace, ColumnName::F64, worst.0, measured));
    }
}
