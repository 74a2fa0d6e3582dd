//! How the slides stand: [`Row`].

use super::{Book, Made};
use crate::slide::{SLIDES, Slide, UNTITLED};

/// How a slide stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// All checks of its figures hold.
    Passed,
    /// Some check does not hold.
    Failed,
    /// No figure of it is in this book.
    Absent,
    /// The slide without title and text: there is nothing to check.
    Untitled,
}

/// A slide and its figures.
#[derive(Clone, Debug)]
pub struct Row<'a> {
    /// The slide.
    pub slide: &'static Slide,
    /// Its figures.
    pub figures: Vec<&'a Made>,
    /// How it stands.
    pub standing: Standing,
}

impl Book {
    /// All slides of the lecture.
    pub fn rows(&self) -> Vec<Row<'_>> {
        let row = |slide: &'static Slide| {
            let of = |m: &&Made| m.entry.rows.contains(&slide.row);
            let figures: Vec<&Made> = self.figures.iter().filter(of).collect();
            let standing = match figures.as_slice() {
                [] if slide.row == UNTITLED => Standing::Untitled,
                [] => Standing::Absent,
                all if all.iter().all(|m| m.figure.passed()) => Standing::Passed,
                _ => Standing::Failed,
            };
            Row { slide, figures, standing }
        };
        SLIDES.iter().map(row).collect()
    }
    /// How many slides stand so.
    pub fn count(&self, standing: Standing) -> usize {
        self.rows().iter().filter(|r| r.standing == standing).count()
    }
    /// The figures of which some check does not hold.
    pub fn failed(&self) -> Vec<&Made> {
        self.figures.iter().filter(|m| !m.figure.passed()).collect()
    }
}
