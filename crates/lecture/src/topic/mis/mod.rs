//! Multiple importance sampling.

use crate::entry::Topic;

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "mis",
    title: "Multiple importance sampling",
    about: "Light sampling finds small lights over rough surfaces, sampling of the lobe finds large ones over smooth surfaces. Weights make one estimator of both.",
    figures: &[],
};
