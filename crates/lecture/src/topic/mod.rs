//! The pages of the book: [`TOPICS`]. Each topic is a folder with a file for each of its figures.

mod anisotropic;
mod caustics;
mod cylinder;
mod diffuse;
mod fibres;
mod gallery;
mod hair;
mod highlights;
mod kajiya_kay;
mod microfacets;
mod mis;
mod torrance_sparrow;

use crate::entry::Topic;

/// All pages, in the order of the lecture.
pub const TOPICS: [Topic; 12] = [
    microfacets::TOPIC,
    torrance_sparrow::TOPIC,
    diffuse::TOPIC,
    anisotropic::TOPIC,
    cylinder::TOPIC,
    highlights::TOPIC,
    kajiya_kay::TOPIC,
    fibres::TOPIC,
    caustics::TOPIC,
    hair::TOPIC,
    mis::TOPIC,
    gallery::TOPIC,
];
