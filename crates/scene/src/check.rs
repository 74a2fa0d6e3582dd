//! Checks the parameters of a statement against its table.

use crate::diagnostic::Span;
use crate::lexer::shorten;
use crate::params::{Param, Params, Values};
use crate::report::Report;
use crate::suggest::remedy;
use crate::tables::{Category, Entity, Kind, Row, Support, Use, successor};

/// Finds the entry of a statement's type, and says what becomes of it where it is not simply rendered.
///
/// `None` where the type is unknown or cannot be rendered; the fault has been reported.
pub(crate) fn entity(
    report: &mut Report,
    category: Category,
    name: &str,
    at: Span,
) -> Option<&'static Entity> {
    let noun = category.noun();
    let Some(entity) = category.find(name) else {
        let shown = shorten(name);
        let remedy = match successor(category, name, false) {
            Some(new) => format!("in pbrt-v4 it is \"{new}\""),
            None => remedy(name, category.names()),
        };
        report.error(at, format!("there is no {noun} \"{shown}\"; {remedy}"));
        return None;
    };
    match entity.support {
        Support::Yes => {}
        Support::Instead(what) => {
            report.warn(at, format!("the {noun} \"{name}\" is not supported yet; {what}"));
        }
        Support::Refused(remedy) => {
            report.error(at, format!("the {noun} \"{name}\" is not supported; {remedy}"));
            return None;
        }
    }
    Some(entity)
}

/// Checks names, types and numbers of values; parameters that fail are removed, and the rest is marked as broken.
///
/// `what` names the statement, such as `shape "sphere"`.
pub(crate) fn params<'a>(
    report: &mut Report,
    category: Category,
    what: &str,
    rows: impl Iterator<Item = &'a Row> + Clone,
    params: &mut Params,
) {
    twice(report, what, &params.own);
    let n = params.own.len();
    params.own.retain(|p| {
        let Some(row) = rows.clone().find(|r| r.name == p.name) else {
            let shown = shorten(&p.name);
            let remedy = match successor(category, &p.name, true) {
                Some(new) => format!("in pbrt-v4 it is \"{new}\""),
                None => remedy(&p.name, rows.clone().map(|r| r.name)),
            };
            report.error(p.at, format!("{what} has no parameter \"{shown}\"; {remedy}"));
            return false;
        };
        if !row.kind.types().contains(&p.ty) {
            let (ty, wants) = (p.ty.name(), row.kind.describe());
            let message = format!(
                "\"{}\" of {what} is given as {ty}; it takes {wants}: write \"{} {}\"",
                p.name,
                row.kind.types()[0].name(),
                p.name
            );
            report.error(p.at, message);
            return false;
        }
        match row.used {
            Use::Yes => {}
            Use::NotYet => {
                report.warn(p.at, format!("\"{}\" of {what} is not supported yet; it is ignored", p.name))
            }
            Use::Moot => {}
        }
        count(report, what, row.kind, p)
    });
    params.broken |= params.own.len() < n;
}

/// pbrt-v4 lets the last one count and says nothing.
fn twice(report: &mut Report, what: &str, own: &[Param]) {
    for (i, p) in own.iter().enumerate() {
        if own[..i].iter().any(|o| o.name == p.name && o.ty == p.ty) {
            report.warn(
                p.at,
                format!("\"{}\" of {what} is given twice; the last one counts", shorten(&p.name)),
            );
        }
    }
}

fn count(report: &mut Report, what: &str, kind: Kind, p: &Param) -> bool {
    let n = p.values.len();
    if n == 0 {
        report.error(p.at, format!("\"{}\" of {what} has no value; write one or remove it", p.name));
        return false;
    }
    // The samples of a spectrum are one item.
    let samples = p.ty == crate::tables::Type::Spectrum && matches!(p.values, Values::Floats(_));
    if n > 1 && !kind.is_list() && !samples {
        let ty = p.ty.name();
        report.error(p.at, format!("\"{}\" of {what} has {n} values of type {ty}; it takes one", p.name));
        return false;
    }
    true
}
