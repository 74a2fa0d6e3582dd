//! Gallery.

mod models;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "gallery",
    title: "Gallery",
    about: "Every registered model on one scene, with its parameters varied.",
    figures: &[
        Entry { id: "gallery-surfaces", title: "Models of surfaces", rows: &[], make: models::surfaces },
        Entry { id: "gallery-fibres", title: "Models of fibres", rows: &[], make: models::fibres },
    ],
};
