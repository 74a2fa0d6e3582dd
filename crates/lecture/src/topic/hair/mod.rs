//! Hair appearance.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "hair",
    title: "Hair appearance",
    about: "Models, colours and directions of light on tresses of strands.",
    figures: &[],
};
