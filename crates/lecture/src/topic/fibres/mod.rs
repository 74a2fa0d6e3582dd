//! The fibre model: slides 20 to 22.

mod azimuthal;
mod longitudinal;
mod paths;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "fibres",
    title: "The fibre model",
    about: "A fibre of glass has three lobes that matter: light reflected (R), passed through (TT), and reflected once inside (TRT).",
    figures: &[
        Entry { id: "fibre-paths", title: "The paths R, TT and TRT", rows: &[20], make: paths::make },
        Entry { id: "longitudinal", title: "Along the fibre", rows: &[21], make: longitudinal::make },
        Entry { id: "azimuthal", title: "Around the fibre", rows: &[22], make: azimuthal::make },
    ],
};
