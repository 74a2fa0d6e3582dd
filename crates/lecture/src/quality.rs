//! How much work goes into a figure: [`Quality`].

/// How much work goes into a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// The whole book within two minutes on two cores; every check is asked and has to hold.
    Draft,
    /// For reading: the whole book within half an hour on two cores.
    Final,
}

impl Quality {
    /// One value or the other, such as numbers of samples.
    pub fn pick<T>(self, draft: T, last: T) -> T {
        match self {
            Quality::Draft => draft,
            Quality::Final => last,
        }
    }
    /// `draft` or `final`.
    pub fn name(self) -> &'static str {
        self.pick("draft", "final")
    }
}
