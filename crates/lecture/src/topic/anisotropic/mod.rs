//! Anisotropic reflection.

mod brushed;
mod horse;
mod wound;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "anisotropic",
    title: "Anisotropic reflection",
    about: "Brushed metal, woven cloth and coats of hair reflect differently along and across their grain.",
    figures: &[
        Entry { id: "brushed", title: "Brushed metal by three models", rows: &[8], make: brushed::make },
        Entry { id: "quarterhorse", title: "Quarterhorse", rows: &[9], make: horse::make },
        Entry { id: "wound", title: "Three models on the same body", rows: &[17], make: wound::make },
    ],
};
