//! The shape of anisotropic highlights: slides 15 and 16.

mod gnomonic;
pub(crate) mod predict;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "highlights",
    title: "The shape of anisotropic highlights",
    about: "Where the tangent of fibres or grooves is perpendicular to the half vector there is the highlight, whatever the body.",
    figures: &[Entry {
        id: "highlight-curves",
        title: "Where highlights lie",
        rows: &[15, 16],
        make: gnomonic::make,
    }],
};
