//! Multiple importance sampling: slides 27 to 29.

mod circular;
mod circular_light;
mod matrix;
mod plates;
mod weights;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "mis",
    title: "Multiple importance sampling",
    about: "Light sampling finds small lights over rough surfaces, sampling of the lobe finds large ones over smooth surfaces. Weights make one estimator of both.",
    figures: &[
        Entry {
            id: "circular-light-errors",
            title: "A circular light over a rough surface: errors",
            rows: &[27],
            make: matrix::make,
        },
        Entry { id: "weights", title: "Two techniques and their weights", rows: &[28], make: weights::make },
        Entry {
            id: "circular-light",
            title: "A circular light over a rough surface",
            rows: &[27],
            make: circular::make,
        },
        Entry { id: "plate-scene", title: "The plate scene", rows: &[29], make: plates::make },
    ],
};
