//! Caustics.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "caustics",
    title: "Caustics",
    about: "The azimuth of TRT turns back as the ray moves across the fibre; light gathers at the turning point.",
    figures: &[],
};
