//! What rendered pictures are measured by: curves on them, ridges, the shape of a highlight, circles, peaks.

mod circle;
mod contour;
mod moments;
mod profile;
mod ridge;

pub(crate) use circle::Circle;
pub(crate) use contour::{Segment, contour};
pub(crate) use moments::Moments;
pub(crate) use profile::{peak, smoothed};
pub(crate) use ridge::{Ridge, along};
