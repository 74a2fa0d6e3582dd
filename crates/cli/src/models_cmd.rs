//! `sparrow models`: what there is, from the models' own tables.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;
use sparrow_models::{Lack, ModelKind, ParamInfo, ParamKind, Property};

use crate::args::ModelsArgs;
use crate::console;
use crate::failure::{DONE, Failure};
use crate::verify_cmd::kind;

#[derive(Serialize)]
struct Model {
    name: &'static str,
    summary: &'static str,
    sources: Vec<&'static str>,
    /// For every choice; so are the others.
    reciprocal: bool,
    energy_conserving: bool,
    anisotropic: bool,
    transmissive: bool,
    lacks: Vec<Missing>,
    parameters: Vec<Param>,
}

#[derive(Serialize)]
struct Missing {
    property: &'static str,
    reason: &'static str,
    /// Parameters with the choices for which it is missing; empty: always.
    when: BTreeMap<&'static str, &'static [&'static str]>,
}

#[derive(Serialize)]
struct Param {
    name: &'static str,
    kind: &'static str,
    unit: &'static str,
    /// A number, or the name of a choice.
    default: serde_json::Value,
    /// Ends; null where there is none.
    range: [Option<f64>; 2],
    soft: [Option<f64>; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    choices: Option<&'static [&'static str]>,
    doc: &'static str,
}

/// Lists the models, or tells all about one.
///
/// # Errors
/// Where there is no such model.
pub(crate) fn run(args: &ModelsArgs) -> Result<u8, Failure> {
    let one = args.model.as_deref().map(kind).transpose()?;
    let text = match (one, args.json) {
        (Some(k), true) => json(&model(k))?,
        (Some(k), false) => sheet(&model(k)),
        (None, true) => json(&ModelKind::all().map(model).collect::<Vec<_>>())?,
        (None, false) => list(),
    };
    console::print(text.trim_end())?;
    Ok(DONE)
}

fn json(v: &impl Serialize) -> Result<String, Failure> {
    serde_json::to_string(v)
        .map_err(|e| Failure::input(format!("the result is no JSON: {e}; please report this")))
}

fn model(kind: ModelKind) -> Model {
    let about = kind.about();
    let lacks = |p: Property| about.lacks.iter().any(|l| l.property == p);
    Model {
        name: kind.name(),
        summary: about.summary,
        sources: about.sources.split(',').map(str::trim).filter(|s| !s.is_empty()).collect(),
        reciprocal: !lacks(Property::Reciprocity),
        energy_conserving: !lacks(Property::Energy),
        anisotropic: about.anisotropic,
        transmissive: about.transmits,
        lacks: about.lacks.iter().map(missing).collect(),
        parameters: kind.params().iter().map(param).collect(),
    }
}

fn missing(lack: &Lack) -> Missing {
    Missing { property: lack.property.name(), reason: lack.reason, when: lack.when.iter().copied().collect() }
}

fn param(p: &ParamInfo) -> Param {
    let ends = |r: [f64; 2]| r.map(|v| v.is_finite().then_some(v));
    let (kind, choices) = match p.kind {
        ParamKind::Real => ("number", None),
        ParamKind::Albedo => ("spectrum in 0..1", None),
        ParamKind::Unbounded => ("spectrum", None),
        ParamKind::Choice(names) => ("choice", Some(names)),
    };
    let default = match choices {
        Some(names) => names.get(p.default as usize).copied().unwrap_or_default().into(),
        None => p.default.into(),
    };
    Param {
        name: p.name,
        kind,
        unit: p.unit,
        default,
        range: ends(p.range),
        soft: ends(p.soft),
        choices,
        doc: p.doc,
    }
}

fn properties(m: &Model) -> String {
    let words = [
        (m.reciprocal, "reciprocal"),
        (m.energy_conserving, "energy-conserving"),
        (m.anisotropic, "anisotropic"),
        (m.transmissive, "transmissive"),
    ];
    words.iter().filter(|(on, _)| *on).map(|(_, w)| *w).collect::<Vec<_>>().join(", ")
}

fn list() -> String {
    let models: Vec<Model> = ModelKind::all().map(model).collect();
    let wide = models.iter().map(|m| m.name.len()).max().unwrap_or(0);
    let mut out = String::new();
    for m in &models {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{:wide$}  {}", m.name, m.summary);
    }
    let _ = writeln!(out, "\n{} models; `sparrow models NAME` tells all about one", models.len());
    out
}

fn sheet(m: &Model) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}: {}", m.name, m.summary);
    let _ = writeln!(out, "sources     {}", m.sources.join(", "));
    let _ = writeln!(out, "properties  {}", properties(m));
    for l in &m.lacks {
        let when: Vec<String> =
            l.when.iter().map(|(name, of)| format!("{name} is {}", of.join(" or "))).collect();
        let when = if when.is_empty() { String::new() } else { format!(" where {}", when.join(" and ")) };
        let _ = writeln!(out, "lacks       {}{when}: {}", l.property, l.reason);
    }
    let _ = writeln!(out, "parameters{}", if m.parameters.is_empty() { "  none" } else { "" });
    for p in &m.parameters {
        let _ = writeln!(out, "  {}", p.name);
        let _ = writeln!(out, "    {}", p.doc);
        let default = p.default.as_str().map_or_else(|| p.default.to_string(), str::to_owned);
        let line = match p.choices {
            Some(names) => format!("one of {}", names.join(", ")),
            None => format!("{}, unit {}, {}, usual {}", p.kind, p.unit, span(p.range), span(p.soft)),
        };
        let _ = writeln!(out, "    {line}; default {default}");
    }
    out
}

fn span([lo, hi]: [Option<f64>; 2]) -> String {
    let end = |v: Option<f64>| v.map_or("any".to_owned(), |v| v.to_string());
    format!("{} to {}", end(lo), end(hi))
}
