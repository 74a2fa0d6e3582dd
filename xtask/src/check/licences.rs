//! Licences of everything the workspace depends on.

use std::path::Path;

use super::arrows::cargo_metadata;
use super::{Findings, Source};

/// Licences that ask for no more than a notice. Another one is added here with a reason in the commit.
const ALLOWED: [&str; 12] = [
    "MIT",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "ISC",
    "Zlib",
    "0BSD",
    "BSL-1.0",
    "CC0-1.0",
    "Unicode-3.0",
    "Unlicense",
];

pub(super) fn check(root: &Path, _: &[Source], found: &mut Findings) -> Result<(), String> {
    let all = cargo_metadata(root, &[])?;
    for package in all["packages"].as_array().into_iter().flatten() {
        let name = package["name"].as_str().unwrap_or_default();
        match package["license"].as_str() {
            Some(licence) if allowed(licence) => {}
            Some(licence) => found.fault(format!("{name} comes under `{licence}`")),
            None => found.fault(format!("{name} states no licence")),
        }
    }
    Ok(())
}

/// Whether an SPDX expression can be met with the licences of the list. The old `MIT/Apache-2.0` means OR.
fn allowed(expression: &str) -> bool {
    let spaced = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut rest = &words[..];
    any_of(&mut rest) == Some(true) && rest.is_empty()
}

/// Alternatives: what OR joins.
fn any_of(rest: &mut &[&str]) -> Option<bool> {
    let mut met = all_of(rest)?;
    while let Some((&"OR", tail)) = rest.split_first() {
        *rest = tail;
        met |= all_of(rest)?;
    }
    Some(met)
}

/// What AND joins; it binds closer.
fn all_of(rest: &mut &[&str]) -> Option<bool> {
    let mut met = one(rest)?;
    while let Some((&"AND", tail)) = rest.split_first() {
        *rest = tail;
        met &= one(rest)?;
    }
    Some(met)
}

/// A licence, with its exception, or an expression in parentheses.
fn one(rest: &mut &[&str]) -> Option<bool> {
    let (&first, tail) = rest.split_first()?;
    *rest = tail;
    if first == "(" {
        let met = any_of(rest)?;
        let (&close, tail) = rest.split_first()?;
        *rest = tail;
        return (close == ")").then_some(met);
    }
    let mut name = first.to_owned();
    if let ["WITH", exception, tail @ ..] = rest {
        name = format!("{name} WITH {exception}");
        *rest = tail;
    }
    Some(ALLOWED.contains(&name.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_understood() {
        for yes in ["MIT", "MIT/Apache-2.0", "GPL-3.0 OR MIT", "(MIT OR GPL-3.0) AND Unicode-3.0"] {
            assert!(allowed(yes), "{yes}");
        }
        assert!(allowed("Apache-2.0 WITH LLVM-exception OR Apache-2.0 OR MIT"));
        for no in ["GPL-3.0", "MIT AND GPL-3.0", "(MIT OR GPL-3.0) AND MPL-2.0", "", "MIT OR", "(MIT"] {
            assert!(!allowed(no), "{no}");
        }
    }
}
