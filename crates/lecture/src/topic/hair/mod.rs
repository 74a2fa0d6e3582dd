//! Hair appearance.

mod strand;
mod tresses;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "hair",
    title: "Hair appearance",
    about: "Models, colours and directions of light on tresses of strands.",
    figures: &[
        Entry {
            id: "tresses",
            title: "Tresses of three colours under three lights",
            rows: &[24, 25],
            make: tresses::make,
        },
        Entry { id: "strand", title: "One hair and its two highlights", rows: &[24, 25], make: strand::make },
    ],
};
