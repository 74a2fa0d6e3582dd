//! What can be wrong with joining films: [`FilmError`].

use core::fmt;

/// Two films, or a film and a tile, that do not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FilmError {
    /// The films differ in width or height.
    Size {
        /// Size of the film added to.
        film: [u32; 2],
        /// Size of the film to be added.
        other: [u32; 2],
    },
    /// One keeps squares for the variance, the other does not.
    Variance,
    /// The tile reaches beyond the film.
    Outside {
        /// Size of the film.
        film: [u32; 2],
        /// First pixel of the tile.
        origin: [u32; 2],
        /// Size of the tile.
        size: [u32; 2],
    },
}

impl fmt::Display for FilmError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FilmError::Size { film, other } => write!(
                f,
                "a film of {} x {} pixels cannot take one of {} x {}; render both parts at one resolution and crop",
                film[0], film[1], other[0], other[1]
            ),
            FilmError::Variance => {
                write!(f, "one film keeps variances and the other does not; render both parts alike")
            }
            FilmError::Outside { film, origin, size } => write!(
                f,
                "a tile of {} x {} pixels at ({}, {}) reaches beyond a film of {} x {}",
                size[0], size[1], origin[0], origin[1], film[0], film[1]
            ),
        }
    }
}

impl core::error::Error for FilmError {}
