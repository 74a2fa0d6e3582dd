//! [`Viewpoint`]: from where a shape is sampled.

use sparrow_math::Vec3;

/// A point from which a shape is sampled.
#[derive(Clone, Copy, Debug)]
pub struct Viewpoint {
    /// The point.
    pub p: Vec3<f32>,
    /// Unit normal of the surface there, if directions are to follow its cosine, as near as a bilinear density can.
    pub n: Option<Vec3<f32>>,
}

impl From<Vec3<f32>> for Viewpoint {
    /// A point in space, to which all directions are alike.
    fn from(p: Vec3<f32>) -> Viewpoint {
        Viewpoint { p, n: None }
    }
}
