//! Microfacets and Torrance-Sparrow: slides 1 and 2.

mod lobe;
mod shadowing;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "microfacets",
    title: "Microfacets and Torrance-Sparrow",
    about: "A rough surface is seen as many small mirrors. Those whose normal lies halfway between light and viewer reflect; D says how many there are.",
    figures: &[
        Entry { id: "cosine-lobe", title: "The lobe of D = cosˢ", rows: &[1], make: lobe::make },
        Entry { id: "shadowing", title: "Fresnel and shadowing", rows: &[2], make: shadowing::make },
    ],
};
