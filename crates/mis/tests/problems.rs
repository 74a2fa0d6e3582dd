//! Problems with known answers: variances of every estimator by quadrature and by drawing, against records that were computed
//! apart (`reference/values_mis.py`).

use std::collections::HashSet;
use std::sync::{LazyLock, Mutex, PoisonError};

use serde_json::Value;
use sparrow_math::Real;
use sparrow_mis::{
    Drawn, Heuristic, Moments, PairMoments, Technique, compensate, control_variate, multi_sample, one_sample,
    sharpen, variance_factor,
};
use sparrow_stats::{Mean, Random};

static RECORDS: LazyLock<Vec<Value>> = LazyLock::new(|| {
    serde_json::from_str(include_str!("reference/values_mis.json")).expect("the records are JSON")
});
static ASKED: Mutex<Option<HashSet<String>>> = Mutex::new(None);

/// A number of a record, by a pointer into it.
fn record(id: &str, pointer: &str) -> f64 {
    let r = RECORDS.iter().find(|r| r["id"] == id).unwrap_or_else(|| unreachable!("no record {id}"));
    ASKED
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .get_or_insert_with(HashSet::new)
        .insert(id.to_owned());
    r.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| unreachable!("no {pointer} in {id}"))
}

fn near(got: f64, want: f64, tol: f64, what: &str) {
    assert!((got - want).abs() <= tol * want.abs().max(1e-3), "{what}: {got}, want {want}");
}

/// `int f` over [a, b] with breaks in it: Gauss's rule of five points on many cells.
fn integral(f: &dyn Fn(f64) -> f64, breaks: &[f64]) -> f64 {
    const NODES: [(f64, f64); 5] = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
        (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    const CELLS: u32 = 2000;
    let mut sum = 0.0;
    for ends in breaks.windows(2) {
        let half = 0.5 * (ends[1] - ends[0]) / f64::from(CELLS);
        for k in 0..CELLS {
            let middle = ends[0] + half * f64::from(2 * k + 1);
            sum += NODES.iter().map(|(x, w)| half * w * f(middle + half * x)).sum::<f64>();
        }
    }
    sum
}

/// An integrand and two techniques, one sample each.
struct Problem<'a> {
    f: &'a dyn Fn(f64) -> f64,
    pdf: &'a dyn Fn(f64) -> [f64; 2],
    breaks: &'a [f64],
}

impl Problem<'_> {
    fn weight(&self, h: Heuristic, k: usize, x: f64) -> f64 {
        let all = (self.pdf)(x).map(|pdf| Technique { count: 1.0, pdf });
        h.weight(&all, k)
    }
    /// Variance of the multi-sample estimator, and the means of both parts.
    fn variance(&self, h: Heuristic) -> (f64, [f64; 2]) {
        let part = |k: usize| integral(&|x| self.weight(h, k, x) * (self.f)(x), self.breaks);
        let square = |k: usize| {
            let g = |x: f64| {
                let wf = self.weight(h, k, x) * (self.f)(x);
                if wf.abs() > 0.0 { wf * wf / (self.pdf)(x)[k] } else { 0.0 }
            };
            integral(&g, self.breaks)
        };
        let means = [part(0), part(1)];
        (square(0) + square(1) - means[0] * means[0] - means[1] * means[1], means)
    }
}

fn f_a(x: f64) -> f64 {
    x * x
}
fn pdf_a(x: f64) -> [f64; 2] {
    [1.0, 2.0 * x]
}
const PROBLEM_A: Problem<'_> = Problem { f: &f_a, pdf: &pdf_a, breaks: &[0.0, 0.05, 0.5, 1.0] };

/// Draws by either technique of problem A.
fn draw_a(k: usize, r: &mut Random) -> f64 {
    let u = r.uniform();
    if k == 0 { u } else { u.sqrt() }
}

const HEURISTICS: [(&str, Heuristic); 6] = [
    ("balance", Heuristic::Balance),
    ("power2", Heuristic::Power(2.0)),
    ("power3", Heuristic::Power(3.0)),
    ("cutoff0.1", Heuristic::Cutoff(0.1)),
    ("maximum", Heuristic::Maximum),
    ("average(1/2)", Heuristic::Average),
];

/// Variance over `n` rounds of `estimate`, with its relative standard error.
fn simulate(n: u32, seed: u64, mut estimate: impl FnMut(&mut Random) -> f64) -> (Mean, f64) {
    let mut r = Random::new(seed);
    let mut mean = Mean::default();
    let (mut second, mut fourth) = (0.0, 0.0);
    let values: Vec<f64> = (0..n).map(|_| estimate(&mut r)).collect();
    for v in &values {
        mean.add(*v);
    }
    for v in &values {
        let d = (v - mean.value()).powi(2);
        second += d / f64::from(n);
        fourth += d * d / f64::from(n);
    }
    let error = ((fourth / (second * second) - 1.0) / f64::from(n)).sqrt();
    (mean, error)
}

fn problem_a_by_quadrature() {
    for (name, h) in HEURISTICS {
        let (v, means) = PROBLEM_A.variance(h);
        let id = format!("A.{name}");
        near(v, record(&id, "/value/variance"), 1e-9, &id);
        near(means[0], record(&id, "/value/int w1 f"), 1e-9, &id);
        near(means[1], record(&id, "/value/int w2 f"), 1e-9, &id);
    }
    let (v, means) = PROBLEM_A.variance(Heuristic::Balance);
    near(v, record("A.balance.closed", "/value/variance"), 1e-9, "closed balance");
    near(
        v + means[0].powi(2) + means[1].powi(2),
        record("A.balance.closed", "/value/second_moment"),
        1e-9,
        "second moment",
    );
    near(
        PROBLEM_A.variance(Heuristic::Maximum).0,
        record("A.maximum.closed", "/value"),
        1e-9,
        "closed maximum",
    );
    near(
        PROBLEM_A.variance(Heuristic::Power(2.0)).0,
        record("A.power2.parts", "/value/variance"),
        1e-9,
        "closed power",
    );
    near(integral(&f_a, &[0.0, 1.0]), record("A.setup", "/value/I"), 1e-12, "I");
}

fn problem_a_by_drawing() {
    for (name, h) in HEURISTICS {
        let (mean, error) = simulate(1_000_000, 1, |r| {
            (0..2)
                .map(|by| {
                    let x = draw_a(by, r);
                    multi_sample(h, &[1.0, 1.0], Drawn { by, f: f_a(x), pdf: &pdf_a(x) })
                })
                .sum()
        });
        let want = record(&format!("A.{name}"), "/value/variance");
        near(mean.variance(), want, 5.0 * error, name);
        assert!((mean.value() - 1.0 / 3.0).abs() < 4.0 * mean.standard_error(), "{name}: {mean:?}");
    }
    let (mean, error) = simulate(1_000_000, 2, |r| {
        let by = usize::from(r.uniform() < 0.5);
        let x = draw_a(by, r);
        one_sample(Heuristic::Balance, &[0.5, 0.5], Drawn { by, f: f_a(x), pdf: &pdf_a(x) })
    });
    near(mean.variance(), record("A.one_sample.balance", "/value"), 5.0 * error, "one sample");
    assert!((mean.value() - 1.0 / 3.0).abs() < 4.0 * mean.standard_error(), "one sample: {mean:?}");
}

#[test]
fn counts_that_differ_leave_the_mean_and_forgotten_ones_cost_variance() {
    // One sample of the first technique and four of the second.
    let run = |counts: [f64; 2]| {
        simulate(300_000, 3, |r| {
            let mut sum = 0.0;
            for (by, n) in [(0, 1), (1, 4)] {
                for _ in 0..n {
                    let x = draw_a(by, r);
                    let pdf = pdf_a(x);
                    let all = [0, 1].map(|k| Technique { count: counts[k], pdf: pdf[k] });
                    sum += Heuristic::Balance.weight(&all, by) * f_a(x) / (f64::from(n) * pdf[by]);
                }
            }
            sum
        })
        .0
    };
    let (right, forgotten) = (run([1.0, 4.0]), run([1.0, 1.0]));
    for m in [&right, &forgotten] {
        assert!((m.value() - 1.0 / 3.0).abs() < 4.0 * m.standard_error(), "{m:?}");
    }
    assert!(right.variance() < 0.8 * forgotten.variance(), "{right:?} {forgotten:?}");
}

fn optimal_weights_of_problem_a() {
    // The moments, by quadrature.
    let q = |x: f64| 1.0 + 2.0 * x;
    for i in 0..2 {
        for j in 0..2 {
            let a = integral(&|x| pdf_a(x)[i] * pdf_a(x)[j] / q(x), &[0.0, 1.0]);
            near(a, record("A.optimal", &format!("/value/A/{i}/{j}")), 1e-8, "A");
        }
    }
    let alpha = [0, 1].map(|i| record("A.optimal", &format!("/value/alpha/{i}")));
    let variance = record("A.optimal", "/value/variance");
    let left = |x: f64| (f_a(x) - alpha[0] - alpha[1] * 2.0 * x).powi(2) / q(x);
    near(integral(&left, &[0.0, 1.0]), variance, 1e-7, "variance");

    // Learned from samples.
    let counts = [1.0, 1.0];
    let round = |r: &mut Random, each: &mut dyn FnMut(Drawn<'_>)| {
        for by in 0..2 {
            let x = draw_a(by, r);
            each(Drawn { by, f: f_a(x), pdf: &pdf_a(x) });
        }
    };
    let mut r = Random::new(4);
    let mut moments = Moments::new(&counts);
    for _ in 0..200_000 {
        round(&mut r, &mut |x| moments.add(x));
        moments.end_round();
    }
    let learned = moments.alpha();
    for (got, want) in learned.iter().zip(alpha) {
        assert!((got - want).abs() < 5e-3, "{learned:?}, want {alpha:?}");
    }
    near(learned.iter().sum(), 1.0 / 3.0, 2e-3, "the direct estimate");

    // With alpha fixed the estimate is unbiased, and its variance is the record's; with a poor alpha it is unbiased still.
    for (alpha, want) in [(alpha, Some(variance)), ([0.3, -0.7], None)] {
        let (mean, error) = simulate(500_000, 5, |r| {
            let mut sum: f64 = alpha.iter().sum();
            round(r, &mut |x| sum += control_variate(&counts, &alpha, x));
            sum
        });
        assert!((mean.value() - 1.0 / 3.0).abs() < 4.0 * mean.standard_error(), "{alpha:?}: {mean:?}");
        if let Some(want) = want {
            near(mean.variance(), want, 5.0 * error, "optimal");
        }
    }

    // Progressive: each round by the moments of those before.
    let (rounds, mut moments, mut mean) = (20_000, Moments::new(&counts), Mean::default());
    for k in 0..rounds {
        let alpha = moments.alpha();
        let mut sum: f64 = alpha.iter().sum();
        let mut add = |x: Drawn<'_>| {
            sum += control_variate(&counts, &alpha, x);
            moments.add(x);
        };
        round(&mut r, &mut add);
        moments.end_round();
        // The first rounds know too little of A.
        if k >= 100 {
            mean.add(sum);
        }
    }
    assert!((mean.value() - 1.0 / 3.0).abs() < 4.0 * mean.standard_error(), "progressive: {mean:?}");
    near(mean.variance(), variance, 0.1, "progressive");
}

fn optimal_weights_of_two_techniques_are_one_number() {
    let alpha = [0, 1].map(|i| record("A.optimal", &format!("/value/alpha/{i}")));
    let variance = record("A.optimal", "/value/variance");
    let mut r = Random::new(8);
    let mut pair = || {
        let (mut b, mut z) = (0.0, 0.0);
        for by in 0..2 {
            let x = draw_a(by, &mut r);
            let pdf = pdf_a(x);
            b += multi_sample(Heuristic::Balance, &[1.0; 2], Drawn { by, f: f_a(x), pdf: &pdf });
            let other = pdf[1 - by] / (pdf[0] + pdf[1]);
            z += if by == 0 { other } else { -other };
        }
        (b, z)
    };
    let mut moments = PairMoments::<1>::default();
    for _ in 0..200_000 {
        let (b, z) = pair();
        moments.add([b], z);
    }
    let [c] = moments.slope();
    near(c, alpha[1] - alpha[0], 5e-3, "c");
    let (mean, error) = simulate(500_000, 0, |_| {
        let (b, z) = pair();
        b - c * z
    });
    assert!((mean.value() - 1.0 / 3.0).abs() < 4.0 * mean.standard_error(), "{mean:?}");
    near(mean.variance(), variance, 5.0 * error, "B - c Z");
}

fn problem_b_is_saved_by_the_good_technique() {
    // In s = sqrt x, dx = 2 s ds.
    let f = |s: f64| 1.0 / s;
    let second = integral(
        &|s: f64| {
            let all = [1.0, 0.5 / s].map(|pdf| Technique { count: 1.0, pdf });
            (0..2).map(|k| (Heuristic::Balance.weight(&all, k) * f(s)).powi(2) / all[k].pdf).sum::<f64>()
                * 2.0
                * s
        },
        &[0.0, 1.0],
    );
    near(second, record("B.balance", "/value/second_moment"), 1e-9, "second moment");
    let first = integral(
        &|s: f64| {
            let all = [1.0, 0.5 / s].map(|pdf| Technique { count: 1.0, pdf });
            Heuristic::Balance.weight(&all, 1) * f(s) * 2.0 * s
        },
        &[0.0, 1.0],
    );
    // The record counts the technique that fails as the second: `int x^(-1/2) / (1 + 2 sqrt x) = ln 3` is this one's.
    near(first, record("B.balance", "/value/int w1 f"), 1e-9, "int w1 f");
    near(
        second - first.powi(2) - (2.0 - first).powi(2),
        record("B.balance", "/value/variance"),
        1e-9,
        "variance",
    );
}

fn problem_c_shows_both_faces_of_compensation() {
    // Cells of a tenth: bright in the first.
    let light: Vec<f64> = (0..10).map(|i| if i == 0 { 10.0 } else { 1.0 }).collect();
    let measure = [0.1; 10];
    let mean: f64 = light.iter().sum::<f64>() * 0.1;
    let plain: Vec<f64> = light.iter().map(|l| l / mean).collect();
    let sharp = sharpen(&light, &measure);
    // int f^2 / (1/2 + p / 2) - I^2 for f = L g, g with the given second moment in each cell.
    let variance = |p: &[f64], g2: &dyn Fn(usize) -> f64, i: f64| {
        let cell = |k: usize| light[k] * light[k] * g2(k) / (0.5 + 0.5 * p[k]);
        (0..10).map(cell).sum::<f64>() - i * i
    };
    let flat = |_: usize| 0.1;
    near(
        variance(&plain, &flat, 1.9),
        record("C.compensation", "/value/light pdf proportional to L"),
        1e-12,
        "plain",
    );
    near(
        variance(&sharp, &flat, 1.9),
        record("C.compensation", "/value/compensated: max(0, L-mean)"),
        1e-9,
        "sharp",
    );
    // The best table leaves no variance at all.
    let best = compensate(&light, &[1.0; 10], &measure, 0.5);
    assert!(variance(&best, &flat, 1.9).abs() < 1e-12);
    // g = 2 x: int 4 x^2 over a cell.
    let slope = |k: usize| 4.0 / 3.0 * ((0.1 * (k + 1) as f64).powi(3) - (0.1 * k as f64).powi(3));
    let i = record("C.compensation.g", "/inputs/I");
    near(variance(&plain, &slope, i), record("C.compensation.g", "/value/plain"), 1e-9, "plain g");
    near(variance(&sharp, &slope, i), record("C.compensation.g", "/value/compensated"), 1e-9, "sharp g");
}

/// A sphere light on the axis of a cosine lobe, in `u = 1 - cos`, without the azimuth.
struct Cap {
    one_minus_c: f64,
    n: f64,
}

impl Cap {
    fn pdf(&self, u: f64) -> [f64; 2] {
        [1.0 / self.one_minus_c, (self.n + 1.0) * Real::pow(1.0 - u, self.n)]
    }
}

fn lights_of_all_sizes_on_surfaces_of_all_widths() {
    for (radius, name) in [(0.03333, "0.03333"), (0.1, "0.1"), (0.3, "0.3"), (0.9, "0.9")] {
        for (alpha, word) in [(0.005f64, "0.005"), (0.02, "0.02"), (0.05, "0.05"), (0.1, "0.1")] {
            let id = format!("matrix.R{name}.a{word}");
            let s2: f64 = (radius / 4.0f64).powi(2);
            let cap = Cap { one_minus_c: s2 / (1.0 + (1.0 - s2).sqrt()), n: (0.5 / (alpha * alpha)).round() };
            let lobe = |u: f64| cap.pdf(u)[1];
            let pdf = |u: f64| cap.pdf(u);
            // Where the densities cross, and where the lobe has ended.
            let cross = 1.0 - Real::exp(-Real::ln((cap.n + 1.0) * cap.one_minus_c) / cap.n);
            let mut breaks = vec![0.0];
            breaks.extend([cross, 40.0 / cap.n].into_iter().filter(|b| *b > 0.0 && *b < cap.one_minus_c));
            breaks.push(cap.one_minus_c);
            breaks.sort_by(f64::total_cmp);
            let p = Problem { f: &lobe, pdf: &pdf, breaks: &breaks };
            let i = integral(&lobe, &breaks);
            near(i, record(&id, "/value/I~1Le"), 1e-5, &id);
            for (word, h) in [
                ("balance", Heuristic::Balance),
                ("power2", Heuristic::Power(2.0)),
                ("maximum", Heuristic::Maximum),
            ] {
                let want = record(&id, &format!("/value/V_{word}~1I^2 (1+1 samples)"));
                let got = p.variance(h).0 / (i * i);
                // Tiny variances are differences of numbers near one.
                assert!((got - want).abs() < 1e-4 * want + 1e-9, "{id} {word}: {got}, want {want}");
            }
        }
    }
}

#[test]
fn knowing_the_variances_never_costs_much_and_may_save() {
    // Problem A with the second technique stratified: its samples are far steadier than their densities tell.
    let strata = 16;
    let run = |factors: [f64; 2]| {
        simulate(20_000, 6, |r| {
            let n = f64::from(strata);
            let mut sum = 0.0;
            for by in 0..2 {
                for k in 0..strata {
                    let u = if by == 0 { r.uniform() } else { (f64::from(k) + r.uniform()) / n };
                    let x = if by == 0 { u } else { u.sqrt() };
                    let pdf = pdf_a(x);
                    let all = [0, 1].map(|k| Technique { count: n * factors[k], pdf: pdf[k] });
                    sum += Heuristic::Balance.weight(&all, by) * f_a(x) / (n * pdf[by]);
                }
            }
            sum
        })
        .0
    };
    let alone = |by: usize| {
        simulate(20_000, 7, |r| {
            let n = f64::from(strata);
            let of = |k: i32, r: &mut Random| {
                let u = if by == 0 { r.uniform() } else { (f64::from(k) + r.uniform()) / n };
                let x = if by == 0 { u } else { u.sqrt() };
                f_a(x) / (n * pdf_a(x)[by])
            };
            (0..strata).map(|k| of(k, r)).sum()
        })
        .0
    };
    let factors = [0, 1].map(|k| {
        let m = alone(k);
        variance_factor(m.value(), m.variance())
    });
    let (plain, aware) = (run([1.0, 1.0]), run(factors));
    assert!((aware.value() - 1.0 / 3.0).abs() < 4.0 * aware.standard_error(), "{aware:?}");
    assert!(aware.variance() < 0.05 * plain.variance(), "{aware:?} {plain:?} {factors:?}");
}

/// Beginnings of ids whose records `crates/render/tests/mis_lab.rs` asks for.
const ELSEWHERE: [&str; 1] = ["plates."];

#[test]
fn every_record_is_asked_for_and_holds() {
    problem_a_by_quadrature();
    problem_a_by_drawing();
    optimal_weights_of_problem_a();
    optimal_weights_of_two_techniques_are_one_number();
    problem_b_is_saved_by_the_good_technique();
    problem_c_shows_both_faces_of_compensation();
    lights_of_all_sizes_on_surfaces_of_all_widths();
    let asked = ASKED.lock().unwrap_or_else(PoisonError::into_inner).clone().unwrap_or_default();
    let ids = RECORDS.iter().filter_map(|r| r["id"].as_str());
    let left: Vec<&str> =
        ids.filter(|id| !asked.contains(*id) && !ELSEWHERE.iter().any(|e| id.starts_with(e))).collect();
    assert!(left.is_empty(), "nobody asks for {left:?}");
    assert_eq!(asked.len() + 5, RECORDS.len(), "five records are about the plates");
}
