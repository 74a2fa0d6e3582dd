//! How far a build or a render is: a bar on a terminal, a line now and then elsewhere.

use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use sparrow_geometry::BuildProgress;
use sparrow_render::Progress;

use crate::console;
use crate::report::{clock, si};

/// Time between two redraws of the bar, in milliseconds.
const REDRAW_MS: u64 = 100;
/// Time between two lines where there is no terminal, in milliseconds.
const LINE_MS: u64 = 5000;
/// Builds that take less are not talked of, in milliseconds.
const SHORT_MS: u64 = 1000;
/// Steps of the bar.
const STEPS: u64 = 1000;

/// What shows how far something is, on standard error.
struct Display {
    bar: Option<ProgressBar>,
    quiet: bool,
    /// When something is shown next, in milliseconds since the start.
    next: AtomicU64,
}

impl Display {
    /// Nothing is shown before `first`, in milliseconds since the start.
    fn new(quiet: bool, first: u64) -> Display {
        let bar = (!quiet && io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template("{bar:24} {percent:>3} %  {msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Display { bar, quiet, next: AtomicU64::new(first) }
    }
    /// Shows a share of the work, and what `text` says, if it is time for it. Called from all threads; cheap where it is not.
    fn show(&self, elapsed: Duration, share: f64, text: impl FnOnce() -> String) {
        if self.quiet {
            return;
        }
        let now = u64::try_from(elapsed.as_millis()).unwrap_or(u64::MAX);
        let pause = if self.bar.is_some() { REDRAW_MS } else { LINE_MS };
        let next = self.next.load(Ordering::Relaxed);
        let after = now.saturating_add(pause);
        // One thread wins and shows it.
        if now < next
            || self.next.compare_exchange(next, after, Ordering::Relaxed, Ordering::Relaxed).is_err()
        {
            return;
        }
        match &self.bar {
            Some(bar) => {
                bar.set_position((share * STEPS as f64) as u64);
                bar.set_message(text());
            }
            None => console::log(format!("{:3.0} %, {}", 100.0 * share, text())),
        }
    }
    /// Takes the bar away.
    fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Tells how far the hierarchy of a scene is, where that takes long.
pub(crate) struct BuildWatch {
    display: Display,
    start: Instant,
}

impl BuildWatch {
    pub(crate) fn new(quiet: bool) -> BuildWatch {
        BuildWatch { display: Display::new(quiet, SHORT_MS), start: Instant::now() }
    }
    /// Takes the news of a part; called from all threads.
    pub(crate) fn update(&self, p: BuildProgress) {
        let share = p.placed as f64 / p.total.max(1) as f64;
        self.display.show(self.start.elapsed(), share, || built(&p));
    }
    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.display.finish();
    }
}

fn built(p: &BuildProgress) -> String {
    format!("building a hierarchy over {} primitives", si(p.total as f64).trim_end())
}

/// Tells how far a render is.
pub(crate) struct Watch {
    display: Display,
    limit: Option<Duration>,
}

impl Watch {
    /// For a render that ends after `limit` at the latest.
    pub(crate) fn new(quiet: bool, limit: Option<Duration>) -> Watch {
        // A bar stands at once, lines come after a while.
        let first = if io::stderr().is_terminal() { 0 } else { LINE_MS };
        Watch { display: Display::new(quiet, first), limit }
    }

    /// Takes the news of a tile; called from all threads.
    pub(crate) fn update(&self, p: Progress) {
        let share = self.share(&p);
        self.display.show(p.elapsed, share, || rates(&p, share));
    }

    /// Part of the work that is done: of the samples, or of the time where that ends first.
    fn share(&self, p: &Progress) -> f64 {
        let samples = p.samples as f64 / p.samples_total.max(1) as f64;
        let time = self.limit.map_or(0.0, |l| p.elapsed.as_secs_f64() / l.as_secs_f64());
        samples.max(time).clamp(0.0, 1.0)
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.display.finish();
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
        let built = built(&BuildProgress { placed: 3, total: 2_500_000 });
        assert_eq!(built, "building a hierarchy over 2.50 M primitives");
    }
}
