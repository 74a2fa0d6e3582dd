//! The shape of anisotropic highlights.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "highlights",
    title: "The shape of anisotropic highlights",
    about: "Where the tangent of fibres or grooves is perpendicular to the half vector there is the highlight, whatever the body.",
    figures: &[],
};
