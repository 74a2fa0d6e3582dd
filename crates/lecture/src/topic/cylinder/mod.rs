//! Reflection from a cylinder: slides 10 to 14.

mod azimuth;
mod bundle;
mod cone;
mod half_vector;
mod screen;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "cylinder",
    title: "Reflection from a cylinder",
    about: "A parallel beam leaves a mirror cylinder as a cone around its axis. All fibre models rest on this.",
    figures: &[
        Entry {
            id: "ray-bundle",
            title: "Parallel rays that meet a cylinder",
            rows: &[10],
            make: bundle::make,
        },
        Entry { id: "cone", title: "The cone of reflected rays", rows: &[11], make: cone::rays },
        Entry {
            id: "cone-on-sphere",
            title: "The cone on the sphere of directions",
            rows: &[12],
            make: cone::sphere,
        },
        Entry { id: "azimuths", title: "Light around the cone", rows: &[13], make: azimuth::make },
        Entry {
            id: "half-vector",
            title: "The rule of the half vector",
            rows: &[14],
            make: half_vector::make,
        },
        Entry {
            id: "cone-on-screen",
            title: "The cone on a screen",
            rows: &[10, 11, 12, 13, 14],
            make: screen::make,
        },
    ],
};
