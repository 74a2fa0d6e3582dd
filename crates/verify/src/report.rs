//! Findings of single cases, and the report they add up to.

use serde::Serialize;
use sparrow_models::Lack;

use crate::case::Case;
use crate::question::{ColumnName, Question};
use crate::subject::Subject;

/// What the answer amounts to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "verdict", content = "reason", rename_all = "snake_case")]
pub enum Verdict {
    /// It holds in every case.
    Pass,
    /// It does not hold, and the model does not say so.
    Fail,
    /// It does not hold, as the model says of the choices made there, for this reason.
    Known(&'static str),
    /// It makes no sense here: no column, no lobe with a density.
    NotAsked,
}

/// One question in one column over all cases.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// What was asked.
    pub question: Question,
    /// In which number type.
    pub column: ColumnName,
    /// The answer.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// Number of cases asked.
    pub cases: usize,
    /// How far the worst case went, in units of what is allowed; above 1 it fails. At most 1e9.
    pub severity: f64,
    /// What was measured there.
    pub measured: String,
    /// How to ask that case alone: arguments of `sparrow verify`.
    pub reproduce: String,
}

/// A lack that a model claims, and what the cases say to that.
#[derive(Clone, Debug, Serialize)]
pub struct Claim {
    /// What is missing.
    pub property: &'static str,
    /// Why, as the model says.
    pub reason: &'static str,
    /// Cases with choices for which it is claimed.
    pub cases: usize,
    /// Those of them where it was found missing.
    pub found: usize,
}

/// All that was asked of one model.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Its name.
    pub model: &'static str,
    /// Samples per case and column.
    pub samples: usize,
    /// Every question in every column, in the order of [`Question::ALL`] and [`ColumnName::ALL`].
    pub rows: Vec<Row>,
    /// Every lack that the model claims.
    pub claims: Vec<Claim>,
    /// Largest weight of a sample, in `f64`.
    pub largest_weight: f64,
    /// Samples of equal weight that are worth as much as one sample, in the worst case, in `f64`.
    pub least_efficiency: f64,
    /// Time of all threads together, in seconds.
    pub seconds: f64,
}

impl Report {
    /// Nothing failed; what the model says it lacks is no failure.
    pub fn holds(&self) -> bool {
        self.rows.iter().all(|r| r.verdict != Verdict::Fail)
    }
    /// The questions that failed, in any column.
    pub fn failed(&self) -> Vec<Question> {
        let mut q: Vec<_> =
            self.rows.iter().filter(|r| r.verdict == Verdict::Fail).map(|r| r.question).collect();
        q.dedup();
        q
    }
}

/// One answer in one case.
#[derive(Clone, Debug)]
pub(crate) struct Finding {
    pub(crate) question: Question,
    pub(crate) column: ColumnName,
    pub(crate) severity: f64,
    pub(crate) measured: String,
}

impl Finding {
    pub(crate) fn new(question: Question, column: ColumnName, severity: f64, measured: String) -> Finding {
        // Files of JSON have no infinity.
        let severity = if severity.is_nan() { 1e9 } else { severity.clamp(0.0, 1e9) };
        Finding { question, column, severity, measured }
    }
}

/// A case and the answers there.
pub(crate) type Answered<'a> = (&'a Case, &'a [Finding]);

/// Every question in every column. Cases for which the model says that it lacks what is asked are judged apart, so that they do
/// not hide what fails elsewhere.
pub(crate) fn rows(subject: &dyn Subject, answers: &[Answered<'_>]) -> Vec<Row> {
    let mut rows = Vec::new();
    for question in Question::ALL {
        for column in ColumnName::ALL {
            let mut cases = 0;
            let (mut open, mut excused) = (None, None);
            for (case, findings) in answers {
                let excuse = lacks(subject, case, question).next();
                let worst = if excuse.is_some() { &mut excused } else { &mut open };
                let mine = || findings.iter().filter(|f| f.question == question && f.column == column);
                cases += usize::from(mine().next().is_some());
                for f in mine() {
                    if worst.as_ref().is_none_or(|w: &Worst<'_>| f.severity > w.finding.severity) {
                        *worst = Some(Worst { finding: f, case, excuse });
                    }
                }
            }
            rows.push(row(subject, question, column, cases, [open, excused]));
        }
    }
    rows
}

/// The worst of some cases.
struct Worst<'a> {
    finding: &'a Finding,
    case: &'a Case,
    excuse: Option<&'static Lack>,
}

fn row(
    subject: &dyn Subject,
    question: Question,
    column: ColumnName,
    cases: usize,
    [open, excused]: [Option<Worst<'_>>; 2],
) -> Row {
    let beyond = |w: &Worst<'_>| w.finding.severity > 1.0;
    let shown = match (open, excused) {
        (Some(o), Some(e)) if !beyond(&o) && beyond(&e) => Some(e),
        (open, excused) => open.or(excused),
    };
    let verdict = match &shown {
        None => Verdict::NotAsked,
        Some(w) if !beyond(w) => Verdict::Pass,
        Some(w) => w.excuse.map_or(Verdict::Fail, |lack| Verdict::Known(lack.reason)),
    };
    let words = |w: &Worst<'_>| format!("{} {}", subject.name(), w.case.words());
    Row {
        question,
        column,
        verdict,
        cases,
        severity: shown.as_ref().map_or(0.0, |w| w.finding.severity),
        measured: shown.as_ref().map_or_else(String::new, |w| w.finding.measured.clone()),
        reproduce: shown.as_ref().map_or_else(String::new, words),
    }
}

/// What the model says it lacks of what is asked, with the choices of the case.
fn lacks(subject: &dyn Subject, case: &Case, question: Question) -> impl Iterator<Item = &'static Lack> {
    let property = question.property();
    let (table, choices) = (subject.params(), case.params.choices);
    let all = subject.about().lacks.iter();
    all.filter(move |l| Some(l.property) == property && l.applies(table, &choices))
}

/// How often each lack that the model claims was found.
pub(crate) fn claims(subject: &dyn Subject, answers: &[Answered<'_>]) -> Vec<Claim> {
    let claim = |lack: &'static Lack| {
        let mine = answers.iter().filter(|(c, _)| lack.applies(subject.params(), &c.params.choices));
        let missing = |f: &Finding| f.question.property() == Some(lack.property) && f.severity > 1.0;
        Claim {
            property: lack.property.name(),
            reason: lack.reason,
            cases: mine.clone().count(),
            found: mine.filter(|(_, findings)| findings.iter().any(missing)).count(),
        }
    };
    subject.about().lacks.iter().map(claim).collect()
}
