//! Gallery.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "gallery",
    title: "Gallery",
    about: "Every registered model on one scene, with its parameters varied.",
    figures: &[],
};
