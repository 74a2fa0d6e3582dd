//! What came out, as a table and as JSON: [`Outcome`].

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

use serde::Serialize;

use super::CompareArgs;
use super::measure::{Measure, Threshold, Value};
use super::noise::{LEVEL, Noise};
use super::pictures::Pictures;
use crate::failure::{DONE, Failure, Remark};

/// A threshold held against its measure.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Judged {
    metric: String,
    limit: f64,
    value: Value,
    pub(super) exceeded: bool,
}

impl Judged {
    /// None where the measure was not taken.
    pub(super) fn new(t: Threshold, values: &[(Measure, Value)]) -> Option<Judged> {
        let (_, value) = values.iter().find(|(m, _)| *m == t.measure)?;
        let exceeded = t.measure.exceeds(value, t.limit);
        Some(Judged { metric: t.measure.name(), limit: t.limit, value: value.clone(), exceeded })
    }
}

/// All that is known at the end.
pub(super) struct Outcome<'a> {
    pub(super) exit_code: u8,
    pub(super) args: &'a CompareArgs,
    pub(super) pictures: &'a Pictures,
    pub(super) values: &'a [(Measure, Value)],
    pub(super) judged: &'a [Judged],
    pub(super) outputs: &'a [PathBuf],
}

/// What `--json` prints. What is not finite or not defined is null.
#[derive(Serialize)]
struct Json<'a> {
    status: &'static str,
    exit_code: u8,
    version: &'static str,
    picture: String,
    reference: String,
    width: usize,
    height: usize,
    metrics: BTreeMap<String, &'a Value>,
    thresholds: &'a [Judged],
    outputs: Vec<String>,
    warnings: &'a [Remark],
}

impl Outcome<'_> {
    pub(super) fn json(&self) -> Result<String, Failure> {
        let [width, height] = self.pictures.size;
        let object = Json {
            status: if self.exit_code == DONE { "done" } else { "exceeded" },
            exit_code: self.exit_code,
            version: env!("CARGO_PKG_VERSION"),
            picture: self.args.picture.display().to_string(),
            reference: self.args.reference.display().to_string(),
            width,
            height,
            metrics: self.values.iter().map(|(m, v)| (m.name(), v)).collect(),
            thresholds: self.judged,
            outputs: self.outputs.iter().map(|p| p.display().to_string()).collect(),
            warnings: &self.pictures.warnings,
        };
        serde_json::to_string(&object)
            .map_err(|e| Failure::input(format!("the result is no JSON: {e}; please report this")))
    }

    /// A line per thing, its name in front.
    pub(super) fn text(&self) -> String {
        let mut out = String::new();
        let mut line = |name: &str, what: String| {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{name:<15} {what}");
        };
        let [width, height] = self.pictures.size;
        line("picture", self.args.picture.display().to_string());
        line("reference", self.args.reference.display().to_string());
        line("size", format!("{width} x {height} pixels"));
        self.pictures.warnings.iter().for_each(|w| line("warning", w.text.clone()));
        for (m, v) in self.values {
            line(&m.name(), described(*m, v));
        }
        for j in self.judged {
            let verdict = if j.exceeded { "EXCEEDED" } else { "kept" };
            line("threshold", format!("{}={} {verdict}", j.metric, j.limit));
        }
        self.outputs.iter().for_each(|p| line("wrote", p.display().to_string()));
        out
    }
}

fn described(measure: Measure, value: &Value) -> String {
    let text = match value {
        Value::Number(v) => number(*v),
        Value::Channels(v) => v.map(number).join("  "),
        Value::Test(noise) => tested(noise),
        Value::Undefined(why) => return format!("-  {why}"),
    };
    format!("{text}  {}", measure.unit()).trim_end().to_owned()
}

fn tested(n: &Noise) -> String {
    let verdict =
        if n.p < LEVEL { "the pictures differ by more than noise" } else { "noise explains the difference" };
    let worst =
        n.worst.map_or(String::new(), |(x, y, c)| format!(", the oddest at column {x}, row {y}, {c}"));
    let bias = n.bias.map(|b| format!("{b:.2}")).join(" ");
    format!("{}: {verdict}; {} values beyond it{worst}; bias {bias} sigma", number(n.p), n.rejected)
}

/// Six places, or six digits where that shows too little.
fn number(v: f64) -> String {
    let size = v.abs();
    if v == 0.0 || (1e-3..1e6).contains(&size) || !v.is_finite() {
        format!("{v:.6}")
    } else {
        format!("{v:.5e}")
    }
}
