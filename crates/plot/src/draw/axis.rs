//! Axes: a range, a scale, the ticks: [`Axis`].

use super::ticks;

/// How numbers become places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// In proportion.
    Linear,
    /// In proportion to the logarithm.
    Log,
}

/// A mark of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// The number.
    pub at: f64,
    /// What is written there; empty for a mark without a number.
    pub label: String,
}

/// An axis; its ticks lie within its range.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Quantity and unit.
    pub title: String,
    /// Least number, above zero for a logarithmic scale.
    pub lo: f64,
    /// Greatest number, above `lo`.
    pub hi: f64,
    /// How numbers become places.
    pub scale: Scale,
    /// Marks, in rising order.
    pub ticks: Vec<Tick>,
}

impl Axis {
    /// From `lo` to `hi` with ticks at multiples of 1, 2 or 5 times a power of ten; the range is widened to such numbers.
    pub fn linear(title: &str, lo: f64, hi: f64, n: usize) -> Axis {
        let (lo, hi) = sound(lo, hi);
        let step = ticks::nice_step(hi - lo, n);
        let lo = (lo / step + 1e-9).floor() * step;
        let hi = (hi / step - 1e-9).ceil() * step;
        Axis::with_step(title, lo, hi, step)
    }
    /// The same, the range left as it is.
    pub fn fixed(title: &str, lo: f64, hi: f64, n: usize) -> Axis {
        let (lo, hi) = sound(lo, hi);
        Axis::with_step(title, lo, hi, ticks::nice_step(hi - lo, n))
    }
    /// Angles in degrees, with ticks at divisors of a right angle.
    pub fn degrees(title: &str, lo: f64, hi: f64) -> Axis {
        let step = if hi - lo > 200.0 {
            45.0
        } else if hi - lo > 100.0 {
            30.0
        } else {
            15.0
        };
        Axis::with_step(title, lo, hi, step)
    }
    fn with_step(title: &str, lo: f64, hi: f64, step: f64) -> Axis {
        let tick = |at: f64| Tick { at, label: ticks::label(at, step) };
        let ticks = ticks::multiples(lo, hi, step).into_iter().map(tick).collect();
        Axis { title: title.to_owned(), lo, hi, scale: Scale::Linear, ticks }
    }
    /// Logarithmic, both ends above zero and widened to 1, 2 or 5 times a power of ten, with about `n` ticks.
    pub fn log(title: &str, lo: f64, hi: f64, n: usize) -> Axis {
        let (lo, hi) = if lo > 1e-100 && hi >= lo && hi < 1e100 { (lo, hi) } else { (0.1, 1.0) };
        let steps = |k: i32| [1.0, 2.0, 5.0, 10.0].map(|m| m * ticks::pow10(k));
        let below = steps(ticks::decade_below(lo)).into_iter().rev().find(|v| *v <= lo * (1.0 + 1e-9));
        let above = steps(ticks::decade_below(hi)).into_iter().find(|v| *v >= hi * (1.0 - 1e-9));
        let (lo, hi) = (below.unwrap_or(lo), above.unwrap_or(hi));
        let hi = if hi < 1.9 * lo { 10.0 * lo } else { hi };
        Axis::log_fixed(title, lo, hi, n)
    }
    /// The same, the range left as it is, which is positive and not empty.
    pub fn log_fixed(title: &str, lo: f64, hi: f64, n: usize) -> Axis {
        let tick = |k: i32| Tick { at: ticks::pow10(k), label: ticks::decade_label(k) };
        let mut ticks: Vec<Tick> = ticks::decades(lo, hi, n).into_iter().map(tick).collect();
        if ticks.len() < 3 && hi / lo < 1000.0 {
            // Few decades: 1, 2 and 5 of each.
            let (a, b) = (ticks::decade_below(lo), ticks::decade_above(hi));
            let numbers = (a..=b).flat_map(|k| [1.0, 2.0, 5.0].map(|m| m * ticks::pow10(k)));
            let within = numbers.filter(|v| *v >= lo * (1.0 - 1e-9) && *v <= hi * (1.0 + 1e-9));
            ticks = within.map(|at| Tick { at, label: ticks::short(at) }).collect();
        }
        Axis { title: title.to_owned(), lo, hi, scale: Scale::Log, ticks }
    }

    /// Place of `v` along the axis: 0 at `lo`, 1 at `hi`, beyond them outside; far below where a logarithm has no place.
    pub fn place(&self, v: f64) -> f64 {
        match self.scale {
            Scale::Linear => (v - self.lo) / (self.hi - self.lo),
            Scale::Log if v > 0.0 => {
                let lo = ticks::log10(self.lo);
                (ticks::log10(v) - lo) / (ticks::log10(self.hi) - lo)
            }
            Scale::Log => -1e3,
        }
    }
    /// The number at a place: the inverse of [`place`](Self::place).
    pub fn at(&self, t: f64) -> f64 {
        match self.scale {
            Scale::Linear => self.lo + t * (self.hi - self.lo),
            Scale::Log => {
                use sparrow_math::Real;
                self.lo * Real::pow(self.hi / self.lo, t)
            }
        }
    }
}

/// A range that is not empty, and that numbers of a few digits can describe; else 0..1.
fn sound(lo: f64, hi: f64) -> (f64, f64) {
    let wide = hi - lo > 1e-100 && hi - lo > 1e-9 * hi.abs().max(lo.abs());
    if wide && lo.abs().max(hi.abs()) < 1e100 { (lo, hi) } else { (0.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_cover_the_range_at_nice_numbers() {
        for (lo, hi) in [(0.0, 17.2), (-3.0, 0.4), (0.0, 3e-7), (0.0, 1.0), (0.0, 0.95), (12.0, 13.0)] {
            let a = Axis::linear("", lo, hi, 6);
            assert!(a.lo <= lo && a.hi >= hi, "{a:?}");
            let (first, last) = (&a.ticks[0], &a.ticks[a.ticks.len() - 1]);
            assert!((first.at - a.lo).abs() < 1e-9 * (a.hi - a.lo), "{a:?}");
            assert!((last.at - a.hi).abs() < 1e-9 * (a.hi - a.lo) && a.ticks.len() <= 9, "{a:?}");
            let labels: std::collections::BTreeSet<_> = a.ticks.iter().map(|t| &t.label).collect();
            assert_eq!(labels.len(), a.ticks.len(), "labels differ: {a:?}");
        }
    }

    #[test]
    fn decades_cover_the_range() {
        let a = Axis::log("", 3e-3, 42.0, 8);
        assert!((a.lo - 2e-3).abs() < 1e-15 && (a.hi - 50.0).abs() < 1e-9 && a.ticks.len() == 4, "{a:?}");
        assert!((a.place(2e-3)).abs() < 1e-12 && (a.place(50.0) - 1.0).abs() < 1e-12);
        assert!(a.place(0.0) < -1.0);
        assert!((a.at(a.place(0.37)) - 0.37).abs() < 1e-12);
        assert_eq!(Axis::log_fixed("", 0.01, 0.7, 8).ticks.len(), 6);
        assert_eq!(Axis::log("", 0.09, 2.6, 8).ticks.len(), 7);
    }

    #[test]
    fn a_range_that_is_none_is_replaced() {
        for (lo, hi) in
            [(0.0, 0.0), (0.0, f64::NAN), (1.0, f64::INFINITY), (-1.0, -2.0), (0.0, 1e-300), (0.0, 1e300)]
        {
            assert!(Axis::linear("", lo, hi, 5).ticks.len() > 1);
            assert!(Axis::log("", lo, hi, 5).ticks.len() > 1);
        }
    }
}
