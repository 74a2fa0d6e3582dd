//! Why nothing grows: [`GroomError`].

/// A groom that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GroomError {
    /// A number of the style that means nothing.
    #[error("{name} is {value}; give a number {wanted}")]
    OutOfRange {
        /// What the number is for.
        name: &'static str,
        /// The number.
        value: f64,
        /// What it may be.
        wanted: &'static str,
    },
    /// There is nothing to grow on.
    #[error("the mesh has no faces to grow on; export it with its faces")]
    NoFaces,
    /// All faces are lines or points.
    #[error("the faces have no area to grow on; export the mesh again")]
    NoArea,
    /// A face with a vertex that is not there or not finite.
    #[error("face {face} has a vertex that is missing or not finite; export the mesh again")]
    BadFace {
        /// The face, from 0.
        face: usize,
    },
    /// The flow follows texture coordinates, and there are none.
    #[error("the flow follows texture coordinates and the mesh has none; give a direction instead")]
    NoCoordinates,
    /// The density leaves the whole surface without a strand.
    #[error("no strand grows on an area of {area}; raise the density")]
    NoStrands {
        /// Area of the surface.
        area: f64,
    },
    /// More points than a scene can hold.
    #[error("{n} strands are asked for and {most} of this many segments can be held; lower the density")]
    TooMany {
        /// Strands asked for.
        n: f64,
        /// Most strands.
        most: usize,
    },
    /// A point beyond what single precision holds.
    #[error("the strands reach beyond the largest number; make mesh or length smaller")]
    TooLarge,
}
