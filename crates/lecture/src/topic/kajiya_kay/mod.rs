//! Kajiya-Kay.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "kajiya-kay",
    title: "Kajiya-Kay",
    about: "The first model of hair: a diffuse term from the angle between light and tangent, and a specular one from the cone of reflection.",
    figures: &[],
};
