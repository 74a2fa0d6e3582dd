//! The scenes of the lecture, held in the program: [`SCENES`].

/// Name and text of each scene of `scenes/lecture/`.
pub(crate) const SCENES: &[(&str, &str)] = &[];
