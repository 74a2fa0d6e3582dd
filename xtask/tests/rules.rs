//! The rules of the repository hold: `cargo run -p xtask -- check`, as a test.

use std::path::Path;

#[test]
fn all_checks_pass() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a package lies in its workspace");
    match xtask::check::run(root) {
        Ok(report) => println!("{report}"),
        Err(report) => panic!("\n{report}"),
    }
}
