//! "Diffuse" reflection: slide 7.

mod bouguer;
mod fit;
mod powder;
mod walk;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "diffuse",
    title: "“Diffuse” reflection",
    about: "A powder reflects more at high angles of incidence, and no distribution of mirrors reflects equally in all directions; multiple reflection does.",
    figures: &[
        Entry { id: "powder", title: "A powder at high incidence", rows: &[7], make: powder::make },
        Entry { id: "bouguer", title: "Bouguer's mirrors", rows: &[7], make: bouguer::make },
        Entry {
            id: "no-diffuse-mirrors",
            title: "No distribution of mirrors is diffuse",
            rows: &[7],
            make: fit::make,
        },
        Entry { id: "many-reflections", title: "Many reflections are", rows: &[7], make: walk::make },
    ],
};
