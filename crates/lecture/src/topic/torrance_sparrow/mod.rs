//! Torrance and Sparrow, 1967.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "torrance-sparrow",
    title: "Torrance and Sparrow, 1967",
    about: "The paper's figures 6 and 7, and its comparison with aluminium and magnesium oxide, drawn by its model alone. No measured points are shown, as we have none; numbers that are our choice are said to be.",
    figures: &[],
};
