//! Curves: hair, fur and ribbons.

/// How control points make a curve; segments of a strand join where they share points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CurveBasis {
    /// Straight from point to point.
    Linear,
    /// Cubic Bezier segments; each begins with the last point of the one before.
    #[default]
    Bezier,
    /// Uniform cubic B-spline.
    BSpline,
    /// Uniform Catmull-Rom spline through all points, the first and last included.
    CatmullRom,
}

impl CurveBasis {
    /// Points of the shortest strand.
    pub fn least(self) -> usize {
        match self {
            CurveBasis::Linear | CurveBasis::CatmullRom => 2,
            CurveBasis::Bezier | CurveBasis::BSpline => 4,
        }
    }
    /// Segments of a strand of `n` points.
    pub fn n_segments(self, n: usize) -> usize {
        match self {
            CurveBasis::Linear | CurveBasis::CatmullRom => n.saturating_sub(1),
            CurveBasis::Bezier => n.saturating_sub(1) / 3,
            CurveBasis::BSpline => n.saturating_sub(3),
        }
    }
    /// The parameter of control point `j` of `n`, counted in segments: with radii that change in proportion to it,
    /// the radius of the curve changes evenly along a strand.
    pub fn parameter(self, j: usize) -> f32 {
        match self {
            CurveBasis::Linear | CurveBasis::CatmullRom => j as f32,
            CurveBasis::Bezier => j as f32 / 3.0,
            CurveBasis::BSpline => j as f32 - 1.0,
        }
    }
}

/// What surface a curve has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CurveKind {
    /// A strip that faces every ray.
    #[default]
    Flat,
    /// The same with the normals of a cylinder.
    Cylinder,
    /// A strip with an orientation.
    Ribbon,
    /// A tube; Sparrow's own.
    Round,
}

/// Strands of control points, in object space.
#[derive(Clone, Debug, Default)]
pub struct Curves {
    /// Control points with radii, `x y z r`.
    pub points: Vec<[f32; 4]>,
    /// The first control point of each strand, which ends where the next one begins.
    pub strands: Vec<u32>,
    /// How control points make a curve.
    pub basis: CurveBasis,
    /// What surface it has.
    pub kind: CurveKind,
    /// Of ribbons: a normal for each end of a segment. Else none.
    pub normals: Vec<[f32; 3]>,
    /// Segments are cut into `2^split_depth` parts for the hierarchy.
    pub split_depth: u8,
    /// Control points with radii where motion ends, one per point, or none: then they stand still.
    pub points_end: Vec<[f32; 4]>,
    /// Normals where motion ends, one per normal, or none: then they stay as they are.
    pub normals_end: Vec<[f32; 3]>,
}

/// Points of all curves of a description, at most.
pub(crate) const MAX_POINTS: usize = 1 << 28;

impl Curves {
    /// Control points of each strand.
    pub fn lengths(&self) -> impl Iterator<Item = usize> {
        let ends = self.strands.iter().skip(1).copied().chain([self.points.len() as u32]);
        self.strands.iter().zip(ends).map(|(&a, b)| b.saturating_sub(a) as usize)
    }
    /// Segments of all strands.
    pub fn n_segments(&self) -> usize {
        self.lengths().map(|n| self.basis.n_segments(n)).sum()
    }
    /// Takes the strands of another, if both are of one sort and there is room.
    pub(crate) fn append(&mut self, other: &Curves) -> bool {
        let alike = self.basis == other.basis
            && self.kind == other.kind
            && self.split_depth == other.split_depth
            && self.points_end.is_empty() == other.points_end.is_empty()
            && self.normals_end.is_empty() == other.normals_end.is_empty();
        if !alike || self.points.len() + other.points.len() > MAX_POINTS {
            return false;
        }
        let first = self.points.len() as u32;
        self.strands.extend(other.strands.iter().map(|s| s + first));
        self.points.extend_from_slice(&other.points);
        self.normals.extend_from_slice(&other.normals);
        self.points_end.extend_from_slice(&other.points_end);
        self.normals_end.extend_from_slice(&other.normals_end);
        true
    }
}
