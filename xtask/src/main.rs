//! The command line of the workspace's own tasks.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

const USAGE: &str = "usage: cargo run -p xtask -- check | assets";

#[allow(clippy::print_stdout, reason = "a command reports to its user")]
fn main() -> ExitCode {
    // As cargo says now: a build folder may serve several checkouts.
    let package = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let root = package.as_deref().and_then(Path::parent).unwrap_or_else(|| Path::new("."));
    let task: Vec<String> = std::env::args().skip(1).collect();
    let result = match task.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["check"] => xtask::check::run(root),
        ["assets"] => xtask::assets::write(&root.join("scenes")),
        _ => Err(USAGE.to_owned()),
    };
    match result {
        Ok(report) => {
            println!("{report}");
            ExitCode::SUCCESS
        }
        Err(report) => {
            eprintln!("{report}");
            ExitCode::FAILURE
        }
    }
}
