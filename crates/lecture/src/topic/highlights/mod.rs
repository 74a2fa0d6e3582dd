//! The shape of anisotropic highlights: slides 15 and 16.

mod curves;
mod gnomonic;
pub(crate) mod predict;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "highlights",
    title: "The shape of anisotropic highlights",
    about: "Where the tangent of fibres or grooves is perpendicular to the half vector there is the highlight, whatever the body.",
    figures: &[
        Entry {
            id: "highlight-curves",
            title: "Where highlights lie",
            rows: &[15, 16],
            make: gnomonic::make,
        },
        Entry { id: "highlight-sphere", title: "Highlights on a sphere", rows: &[15], make: curves::sphere },
        Entry {
            id: "highlight-cylinder",
            title: "Highlights on a cylinder",
            rows: &[15, 16],
            make: curves::on_cylinder,
        },
        Entry { id: "highlight-disc", title: "Highlights on a disc", rows: &[16], make: curves::on_disc },
    ],
};
