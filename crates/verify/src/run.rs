//! Cases times models on threads: [`verify`].

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use sparrow_math::LocalDir;
use sparrow_models::{Lack, ParamInfo, ParamKind};
use sparrow_stats::{Random, sidak};

use crate::case::{Case, Style};
use crate::integrals::{self, Sizes, Spread, View};
use crate::pins::Pins;
use crate::report::{self, Answered, Finding, Report};
use crate::subject::Subject;
use crate::{edges, furnace, points, tally};

/// Chance of any false alarm among all chi-square tests of a model.
const FALSE_ALARMS: f64 = 1e-4;

/// Sizes, seed and threads of a trial.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Samples per case and column.
    pub samples: usize,
    /// Cases with all questions.
    pub cases: usize,
    /// Further cases, with the questions about single points and edges alone.
    pub points: usize,
    /// What all that is drawn depends on.
    pub seed: u64,
    /// Threads; answers do not depend on them.
    pub threads: usize,
}

impl Default for Options {
    fn default() -> Self {
        Options { samples: 1_000_000, cases: 8, points: 48, seed: 0, threads: 1 }
    }
}

/// One piece of work.
struct Job {
    subject: usize,
    case: Case,
    full: bool,
}

struct Done {
    findings: Vec<Finding>,
    spread: Spread,
    seconds: f64,
}

/// Tries every subject; one report each, in their order. `progress` hears how many of how many cases are done.
///
/// What `pins` names holds in every case, and what it leaves open is at its default; where it names nothing,
/// parameters are drawn from each subject's table.
pub fn verify(
    subjects: &[&dyn Subject],
    pins: &Pins,
    options: &Options,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Vec<Report> {
    let jobs = jobs(subjects, pins, options);
    let done: Vec<Mutex<Option<Done>>> = jobs.iter().map(|_| Mutex::new(None)).collect();
    let (next, finished) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let samples = options.samples.max(1000);
    let sizes = |subject: usize| {
        let tests = 3 * jobs.iter().filter(|j| j.full && j.subject == subject).count();
        Sizes { samples, level: sidak(FALSE_ALARMS, tests) }
    };
    let sizes: Vec<Sizes> = (0..subjects.len()).map(sizes).collect();
    std::thread::scope(|scope| {
        for _ in 0..options.threads.max(1) {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(job) = jobs.get(i) else { break };
                    let answer = work(subjects[job.subject], job, sizes[job.subject], options.seed);
                    if let Ok(mut slot) = done[i].lock() {
                        *slot = Some(answer);
                    }
                    progress(finished.fetch_add(1, Ordering::Relaxed) + 1, jobs.len());
                }
            });
        }
    });
    let answers: Vec<Option<Done>> = done.into_iter().map(|d| d.into_inner().ok().flatten()).collect();
    let report = |(s, subject): (usize, &&dyn Subject)| {
        let mine = jobs.iter().zip(&answers).filter(|(j, _)| j.subject == s);
        let mine: Vec<(&Job, &Done)> = mine.filter_map(|(j, d)| Some((j, d.as_ref()?))).collect();
        let answers: Vec<Answered<'_>> = mine.iter().map(|(j, d)| (&j.case, d.findings.as_slice())).collect();
        Report {
            model: subject.name(),
            samples,
            rows: report::rows(*subject, &answers),
            claims: report::claims(*subject, &answers),
            largest_weight: mine.iter().map(|(_, d)| d.spread.largest).fold(0.0, f64::max),
            least_efficiency: mine.iter().map(|(_, d)| d.spread.efficiency).fold(1.0, f64::min),
            seconds: mine.iter().map(|(_, d)| d.seconds).sum(),
        }
    };
    subjects.iter().enumerate().map(report).collect()
}

/// The cases, long ones first so that threads end together.
fn jobs(subjects: &[&dyn Subject], pins: &Pins, options: &Options) -> Vec<Job> {
    let mut jobs = Vec::new();
    for full in [true, false] {
        for (subject, s) in subjects.iter().enumerate() {
            let names = names(*s);
            let n = match (pins.is_empty(), pins.has_view()) {
                // Many choices take many cases to pair.
                (true, _) if full => options.cases.max(options.cases * names / 16),
                (true, _) => options.points.max(options.points * names / 8),
                // The same parameters from every angle.
                (false, false) if full => options.cases,
                (false, true) if full => 1,
                _ => 0,
            };
            let purpose = if full { "full" } else { "points" };
            for index in 0..n {
                let mut rng = Random::named(options.seed, &format!("{} {purpose} {index}", s.name()));
                let style = match (full, index % 4) {
                    (true, 2) | (false, 2) => Style::White,
                    (true, 0) if index > 0 => Style::White,
                    (false, 1 | 3) => Style::Ends,
                    _ => Style::Common,
                };
                // Points begin where the full cases stop, with other angles.
                let index = if full { index } else { index + 1 };
                let case = Case::draw(s.params(), s.is_fibre(), pins, index, style, &mut rng);
                jobs.push(Job { subject, case, full });
            }
            if !full && pins.is_empty() {
                let cases = claimed(*s, options.seed);
                jobs.extend(cases.into_iter().map(|case| Job { subject, case, full }));
            }
        }
    }
    jobs
}

/// White cases of the choices for which the model says that it lacks something: drawn at random, some would not be met.
fn claimed(subject: &dyn Subject, seed: u64) -> Vec<Case> {
    /// Cases for each claim.
    const EACH: usize = 6;
    let lacks = subject.about().lacks.iter().enumerate().filter(|(_, l)| !l.when.is_empty());
    let case = |claim: usize, lack: &Lack, k: usize| {
        let mut rng = Random::named(seed, &format!("{} claim {claim} {k}", subject.name()));
        let mut case =
            Case::draw(subject.params(), subject.is_fibre(), &Pins::default(), k + 1, Style::White, &mut rng);
        for (parameter, of) in lack.when {
            case.choose(parameter, of[k % of.len()]);
        }
        case
    };
    lacks.flat_map(|(claim, lack)| (0..EACH).map(move |k| case(claim, lack, k))).collect()
}

/// Number of names of all choices together.
fn names(subject: &dyn Subject) -> usize {
    let of = |p: &ParamInfo| match p.kind {
        ParamKind::Choice(names) => names.len(),
        ParamKind::Real | ParamKind::Albedo | ParamKind::Unbounded => 0,
    };
    subject.params().iter().map(of).sum()
}

fn work(subject: &dyn Subject, job: &Job, sizes: Sizes, seed: u64) -> Done {
    let start = Instant::now();
    let columns = subject.columns(&job.case.params);
    let words = job.case.words();
    let wo = job.case.wo();
    let fibre = subject.is_fibre();
    let mut view = View { columns: &columns, wo, eta: 1.0, fibre, seed, words: &words };
    view.eta = crossed_index(&view);
    let mut findings = Vec::new();
    edges::ask(&columns, &mut findings);
    points::ask(&view, &mut findings);
    furnace::ask(&view, &mut findings);
    let mut spread = Spread { largest: 0.0, efficiency: 1.0 };
    if job.full {
        spread = integrals::ask(&view, sizes, &mut findings);
    }
    Done { findings, spread, seconds: start.elapsed().as_secs_f64() }
}

/// The relative index of samples that pass to the other side; 1 where none does.
///
/// Where all that is sampled is reflected, as beyond the critical angle, the way back from the other side tells.
fn crossed_index(view: &View<'_>) -> f64 {
    let Some(double) = view.columns.first() else { return 1.0 };
    let from = |wo: LocalDir<f64>| {
        let mut eta = None;
        tally::stream(&**double, wo, 4096, &mut view.rng("index"), |s| {
            if s.valid && wo.z() * s.wi.z() < 0.0 {
                eta.get_or_insert(s.eta);
            }
        });
        eta
    };
    let back = || Some(1.0 / from(-view.wo)?);
    from(view.wo).or_else(back).unwrap_or(1.0)
}
