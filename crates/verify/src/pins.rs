//! What the user names on the command line: [`Pins`].

use sparrow_models::suggest::remedy;
use sparrow_models::{ParamInfo, ParamKind};
use sparrow_spectra::N_LAMBDA;

use crate::subject::Subject;

/// A parameter on the command line that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PinError {
    /// Not of the form `NAME=VALUE`.
    #[error("`{0}` is no parameter; write NAME=VALUE")]
    Form(String),
    /// The model has no such parameter.
    #[error("no parameter `{name}`; {remedy}")]
    Unknown {
        /// The name given.
        name: String,
        /// What to do about it.
        remedy: String,
    },
    /// The value cannot be read.
    #[error("`{name}={value}`: give {form}")]
    Value {
        /// The name given.
        name: String,
        /// The value given.
        value: String,
        /// What would be accepted.
        form: String,
    },
}

/// What the user named: parameters in the order of the table, and the view in degrees.
#[derive(Clone, Debug, Default)]
pub struct Pins {
    pub(crate) values: Vec<Option<Pin>>,
    pub(crate) view: Option<[f64; 2]>,
    pub(crate) h: Option<f64>,
}

/// A value that was named.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Pin {
    Real(f64),
    Spectrum([f64; N_LAMBDA]),
    Choice(u8),
}

impl Pins {
    /// As [`parse`](Self::parse); a fibre takes `h=OFFSET` besides, the offset of the ray in radii.
    ///
    /// # Errors
    /// Where a name is unknown, or a value is none or out of range.
    pub fn parse_for(subject: &dyn Subject, words: &[impl AsRef<str>]) -> Result<Pins, PinError> {
        let mut h = None;
        let mut rest: Vec<&str> = Vec::new();
        for word in words.iter().map(AsRef::as_ref) {
            match word.strip_prefix("h=").filter(|_| subject.is_fibre()) {
                Some(value) => {
                    let offset = numbers(value).filter(|v| v.len() == 1 && (-1.0..=1.0).contains(&v[0]));
                    let wrong = || PinError::Value {
                        name: "h".to_owned(),
                        value: value.to_owned(),
                        form: "a number from -1 to 1".to_owned(),
                    };
                    h = Some(offset.ok_or_else(wrong)?[0]);
                }
                None => rest.push(word),
            }
        }
        Ok(Pins { h, ..Pins::parse(subject.params(), &rest)? })
    }
    /// Reads `NAME=VALUE`: a number, four numbers with commas for the wavelengths of a spectrum, a name of a choice;
    /// `wo=THETA,PHI` in degrees is the view.
    ///
    /// # Errors
    /// Where a name is unknown, or a value is none or out of range.
    pub fn parse(table: &[ParamInfo], words: &[impl AsRef<str>]) -> Result<Pins, PinError> {
        let mut pins = Pins { values: vec![None; table.len()], view: None, h: None };
        for word in words {
            let word = word.as_ref();
            let (name, value) = word.split_once('=').ok_or_else(|| PinError::Form(word.to_owned()))?;
            let wrong =
                |form: String| PinError::Value { name: name.to_owned(), value: value.to_owned(), form };
            if name == "wo" {
                let angles = numbers(value).filter(|v| v.len() == 2 && (0.0..=180.0).contains(&v[0]));
                let angles =
                    angles.ok_or_else(|| wrong("THETA,PHI in degrees, THETA from 0 to 180".into()))?;
                pins.view = Some([angles[0], angles[1]]);
                continue;
            }
            let Some(i) = table.iter().position(|p| p.name == name) else {
                let known = table.iter().map(|p| p.name).chain(["wo"]);
                return Err(PinError::Unknown { name: name.to_owned(), remedy: remedy(name, known) });
            };
            pins.values[i] = Some(pin(&table[i], value).ok_or_else(|| wrong(form(&table[i])))?);
        }
        Ok(pins)
    }
    /// Nothing was named.
    pub fn is_empty(&self) -> bool {
        self.view.is_none() && self.h.is_none() && self.values.iter().all(Option::is_none)
    }
    /// The view was named.
    pub(crate) fn has_view(&self) -> bool {
        self.view.is_some()
    }
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(|v| v.trim().parse().ok().filter(|v: &f64| v.is_finite())).collect()
}

fn pin(info: &ParamInfo, value: &str) -> Option<Pin> {
    if let ParamKind::Choice(names) = info.kind {
        return names.iter().position(|n| *n == value).map(|k| Pin::Choice(k as u8));
    }
    let v = numbers(value)?;
    // Single precision may round a bound to just beyond it.
    let slack = |b: f64| 1e-6 * b.abs();
    if v.iter()
        .any(|v| *v < info.range[0] - slack(info.range[0]) || *v > info.range[1] + slack(info.range[1]))
    {
        return None;
    }
    match (info.kind, v.as_slice()) {
        (ParamKind::Real, [v]) => Some(Pin::Real(*v)),
        (ParamKind::Albedo | ParamKind::Unbounded, [v]) => Some(Pin::Spectrum([*v; N_LAMBDA])),
        (ParamKind::Albedo | ParamKind::Unbounded, [a, b, c, d]) => Some(Pin::Spectrum([*a, *b, *c, *d])),
        _ => None,
    }
}

fn form(info: &ParamInfo) -> String {
    let [lo, hi] = info.range;
    match info.kind {
        ParamKind::Real => format!("a number from {lo} to {hi}"),
        ParamKind::Albedo | ParamKind::Unbounded => {
            format!("a number from {lo} to {hi}, or four with commas")
        }
        ParamKind::Choice(names) => format!("one of {}", names.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &[ParamInfo] = &[
        ParamInfo::real("alpha").default(0.2),
        ParamInfo::albedo("rho"),
        ParamInfo::choice("kind", &["one", "two"]),
    ];

    #[test]
    fn what_cannot_be_read_is_told() {
        let told = |w: &str| Pins::parse(TABLE, &[w]).unwrap_err().to_string();
        assert_eq!(told("alpha"), "`alpha` is no parameter; write NAME=VALUE");
        assert_eq!(told("alpah=1"), "no parameter `alpah`; did you mean \"alpha\"?");
        assert_eq!(told("shine=1"), "no parameter `shine`; known are alpha, kind, rho, wo");
        assert_eq!(told("alpha=2"), "`alpha=2`: give a number from 0 to 1");
        assert_eq!(told("rho=1,0"), "`rho=1,0`: give a number from 0 to 1, or four with commas");
        assert_eq!(told("kind=three"), "`kind=three`: give one of one, two");
        assert!(told("wo=200,0").contains("THETA,PHI"));
    }
}
