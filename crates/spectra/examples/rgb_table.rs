//! Writes the table that turns sRGB into spectra: `crates/spectra/src/data/rgb_srgb.bin`.
//!
//! Run from the workspace root: `cargo run --release -p sparrow-spectra --example rgb_table`

use std::path::Path;

use sparrow_spectra::{ColorSpace, table_bytes};

fn main() -> std::io::Result<()> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/data/rgb_srgb.bin");
    std::fs::write(path, table_bytes(ColorSpace::Srgb))
}
