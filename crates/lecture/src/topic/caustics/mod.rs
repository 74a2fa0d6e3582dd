//! Caustics: slide 23.

mod density;
mod fan;
mod screen;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "caustics",
    title: "Caustics",
    about: "The azimuth of TRT turns back as the ray moves across the fibre; light gathers at the turning point.",
    figures: &[
        Entry { id: "caustic-angle", title: "Where TRT turns back", rows: &[23], make: fan::make },
        Entry { id: "caustic-density", title: "Light around a caustic", rows: &[23], make: density::make },
        Entry { id: "caustic-on-screen", title: "The caustic on a screen", rows: &[23], make: screen::make },
    ],
};
