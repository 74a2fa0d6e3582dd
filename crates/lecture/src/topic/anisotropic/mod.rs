//! Anisotropic reflection.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "anisotropic",
    title: "Anisotropic reflection",
    about: "Brushed metal, woven cloth and coats of hair reflect differently along and across their grain.",
    figures: &[],
};
