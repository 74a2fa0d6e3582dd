//! Reference values, computed independently in `values.py`; a test names them by their id.

use std::collections::HashSet;
use std::sync::{LazyLock, Mutex, PoisonError};

use serde_json::Value;

static RECORDS: LazyLock<Vec<Value>> = LazyLock::new(|| {
    serde_json::from_str(include_str!("values_surfaces.json")).expect("the records are JSON")
});

static USED: Mutex<Option<HashSet<String>>> = Mutex::new(None);

/// The record of that id: `inputs`, `value`, `tol`, `how`.
pub(crate) fn record(id: &str) -> Value {
    let found = RECORDS.iter().find(|r| r["id"] == id).cloned();
    assert!(found.is_some(), "no record `{id}`");
    let mut used = USED.lock().unwrap_or_else(PoisonError::into_inner);
    used.get_or_insert_with(HashSet::new).insert(id.to_owned());
    found.unwrap_or_default()
}

/// How many records there are.
pub(crate) fn count() -> usize {
    RECORDS.len()
}

/// The ids that nobody has asked for.
pub(crate) fn unused() -> Vec<&'static str> {
    let used = USED.lock().unwrap_or_else(PoisonError::into_inner);
    let asked = |id: &str| used.as_ref().is_some_and(|u| u.contains(id));
    RECORDS.iter().filter_map(|r| r["id"].as_str()).filter(|id| !asked(id)).collect()
}
