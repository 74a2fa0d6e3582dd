//! Every registered model, because it is registered: the trial of `sparrow verify --all`, with fewer samples and cases.

use sparrow_models::ModelKind;
use sparrow_verify::{ColumnName, Options, Pins, Question, Subject, Verdict, verify};

/// Fibres whose value is a sum over the width: each takes as long as ten others.
const SUMS: [&str; 3] = ["marschner", "zinke_weber", "deon"];
/// Fibres whose far field is such a sum: the whole trial asks their near field.
const FAR_SUMS: [&str; 2] = ["hair", "fur"];
/// Fibres whose value is a sum over the width of sums over facets, which take five times as long again.
const DOUBLE_SUMS: [&str; 2] = ["elliptical_hair", "microfacet_hair"];

#[test]
fn every_registered_model_holds() {
    let kinds: Vec<ModelKind> = ModelKind::all().collect();
    let subjects: Vec<&dyn Subject> = kinds.iter().map(|k| k as &dyn Subject).collect();
    let (sums, closed): (Vec<_>, Vec<_>) = subjects.into_iter().partition(|s| SUMS.contains(&s.name()));
    let (double_sums, closed): (Vec<_>, Vec<_>) =
        closed.into_iter().partition(|s| DOUBLE_SUMS.contains(&s.name()));
    let (far_sums, closed): (Vec<_>, Vec<_>) = closed.into_iter().partition(|s| FAR_SUMS.contains(&s.name()));
    let found = [sums.len(), double_sums.len(), far_sums.len()];
    assert_eq!(found, [SUMS.len(), DOUBLE_SUMS.len(), FAR_SUMS.len()]);
    let options = Options { samples: 100_000, cases: 4, points: 24, seed: 1, threads: 2 };
    let mut reports = verify(&closed, &Pins::default(), &options, &|_, _| ());
    let in_field =
        |s: &dyn Subject, field: &str| Pins::parse_for(s, &[field]).expect("the fibre has two fields");
    for &s in &far_sums {
        reports.extend(verify(&[s], &in_field(s, "field=near"), &options, &|_, _| ()));
    }
    let fewer = Options { samples: 12_000, cases: 2, points: 4, ..options };
    reports.extend(verify(&sums, &Pins::default(), &fewer, &|_, _| ()));
    // Of one case each a single thread can work: side by side.
    let fewest = Options { samples: 8_000, cases: 1, threads: 1, ..fewer };
    let far = far_sums.iter().map(|s| (*s, in_field(*s, "field=far")));
    let dear: Vec<(&dyn Subject, Pins)> =
        double_sums.into_iter().map(|s| (s, Pins::default())).chain(far).collect();
    std::thread::scope(|scope| {
        let running = dear.iter().map(|(s, pins)| scope.spawn(|| verify(&[*s], pins, &fewest, &|_, _| ())));
        for one in running.collect::<Vec<_>>() {
            reports.extend(one.join().expect("a trial does not panic"));
        }
    });
    assert_eq!(reports.len(), kinds.len() + far_sums.len());
    let mut wrong = Vec::new();
    for report in &reports {
        for row in &report.rows {
            if row.verdict == Verdict::Fail {
                wrong.push(format!(
                    "{:?} in {:?}: {}; {}",
                    row.question, row.column, row.measured, row.reproduce
                ));
            }
            // A question that is not asked does not hold. Mirrors have no density to ask about.
            let of_density = matches!(
                row.question,
                Question::Density | Question::Samples | Question::Pdf | Question::Weight | Question::Mean
            );
            let mirror = matches!(report.model, "thin_dielectric" | "mirror_cylinder");
            let asked = row.verdict != Verdict::NotAsked;
            let both_ways = row.question == Question::Agreement && row.column == ColumnName::F64;
            let reciprocal = row.question == Question::Reciprocity;
            assert!(asked || both_ways || mirror && (of_density || reciprocal), "{} {row:?}", report.model);
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
