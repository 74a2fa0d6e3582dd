//! The paper of 1967: slides 3 to 6.

mod fresnel;
mod g_over_cos;
mod off_specular;
mod rendered;

use crate::entry::{Entry, Topic};

/// The page.
pub(super) const TOPIC: Topic = Topic {
    id: "torrance-sparrow",
    title: "Torrance and Sparrow, 1967",
    about: "The paper's figures 6 and 7, and its comparison with aluminium and magnesium oxide, drawn by its model alone. No measured points are shown, as we have none; numbers that are our choice are said to be.",
    figures: &[
        Entry { id: "fresnel", title: "Fresnel reflectance", rows: &[3], make: fresnel::make },
        Entry {
            id: "g-over-cos",
            title: "G/cos θ in the plane of incidence",
            rows: &[4],
            make: g_over_cos::make,
        },
        Entry {
            id: "off-specular-aluminium",
            title: "Off-specular peaks: aluminium",
            rows: &[5],
            make: off_specular::aluminium,
        },
        Entry {
            id: "off-specular-magnesium-oxide",
            title: "Off-specular peaks: magnesium oxide",
            rows: &[6],
            make: off_specular::magnesium_oxide,
        },
        Entry {
            id: "plates-aluminium",
            title: "Plates and balls of aluminium",
            rows: &[5],
            make: rendered::aluminium,
        },
        Entry {
            id: "plates-magnesium-oxide",
            title: "Plates and balls of magnesium oxide",
            rows: &[6],
            make: rendered::magnesium_oxide,
        },
    ],
};
