//! Two numbers that ought to be the same.
//!
//! A tolerance alone would either miss faults or blame rounding: in a narrow lobe the last bit of a direction moves the
//! density by much more than a bit. So where a comparison fails, both directions are moved by some roundings, and what
//! that changes is allowed on top.

use sparrow_math::{LocalDir, vec3};
use sparrow_spectra::N_LAMBDA;

use crate::column::{Column, Dir, Value};
use crate::question::{ColumnName, Question};
use crate::report::Finding;

/// Tolerances of a column.
#[derive(Clone, Copy)]
pub(crate) struct Precision {
    pub(crate) relative: f64,
    /// Below this, values carry no light.
    pub(crate) floor: f64,
    /// By how much directions are moved.
    pub(crate) nudge: f64,
}

impl Precision {
    pub(crate) fn of(name: ColumnName) -> Precision {
        match name {
            ColumnName::F64 => Precision { relative: 1e-9, floor: 1e-13, nudge: 4.0 * f64::EPSILON },
            ColumnName::F32 | ColumnName::Lanes => {
                Precision { relative: 1e-4, floor: 1e-7, nudge: 2.0 * f64::from(f32::EPSILON) }
            }
        }
    }
}

/// Finite, and not negative.
pub(crate) fn fair(v: &Value) -> bool {
    let fair = |x: f64| x >= 0.0 && x.is_finite();
    v.f_cos.iter().all(|x| fair(*x)) && fair(v.pdf)
}

/// A direction with the digits that are needed to ask again.
pub(crate) fn show(w: Dir) -> String {
    format!("({:e}, {:e}, {:e})", w.x(), w.y(), w.z())
}

/// By how much moved directions change density and value: densities first, then `f_cos` per wavelength.
pub(crate) fn conditioning(
    column: &dyn Column,
    pair: [Dir; 2],
    at: &Value,
    nudge: f64,
) -> [f64; 1 + N_LAMBDA] {
    let mut moved = Vec::with_capacity(12);
    for which in 0..2 {
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let step = |a: usize| if a == axis { sign * nudge } else { 0.0 };
                let mut p = pair;
                p[which] = LocalDir::new(p[which].v() + vec3(step(0), step(1), step(2)));
                moved.push(p);
            }
        }
    }
    let mut values = Vec::new();
    column.eval(&moved, &mut values);
    let mut c = [0.0f64; 1 + N_LAMBDA];
    for v in values.iter().filter(|v| fair(v)) {
        c[0] = c[0].max((v.pdf - at.pdf).abs());
        for k in 0..N_LAMBDA {
            c[k + 1] = c[k + 1].max((v.f_cos[k] - at.f_cos[k]).abs());
        }
    }
    c
}

/// The worst of many comparisons.
pub(crate) struct Comparison {
    severity: f64,
    measured: String,
}

impl Comparison {
    pub(crate) fn new() -> Comparison {
        Comparison { severity: 0.0, measured: String::new() }
    }
    /// Compares two numbers; `more` is asked for a further allowance only where the first does not do.
    pub(crate) fn add(
        &mut self,
        a: f64,
        b: f64,
        allowed: f64,
        more: impl FnOnce() -> f64,
        place: impl FnOnce() -> String,
    ) {
        let off = (a - b).abs();
        if off <= self.severity * allowed && !off.is_nan() {
            return;
        }
        let mut severity = off / allowed;
        if !(severity <= 1.0) {
            severity = off / (allowed + more());
        }
        let severity = if severity.is_nan() { f64::INFINITY } else { severity };
        if severity > self.severity {
            self.severity = severity;
            self.measured = format!("{a:.9e} against {b:.9e} at {}", place());
        }
    }
    pub(crate) fn finding(self, question: Question, name: ColumnName) -> Finding {
        Finding::new(question, name, self.severity, self.measured)
    }
}
