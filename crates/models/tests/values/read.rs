//! Reading records and binding models for them.

use serde_json::Value;
use sparrow_math::LocalDir;
use sparrow_models::{ParamBlock, Surface, SurfaceKind};
use sparrow_spectra::Spectrum;

/// A number inside a record, by its path.
pub(crate) fn at(v: &Value, path: &str) -> f64 {
    v.pointer(path).and_then(Value::as_f64).expect("the record has a number there")
}

#[track_caller]
pub(crate) fn check(r: &Value, path: &str, got: f64) {
    let want = at(r, &format!("/value{path}"));
    let tol = at(r, "/tol");
    let bound = tol * want.abs().max(1e-9) + 1e-12;
    assert!((got - want).abs() <= bound, "{} {path}: {got}, want {want}", r["id"]);
}

pub(crate) fn dir(theta_deg: f64, phi_deg: f64) -> LocalDir<f64> {
    LocalDir::from_angles(theta_deg.to_radians(), phi_deg.to_radians())
}

/// The directions (i, o) of a record's pair.
pub(crate) fn pair(r: &Value) -> (LocalDir<f64>, LocalDir<f64>) {
    let a = |k: usize| at(r, &format!("/inputs/pair/{k}"));
    (dir(a(0), a(1)), dir(a(2), a(3)))
}

/// A model at given choices and numbers; spectra of one value each.
pub(crate) fn bind(kind: SurfaceKind, choices: &[u8], reals: &[f64], spectra: &[f64]) -> Surface<f64> {
    let mut p = ParamBlock::defaults(kind.params());
    p.choices[..choices.len()].copy_from_slice(choices);
    p.reals[..reals.len()].copy_from_slice(reals);
    for (slot, v) in p.spectra.iter_mut().zip(spectra) {
        *slot = Spectrum::splat(*v);
    }
    kind.bind(&p)
}
