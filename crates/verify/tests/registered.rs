//! Every registered model, because it is registered.

#![allow(clippy::print_stderr, reason = "a test tells what it found")]

use sparrow_models::SurfaceKind;
use sparrow_verify::{Options, Pins, Subject, Verdict, verify};

#[test]
fn every_registered_model_holds() {
    let subjects: Vec<&dyn Subject> = SurfaceKind::ALL.iter().map(|k| k as &dyn Subject).collect();
    let options = Options { samples: 200_000, cases: 8, points: 48, threads: 2, ..Options::default() };
    let reports = verify(&subjects, &Pins::default(), &options, &|_, _| ());
    for r in &reports {
        eprintln!(
            "{} {:.2} s, largest weight {:.3}, efficiency {:.4}",
            r.model, r.seconds, r.largest_weight, r.least_efficiency
        );
        for row in &r.rows {
            if row.verdict != Verdict::NotAsked {
                eprintln!(
                    "  {:?} {:?} {:?} {:.3} {} | {}",
                    row.question, row.column, row.verdict, row.severity, row.measured, row.reproduce
                );
            }
        }
    }
    assert!(reports.iter().all(sparrow_verify::Report::holds));
}
