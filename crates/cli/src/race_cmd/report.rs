//! The outcome of a race in words and in JSON.

use serde::Serialize;

use super::RaceArgs;
use super::options::Setting;
use super::runner::Run;
use super::verdict::Verdict;
use crate::failure::Failure;

/// What there is to tell.
pub(super) struct Outcome<'a> {
    pub(super) args: &'a RaceArgs,
    pub(super) settings: &'a [Setting; 2],
    pub(super) runs: &'a [Vec<Run>; 2],
    pub(super) verdict: &'a Verdict,
}

#[derive(Serialize)]
struct JsonSetting<'a> {
    options: &'a str,
    samples_per_pixel: f64,
    cpu_seconds: Vec<f64>,
}

#[derive(Serialize)]
struct JsonOutcome<'a> {
    status: &'static str,
    exit_code: u8,
    version: &'static str,
    scene: String,
    seeds: u32,
    reference: Option<String>,
    settings: [JsonSetting<'a>; 2],
    #[serde(flatten)]
    verdict: &'a Verdict,
}

impl Outcome<'_> {
    fn samples(&self, i: usize) -> f64 {
        mean(self.runs[i].iter().map(|r| r.samples_per_pixel))
    }

    pub(super) fn json(&self) -> Result<String, Failure> {
        let setting = |i: usize| JsonSetting {
            options: &self.settings[i].text,
            samples_per_pixel: self.samples(i),
            cpu_seconds: self.runs[i].iter().map(|r| r.cpu_seconds).collect(),
        };
        let outcome = JsonOutcome {
            status: "done",
            exit_code: 0,
            version: env!("CARGO_PKG_VERSION"),
            scene: self.args.scene.display().to_string(),
            seeds: self.args.seeds,
            reference: self.args.reference.as_ref().map(|p| p.display().to_string()),
            settings: [setting(0), setting(1)],
            verdict: self.verdict,
        };
        serde_json::to_string(&outcome)
            .map_err(|e| Failure::input(format!("the result is no JSON: {e}; please report this")))
    }

    pub(super) fn text(&self) -> String {
        let v = self.verdict;
        let mut text = format!("{:>11} {:>9} {:>10}  options\n", "spp", "CPU s", "relMSE");
        for (i, setting) in self.settings.iter().enumerate() {
            text += &format!(
                "{} {:>9.1} {:>9.2} {:>10.3e}  {}\n",
                setting.name,
                self.samples(i),
                mean(self.runs[i].iter().map(|r| r.cpu_seconds)),
                mean(v.relmse[i].iter().copied()),
                setting.text
            );
        }
        let [low, high] = v.interval;
        text += &format!(
            "efficiency of A over B: {}, 95 % within {} .. {}, {} seeds: {}\n",
            short(v.efficiency_ratio),
            short(low),
            short(high),
            self.args.seeds,
            winner(v.interval)
        );
        let [r, g, b] = v.mean_ratio;
        text += &format!("mean of A over B: {r:.5} {g:.5} {b:.5}, same mean: p = {:.3}\n", v.p_same_mean);
        if v.means_differ {
            text += "warning: the means differ by more than noise: one setting is biased, or finds some light so seldom \
                     that it looks so; the ratio compares different pictures\n";
        }
        text
    }
}

/// Three digits, whatever the size.
fn short(v: f64) -> String {
    if (0.1..1000.0).contains(&v) { format!("{v:.3}") } else { format!("{v:.2e}") }
}

fn winner([low, high]: [f64; 2]) -> &'static str {
    match (low > 1.0, high < 1.0) {
        (true, _) => "A wins",
        (_, true) => "B wins",
        _ => "undecided",
    }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let n = values.len().max(1) as f64;
    values.sum::<f64>() / n
}
