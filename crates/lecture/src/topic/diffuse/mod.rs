//! “Diffuse” reflection.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "diffuse",
    title: "“Diffuse” reflection",
    about: "A powder reflects more at high angles of incidence, and no distribution of mirrors reflects equally in all directions; multiple reflection does.",
    figures: &[],
};
