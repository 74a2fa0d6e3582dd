//! The records.

use std::sync::LazyLock;

use serde_json::Value;

static RECORDS: LazyLock<Vec<Value>> = LazyLock::new(|| {
    serde_json::from_str(include_str!("../reference/values_fibres.json")).expect("the records are JSON")
});

/// All ids.
pub(crate) fn ids() -> Vec<&'static str> {
    RECORDS.iter().filter_map(|r| r["id"].as_str()).collect()
}

/// The records whose ids begin so; there is one at least.
pub(crate) fn of(prefix: &str) -> Vec<(&'static str, &'static Value)> {
    let mine = RECORDS.iter().filter_map(|r| Some((r["id"].as_str()?, r)));
    let mine: Vec<_> = mine.filter(|(id, _)| id.starts_with(prefix)).collect();
    assert!(!mine.is_empty(), "no record begins with `{prefix}`");
    mine
}

/// An input by its name.
pub(crate) fn input(r: &Value, name: &str) -> f64 {
    r["inputs"][name].as_f64().expect("the record has that input")
}

/// A number inside the value by its path.
pub(crate) fn want(r: &Value, path: &[&str]) -> f64 {
    let found = path.iter().fold(&r["value"], |v, key| match key.parse::<usize>() {
        Ok(i) if v.is_array() => &v[i],
        _ => &v[*key],
    });
    found.as_f64().expect("the record has a number there")
}

/// Within the tolerance of the record.
#[track_caller]
pub(crate) fn check(r: &Value, path: &[&str], got: f64) {
    let want = want(r, path);
    let tol = r["tol"].as_f64().expect("the record has a tolerance");
    let bound = tol * want.abs().max(1e-9) + 1e-12;
    assert!((got - want).abs() <= bound, "{} {path:?}: {got}, want {want}", r["id"]);
}
