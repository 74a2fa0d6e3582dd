//! Reference values, computed independently in `values.py`; a test names them by their id.

use std::sync::LazyLock;

use serde_json::Value;

static RECORDS: LazyLock<Vec<Value>> = LazyLock::new(|| {
    serde_json::from_str(include_str!("values_surfaces.json")).expect("the records are JSON")
});

/// The record of that id: `inputs`, `value`, `tol`, `how`.
pub(crate) fn record(id: &str) -> Value {
    let found = RECORDS.iter().find(|r| r["id"] == id).cloned();
    assert!(found.is_some(), "no record `{id}`");
    found.unwrap_or_default()
}
