//! What an entry makes: [`Figure`].

use sparrow_plot::draw::table::Table;

use crate::check::Check;
use crate::formula::Formula;

/// The file of a picture.
#[derive(Clone, Debug)]
pub enum Content {
    /// An SVG document.
    Svg(String),
    /// A PNG file.
    Png(Vec<u8>),
}

/// A picture of a figure.
#[derive(Clone, Debug)]
pub struct Picture {
    /// What sets it apart from the others of its figure, for the file's name: `grazing`; empty for an only one.
    pub name: String,
    /// What those read who do not see it.
    pub alt: String,
    /// What stands under it among the pictures of a figure; may be empty.
    pub label: String,
    /// The file.
    pub content: Content,
}

impl Picture {
    /// An SVG document.
    pub fn svg(name: &str, alt: impl Into<String>, svg: String) -> Picture {
        Picture { name: name.to_owned(), alt: alt.into(), label: String::new(), content: Content::Svg(svg) }
    }
    /// A PNG file.
    pub fn png(name: &str, alt: impl Into<String>, png: Vec<u8>) -> Picture {
        Picture { name: name.to_owned(), alt: alt.into(), label: String::new(), content: Content::Png(png) }
    }
    /// With a line under it.
    pub fn labelled(self, label: impl Into<String>) -> Picture {
        Picture { label: label.into(), ..self }
    }
}

/// A figure: pictures, the numbers in them, and what the numbers are held to.
#[derive(Clone, Debug, Default)]
pub struct Figure {
    /// What is to be seen, and what is our own choice; plain text, a line feed parts paragraphs.
    pub caption: String,
    /// Formulas behind it.
    pub formulas: Vec<Formula>,
    /// Commands beside `sparrow lecture --only ID` that show the same or let it be changed.
    pub commands: Vec<String>,
    /// Names and values of what was chosen.
    pub parameters: Vec<(String, String)>,
    /// The pictures.
    pub pictures: Vec<Picture>,
    /// The numbers.
    pub table: Option<Table>,
    /// What the numbers are held to; a figure without checks has not passed.
    pub checks: Vec<Check>,
}

impl Figure {
    /// There are checks, and all hold.
    pub fn passed(&self) -> bool {
        !self.checks.is_empty() && self.checks.iter().all(Check::holds)
    }
    /// With another choice to be told.
    pub fn with(mut self, name: &str, value: impl ToString) -> Figure {
        self.parameters.push((name.to_owned(), value.to_string()));
        self
    }
}
