//! Reflection from a cylinder.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "cylinder",
    title: "Reflection from a cylinder",
    about: "A parallel beam leaves a mirror cylinder as a cone around its axis. All fibre models rest on this.",
    figures: &[],
};
