//! What can be wrong with a wish for a figure: [`PlotError`].

use core::fmt;

/// One fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The word that is wrong, and its place among the words, from 1; none where the whole is meant.
    pub word: Option<(usize, String)>,
    /// What is wrong; what to do.
    pub message: String,
}

impl Fault {
    /// About one word.
    pub(crate) fn at(place: usize, word: &str, message: impl Into<String>) -> Fault {
        Fault { word: Some((place, word.to_owned())), message: message.into() }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.word {
            Some((place, word)) => write!(f, "word {place}, `{word}`: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

/// Everything that is wrong with a wish for a figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlotError {
    /// The faults, at least one, in the order of the words.
    pub faults: Vec<Fault>,
}

impl PlotError {
    /// One fault of the whole.
    pub fn plain(message: impl Into<String>) -> PlotError {
        PlotError { faults: vec![Fault { word: None, message: message.into() }] }
    }
}

impl fmt::Display for PlotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, fault) in self.faults.iter().enumerate() {
            let end = if i == 0 { "" } else { "\n" };
            write!(f, "{end}{fault}")?;
        }
        Ok(())
    }
}

impl core::error::Error for PlotError {}
