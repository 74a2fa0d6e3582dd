//! The outcome for machines.

use serde_json::{Value, json};

use super::{Book, Standing};
use crate::check::{Bound, Check};

/// Slides, figures and checks as one object.
pub(super) fn json(book: &Book) -> String {
    let rows = book.rows();
    let row = |r: &super::Row<'_>| json!({ "slide": r.slide.row, "title": r.slide.title, "standing": word(r.standing) });
    let figure = |m: &super::Made| {
        json!({
            "id": m.entry.id, "title": m.entry.title, "slides": m.entry.rows, "passed": m.figure.passed(),
            "checks": m.figure.checks.iter().map(check).collect::<Vec<_>>(),
        })
    };
    let object = json!({
        "book": "sparrow lecture",
        "version": env!("CARGO_PKG_VERSION"),
        "quality": book.quality.name(),
        "only": book.only,
        "slides": rows.iter().map(row).collect::<Vec<_>>(),
        "figures": book.figures.iter().map(figure).collect::<Vec<_>>(),
    });
    // An object of texts and numbers can always be written.
    serde_json::to_string_pretty(&object).unwrap_or_default() + "\n"
}

fn check(c: &Check) -> Value {
    let bound = match c.bound {
        Bound::Near { expected, tolerance } => json!({ "expected": expected, "tolerance": tolerance }),
        Bound::AtMost(v) => json!({ "at_most": v }),
        Bound::AtLeast(v) => json!({ "at_least": v }),
    };
    json!({ "what": c.what, "measured": c.measured, "bound": bound, "holds": c.holds() })
}

fn word(standing: Standing) -> &'static str {
    match standing {
        Standing::Passed => "passed",
        Standing::Failed => "failed",
        Standing::Absent => "absent",
        Standing::Untitled => "untitled",
    }
}
