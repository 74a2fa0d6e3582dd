//! Microfacets and Torrance-Sparrow.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "microfacets",
    title: "Microfacets and Torrance-Sparrow",
    about: "A rough surface is seen as many small mirrors. Those whose normal lies halfway between light and viewer reflect; D says how many there are.",
    figures: &[],
};
