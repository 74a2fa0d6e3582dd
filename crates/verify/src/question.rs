//! Questions, and the number types they are asked in.

use serde::Serialize;
use sparrow_models::Property;

/// What a model is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Question {
    /// Is every number finite, none negative, every direction of unit length?
    Finite,
    /// Does the density integrate to the share of samples that is kept?
    Density,
    /// Do samples follow the density?
    Samples,
    /// Is a sample's density what `pdf` says?
    Pdf,
    /// Is a sample's weight value over density?
    Weight,
    /// Is the mean weight the integral of the value?
    Mean,
    /// Does no more light leave than arrived?
    Furnace,
    /// May viewer and light be exchanged, up to the square of the index crossed?
    Reciprocity,
    /// Does `f32` agree with `f64`, and lanes with `f32`?
    Agreement,
}

impl Question {
    /// All of them, in the order of reports.
    pub const ALL: [Question; 9] = [
        Question::Finite,
        Question::Density,
        Question::Samples,
        Question::Pdf,
        Question::Weight,
        Question::Mean,
        Question::Furnace,
        Question::Reciprocity,
        Question::Agreement,
    ];
    /// The word in reports.
    pub fn name(self) -> &'static str {
        match self {
            Question::Finite => "finite",
            Question::Density => "density",
            Question::Samples => "samples",
            Question::Pdf => "pdf",
            Question::Weight => "weight",
            Question::Mean => "mean",
            Question::Furnace => "furnace",
            Question::Reciprocity => "reciprocity",
            Question::Agreement => "agreement",
        }
    }
    /// The whole question.
    pub fn sentence(self) -> &'static str {
        match self {
            Question::Finite => "every number is finite, none negative, directions have unit length",
            Question::Density => "the density integrates to the share of samples that is kept",
            Question::Samples => "samples follow the density (chi-square)",
            Question::Pdf => "the density of a sample is what pdf() says",
            Question::Weight => "the weight of a sample is value times cosine over density",
            Question::Mean => "the mean weight is the integral of value times cosine",
            Question::Furnace => "no more light leaves than arrived",
            Question::Reciprocity => "viewer and light may be exchanged",
            Question::Agreement => "f32 agrees with f64, lanes with f32",
        }
    }
    /// The property it is about, where it is one that a model may say it lacks.
    pub(crate) fn property(self) -> Option<Property> {
        match self {
            Question::Furnace => Some(Property::Energy),
            Question::Reciprocity => Some(Property::Reciprocity),
            Question::Finite
            | Question::Density
            | Question::Samples
            | Question::Pdf
            | Question::Weight
            | Question::Mean
            | Question::Agreement => None,
        }
    }
}

/// The number type a question was asked in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ColumnName {
    /// Double precision: the formula.
    F64,
    /// Single precision: what renders.
    F32,
    /// The batch form.
    Lanes,
}

impl ColumnName {
    /// All of them, in the order of reports.
    pub const ALL: [ColumnName; 3] = [ColumnName::F64, ColumnName::F32, ColumnName::Lanes];
    /// The word in reports.
    pub fn name(self) -> &'static str {
        match self {
            ColumnName::F64 => "f64",
            ColumnName::F32 => "f32",
            ColumnName::Lanes => "lanes",
        }
    }
}
