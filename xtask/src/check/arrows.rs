//! The crate arrows of ARCHITECTURE.md: who may use whom.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use super::{Findings, Source};

/// Each crate and those it may use. A new arrow is a change of design: it gets a commit of its own and a line in
/// ARCHITECTURE.md.
const ARROWS: [(&str, &[&str]); 13] = [
    ("math", &[]),
    ("spectra", &["math"]),
    ("models", &["spectra", "math"]),
    ("stats", &["math"]),
    ("mis", &["math"]),
    ("groom", &["stats", "math"]),
    ("verify", &["models", "stats", "spectra", "math"]),
    ("plot", &["models", "stats", "spectra", "math"]),
    ("geometry", &["math"]),
    ("image", &["math"]),
    ("scene", &["models", "mis", "spectra", "math"]),
    ("render", &["scene", "geometry", "models", "mis", "image", "spectra", "math"]),
    (
        "lecture",
        &[
            "render", "scene", "image", "geometry", "groom", "plot", "models", "mis", "stats", "spectra",
            "math",
        ],
    ),
];
/// The ends of all arrows: nothing uses them, they may use everything.
const ENDS: [&str; 2] = ["sparrow-cli", "xtask"];
/// Crates that stand without anybody else's code.
const ALONE: [&str; 6] = ["math", "spectra", "models", "stats", "mis", "plot"];

pub(super) fn check(root: &Path, _: &[Source], found: &mut Findings) -> Result<(), String> {
    let workspace = cargo_metadata(root, &["--no-deps"])?;
    for package in workspace["packages"].as_array().into_iter().flatten() {
        let name = package["name"].as_str().unwrap_or_default();
        let used: Vec<&str> = package["dependencies"]
            .as_array()
            .into_iter()
            .flatten()
            // What only tests use points where it likes; `null` stands for an ordinary dependency.
            .filter(|d| d["kind"] != "dev" && d["optional"] != true)
            .filter_map(|d| d["name"].as_str())
            .collect();
        judge(name, &used, found);
    }
    Ok(())
}

fn judge(name: &str, used: &[&str], found: &mut Findings) {
    if ENDS.contains(&name) {
        return;
    }
    let short = name.strip_prefix("sparrow-").unwrap_or(name);
    let Some((_, allowed)) = ARROWS.iter().find(|(n, _)| *n == short) else {
        found.fault(format!("{name} has no row among the arrows; add one here and in ARCHITECTURE.md"));
        return;
    };
    for dependency in used {
        match dependency.strip_prefix("sparrow-") {
            Some(own) if allowed.contains(&own) => {}
            Some(_) => found.fault(format!("{name} uses {dependency}, which no arrow allows")),
            None if ALONE.contains(&short) => {
                found.fault(format!("{name} requires {dependency}; it must stand alone"));
            }
            None => {}
        }
    }
}

/// The answer of `cargo metadata`.
pub(super) fn cargo_metadata(root: &Path, args: &[&str]) -> Result<Value, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--locked"])
        .args(args)
        .current_dir(root)
        .output()
        .map_err(|e| format!("cargo metadata: {e}"))?;
    if !output.status.success() {
        return Err(format!("cargo metadata: {}", String::from_utf8_lossy(&output.stderr).trim()));
    }
    serde_json::from_slice(&output.stdout).map_err(|e| format!("cargo metadata: {e}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(name: &str, used: &[&str]) -> usize {
        let mut found = Findings::default();
        judge(name, used, &mut found);
        found.faults.len()
    }

    #[test]
    fn arrows_point_one_way() {
        assert_eq!(faults("sparrow-render", &["sparrow-scene", "rayon"]), 0);
        assert_eq!(faults("sparrow-scene", &["sparrow-render"]), 1);
        assert_eq!(faults("sparrow-models", &["sparrow-math", "rayon"]), 1);
        assert_eq!(faults("sparrow-unheard", &[]), 1);
        assert_eq!(faults("sparrow-cli", &["sparrow-render", "clap"]), 0);
    }

    #[test]
    fn the_table_has_no_circle() {
        for (i, (name, allowed)) in ARROWS.iter().enumerate() {
            for a in *allowed {
                assert!(ARROWS[..i].iter().any(|(n, _)| n == a), "{name} may use {a}, which comes later");
            }
        }
    }
}
