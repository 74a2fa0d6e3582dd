//! The checks of a figure: [`Check`].

/// What a number is held to.
#[derive(Clone, Copy, Debug)]
pub enum Bound {
    /// Within `tolerance` of `expected`.
    Near {
        /// The right number.
        expected: f64,
        /// How far from it is still right.
        tolerance: f64,
    },
    /// No more than this.
    AtMost(f64),
    /// No less than this.
    AtLeast(f64),
}

/// A number that a figure is judged by.
#[derive(Clone, Debug)]
pub struct Check {
    /// What the number is.
    pub what: String,
    /// The number.
    pub measured: f64,
    /// What it is held to.
    pub bound: Bound,
}

impl Check {
    /// A number that is known.
    pub fn near(what: impl Into<String>, measured: f64, expected: f64, tolerance: f64) -> Check {
        Check { what: what.into(), measured, bound: Bound::Near { expected, tolerance } }
    }
    /// A number with an upper bound.
    pub fn at_most(what: impl Into<String>, measured: f64, bound: f64) -> Check {
        Check { what: what.into(), measured, bound: Bound::AtMost(bound) }
    }
    /// A number with a lower bound.
    pub fn at_least(what: impl Into<String>, measured: f64, bound: f64) -> Check {
        Check { what: what.into(), measured, bound: Bound::AtLeast(bound) }
    }
    /// The number is as it should be. NaN never is.
    pub fn holds(&self) -> bool {
        match self.bound {
            Bound::Near { expected, tolerance } => (self.measured - expected).abs() <= tolerance,
            Bound::AtMost(bound) => self.measured <= bound,
            Bound::AtLeast(bound) => self.measured >= bound,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_hold_and_break() {
        assert!(Check::near("", 1.04, 1.0, 0.05).holds() && !Check::near("", 1.06, 1.0, 0.05).holds());
        assert!(Check::at_most("", 1.0, 1.0).holds() && !Check::at_most("", 1.1, 1.0).holds());
        assert!(Check::at_least("", 1.0, 1.0).holds() && !Check::at_least("", 0.9, 1.0).holds());
        assert!(!Check::at_most("", f64::NAN, 1.0).holds() && !Check::near("", f64::NAN, 1.0, 9.0).holds());
    }
}
