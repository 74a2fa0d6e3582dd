//! The fibre model.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "fibres",
    title: "The fibre model",
    about: "A fibre of glass has three lobes that matter: light reflected (R), passed through (TT), and reflected once inside (TRT).",
    figures: &[],
};
