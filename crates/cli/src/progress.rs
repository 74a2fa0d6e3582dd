//! How far a render is: a bar on a terminal, a line now and then elsewhere.

use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use sparrow_render::Progress;

use crate::console;
use crate::report::{clock, si};

/// Time between two redraws of the bar, in milliseconds.
const REDRAW_MS: u64 = 100;
/// Time between two lines where there is no terminal, in milliseconds.
const LINE_MS: u64 = 5000;
/// Steps of the bar.
const STEPS: u64 = 1000;

/// Tells how far a render is, on standard error.
pub(crate) struct Watch {
    bar: Option<ProgressBar>,
    quiet: bool,
    limit: Option<Duration>,
    /// When something was shown last, in milliseconds since the start.
    shown: AtomicU64,
}

impl Watch {
    /// For a render that ends after `limit` at the latest.
    pub(crate) fn new(quiet: bool, limit: Option<Duration>) -> Watch {
        let bar = (!quiet && io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template("{bar:24} {percent:>3} %  {msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Watch { bar, quiet, limit, shown: AtomicU64::new(0) }
    }

    /// Takes the news of a tile; cheap where there is nothing to show yet. Called from all threads.
    pub(crate) fn update(&self, p: Progress) {
        if self.quiet {
            return;
        }
        let now = u64::try_from(p.elapsed.as_millis()).unwrap_or(u64::MAX);
        let pause = if self.bar.is_some() { REDRAW_MS } else { LINE_MS };
        let shown = self.shown.load(Ordering::Relaxed);
        let due = now >= shown.saturating_add(pause);
        // One thread wins and shows it.
        if !due || self.shown.compare_exchange(shown, now, Ordering::Relaxed, Ordering::Relaxed).is_err() {
            return;
        }
        let share = self.share(&p);
        match &self.bar {
            Some(bar) => {
                bar.set_position((share * STEPS as f64) as u64);
                bar.set_message(rates(&p, share));
            }
            None => console::log(format!("{:3.0} %, {}", 100.0 * share, rates(&p, share))),
        }
    }

    /// Part of the work that is done: of the samples, or of the time where that ends first.
    fn share(&self, p: &Progress) -> f64 {
        let samples = p.samples as f64 / p.samples_total.max(1) as f64;
        let time = self.limit.map_or(0.0, |l| p.elapsed.as_secs_f64() / l.as_secs_f64());
        samples.max(time).clamp(0.0, 1.0)
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn rates(p: &Progress, share: f64) -> String {
    let seconds = p.elapsed.as_secs_f64().max(1e-9);
    let left = if share > 0.0 { clock(seconds * (1.0 - share) / share) } else { "?".to_owned() };
    let (samples, rays) = (si(p.samples as f64 / seconds), si(p.rays as f64 / seconds));
    format!("{samples}samples/s, {rays}rays/s, {left} left")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearer_end_counts() {
        let p = Progress { samples: 25, samples_total: 100, rays: 50, elapsed: Duration::from_secs(5) };
        let share = |limit: Option<u64>| Watch::new(true, limit.map(Duration::from_secs)).share(&p);
        assert!((share(None) - 0.25).abs() < 1e-12);
        assert!((share(Some(10)) - 0.5).abs() < 1e-12);
        assert!((share(Some(100)) - 0.25).abs() < 1e-12);
        assert_eq!(rates(&p, 0.25), "5.0 samples/s, 10.0 rays/s, 0:15 left");
    }
}
