//! What a scene hands over: [`Shape`]s and their placement.

use sparrow_math::Transform;

/// A triangle mesh in world space.
///
/// The per-vertex lists are empty or as long as `p`. Normals are stored as pbrt-v4 stores them:
/// mapped to world space and already negated where the orientation is reversed.
#[derive(Clone, Debug, Default)]
pub struct TriangleMesh {
    /// Vertices.
    pub p: Vec<[f32; 3]>,
    /// Three vertex numbers a triangle.
    pub indices: Vec<[u32; 3]>,
    /// Shading normals, of any length, or empty.
    pub n: Vec<[f32; 3]>,
    /// Shading tangents, or empty.
    pub s: Vec<[f32; 3]>,
    /// Texture coordinates, or empty: then every triangle has (0,0), (1,0), (1,1).
    pub uv: Vec<[f32; 2]>,
    /// Vertices where motion ends, which each goes to in a straight line; or empty: then they stand still.
    pub p_end: Vec<[f32; 3]>,
    /// Shading normals where motion ends, or empty: then they stay as they are.
    pub n_end: Vec<[f32; 3]>,
}

impl TriangleMesh {
    /// Its vertices move: all have a place where motion ends.
    pub fn deforms(&self) -> bool {
        !self.p.is_empty() && self.p_end.len() == self.p.len()
    }
}

/// A mesh of bilinear patches in world space.
///
/// The per-vertex lists are empty or as long as `p`; normals as in [`TriangleMesh`].
#[derive(Clone, Debug, Default)]
pub struct BilinearMesh {
    /// Vertices.
    pub p: Vec<[f32; 3]>,
    /// Four vertex numbers a patch, in the order p00, p10, p01, p11.
    pub indices: Vec<[u32; 4]>,
    /// Shading normals, of any length, or empty.
    pub n: Vec<[f32; 3]>,
    /// Texture coordinates, or empty: then those of the patch itself.
    pub uv: Vec<[f32; 2]>,
    /// Vertices and normals where motion ends, as in [`TriangleMesh`].
    pub p_end: Vec<[f32; 3]>,
    /// As `p_end`.
    pub n_end: Vec<[f32; 3]>,
}

impl BilinearMesh {
    /// As of a [`TriangleMesh`].
    pub fn deforms(&self) -> bool {
        !self.p.is_empty() && self.p_end.len() == self.p.len()
    }
}

/// How control points make a curve. Segments join where they share control points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CurveBasis {
    /// Straight segments from point to point.
    Linear,
    /// Cubic Bezier segments; each begins with the last point of the one before.
    #[default]
    Bezier,
    /// Uniform cubic B-spline: a strand of `n` points has `n - 3` segments.
    BSpline,
    /// Uniform Catmull-Rom spline through all points, the first and last included, where the tangent is that of the
    /// chord: a strand of `n` points has `n - 1` segments.
    CatmullRom,
}

/// What surface a curve has; see the notes beside `src/curve`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CurveKind {
    /// pbrt-v4's `flat`: a strip that faces every ray.
    #[default]
    Flat,
    /// pbrt-v4's `cylinder`: the same strip with the normals of a cylinder.
    Cylinder,
    /// pbrt-v4's `ribbon`: a strip as wide as an oriented one looks.
    Ribbon,
    /// A tube: the circle at right angles to the curve, swept along it.
    Round,
}

/// Curves in world space.
#[derive(Clone, Debug, Default)]
pub struct CurveSet {
    /// Control points and radii there; `x y z r`.
    pub points: Vec<[f32; 4]>,
    /// The first control point of each strand, which ends where the next one begins.
    pub strands: Vec<u32>,
    /// How control points make a curve.
    pub basis: CurveBasis,
    /// What surface it has.
    pub kind: CurveKind,
    /// Of ribbons: a normal for each end of a segment, one more a strand than it has segments. Else empty.
    pub normals: Vec<[f32; 3]>,
    /// Every segment is cut into `2^split_depth` pieces with boxes of their own: faster, and larger. At most 2.
    pub split_depth: u8,
    /// Control points and radii where motion ends, which each goes to evenly; or empty: then they stand still.
    pub points_end: Vec<[f32; 4]>,
    /// Normals where motion ends, or empty: then they stay as they are.
    pub normals_end: Vec<[f32; 3]>,
}

impl CurveSet {
    /// Its control points move: all have a place where motion ends.
    pub fn deforms(&self) -> bool {
        !self.points.is_empty() && self.points_end.len() == self.points.len()
    }
}

/// A shape. Quadrics stand in their own object space around the z axis; angles are in radians.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Triangles.
    Triangles(TriangleMesh),
    /// Bilinear patches.
    Patches(BilinearMesh),
    /// Curves.
    Curves(CurveSet),
    /// Sphere around the origin, cut at two heights and at an azimuth.
    Sphere {
        /// Radius.
        radius: f32,
        /// Lower cut.
        z_min: f32,
        /// Upper cut.
        z_max: f32,
        /// Azimuth where it ends, at most 2 pi.
        phi_max: f32,
    },
    /// Disk at z = `height`.
    Disk {
        /// Place along z.
        height: f32,
        /// Outer radius.
        radius: f32,
        /// Radius of the hole.
        inner_radius: f32,
        /// Azimuth where it ends, at most 2 pi.
        phi_max: f32,
    },
    /// Open cylinder around z.
    Cylinder {
        /// Radius.
        radius: f32,
        /// Lower end.
        z_min: f32,
        /// Upper end.
        z_max: f32,
        /// Azimuth where it ends, at most 2 pi.
        phi_max: f32,
    },
}

/// A shape at its place.
#[derive(Clone, Debug)]
pub struct ShapeInstance {
    /// The shape.
    pub shape: Shape,
    /// World space from object space, for quadrics; not looked at for meshes and curves, which are in world space.
    pub to_world: Transform,
    /// The orientation is reversed, or the map to world space swaps handedness, but not both.
    pub flip_normal: bool,
}
