//! The verifier against models that are wrong on purpose: each has to be found, by the question it violates.

#![allow(clippy::print_stderr, reason = "a test tells what it found")]

mod planted;

use planted::{FAULTS, Planted};
use sparrow_verify::{Options, Pins, Report, Subject, Verdict, verify};

const OPTIONS: Options = Options { samples: 100_000, cases: 4, points: 16, seed: 0, threads: 2 };

fn reports(subjects: &[Planted]) -> Vec<Report> {
    let subjects: Vec<&dyn Subject> = subjects.iter().map(|s| s as &dyn Subject).collect();
    verify(&subjects, &Pins::default(), &OPTIONS, &|_, _| ())
}

#[test]
fn the_model_without_a_fault_holds() {
    for r in reports(&[Planted(None)]) {
        let wrong: Vec<_> = r.rows.iter().filter(|row| row.verdict == Verdict::Fail).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
    }
}

#[test]
fn every_planted_fault_is_found_by_its_question() {
    assert!(FAULTS.len() >= 10);
    let planted: Vec<Planted> = FAULTS.iter().map(|(fault, _)| Planted(Some(*fault))).collect();
    let mut missed = Vec::new();
    for (report, (_, question)) in reports(&planted).iter().zip(FAULTS) {
        let failed = report.failed();
        eprintln!("{}: {failed:?}", report.model);
        if !failed.contains(question) {
            missed.push((report.model, question, failed));
        }
        // What failed says how to see it again.
        for row in report.rows.iter().filter(|r| r.verdict == Verdict::Fail) {
            assert!(row.reproduce.starts_with(report.model) && row.reproduce.contains("wo="), "{row:?}");
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}
