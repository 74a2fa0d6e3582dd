//! Kajiya-Kay: slides 18 and 19.

mod curves;
mod herbert;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "kajiya-kay",
    title: "Kajiya-Kay",
    about: "The first model of hair: a diffuse term from the angle between light and tangent, and a specular one from the cone of reflection.",
    figures: &[
        Entry {
            id: "kajiya-kay-terms",
            title: "The diffuse and the specular term",
            rows: &[18],
            make: curves::make,
        },
        Entry { id: "herbert", title: "Herbert", rows: &[19], make: herbert::make },
    ],
};
