//! The tables of `docs/mis.md`.
//!
//! ```text
//! cargo run --release -p sparrow-render --example mis_lab -- matrix 1000000   # paths per entry
//! cargo run --release -p sparrow-render --example mis_lab -- plates 128       # samples per pixel
//! ```

#![allow(clippy::print_stdout, reason = "it is run to be read")]
#![allow(dead_code, unreachable_pub, reason = "the tests `mis_lab` share its modules")]

mod matrix;
mod plates;

use std::path::Path;

fn main() -> Result<(), String> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let words: Vec<String> = std::env::args().skip(1).collect();
    let number = words.get(1).and_then(|n| n.parse().ok());
    match (words.first().map(String::as_str), number) {
        (Some("matrix"), Some(n)) => print_matrix(&scenes, n),
        (Some("plates"), Some(n)) => print_plates(&scenes, n),
        _ => Err("usage: mis_lab matrix PATHS | plates SAMPLES".to_owned()),
    }
}

fn print_matrix(scenes: &Path, n: u32) -> Result<(), String> {
    let names: Vec<&str> = matrix::COLUMNS.iter().map(|c| c.0).collect();
    println!("| R | alpha | {} | optimal, by quadrature |", names.join(" | "));
    println!("{}", "| --- ".repeat(names.len() + 3) + "|");
    for (radius, r) in matrix::RADII {
        for (alpha, a) in matrix::ALPHAS {
            let mut row = format!("| {r} | {a} |");
            for (_, mis) in matrix::COLUMNS {
                let m = matrix::measure(scenes, r, alpha, mis, n)?;
                row += &format!(" {:.3e} ± {:.0e} |", m.variance, m.error);
            }
            println!("{row} {:.3e} |", matrix::optimal_variance(radius, alpha));
        }
    }
    Ok(())
}

fn print_plates(scenes: &Path, samples: u32) -> Result<(), String> {
    let mut columns = Vec::new();
    for (_, mis) in plates::WAYS {
        columns.push(plates::errors(scenes, [384, 256], mis, samples)?);
    }
    let names: Vec<&str> = plates::WAYS.iter().map(|w| w.0).collect();
    println!("| plate | lamp | {} | balance / better single |", names.join(" | "));
    println!("{}", "| --- ".repeat(names.len() + 3) + "|");
    for plate in 0..4 {
        for lamp in 0..4 {
            let errors: Vec<f64> = columns.iter().map(|c| c[plate][lamp]).collect();
            let cells: Vec<String> = errors.iter().map(|e| format!("{e:.4}")).collect();
            let ratio = errors[2] / errors[0].min(errors[1]);
            println!("| {} | {} | {} | {ratio:.2} |", plate + 1, lamp + 1, cells.join(" | "));
        }
    }
    Ok(())
}
